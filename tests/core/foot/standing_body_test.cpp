#include "core/foot/standing_body.h"

#include <gtest/gtest.h>

#include "core/foot/alignment.h"
#include "core/foot/open_sole.h"
#include "tests/support/foot_body.h"

namespace instep {
namespace {

using Eigen::Vector3d;
using test::FootBody;

TEST(StandingBody, LeavesOutWhatStandsApart) {
  const auto foot = FootBody{}.points();
  auto points = foot.positions;
  for (int i = 0; i < 400; ++i) points.emplace_back(100.0 + i % 20, 200.0 + i / 20, 5.0);
  points.emplace_back(-60.0, 0.0, 30.0);
  const auto body = standing_body(points);
  EXPECT_EQ(body.points.size(), foot.size());
  EXPECT_GT(body.apart_share, 0.0);
  EXPECT_NEAR(body.next_share, 400.0 / static_cast<double>(foot.size()), 1e-9);
  EXPECT_TRUE(standing_body({}).points.empty());
}

TEST(StandingBody, OfAFootBesideAnotherOnesRemainsIsMeasuredWithAWarning) {
  auto cloud = FootBody{}.points();
  const auto alone = align_foot(cloud);
  const auto other = test::mirrored(FootBody{}.points());
  for (std::size_t i = 0; i < other.size(); ++i) {
    if (other.positions[i].x() < 90.0) {
      cloud.positions.push_back(other.positions[i] - Vector3d(0.0, 160.0, 0.0));
    }
  }
  const auto foot = align_foot(cloud);
  ASSERT_TRUE(alone && foot);
  EXPECT_EQ(foot->side, alone->side);
  EXPECT_NEAR(foot->landmarks.at("acropodion").position_mm.x(),
              alone->landmarks.at("acropodion").position_mm.x(), 0.1);
  ASSERT_FALSE(foot->warnings.empty());
  EXPECT_NE(foot->warnings.back().find("more than one body"), std::string::npos);
}

TEST(OpenSole, IsToldFromAClosedOneAndClosed) {
  const auto whole = FootBody{}.points();
  const auto closed = align_foot(whole);
  ASSERT_TRUE(closed);
  EXPECT_FALSE(is_sole_open(*closed));
  PointCloud open;
  for (const auto& point : whole.positions) {
    if (point.z() > 2.0) open.positions.push_back(point);
  }
  AlignmentOptions options;
  options.standing_plane = StandingPlane{};
  const auto foot = align_foot(open, options);
  ASSERT_TRUE(foot) << foot.error().line();
  std::size_t added = 0;
  for (std::size_t i = 0; i < foot->cloud.size(); ++i) added += foot->cloud.was_seen(i) ? 0U : 1U;
  EXPECT_GT(added, 1000U);
  EXPECT_FALSE(is_sole_open(*foot));
}

}  // namespace
}  // namespace instep
