#include "core/surface/paper/cube_polygons.h"

#include <algorithm>
#include <cstddef>

namespace instep {
namespace {

constexpr std::size_t kCases = 256;
constexpr std::size_t kEdges = 24;  // by corner and axis; half of the numbers are used

using Face = std::array<unsigned, 4>;

/// The corners of the six faces, counter-clockwise seen from outside.
std::array<Face, 6> faces() {
  std::array<Face, 6> all;
  for (unsigned axis = 0; axis < 3; ++axis) {
    const unsigned b = 1U << ((axis + 1) % 3);
    const unsigned c = 1U << ((axis + 2) % 3);
    const unsigned upper = 1U << axis;
    all[2 * axis] = {0, c, b | c, b};
    all[2 * axis + 1] = {upper, upper | b, upper | b | c, upper | c};
  }
  return all;
}

/// Number of the edge between two neighbouring corners.
std::size_t edge_number(unsigned a, unsigned b) {
  const unsigned direction = a ^ b;
  const unsigned axis = direction == 1 ? 0 : direction == 2 ? 1 : 2;
  return 3 * std::min(a, b) + axis;
}

CubeEdge edge_of(std::size_t number) {
  return {static_cast<std::uint8_t>(number / 3), static_cast<std::uint8_t>(number % 3)};
}

bool is_inside(unsigned inside, unsigned corner) {
  return ((inside >> corner) & 1U) != 0;
}

/// For each crossed edge the next one of its polygon: on the face on which a run of inside corners
/// begins at this edge, the edge at which it ends. On the other face of the edge a run ends.
std::array<std::size_t, kEdges> next_edges(unsigned inside) {
  std::array<std::size_t, kEdges> next;
  next.fill(kEdges);
  for (const Face& face : faces()) {
    for (std::size_t i = 0; i < face.size(); ++i) {
      if (is_inside(inside, face[i]) || !is_inside(inside, face[(i + 1) % 4])) continue;
      std::size_t last = i + 1;
      while (is_inside(inside, face[(last + 1) % 4])) ++last;
      next[edge_number(face[i], face[(i + 1) % 4])] =
          edge_number(face[last % 4], face[(last + 1) % 4]);
    }
  }
  return next;
}

std::vector<std::vector<CubeEdge>> polygons_of(unsigned inside) {
  auto next = next_edges(inside);
  std::vector<std::vector<CubeEdge>> polygons;
  for (std::size_t start = 0; start < kEdges; ++start) {
    std::vector<CubeEdge> polygon;
    for (std::size_t edge = start; next[edge] != kEdges;) {
      polygon.push_back(edge_of(edge));
      const std::size_t following = next[edge];
      next[edge] = kEdges;
      edge = following;
    }
    if (!polygon.empty()) polygons.push_back(std::move(polygon));
  }
  return polygons;
}

std::vector<std::vector<std::vector<CubeEdge>>> all_cases() {
  std::vector<std::vector<std::vector<CubeEdge>>> cases;
  for (unsigned inside = 0; inside < kCases; ++inside) cases.push_back(polygons_of(inside));
  return cases;
}

}  // namespace

const std::vector<std::vector<CubeEdge>>& cube_polygons(std::uint8_t inside) {
  static const auto cases = all_cases();
  return cases[inside];
}

}  // namespace instep
