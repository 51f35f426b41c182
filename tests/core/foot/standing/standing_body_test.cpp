#include "core/foot/standing/standing_body.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/foot/alignment.h"
#include "core/foot/sole/open_sole.h"
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
  const auto body = standing_body(points, false);
  EXPECT_EQ(body.points.size(), foot.size());
  EXPECT_GT(body.apart_share, 0.0);
  EXPECT_NEAR(body.next_share, 400.0 / static_cast<double>(foot.size()), 1e-9);
  EXPECT_TRUE(standing_body({}, false).points.empty());
}

TEST(StandingBody, IsPartedFromTheNextWhateverStraysAreFarAway) {
  auto points = FootBody{260.0, 3.0}.points().positions;
  const std::size_t of_foot = points.size();
  for (int i = 0; i < 400; ++i) points.emplace_back(100.0 + i % 20, 110.0 + i / 20, 5.0);
  points.emplace_back(3000.0, 0.0, 30.0);
  EXPECT_EQ(standing_body(points, false).points.size(), of_foot);
}

TEST(StandingBody, IsTheSameHoweverItLies) {
  const auto foot = FootBody{}.points().positions;
  auto both = foot;
  for (const auto& point : foot) {
    if (point.x() < 90.0) both.push_back(point - Vector3d(0.0, 160.0, 0.0));
  }
  for (const double turn : {0.0, 0.4, 0.8, 1.2, 2.4}) {
    auto turned = both;
    const Eigen::AngleAxisd by(turn, Vector3d(0.1, 0.2, 1.0).normalized());
    for (auto& point : turned) point = by * point;
    EXPECT_EQ(standing_body(turned, false).points.size(), foot.size()) << turn;
  }
}

/// A side seen apart from the rest is of the foot, a thing that stands before its skin is not.
TEST(StandingBody, HoldsASideSeenApartButNothingBesideIt) {
  const auto foot = FootBody{}.points().positions;
  double widest = 0.0;
  for (const auto& point : foot) widest = std::max(widest, point.y());
  const auto apart = [&](const Vector3d& point) { return point.y() - widest; };
  std::vector<Vector3d> parted;
  for (const auto& point : foot) {
    if (apart(point) > -8.0 || apart(point) < -18.0) parted.push_back(point);
  }
  EXPECT_EQ(standing_body(parted, false).points.size(), parted.size());
  EXPECT_EQ(standing_body(parted, false).gap_beside_mm, 0.0);
  for (const double gap : {11.0, 25.0}) {
    auto points = foot;
    for (int i = 0; i < 200; ++i) {
      points.emplace_back(80.0 + i % 20, widest + gap, 5.0 + i / 20);
    }
    EXPECT_EQ(standing_body(points, false).points.size(), foot.size()) << gap;
  }
}

/// A strip that no camera saw parts the heel from the forefoot; a roll of tape stands behind it.
TEST(StandingBody, OfOneFootHoldsItsPartsButNothingSmall) {
  const auto foot = FootBody{}.points();
  double first = 1e9;
  double last = -1e9;
  for (const auto& point : foot.positions) {
    first = std::min(first, point.x());
    last = std::max(last, point.x());
  }
  const double middle = first + 0.4 * (last - first);
  std::vector<Vector3d> points;
  for (const auto& point : foot.positions) {
    if (std::abs(point.x() - middle) > 15.0) points.push_back(point);
  }
  const std::size_t of_foot = points.size();
  for (int i = 0; i < 400; ++i) points.emplace_back(first - 40.0 + i % 20, i / 20, 5.0);
  const auto parts = standing_body(points, true);
  EXPECT_EQ(parts.parts, 2U);
  EXPECT_EQ(parts.points.size(), of_foot);
  EXPECT_LT(standing_body(points, false).points.size(), of_foot);
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
