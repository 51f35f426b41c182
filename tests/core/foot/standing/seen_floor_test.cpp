#include "core/foot/standing/seen_floor.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <string>

#include "core/foot/alignment.h"
#include "core/foot/landmarks.h"
#include "core/foot/measures.h"
#include "tests/support/foot_body.h"
#include "tests/support/random_numbers.h"

namespace instep {
namespace {

using Eigen::Vector3d;
using Points = std::vector<Vector3d>;
using test::FootBody;

const StandingPlane kGround;

struct Floor {
  double rim_mm;
  double gap_mm = 0.0;  ///< round the foot, that nobody saw
  double sigma_mm = 0.2;
  bool is_cut_along_foot = false;  ///< else a rectangle
};

/// Beside the foot, as far as it can be seen from above.
void add_floor(const FootBody& body, const Floor& floor, PointCloud& cloud) {
  test::RandomNumbers random(7);
  constexpr double kPitch = 1.5;
  const double length = body.length_mm;
  for (double x = -floor.rim_mm; x < length + floor.rim_mm; x += kPitch) {
    for (double y = -0.2 * length - floor.rim_mm; y < 0.2 * length + floor.rim_mm; y += kPitch) {
      const bool is_beside_in_length = x < -floor.gap_mm || x > length + floor.gap_mm;
      const double along = std::clamp(x, 0.0, length);
      const bool is_beside = y > body.medial_border(along) + floor.gap_mm ||
                             y < -body.lateral_border(along) - floor.gap_mm;
      if (!is_beside_in_length && !is_beside) continue;
      const bool is_cut_off = y > body.medial_border(along) + floor.rim_mm ||
                              y < -body.lateral_border(along) - floor.rim_mm;
      if (floor.is_cut_along_foot && is_cut_off) continue;
      cloud.positions.emplace_back(x, y, floor.sigma_mm * random.normal());
    }
  }
}

MeasureSet measured(const PointCloud& cloud) {
  const auto foot = align_foot(cloud).and_then(find_landmarks);
  if (!foot) throw std::runtime_error(foot.error().line());
  return measure_foot(*foot).value();
}

/// A rim of floor was measured as skin: feet were 27 to 54 mm too long and 48 mm too broad, with no
/// word of it.
TEST(SeenFloor, IsLeftOutOfTheFootOnIt) {
  const FootBody body;
  const auto alone = measured(body.points());
  for (const Floor floor : {Floor{8.0}, Floor{25.0}, Floor{25.0, 7.0}, Floor{300.0, 0.0, 0.5},
                            Floor{6.0, 0.0, 0.2, true}}) {
    SCOPED_TRACE(testing::Message() << floor.rim_mm << " " << floor.gap_mm);
    PointCloud cloud = body.points();
    add_floor(body, floor, cloud);
    const auto foot = align_foot(cloud);
    ASSERT_TRUE(foot) << foot.error().line();
    EXPECT_TRUE(std::any_of(foot->warnings.begin(), foot->warnings.end(), [](const auto& warning) {
      return warning.find("floor round the foot") != std::string::npos;
    }));
    const auto set = measured(cloud);
    for (const char* id : {"foot_length", "foot_breadth", "heel_breadth", "ball_height"}) {
      EXPECT_NEAR(set.find(id)->value(), alone.find(id)->value(), 0.5) << id;
    }
    for (const char* id : {"ball_girth", "instep_girth"}) {
      EXPECT_NEAR(set.find(id)->value(), alone.find(id)->value(), 3.0) << id;
    }
  }
}

TEST(SeenFloor, IsFoundInAnyPose) {
  const FootBody body;
  PointCloud cloud = body.points();
  add_floor(body, {25.0}, cloud);
  RigidTransform turn = RigidTransform::Identity();
  turn.rotate(Eigen::AngleAxisd(2.0, Vector3d(1, 2, -1).normalized()));
  turn.pretranslate(Vector3d(300, -50, 20));
  const auto upright = measured(cloud);
  const auto turned = measured(transformed(turn, cloud));
  for (const char* id : {"foot_length", "foot_breadth", "ball_girth"}) {
    EXPECT_NEAR(turned.find(id)->value(), upright.find(id)->value(), 0.6) << id;
  }
}

TEST(SeenFloor, TellsItsPlane) {
  const FootBody body;
  PointCloud cloud = body.points();
  add_floor(body, {25.0, 0.0, 0.3}, cloud);
  // As the lowest points of noise have it.
  const auto floor = seen_floor(cloud.positions, {Vector3d(0.01, 0.0, 1.0).normalized(), -1.0});
  ASSERT_TRUE(floor);
  EXPECT_NEAR(floor->plane.height_mm, 0.0, 0.1);
  EXPECT_GT(floor->plane.up.z(), 1.0 - 1e-5);
  for (const std::size_t i : floor->above) EXPECT_GT(cloud.positions[i].z(), 2.5);
  EXPECT_TRUE(std::is_sorted(floor->above.begin(), floor->above.end()));
}

TEST(SeenFloor, IsNotASole) {
  for (const double length : {140.0, 260.0, 320.0}) {
    Points points = FootBody{length, 2.0}.points().positions;
    EXPECT_FALSE(seen_floor(points, kGround)) << length;
    test::RandomNumbers random(3);
    for (auto& point : points) {
      point += Vector3d(random.normal(), random.normal(), random.normal());
    }
    EXPECT_FALSE(seen_floor(points, kGround)) << length;
  }
}

/// A column on a flat cone, as toes lie round what stands higher of a foot that was cut off over
/// them.
TEST(SeenFloor, IsNotSkinThatClimbsToTheBody) {
  for (const double climb : {0.0, 0.1}) {
    Points points;
    for (double x = -90.0; x < 90.0; x += 2.0) {
      for (double y = -90.0; y < 90.0; y += 2.0) {
        const double away = std::hypot(x, y);
        if (away > 40.0 && away < 90.0) points.emplace_back(x, y, climb * (90.0 - away));
        if (away < 40.0) points.emplace_back(x, y, 40.0 - 0.5 * away);
      }
    }
    EXPECT_EQ(seen_floor(points, kGround).has_value(), climb == 0.0) << climb;
  }
}

/// A sheet of paper on one side of the foot.
TEST(SeenFloor, LiesOnMoreThanOneSide) {
  PointCloud cloud = FootBody{}.points();
  for (double x = 100.0; x < 200.0; x += 1.5) {
    for (double y = 60.0; y < 160.0; y += 1.5) cloud.positions.emplace_back(x, y, 0.1);
  }
  EXPECT_FALSE(seen_floor(cloud.positions, kGround));
}

TEST(SeenFloor, IsLevel) {
  const FootBody body;
  PointCloud rough = body.points();
  add_floor(body, {40.0, 0.0, 4.0}, rough);
  EXPECT_FALSE(seen_floor(rough.positions, kGround));
  PointCloud slope;
  add_floor(body, {40.0}, slope);
  for (auto& point : slope.positions) point.z() += 0.1 * point.y();
  Points points = body.points().positions;
  points.insert(points.end(), slope.positions.begin(), slope.positions.end());
  EXPECT_FALSE(seen_floor(points, kGround));
}

TEST(SeenFloor, IsNothingWithoutABody) {
  EXPECT_FALSE(seen_floor({}, kGround));
  EXPECT_FALSE(seen_floor({{0, 0, 0}, {100, 0, 0}, {0, 100, 0}}, kGround));
  EXPECT_FALSE(seen_floor(Points(500, Vector3d(1, 1, 30)), kGround));
}

}  // namespace
}  // namespace instep
