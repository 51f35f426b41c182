#include "core/fusion/wall_foot.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "core/fusion/ground_plan.h"
#include "core/geometry/point_index.h"

namespace instep {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;
using Matrix5 = Eigen::Matrix<double, 5, 5>;
using Vector5 = Eigen::Matrix<double, 5, 1>;

constexpr double kWallCellMm = 6.0;      // within it the lowest seen points are one piece of wall
constexpr double kLowestLayerMm = 1.5;   // above the lowest point, still taken as lowest
constexpr double kInwardRadiusMm = 5.0;  // of the ground searched for lower skin, a cell inward
constexpr double kMostUpward = 0.5;      // z of the normal of a wall; above, it is the foot's back
constexpr double kMostSine = 0.95;
constexpr double kLeastLean = 0.15;       // sine of a wall's lean that is not its noise
constexpr double kRadiusOfLean = 60.0;    // mm of radius that a lean allows
constexpr double kLeastSameFacing = 0.3;  // cosine, of normals of one piece of wall
constexpr double kFewestWallPoints = 8;
constexpr double kRidge = 1e-3;  // keeps a fit to few or crowded points from leaning

PointCloud part_below(const PointCloud& cloud, double z) {
  std::vector<std::size_t> indices;
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    if (cloud.positions[i].z() < z) indices.push_back(i);
  }
  return cloud.subset(indices);
}

/// The lowest seen points above one cell.
struct LowestPoints {
  Vector3d position = Vector3d::Zero();  ///< mean
  Vector3d normal = Vector3d::Zero();    ///< sum
  double count = 0.0;
};

/// Height of the lowest point above each cell; infinite where there is none.
std::vector<double> lowest_heights(const GroundPlan& plan, const PointCloud& foot) {
  std::vector<double> lowest(plan.cells(), std::numeric_limits<double>::infinity());
  for (const auto& point : foot.positions) {
    double& height = lowest[plan.cell_of(point)];
    height = std::min(height, point.z());
  }
  return lowest;
}

/// Whether the wall goes on downward further in: it leans, and this is not its foot.
bool goes_on_inward(const GroundPlan& plan, const std::vector<double>& lowest,
                    const LowestPoints& points) {
  const Vector3d inward =
      -kWallCellMm * Vector3d(points.normal.x(), points.normal.y(), 0.0).normalized();
  bool lower = false;
  plan.disc((points.position + inward).head<2>(), kInwardRadiusMm, [&](std::size_t cell) {
    lower = lower || lowest[cell] < points.position.z() - kLowestLayerMm;
  });
  return lower;
}

std::vector<LowestPoints> lowest_points(const PointCloud& foot, double most_z) {
  const GroundPlan plan = GroundPlan::round(foot, kWallCellMm, kWallCellMm);
  const auto lowest = lowest_heights(plan, foot);
  std::vector<LowestPoints> found(plan.cells());
  for (std::size_t i = 0; i < foot.size(); ++i) {
    const auto& point = foot.positions[i];
    const std::size_t cell = plan.cell_of(point);
    if (point.z() > std::min(lowest[cell] + kLowestLayerMm, most_z)) continue;
    found[cell].position += point;
    found[cell].normal += foot.normals[i];
    found[cell].count += 1.0;
  }
  std::erase_if(found, [](const LowestPoints& points) { return points.count == 0.0; });
  for (auto& points : found) points.position /= points.count;
  std::erase_if(found, [&](const LowestPoints& points) {
    return points.normal.normalized().z() > kMostUpward || goes_on_inward(plan, lowest, points);
  });
  return found;
}

/// How a piece of wall ends below.
struct WallEnd {
  Vector3d normal = Vector3d::Zero();
  double bend_radius = std::numeric_limits<double>::infinity();
};

