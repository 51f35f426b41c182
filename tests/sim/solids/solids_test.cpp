#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "sim/random.h"
#include "sim/solids/cylinder_solid.h"
#include "sim/solids/foot_solid.h"
#include "sim/solids/last_solid.h"

namespace instep {
namespace {

using Eigen::Vector3d;

struct Named {
  const char* name;
  std::shared_ptr<const Solid> solid;
};

std::vector<Named> all_solids() {
  return {{"usual foot", std::make_shared<FootSolid>(FootParameters{})},
          {"left foot", std::make_shared<FootSolid>(draw_foot(8, Side::kLeft))},
          {"cylinder", std::make_shared<CylinderSolid>(40.0, 150.0)},
          {"last", std::make_shared<LastSolid>()}};
}

Vector3d point_near(const Solid& solid, Random& random) {
  const Eigen::AlignedBox3d box = solid.bounds();
  Vector3d point;
  for (int axis = 0; axis < 3; ++axis) {
    point[axis] = random.uniform(box.min()[axis] - 20.0, box.max()[axis] + 20.0);
  }
  return point;
}

TEST(Solids, LieWithinTheirBounds) {
  for (const auto& [name, solid] : all_solids()) {
    Random random(3);
    for (int i = 0; i < 20000; ++i) {
      const Vector3d point = point_near(*solid, random);
      if (solid->value(point) < 0.0) {
        EXPECT_TRUE(solid->bounds().contains(point)) << name << " " << point.transpose();
      }
    }
  }
}

TEST(Solids, LetARayAdvanceSafely) {
  for (const auto& [name, solid] : all_solids()) {
    Random random(4);
    for (int i = 0; i < 20000; ++i) {
      const Vector3d point = point_near(*solid, random);
      const Vector3d aside =
          Vector3d(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1)) * 20.0;
      const double change = std::abs(solid->value(point + aside) - solid->value(point));
      EXPECT_LE(change, 1.415 * aside.norm() + 1e-6) << name << " " << point.transpose();
    }
  }
}

TEST(Solids, GradientIsTheSlope) {
  for (const auto& [name, solid] : all_solids()) {
    Random random(5);
    for (int i = 0; i < 2000; ++i) {
      const Vector3d point = point_near(*solid, random);
      const Vector3d by_differences = solid->Solid::gradient(point);
      // At an edge the slope jumps; the soft parts have none.
      if (dynamic_cast<const FootSolid*>(solid.get()) == nullptr) continue;
      EXPECT_LT((solid->gradient(point) - by_differences).norm(), 1e-4)
          << name << " " << point.transpose();
    }
  }
}

TEST(FootSolid, StandsFlatWithARoundRim) {
  const FootSolid foot(FootParameters{});
  // Heel and ball are pressed flat; above the middle of the medial arch there is air.
  for (const Vector3d& pressed :
       {Vector3d(35, 0, 0), Vector3d(170, 18, 0), Vector3d(165, -15, 0)}) {
    EXPECT_NEAR(foot.value(pressed), 0.0, 1e-6) << pressed.transpose();
  }
  EXPECT_GT(foot.value({110, 25, 1.0}), 1.0);
  // Round rim: at the heel's end the skin draws back towards the floor by millimetres.
  const auto rear_at = [&](double z) {
    double x = -40.0;
    while (foot.value({x, 0, z}) > 0) x += 0.01;
    return x;
  };
  EXPECT_GT(rear_at(0.05), rear_at(6.0) + 2.0);
  EXPECT_GT(rear_at(6.0), rear_at(15.0) + 0.1);
}

TEST(FootSolid, HeelIsNarrowerThanBall) {
  const FootParameters asked;
  const FootSolid foot(asked);
  const auto breadth_at = [&](double x) {
    double low = 0.0, high = 0.0;
    while (foot.value({x, low, 15}) < 0) low -= 0.01;
    while (foot.value({x, high, 15}) < 0) high += 0.01;
    return high - low;
  };
  EXPECT_NEAR(breadth_at(asked.length_mm / 6), asked.heel_breadth_mm, 5.0);
  EXPECT_GT(breadth_at(0.66 * asked.length_mm), breadth_at(asked.length_mm / 6) + 20.0);
}

TEST(FootSolid, LeftIsTheMirrorImageOfRight) {
  const FootSolid right(draw_foot(6, Side::kRight));
  const FootSolid left(draw_foot(6, Side::kLeft));
  Random random(6);
  for (int i = 0; i < 2000; ++i) {
    const Vector3d point = point_near(right, random);
    EXPECT_DOUBLE_EQ(right.value(point), left.value({point.x(), -point.y(), point.z()}));
  }
}

TEST(FootParameters, DrawsAreWithinTheirRangesAndDiffer) {
  double last = 0.0;
  for (std::uint64_t seed = 0; seed < 300; ++seed) {
    const FootParameters foot = draw_foot(seed, Side::kRight);
    ASSERT_TRUE(check_foot_parameters(foot)) << seed;
    EXPECT_GE(foot.length_mm, 200.0);
    EXPECT_LE(foot.length_mm, 310.0);
    EXPECT_NE(foot.length_mm, last);
    last = foot.length_mm;
    EXPECT_EQ(draw_foot(seed, Side::kRight).length_mm, foot.length_mm);
  }
}

TEST(FootParameters, ImpossibleOnesAreRefused) {
  for (const double length : {0.0, -250.0, 1e30, std::numeric_limits<double>::quiet_NaN()}) {
    FootParameters foot;
    foot.length_mm = length;
    EXPECT_FALSE(check_foot_parameters(foot)) << length;
  }
  FootParameters foot;
  foot.rim_radius_mm = std::numeric_limits<double>::infinity();
  const auto checked = check_foot_parameters(foot);
  ASSERT_FALSE(checked);
  EXPECT_NE(checked.error().message.find("rim_radius_mm"), std::string::npos);
}

TEST(LastSolid, HasASharpFeatherline) {
  const LastSolid last;
  // At the edge of the sole the normal turns at once from the wall to the ground.
  double y = 80.0;
  while (y > 0.0 && last.value({170, y, 0.1}) > 0) y -= 1e-3;
  ASSERT_GT(y, 10.0);
  EXPECT_GT(last.normal({170, y, 0.1}).y(), 0.3);
  EXPECT_LT(last.normal({170, y - 0.5, 0.0}).z(), -0.9);
}

}  // namespace
}  // namespace instep
