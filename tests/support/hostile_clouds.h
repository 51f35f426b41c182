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

/// Clouds that no method may measure: numbers that are none, too few points, points that span no
/// surface, planes that miss the body.
std::vector<HostileCase> unmeasurable_clouds();

/// Points of no body, or of one that the plane cuts in no ring, so that there is no truth: a method
/// may refuse them or warn.
std::vector<HostileCase> ringless_clouds();

/// Points of a body with a known girth, spoilt: repeated, crowded, uneven, among outliers, in
/// several shells, inside-out, with holes, in another unit, hardly cut.
std::vector<HostileCase> spoilt_clouds();

}  // namespace instep::test
