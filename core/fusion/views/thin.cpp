#include "core/fusion/views/thin.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/geometry/voxel_grid.h"
#include "core/median.h"

namespace instep {
namespace {

using Eigen::Vector3d;

constexpr double kLeastNormalCosine = 0.5;
constexpr double kSheetSigmas = 4.0;
constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();

/// What one view says of the place of a chosen point.
struct ViewMean {
  double weight = 0.0;
  double height = 0.0;    ///< weighted sum
  double variance = 0.0;  ///< weighted sum
  double count = 0.0;
};

class Thinning {
 public:
  Thinning(const ViewedCloud& points, const ThinSettings& settings)
      : points_(points.cloud),
        views_(points.views),
        settings_(settings),
        grid_(points.cloud.positions, reach(points.cloud.sigma_mm, settings.spacing_mm)) {}

  ThinnedCloud run(std::size_t views) {
    choose_and_assign();
    ThinnedCloud thinned;
    thinned.shares = Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(views),
                                           static_cast<Eigen::Index>(chosen_.size()));
    for (std::size_t i = 0; i < chosen_.size(); ++i) add_mean(i, thinned);
    return thinned;
  }

 private:
  /// How far a point looks: along the surface, and across it as far as the noise goes.
  static double reach(const std::vector<double>& sigma_mm, double spacing_mm) {
    return std::max(spacing_mm, 2.5 * median(sigma_mm));
  }

  /// Distance from a chosen point along the surface, or infinity if it is another surface.
  double distance(std::size_t chosen, std::size_t point) const {
    const Vector3d offset = points_.positions[point] - points_.positions[chosen];
    const Vector3d& normal = points_.normals[chosen];
    const double squared = offset.squaredNorm();
    const double height = normal.dot(offset);
    const double along = std::sqrt(std::max(0.0, squared - height * height));
    const double sigma = std::max(points_.sigma_mm[chosen], points_.sigma_mm[point]);
    const double sheet = kSheetSigmas * sigma + 0.5 * settings_.spacing_mm;
    const bool same = along < settings_.spacing_mm && std::abs(height) < sheet &&
                      normal.dot(points_.normals[point]) > kLeastNormalCosine;
    return same ? along : std::numeric_limits<double>::infinity();
  }

  /// Each point joins the nearest chosen point near it, or is chosen itself.
  void choose_and_assign() {
    std::vector<std::vector<std::uint32_t>> chosen_in(grid_.cell_count());
    for (std::size_t cell = 0; cell < grid_.cell_count(); ++cell) {
      for (const std::uint32_t point : grid_.members(cell)) {
        double best = std::numeric_limits<double>::infinity();
        std::uint32_t joined = kNone;
        grid_.each_near(cell, [&](std::size_t other) {
          for (const std::uint32_t number : chosen_in[other]) {
            const double away = distance(chosen_[number], point);
            if (away >= best) continue;
            best = away;
            joined = number;
          }
        });
        if (joined == kNone) {
          joined = static_cast<std::uint32_t>(chosen_.size());
          chosen_.push_back(point);
          members_.emplace_back();
          chosen_in[cell].push_back(joined);
        }
        members_[joined].push_back(point);
      }
    }
  }

  void add_mean(std::size_t number, ThinnedCloud& thinned) const {
    const std::size_t chosen = chosen_[number];
    const Vector3d& origin = points_.positions[chosen];
    const Vector3d& chosen_normal = points_.normals[chosen];
    Vector3d along = Vector3d::Zero();
    Vector3d normal = Vector3d::Zero();
    Vector3d view = Vector3d::Zero();
    double weights = 0.0;
    std::vector<std::pair<std::uint16_t, ViewMean>> by_view;
    for (const std::uint32_t point : members_[number]) {
      const Vector3d offset = points_.positions[point] - origin;
      const double variance = points_.sigma_mm[point] * points_.sigma_mm[point];
      const double weight = 1.0 / variance;
      const double height = 0.5 * (chosen_normal + points_.normals[point]).dot(offset);
      along += weight * (offset - chosen_normal.dot(offset) * chosen_normal);
      normal += weight * points_.normals[point];
      view += weight * points_.view_directions[point];
      weights += weight;
      auto& mean = mean_of(by_view, views_[point]);
      mean.weight += weight;
      mean.height += weight * height;
      mean.variance += weight * variance;
      mean.count += 1.0;
    }
    const auto [height, sigma] =
        joined(by_view, thinned.shares.col(static_cast<Eigen::Index>(number)));
    thinned.cloud.positions.push_back(origin + along / weights + height * chosen_normal);
    thinned.cloud.normals.push_back(normal.normalized());
    thinned.cloud.view_directions.push_back(view.normalized());
    thinned.cloud.sigma_mm.push_back(sigma);
  }

  static ViewMean& mean_of(std::vector<std::pair<std::uint16_t, ViewMean>>& by_view,
                           std::uint16_t view) {
    for (auto& [known, mean] : by_view) {
      if (known == view) return mean;
    }
    return by_view.emplace_back(view, ViewMean{}).second;
  }

  /// Mean height of the views and its sigma, and how much each view counts.
  std::pair<double, double> joined(const std::vector<std::pair<std::uint16_t, ViewMean>>& by_view,
                                   Eigen::Ref<Eigen::VectorXd> shares) const {
    const double shared = settings_.correlated_share * settings_.correlated_share;
    const double own = settings_.view_sigma_mm * settings_.view_sigma_mm;
    double weights = 0.0;
    double height = 0.0;
    double squares = 0.0;
    for (const auto& [view, mean] : by_view) {
      const double single = mean.variance / mean.weight;
      const double variance = single * ((1.0 - shared) / mean.count + shared) + own;
      const double view_height = mean.height / mean.weight;
      weights += 1.0 / variance;
      shares(view) = 1.0 / variance;
      height += view_height / variance;
      squares += view_height * view_height / variance;
    }
    height /= weights;
    shares /= weights;
    // Views that disagree by more than their sigmas say (Birge's ratio) are trusted less.
    const double freedom = static_cast<double>(by_view.size()) - 1.0;
    const double chi2 = std::max(0.0, squares - height * height * weights);
    const double birge = freedom > 0.0 ? std::max(1.0, chi2 / (4.0 * freedom)) : 1.0;
    return {height, std::sqrt(birge / weights)};
  }

  const PointCloud& points_;
  const std::vector<std::uint16_t>& views_;
  const ThinSettings& settings_;
  VoxelGrid grid_;
  std::vector<std::size_t> chosen_;                  ///< point indices
  std::vector<std::vector<std::uint32_t>> members_;  ///< of each chosen point
};

}  // namespace

ViewedCloud subset(const ViewedCloud& points, const std::vector<std::size_t>& indices) {
  ViewedCloud part;
  part.cloud = points.cloud.subset(indices);
  for (const std::size_t index : indices) part.views.push_back(points.views[index]);
  return part;
}

ThinnedCloud thin(const ViewedCloud& points, std::size_t views, const ThinSettings& settings) {
  if (points.cloud.empty()) return {};
  return Thinning(points, settings).run(views);
}

}  // namespace instep
