#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <numbers>
#include <optional>
#include <ostream>
#include <string>
#include <utility>
#include <vector>

#include "core/girth/girth.h"
#include "tests/support/cylinder_tape.h"

// Faces as files have them when something went wrong. As for clouds: near the truth, or a warning,
// or a refusal that says why.

namespace instep {
namespace {

using Eigen::Vector3d;
using test::level_plane;
using test::plane_at;

constexpr int kColumns = 60;
constexpr int kRows = 10;

/// The walls of a tube of 60 corners, 60 mm high, round an axis along z.
TriangleMesh tube(double radius = 40.0, double x = 0.0) {
  TriangleMesh mesh;
  for (int row = 0; row <= kRows; ++row) {
    for (int column = 0; column < kColumns; ++column) {
      const double angle = 2.0 * std::numbers::pi * column / kColumns;
      mesh.positions.emplace_back(x + radius * std::cos(angle), radius * std::sin(angle),
                                  60.0 * row / kRows - 30.0);
    }
  }
  const auto corner = [](int row, int column) {
    return static_cast<std::uint32_t>(row * kColumns + column % kColumns);
  };
  for (int row = 0; row < kRows; ++row) {
    for (int column = 0; column < kColumns; ++column) {
      const auto a = corner(row, column);
      const auto c = corner(row + 1, column + 1);
      mesh.triangles.push_back({a, corner(row, column + 1), c});
      mesh.triangles.push_back({a, c, corner(row + 1, column)});
    }
  }
  return mesh;
}

double girth_of_tube() {
  return 2.0 * kColumns * 40.0 * std::sin(std::numbers::pi / kColumns);
}

TriangleMesh with(TriangleMesh mesh, const TriangleMesh& other) {
  const auto first = static_cast<std::uint32_t>(mesh.positions.size());
  mesh.positions.insert(mesh.positions.end(), other.positions.begin(), other.positions.end());
  for (const auto& t : other.triangles) {
    mesh.triangles.push_back({t[0] + first, t[1] + first, t[2] + first});
  }
  return mesh;
}

TriangleMesh moved(TriangleMesh mesh, const std::function<void(Vector3d&)>& move) {
  for (auto& position : mesh.positions) move(position);
  return mesh;
}

/// Each so-manieth face once more, or turned round.
TriangleMesh repeated(std::size_t every) {
  TriangleMesh mesh = tube();
  const auto faces = mesh.triangles;
  for (std::size_t i = 0; i < faces.size(); i += every) mesh.triangles.push_back(faces[i]);
  return mesh;
}

TriangleMesh turned(std::size_t every) {
  TriangleMesh mesh = tube();
  for (std::size_t i = 0; i < mesh.triangles.size(); i += every) {
    std::swap(mesh.triangles[i][0], mesh.triangles[i][1]);
  }
  return mesh;
}

TriangleMesh open(double half_angle) {
  TriangleMesh mesh = tube();
  std::erase_if(mesh.triangles, [&](const auto& face) {
    const Vector3d& place = mesh.positions[face[0]];
    return std::abs(std::atan2(place.y(), place.x())) < half_angle;
  });
  return mesh;
}

TriangleMesh with_slivers() {
  TriangleMesh mesh = tube();
  for (std::uint32_t i = 0; i + 60 < mesh.positions.size(); i += 7) {
    mesh.triangles.push_back({i, i, i});
    mesh.triangles.push_back({i, i + 60, i + 60});
  }
  return mesh;
}

/// All faces hang on one corner: no surface.
TriangleMesh tangle() {
  TriangleMesh mesh = tube();
  for (auto& face : mesh.triangles) face[0] = 0;
  return mesh;
}

TriangleMesh one_triangle(double height) {
  return {{{0, 0, 1.3 - height}, {10, 0, 1.3 - height}, {0, 10, 1.3 + height}}, {{0, 1, 2}}};
}

TriangleMesh with_corner(double value) {
  TriangleMesh mesh = tube();
  mesh.positions[17].y() = value;
  return mesh;
}

TriangleMesh with_face_of_no_corner() {
  TriangleMesh mesh = tube();
  mesh.triangles[3][1] = 100000;
  return mesh;
}

struct HostileMesh {
  std::string name;
  std::function<TriangleMesh()> make;
  TapePlane plane = level_plane();
};

void PrintTo(const HostileMesh& hostile, std::ostream* stream) {
  *stream << hostile.name;
}

TapePlane along_the_axis(double x) {
  return plane_at({x, 0, 0}, {x, 1, 0}, {x, 0, 1});
}

const double kNan = std::numeric_limits<double>::quiet_NaN();
const double kInfinity = std::numeric_limits<double>::infinity();

std::vector<HostileMesh> unmeasurable() {
  return {
      {"NoFace", [] { return TriangleMesh{}; }},
      {"NaNCorner", [] { return with_corner(kNan); }},
      {"InfiniteCorner", [] { return with_corner(kInfinity); }},
      {"AbsurdCorner", [] { return with_corner(1e300); }},
      {"FaceOfNoCorner", with_face_of_no_corner},
      {"OneTriangle", [] { return one_triangle(5.0); }},
      {"OneTriangleInThePlane", [] { return one_triangle(0.0); }},
      {"AllTheSameCorner",
       [] { return moved(tube(), [](Vector3d& p) { p = Vector3d(1, 2, 1.3); }); }},
      {"Line", [] { return moved(tube(), [](Vector3d& p) { p.head<2>().setZero(); }); }},
      {"FlatAcross", [] { return moved(tube(), [](Vector3d& p) { p.y() = 0.0; }); }},
      {"FlatInThePlane", [] { return moved(tube(), [](Vector3d& p) { p.z() = 1.3; }); }},
      {"PlaneMisses", [] { return tube(); }, level_plane(80)},
      {"PlaneJustMisses", [] { return tube(); }, level_plane(30.0001)},
      {"PlaneTouchesTheSide", [] { return tube(); }, along_the_axis(40.0)},
  };
}

std::vector<HostileMesh> spoilt() {
  return {
      {"FacesTwice", [] { return repeated(1); }},
      {"HalfTheFacesTwice", [] { return repeated(2); }},
      {"AllTwice", [] { return with(tube(), tube()); }},
      {"AllTwiceAlmost", [] { return with(tube(), tube(40.0 * (1.0 + 1e-9))); }},
      {"InsideOut", [] { return turned(1); }},
      {"HalfInsideOut", [] { return turned(2); }},
      {"TwoShells", [] { return with(tube(), tube(37.0)); }},
      {"TwoLoops", [] { return with(tube(), tube(20.0, 66.0)); }},
      {"TwoBodiesInEachOther", [] { return with(tube(), tube(39.0, 30.0)); }},
      {"Slivers", with_slivers},
      {"Tangle", tangle},
      {"OpenByATwentieth", [] { return open(0.05 * std::numbers::pi); }},
      {"OpenByAQuarter", [] { return open(0.25 * std::numbers::pi); }},
      {"OpenByHalf", [] { return open(0.5 * std::numbers::pi); }},
      {"OpenBesideAToe", [] { return with(open(0.7 * std::numbers::pi), tube(8.0, 60.0)); }},
      {"PlaneAlongTheUpperEdge", [] { return tube(); }, level_plane(30)},
      {"PlaneAlongTheLowerEdge", [] { return tube(); }, level_plane(-30)},
      {"PlaneThroughCorners", [] { return tube(); }, level_plane(0)},
  };
}

/// Cuts of the tube along its axis: lines, no ring.
std::vector<HostileMesh> ringless() {
  return {{"PlaneGrazesTheSide", [] { return tube(); }, along_the_axis(39.9)},
          {"PlaneAlongTheAxis", [] { return tube(); }, along_the_axis(0.0)}};
}

class UnmeasurableMeshes : public testing::TestWithParam<HostileMesh> {};
class RinglessMeshes : public testing::TestWithParam<HostileMesh> {};
class SpoiltMeshes : public testing::TestWithParam<HostileMesh> {};

TEST_P(UnmeasurableMeshes, AreRefused) {
  const auto girth = girth_by_section(GetParam().make(), GetParam().plane);
  ASSERT_FALSE(girth) << girth->stretched_mm << " mm";
  EXPECT_FALSE(girth.error().message.empty());
  EXPECT_FALSE(girth.error().advice.empty());
}

TEST_P(RinglessMeshes, AreRefusedOrWarnedOf) {
  const auto girth = girth_by_section(GetParam().make(), GetParam().plane);
  EXPECT_TRUE(!girth || !girth->warnings.empty());
}

TEST_P(SpoiltMeshes, AreMeasuredRefusedOrWarnedOf) {
  const auto girth = girth_by_section(GetParam().make(), GetParam().plane);
  if (!girth) {
    EXPECT_FALSE(girth.error().advice.empty());
    return;
  }
  EXPECT_TRUE(std::isfinite(girth->stretched_mm) && std::isfinite(girth->contact_mm));
  if (!girth->warnings.empty()) return;
  EXPECT_NEAR(girth->stretched_mm, girth_of_tube(), 1e-6);
  EXPECT_NEAR(girth->contact_mm, girth_of_tube(), 1e-6);
}

// Copies that say the same twice must not turn a right number into a warned one without a number.
TEST(GirthBySection, IsNotMovedByRepeatedOrTurnedFaces) {
  for (const auto& mesh : {repeated(1), with(tube(), tube()), turned(1), turned(2), with_slivers(),
                           with(tube(), tube(37.0)), with(tube(), tube(20.0, 66.0))}) {
    const auto girth = girth_by_section(mesh, level_plane());
    ASSERT_TRUE(girth) << girth.error().line();
    EXPECT_NEAR(girth->stretched_mm, girth_of_tube(), 1e-6);
    EXPECT_NEAR(girth->contact_mm, girth_of_tube(), 1e-6);
  }
}

std::string name_of(const testing::TestParamInfo<HostileMesh>& info) {
  return info.param.name;
}

INSTANTIATE_TEST_SUITE_P(All, UnmeasurableMeshes, testing::ValuesIn(unmeasurable()), name_of);
INSTANTIATE_TEST_SUITE_P(All, RinglessMeshes, testing::ValuesIn(ringless()), name_of);
INSTANTIATE_TEST_SUITE_P(All, SpoiltMeshes, testing::ValuesIn(spoilt()), name_of);

}  // namespace
}  // namespace instep
