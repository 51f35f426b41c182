#include "daemon/page/foot_view.h"

#include <gtest/gtest.h>

#include "tests/support/foot_body.h"

namespace instep {
namespace {

using Eigen::Vector3d;
using From = FootView::From;

FootScan foot(Side side) {
  FootScan scan;
  scan.side = side;
  const auto right = test::FootBody{}.points();
  scan.cloud = side == Side::kRight ? right : test::mirrored(right);
  return scan;
}

/// A point a way towards medial from another.
Vector3d towards_medial(const FootScan& scan, double mm) {
  return {0.0, scan.medial_sign() * mm, 0.0};
}

TEST(FootView, HasTheMedialSideBelowAndTheToesOnTheSideOfTheBody) {
  for (const Side side : {Side::kLeft, Side::kRight}) {
    const FootScan scan = foot(side);
    FootView above(scan, From::kAbove, 200.0);
    above.place({0.0, 0.0}, 4.0);
    const Vector3d heel(0.0, 0.0, 10.0);
    const Vector3d toe(260.0, 0.0, 10.0);
    const double toes = side == Side::kLeft ? 1.0 : -1.0;
    EXPECT_DOUBLE_EQ((above(toe) - above(heel)).x(), toes * 4.0 * 260.0);
    EXPECT_DOUBLE_EQ((above(heel + towards_medial(scan, 30.0)) - above(heel)).y(), 4.0 * 30.0);
    // It is no mirror image: from heel to toe, then to medial, turns as on the foot.
    FootView beside(scan, From::kMedial, 200.0);
    beside.place({0.0, 0.0}, 4.0);
    EXPECT_DOUBLE_EQ((beside(toe) - beside(heel)).x(), toes * 4.0 * 260.0);
    EXPECT_DOUBLE_EQ((beside({0.0, 0.0, 60.0}) - beside({0.0, 0.0, 0.0})).y(), -4.0 * 60.0);
    EXPECT_DOUBLE_EQ(above.heading(), toes);
  }
}

TEST(FootView, IsPlacedByItsLeftUpperCorner) {
  FootView view(foot(Side::kLeft), From::kAbove, 200.0);
  view.place({100.0, 200.0}, 5.0);
  const Eigen::Vector2d size = 5.0 * view.bounds().sizes();
  EXPECT_NEAR(size.x(), 5.0 * 260.0, 20.0);
  for (const auto& point : foot(Side::kLeft).cloud.positions) {
    const auto place = view(point);
    EXPECT_GE(place.x(), 100.0 - 1e-9);
    EXPECT_GE(place.y(), 200.0 - 1e-9);
    EXPECT_LE(place.x(), 100.0 + size.x() + 1e-9);
    EXPECT_LE(place.y(), 200.0 + size.y() + 1e-9);
  }
}

TEST(FootView, HidesWhatIsBehindTheBody) {
  const FootScan scan = foot(Side::kRight);
  const test::FootBody body;
  const FootView above(scan, From::kAbove, 200.0);
  EXPECT_TRUE(above.hides({130.0, 0.0, 0.0}));
  EXPECT_FALSE(above.hides({130.0, 0.0, body.height(130.0)}));
  EXPECT_FALSE(above.hides({1e300, 0.0, -1e300}));
  const FootView medial(scan, From::kMedial, 200.0);
  EXPECT_FALSE(medial.hides({180.0, body.medial_border(180.0), 15.0}));
  EXPECT_TRUE(medial.hides({180.0, -body.lateral_border(180.0), 15.0}));
}

TEST(FootView, LeavesOutWhatIsHigherOrNoPoint) {
  FootScan scan = foot(Side::kRight);
  scan.cloud.positions.emplace_back(0.0, 0.0, std::nan(""));
  scan.cloud.positions.emplace_back(1e9, 0.0, 0.0);
  const FootView low(scan, From::kMedial, 50.0);
  EXPECT_LE(low.bounds().sizes().y(), 50.0 + 1e-9);
  EXPECT_LT(low.bounds().sizes().x(), 300.0);
  EXPECT_TRUE(FootView(FootScan{}, From::kAbove, 50.0).is_empty());
  EXPECT_EQ(FootView(FootScan{}, From::kAbove, 50.0).relief().find("nan"), std::string::npos);
}

}  // namespace
}  // namespace instep