/// Fits a parabola to the wall above its lowest points: over the way up, nearer points counting
/// more, and over the way along. Positions, not normals: those were fitted in windows that end
/// where the seen skin does, and so belong to places further up.
std::optional<WallEnd> fit_end(const PointCloud& foot, const PointIndex& index,
                               const LowestPoints& lowest, double reach) {
  const Vector3d normal = lowest.normal.normalized();
  const Vector3d along = Vector3d::UnitZ().cross(normal).normalized();
  const Vector3d up = normal.cross(along);
  Matrix5 matrix = Matrix5::Zero();
  Vector5 right = Vector5::Zero();
  double count = 0.0;
  for (const auto& neighbour : index.within(lowest.position, reach)) {
    if (foot.normals[neighbour.index].dot(normal) < kLeastSameFacing) continue;
    const Vector3d offset = foot.positions[neighbour.index] - lowest.position;
    const double way = up.dot(offset);
    const double aside = along.dot(offset);
    if (std::abs(aside) > kWallCellMm) continue;
    const double weight = std::exp(-0.5 * std::pow(2.0 * way / reach, 2));
    Vector5 row;
    row << 1.0, way, way * way, aside, aside * aside;
    matrix += weight * row * row.transpose();
    right += weight * normal.dot(offset) * row;
    count += weight;
  }
  if (count < kFewestWallPoints) return std::nullopt;
  matrix.diagonal().tail<4>().array() += kRidge * count;
  const Vector5 fitted = matrix.ldlt().solve(right);
  if (!fitted.allFinite()) return std::nullopt;
  WallEnd end;
  end.normal = (normal - fitted(1) * up).normalized();
  if (fitted(2) < 0.0) {
    end.bend_radius = std::pow(1.0 + fitted(1) * fitted(1), 1.5) / (-2.0 * fitted(2));
  }
  return end;
}

}  // namespace

WallFoot::WallFoot(const Vector2d& place, const Vector2d& out, double height, double sine_of_dip,
                   double bend_radius, const WallSettings& settings)
    : place_(place), out_(out), height_(std::max(0.0, height)) {
  const double sine = std::clamp(sine_of_dip, 0.0, kMostSine);
  const double cosine = std::sqrt(1.0 - sine * sine);
  // An upright wall whose foot was hidden says nothing of its rounding; one that leans in does.
  const double widest =
      settings.usual_radius_mm + kRadiusOfLean * std::max(0.0, sine - kLeastLean) / (1.0 - sine);
  const double rounding = std::min(height_ / (1.0 - sine), widest);
  const double straight = height_ - rounding * (1.0 - sine);  // height lost before the arc begins
  contact_ = std::clamp(straight * sine / cosine + rounding * cosine, settings.least_inset_mm,
                        settings.most_inset_mm);
  radius_ = std::min(bend_radius, rounding);
  const bool arch = bend_radius < rounding;
  const double down = arch ? 0.0 : straight;
  arc_begins_ = down * sine / cosine;
  centre_ = {arc_begins_ + radius_ * cosine, height_ - down + radius_ * sine};
  // The arc ends where its tangent points at the contact.
  const Vector2d to_contact = Vector2d(contact_, 0.0) - centre_;
  const double distance = to_contact.norm();
  if (!(distance > radius_)) {
    arc_ends_ = contact_;
    return;
  }
  const double turn = std::acos(radius_ / distance);
  const Vector2d towards = to_contact / distance;
  const Vector2d touch(std::cos(turn) * towards.x() + std::sin(turn) * towards.y(),
                       std::cos(turn) * towards.y() - std::sin(turn) * towards.x());
  arc_ends_ = centre_.x() + radius_ * touch.x();
}

double WallFoot::skin_height(double inward) const {
  if (inward >= contact_) return 0.0;
  const auto on_arc = [&](double at) {
    const double offset = std::clamp((at - centre_.x()) / std::max(radius_, 1e-9), -1.0, 1.0);
    return centre_.y() - radius_ * std::sqrt(1.0 - offset * offset);
  };
  if (inward < arc_begins_) return std::lerp(height_, on_arc(arc_begins_), inward / arc_begins_);
  if (inward <= arc_ends_) return std::max(0.0, on_arc(inward));
  const double end = std::max(0.0, on_arc(arc_ends_));
  return end * (contact_ - inward) / std::max(contact_ - arc_ends_, 1e-9);
}

std::vector<WallFoot> find_wall_feet(const PointCloud& foot, double standing_height_mm,
                                     const WallSettings& settings) {
  std::vector<WallFoot> feet;
  const double most_z = standing_height_mm + settings.highest_mm;
  const PointCloud low = part_below(foot, most_z + settings.bend_reach_mm);
  if (low.empty()) return feet;
  const PointIndex index(low.positions);
  for (const auto& lowest : lowest_points(low, most_z)) {
    const auto fitted = fit_end(low, index, lowest, settings.bend_reach_mm);
    const WallEnd end = fitted.value_or(WallEnd{lowest.normal.normalized()});
    const double level = end.normal.head<2>().norm();
    if (!(level > std::sqrt(1.0 - kMostSine * kMostSine))) continue;
    feet.emplace_back(lowest.position.head<2>(), end.normal.head<2>() / level,
                      lowest.position.z() - standing_height_mm, -end.normal.z(), end.bend_radius,
                      settings);
  }
  return feet;
}

}  // namespace instep
