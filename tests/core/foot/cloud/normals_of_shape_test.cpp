#include "core/foot/cloud/normals_of_shape.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "core/foot/alignment.h"
#include "tests/support/foot_body.h"
#include "tests/support/random_numbers.h"

namespace instep {
namespace {

using Eigen::Vector3d;

PointCloud foot_with_normals() {
  PointCloud cloud = test::FootBody{260.0, 3.0}.points();
  cloud.normals.clear();
  // A foot is roundish across: that is near enough to normals for this.
  for (const auto& point : cloud.positions) {
    const Vector3d arm(0.0, point.y(), point.z() - 25.0);
    cloud.normals.push_back(point.z() < 1.0 ? -Vector3d::UnitZ() : arm.normalized());
  }
  return cloud;
}

TEST(NormalsOfShape, AreThoseThatStandOnItOutwards) {
  EXPECT_FALSE(normals_contradict_shape(foot_with_normals()));
  EXPECT_FALSE(normals_contradict_shape(test::FootBody{260.0, 3.0}.points()));
  EXPECT_FALSE(normals_contradict_shape({}));
}

TEST(NormalsOfShape, AreNotInvertedOnes) {
  PointCloud cloud = foot_with_normals();
  for (auto& normal : cloud.normals) normal = -normal;
  EXPECT_TRUE(normals_contradict_shape(cloud));
  const auto foot = align_foot(cloud);
  ASSERT_TRUE(foot) << foot.error().line();
  EXPECT_FALSE(foot->cloud.has_normals());
  ASSERT_FALSE(foot->warnings.empty());
  EXPECT_NE(foot->warnings.back().find("contradict the shape"), std::string::npos);
}

TEST(NormalsOfShape, AreNotRandomOnes) {
  PointCloud cloud = foot_with_normals();
  test::RandomNumbers random(5);
  for (auto& normal : cloud.normals) {
    normal = Vector3d(random.normal(), random.normal(), random.normal()).normalized();
  }
  EXPECT_TRUE(normals_contradict_shape(cloud));
}

/// As they are before anyone orients them, and where a tenth of them was not: a sole was closed by
/// them up to 13 mm off.
TEST(NormalsOfShape, AreNotThoseOfWhichSomeAreTurnedOver) {
  for (const double share : {0.1, 0.5}) {
    PointCloud cloud = foot_with_normals();
    test::RandomNumbers random(6);
    for (auto& normal : cloud.normals) {
      if (random.uniform() < share) normal = -normal;
    }
    EXPECT_TRUE(normals_contradict_shape(cloud)) << share;
  }
}

TEST(NormalsOfShape, AreNotThoseThatAllPointUp) {
  PointCloud cloud = foot_with_normals();
  for (auto& normal : cloud.normals) {
    if (normal.z() < 0.0) normal = -normal;
  }
  EXPECT_TRUE(normals_contradict_shape(cloud));
}

/// Of 200 sections of 90 points, one written after the other: every fifth lie in columns, which
/// tell no skin.
TEST(NormalsOfShape, AreThoseOfAFileThatIsWrittenSectionBySection) {
  PointCloud cloud;
  for (int section = 0; section < 200; ++section) {
    for (int i = 0; i < 90; ++i) {
      const double turn = 2.0 * std::numbers::pi * i / 90.0;
      const Vector3d outward(std::cos(turn), 0.0, std::sin(turn));
      cloud.positions.push_back((40.0 + 0.1 * section) * outward +
                                1.3 * section * Vector3d::UnitY());
      cloud.normals.push_back(outward);
    }
  }
  EXPECT_FALSE(normals_contradict_shape(cloud));
  for (auto& normal : cloud.normals) normal = -normal;
  EXPECT_TRUE(normals_contradict_shape(cloud));
}

}  // namespace
}  // namespace instep
