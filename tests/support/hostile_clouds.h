#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "core/geometry/point_cloud.h"
#include "core/girth/tape_plane.h"
#include "tests/support/cylinder_tape.h"

namespace instep::test {

/// A cloud that asks for a wrong girth, and what is true of it.
struct HostileCloud {
  PointCloud cloud;
  TapePlane plane = level_plane();
  /// Stretched girth of the body from which the points were taken. Nothing where there is no body,
  /// or none that the plane cuts in a ring: then every number is wrong.
  std::optional<double> truth_mm;
};

/// One of them, made when it is wanted; the name is fit for a test's.
struct HostileCase {
  std::string name;
  std::function<HostileCloud()> make;
};

/// Numbers that are none, copies and crowds, points that form no body or a broken one, uneven
/// spacing, outliers, and planes that hardly meet the body. All truths are analytic.
std::vector<HostileCase> hostile_cases();

}  // namespace instep::test
