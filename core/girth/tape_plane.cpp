#include "core/girth/tape_plane.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "core/geometry/point_cloud.h"

namespace instep {
namespace {

/// Height of the triangle over its longest side, relative to that side, below which three points
/// are taken for a line: one that is off by a six-thousandth of that side, 0.01 mm of 50, turns
/// their plane by a degree.
constexpr double kFlattestTriangle = 0.01;

}  // namespace

Result<TapePlane> TapePlane::through(const Eigen::Vector3d& c1, const Eigen::Vector3d& c2,
                                     const Eigen::Vector3d& c3) {
  for (const auto* point : {&c1, &c2, &c3}) {
    if (!point->allFinite() || point->cwiseAbs().maxCoeff() > kLargestCoordinateMm) {
      return fail(ErrorCode::kInvalidInput,
                  "a control point of the tape plane is no number or further than 100 m away",
                  "give nine finite coordinates in millimetres");
    }
  }
  const double longest = std::max({(c2 - c1).norm(), (c3 - c2).norm(), (c1 - c3).norm()});
  const Eigen::Vector3d cross = (c2 - c1).cross(c3 - c1);
  if (!(cross.norm() > kFlattestTriangle * longest * longest)) {
    return fail(ErrorCode::kInvalidInput,
                "the control points of the tape plane lie on one line, or so nearly that they "
                "do not tell how the plane is turned round it",
                "give three points that span a plane, the third one well beside the line");
  }
  TapePlane plane;
  plane.control_points_ = {c1, c2, c3};
  plane.normal_ = cross.normalized();
  plane.u_ = (c2 - c1).normalized();
  plane.v_ = plane.normal_.cross(plane.u_);
  return plane;
}

TapePlane TapePlane::turned(double radians) const {
  TapePlane plane = *this;
  plane.u_ = std::cos(radians) * u_ + std::sin(radians) * v_;
  plane.v_ = normal_.cross(plane.u_);
  return plane;
}

TapePlane TapePlane::transformed(const RigidTransform& target_from_source) const {
  TapePlane plane = *this;
  for (auto& point : plane.control_points_) point = target_from_source * point;
  plane.u_ = target_from_source.linear() * u_;
  plane.v_ = target_from_source.linear() * v_;
  plane.normal_ = target_from_source.linear() * normal_;
  return plane;
}

}  // namespace instep
