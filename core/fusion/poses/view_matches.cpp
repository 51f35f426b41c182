#include "core/fusion/poses/view_matches.h"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "core/mean.h"
#include "core/median.h"
#include "core/normal_spread.h"

namespace instep {
namespace {

using Eigen::Vector3d;

constexpr double kLeastNormalCosine = 0.85;
constexpr double kLeastViewCosine = 0.2;  // of a surface that another camera can see
/// What even a pixel that lies still may be off by, by its lens and its unit of depth.
constexpr double kLeastSigmaMm = 0.05;

PointCloud even_subset(const PointCloud& cloud, std::size_t most) {
  std::vector<std::size_t> indices;
  const double stride =
      std::max(1.0, static_cast<double>(cloud.size()) / static_cast<double>(most));
  for (double at = 0.0; at < static_cast<double>(cloud.size()); at += stride) {
    indices.push_back(static_cast<std::size_t>(at));
  }
  return cloud.subset(indices);
}

/// All queries of `view`, or one in `stride`, that find the same surface in `other` within `reach`.
void match_pair(const std::vector<MovingView>& views, std::size_t view, std::size_t other,
                double reach, std::size_t stride, std::vector<ViewMatch>& matches) {
  const auto& source = views[view];
  const auto& target = views[other];
  const Eigen::Affine3d station_from_other = target.correction();
  const Eigen::Affine3d other_from_view = station_from_other.inverse() * source.correction();
  for (std::size_t i = 0; i < source.queries.size(); i += stride) {
    // As if turned alone: by a stretch of a percent a normal turns by less than it is known to.
    const Vector3d normal = (other_from_view.linear() * source.queries.normals[i]).normalized();
    if (normal.dot(target.towards_camera) < kLeastViewCosine) continue;
    const Vector3d point = other_from_view * source.queries.positions[i];
    const auto found = target.index->nearest(point, 1);
    if (found.empty() || found[0].squared_distance > reach * reach) continue;
    const Vector3d& partner = target.targets.positions[found[0].index];
    const Vector3d& partner_normal = target.targets.normals[found[0].index];
    if (normal.dot(partner_normal) < kLeastNormalCosine) continue;
    const Vector3d middle = (normal + partner_normal).normalized();
    const double variance = std::pow(source.queries.sigma_mm[i], 2) +
                            std::pow(target.targets.sigma_mm[found[0].index], 2) +
                            kLeastSigmaMm * kLeastSigmaMm;
    matches.push_back({view, other, i, found[0].index, station_from_other * point,
                       station_from_other.linear() * middle, middle.dot(point - partner),
                       variance});
  }
}

/// What the corrections of poses took away from the distance of a match.
double taken_away(const std::vector<MovingView>& views, const ViewMatch& match) {
  const Vector3d foot = match.point - match.distance * match.normal;
  const Vector3d given = views[match.view].pose_correction.inverse() * match.point -
                         views[match.other].pose_correction.inverse() * foot;
  return match.normal.dot(given) - match.distance;
}

}  // namespace

Eigen::Matrix3d MovingView::stretch() const {
  const Vector3d axis = optical_axis();
  return (1.0 + wider) * Eigen::Matrix3d::Identity() + (deeper - wider) * axis * axis.transpose();
}

Eigen::Affine3d MovingView::correction() const {
  Eigen::Affine3d stretched;
  stretched.linear() = stretch();
  stretched.translation() = centroid - stretched.linear() * centroid;
  return pose_correction * stretched;
}

std::vector<MovingView> moving_views(const std::vector<PosedCloud>& views, std::size_t queries,
                                     std::size_t targets) {
  std::vector<MovingView> moving(views.size());
  for (std::size_t i = 0; i < views.size(); ++i) {
    const auto& [cloud, station_from_camera] = views[i];
    moving[i].station_from_camera = station_from_camera;
    const bool can_be_matched = !cloud.empty() && cloud.has_normals() && cloud.has_sigma() &&
                                !cloud.view_directions.empty();
    if (!can_be_matched) continue;
    moving[i].queries = even_subset(cloud, queries);
    moving[i].targets = even_subset(cloud, targets);
    moving[i].index = std::make_unique<PointIndex>(moving[i].targets.positions);
    moving[i].centroid = mean_of(moving[i].targets.positions);
    moving[i].towards_camera = mean_of(moving[i].targets.view_directions).normalized();
    moving[i].taking_part = true;
  }
  return moving;
}

std::vector<ViewMatch> match_views(const std::vector<MovingView>& views, double reach,
                                   std::size_t stride) {
  std::vector<ViewMatch> matches;
  for (std::size_t view = 0; view < views.size(); ++view) {
    for (std::size_t other = 0; other < views.size(); ++other) {
      if (view == other || !views[view].taking_part || !views[other].taking_part) continue;
      match_pair(views, view, other, reach, stride, matches);
    }
  }
  return matches;
}

double median_residual(const std::vector<ViewMatch>& matches) {
  std::vector<double> distances;
  for (const auto& match : matches) distances.push_back(std::abs(match.distance));
  return median(std::move(distances));
}

double unexplained(const std::vector<ViewMatch>& matches) {
  std::vector<double> sigmas;
  std::vector<double> in_sigmas;
  for (const auto& match : matches) {
    sigmas.push_back(std::sqrt(match.variance));
    in_sigmas.push_back(std::abs(match.distance) / sigmas.back());
  }
  const double spread = kSigmaInMedians * median(std::move(in_sigmas));
  return std::sqrt(std::max(0.0, spread * spread - 1.0)) * median(std::move(sigmas));
}

double taken_away(const std::vector<MovingView>& views, const std::vector<ViewMatch>& matches) {
  double squares = 0.0;
  double weights = 0.0;
  for (const auto& match : matches) {
    const double square = std::pow(taken_away(views, match), 2);
    const double weight = square / (square + match.variance);
    squares += weight * square;
    weights += weight;
  }
  return weights > 0.0 ? std::sqrt(squares / weights) : 0.0;
}

std::vector<ViewMatch> matches_of(std::size_t view, const std::vector<ViewMatch>& all) {
  std::vector<ViewMatch> own;
  std::copy_if(all.begin(), all.end(), std::back_inserter(own),
               [view](const ViewMatch& match) { return match.view == view; });
  return own;
}

}  // namespace instep
