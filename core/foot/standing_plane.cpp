#include "core/foot/standing_plane.h"

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "core/geometry/polygon.h"

namespace instep {
namespace {

using Eigen::Vector3d;
using Points = std::vector<Vector3d>;

constexpr double kStrayShare = 5e-4;
constexpr double kFootprintShareOfSize = 1.0 / 40.0;
constexpr double kSmallestFootprintMm2 = 2500.0;
constexpr double kClearlyLarger = 1.25;
constexpr int kRounds = 6;
constexpr std::size_t kLargestSample = 40000;

Points even_sample(const Points& points) {
  const std::size_t step = points.size() / kLargestSample + 1;
  Points sample;
  for (std::size_t i = 0; i < points.size(); i += step) sample.push_back(points[i]);
  return sample;
}

double diameter(const Points& points) {
  Eigen::AlignedBox3d box;
  for (const auto& point : points) box.extend(point);
  return box.diagonal().norm();
}

Points footprint(const Points& points, const StandingPlane& plane, double thickness) {
  Points low;
  for (const auto& point : points) {
    if (plane.up.dot(point) - plane.height_mm < thickness) low.push_back(point);
  }
  return low;
}

double footprint_area(const Points& points, const StandingPlane& plane, double thickness) {
  const RigidTransform standing = plane.standing_from_input();
  std::vector<Eigen::Vector2d> flat;
  for (const auto& point : footprint(points, plane, thickness)) {
    flat.push_back((standing * point).head<2>());
  }
  return std::abs(signed_area(convex_hull(std::move(flat))));
}

struct PrincipalAxes {
  Eigen::Matrix3d directions;  ///< columns, the least spread first
};

PrincipalAxes principal_axes(const Points& points) {
  Vector3d mean = Vector3d::Zero();
  for (const auto& point : points) mean += point;
  mean /= static_cast<double>(points.size());
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
  for (const auto& point : points) covariance += (point - mean) * (point - mean).transpose();
  return {Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(covariance).eigenvectors()};
}

/// Tilts the plane until it fits its own footprint.
StandingPlane settled(const Points& points, StandingPlane plane, double thickness) {
  for (int round = 0; round < kRounds; ++round) {
    const Points low = footprint(points, plane, thickness);
    if (low.size() < 3) return plane;
    Vector3d up = principal_axes(low).directions.col(0);
    if (up.dot(plane.up) < 0.0) up = -up;
    plane = plane_below(points, up);
  }
  return plane;
}

struct Candidate {
  StandingPlane plane;
  double area = 0.0;
};

void keep_larger(Candidate& best, const Points& points, const StandingPlane& plane,
                 double thickness, double advantage) {
  const double area = footprint_area(points, plane, thickness);
  if (area > advantage * best.area) best = {plane, area};
}

}  // namespace

RigidTransform StandingPlane::standing_from_input() const {
  RigidTransform transform = RigidTransform::Identity();
  transform.linear() = Eigen::Quaterniond::FromTwoVectors(up, Vector3d::UnitZ()).toRotationMatrix();
  transform.translation() = -height_mm * Vector3d::UnitZ();
  return transform;
}

StandingPlane plane_below(const Points& points, const Vector3d& up) {
  std::vector<double> heights;
  heights.reserve(points.size());
  for (const auto& point : points) heights.push_back(up.dot(point));
  const auto strays = static_cast<std::ptrdiff_t>(kStrayShare * static_cast<double>(points.size()));
  std::nth_element(heights.begin(), heights.begin() + strays, heights.end());
  return {up, heights[static_cast<std::size_t>(strays)]};
}

Result<StandingPlane> find_standing_plane(const Points& points) {
  const Points sample = even_sample(points);
  const double thickness = kFootprintShareOfSize * diameter(sample);
  Candidate best;
  // z up is the habit of files, so it is tried first and wins a tie.
  for (const int axis : {2, 1, 0}) {
    for (const double sign : {1.0, -1.0}) {
      const StandingPlane plane = plane_below(sample, sign * Vector3d::Unit(axis));
      keep_larger(best, sample, plane, thickness, axis == 2 && sign > 0.0 ? 1.0 : kClearlyLarger);
    }
  }
  const PrincipalAxes axes = principal_axes(sample);
  for (int axis = 0; axis < 3; ++axis) {
    for (const double sign : {1.0, -1.0}) {
      const StandingPlane rough = plane_below(sample, sign * axes.directions.col(axis));
      keep_larger(best, sample, settled(sample, rough, thickness), thickness, kClearlyLarger);
    }
  }
  if (best.area < kSmallestFootprintMm2) {
    return fail(ErrorCode::kInvalidInput, "the cloud has no flat support as large as a foot's",
                "measure one whole foot, in millimetres");
  }
  return best.plane;
}

}  // namespace instep
