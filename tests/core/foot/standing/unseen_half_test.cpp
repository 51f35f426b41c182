#include "core/foot/standing/unseen_half.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

namespace instep {
namespace {

using Eigen::Vector3d;

constexpr double kLength = 250.0;
constexpr double kRadius = 40.0;
constexpr double kGrazing = 0.2;  ///< of the cosine, less than which a camera sees nothing

/// Upright walls round a foot with round ends, as far as cameras in these directions see them;
/// behind the heel is 180 degrees, 90 is to the customer's left.
FootScan seen_from(const std::vector<double>& degrees) {
  FootScan foot;
  const auto add = [&](double x, double y, double angle) {
    const Vector3d normal(std::cos(angle), std::sin(angle), 0.0);
    const bool is_seen = std::any_of(degrees.begin(), degrees.end(), [&](double towards) {
      return std::cos(angle - towards * std::numbers::pi / 180.0) > kGrazing;
    });
    if (!is_seen) return;
    for (double z = 2.0; z < 36.0; z += 2.0) {
      foot.cloud.positions.emplace_back(x, y, z);
      foot.cloud.normals.push_back(normal);
    }
  };
  for (double angle = -std::numbers::pi; angle < std::numbers::pi; angle += 0.05) {
    const double centre = std::cos(angle) > 0.0 ? kLength - kRadius : kRadius;
    add(centre + kRadius * std::cos(angle), kRadius * std::sin(angle), angle);
  }
  for (double x = kRadius; x < kLength - kRadius; x += 2.0) {
    add(x, kRadius, 0.5 * std::numbers::pi);
    add(x, -kRadius, -0.5 * std::numbers::pi);
  }
  foot.landmarks["pternion"].position_mm = Vector3d::Zero();
  foot.landmarks["acropodion"].position_mm = Vector3d(kLength, 0.0, 10.0);
  return foot;
}

TEST(UnseenHalf, IsTheOneThatTwoNeighbouringCamerasLookPast) {
  EXPECT_EQ(unseen_half(seen_from({0, 90})), "the right half of its heel");
  EXPECT_EQ(unseen_half(seen_from({0, -90})), "the left half of its heel");
  EXPECT_EQ(unseen_half(seen_from({180, 90})), "the right half of its toes");
  EXPECT_EQ(unseen_half(seen_from({180, -90})), "the left half of its toes");
  EXPECT_EQ(unseen_half(seen_from({90})), "the right half of its heel");
}

TEST(UnseenHalf, IsNoneBeforeCamerasThatFaceEachOther) {
  EXPECT_FALSE(unseen_half(seen_from({90, -90})));
  EXPECT_FALSE(unseen_half(seen_from({0, 180})));
  EXPECT_FALSE(unseen_half(seen_from({0, 90, -90})));
  EXPECT_FALSE(unseen_half(seen_from({0, 90, 180})));
}

TEST(UnseenHalf, IsNotSeenBecausePointsWerePutThere) {
  FootScan foot = seen_from({0, 90});
  foot.cloud.origins.assign(foot.cloud.size(), PointOrigin::kSeen);
  const FootScan whole = seen_from({0, 90, 180, -90});
  PointCloud guessed = whole.cloud;
  guessed.origins.assign(guessed.size(), PointOrigin::kPlatform);
  foot.cloud.append(guessed);
  EXPECT_EQ(unseen_half(foot), "the right half of its heel");
}

TEST(UnseenHalf, IsUnknownWithoutNormals) {
  FootScan foot = seen_from({0, 90});
  foot.cloud.normals.clear();
  EXPECT_FALSE(unseen_half(foot));
}

/// The side beside it was seen: views met there, and some of their pixels had no depth.
TEST(UnseenHalf, IsNoHole) {
  for (const double along : {8.0, kLength - 8.0}) {
    FootScan foot = seen_from({0, 90, 180, -90});
    std::vector<std::size_t> left;
    for (std::size_t i = 0; i < foot.cloud.size(); ++i) {
      const Vector3d place(along, 25.0, 20.0);
      if ((foot.cloud.positions[i] - place).norm() > 35.0) left.push_back(i);
    }
    ASSERT_LT(left.size(), foot.cloud.size() - 100);
    foot.cloud = foot.cloud.subset(left);
    EXPECT_FALSE(unseen_half(foot));
  }
}

/// What ends before the heel or the toes does so on both sides.
TEST(UnseenHalf, IsNoneOfAnEndThatWasNotSeenAtAll) {
  const FootScan whole = seen_from({0, 90, 180, -90});
  std::vector<std::size_t> before;
  for (std::size_t i = 0; i < whole.cloud.size(); ++i) {
    if (whole.cloud.positions[i].x() > 50.0) before.push_back(i);
  }
  FootScan cut = whole;
  cut.cloud = whole.cloud.subset(before);
  EXPECT_FALSE(unseen_half(cut));
}

}  // namespace
}  // namespace instep
