#pragma once

#include <array>
#include <cstdint>
#include <vector>

namespace instep {

/// An edge of a cube: along `axis` (0, 1, 2) from the corner of that number. Corner c lies at
/// (c & 1, c >> 1 & 1, c >> 2 & 1).
struct CubeEdge {
  std::uint8_t corner = 0;
  std::uint8_t axis = 0;

  bool operator==(const CubeEdge&) const = default;
};

/// The polygons in which a surface cuts a cube (marching cubes: Lorensen and Cline 1987), by the
/// edges that they cross in order, counter-clockwise seen from outside. Bit c of `inside` tells
/// that corner c lies inside.
///
/// Not a table of 15 drawn cases but the rule behind them: round each face, a run of inside corners
/// is cut off by one line, and the lines of the six faces close to polygons. A face with two inside
/// corners across from each other is cut into two, and its neighbour, which sees the same corners,
/// cuts it likewise: so surfaces of neighbouring cubes always meet.
const std::vector<std::vector<CubeEdge>>& cube_polygons(std::uint8_t inside);

}  // namespace instep
