#include "core/surface/paper/cube_polygons.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <set>

namespace instep {
namespace {

bool is_inside(unsigned inside, unsigned corner) {
  return ((inside >> corner) & 1U) != 0;
}

TEST(CubePolygons, CrossEachEdgeBetweenInsideAndOutsideExactlyOnce) {
  for (unsigned inside = 0; inside < 256; ++inside) {
    std::map<std::pair<unsigned, unsigned>, int> crossings;
    for (const auto& polygon : cube_polygons(static_cast<std::uint8_t>(inside))) {
      EXPECT_GE(polygon.size(), 3U);
      for (const auto& edge : polygon) ++crossings[{edge.corner, edge.axis}];
    }
    for (unsigned corner = 0; corner < 8; ++corner) {
      for (unsigned axis = 0; axis < 3; ++axis) {
        if (is_inside(corner, axis)) continue;  // the edge starts at the other end
        const bool crossed = is_inside(inside, corner) != is_inside(inside, corner | (1U << axis));
        EXPECT_EQ((crossings[{corner, axis}]), crossed ? 1 : 0) << inside;
      }
    }
  }
}

/// The lines of the polygons on one face of the cube, as pairs of edges in the numbers of a square.
std::set<std::pair<unsigned, unsigned>> lines_on_face(unsigned inside, unsigned axis, bool upper) {
  const auto on_face = [&](const CubeEdge& edge) {
    return edge.axis != axis && is_inside(edge.corner, axis) == upper;
  };
  const auto number = [&](const CubeEdge& edge) {
    return 3U * (edge.corner & ~(1U << axis)) + edge.axis;
  };
  std::set<std::pair<unsigned, unsigned>> lines;
  for (const auto& polygon : cube_polygons(static_cast<std::uint8_t>(inside))) {
    for (std::size_t i = 0; i < polygon.size(); ++i) {
      const CubeEdge& a = polygon[i];
      const CubeEdge& b = polygon[(i + 1) % polygon.size()];
      if (on_face(a) && on_face(b)) lines.emplace(number(a), number(b));
    }
  }
  return lines;
}

/// The four corners of a face as bits, in an order that both cubes at the face share.
unsigned corners_of_face(unsigned inside, unsigned axis, bool upper) {
  unsigned bits = 0;
  unsigned count = 0;
  for (unsigned corner = 0; corner < 8; ++corner) {
    if (is_inside(corner, axis) != upper) continue;
    if (is_inside(inside, corner)) bits |= 1U << count;
    ++count;
  }
  return bits;
}

TEST(CubePolygons, MeetThoseOfTheNeighbouringCubeInOppositeDirection) {
  for (unsigned axis = 0; axis < 3; ++axis) {
    for (unsigned a = 0; a < 256; ++a) {
      for (unsigned b = 0; b < 256; ++b) {
        if (corners_of_face(a, axis, true) != corners_of_face(b, axis, false)) continue;
        std::set<std::pair<unsigned, unsigned>> turned;
        for (const auto& [from, to] : lines_on_face(b, axis, false)) turned.emplace(to, from);
        ASSERT_EQ(lines_on_face(a, axis, true), turned) << a << " beside " << b;
      }
    }
  }
}

TEST(CubePolygons, RunCounterClockwiseRoundAnInsideCorner) {
  const auto& polygons = cube_polygons(1);
  ASSERT_EQ(polygons.size(), 1U);
  auto polygon = polygons.front();
  std::rotate(polygon.begin(), std::find(polygon.begin(), polygon.end(), CubeEdge{0, 0}),
              polygon.end());
  // Seen from (1, 1, 1), outside, x follows y follows z counter-clockwise.
  EXPECT_EQ(polygon, (std::vector<CubeEdge>{{0, 0}, {0, 1}, {0, 2}}));
}

TEST(CubePolygons, AreNoneForACubeAllInsideOrAllOutside) {
  EXPECT_TRUE(cube_polygons(0).empty());
  EXPECT_TRUE(cube_polygons(255).empty());
}

}  // namespace
}  // namespace instep
