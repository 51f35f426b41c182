#include "core/foot/measures/hidden_skin.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace instep {
namespace {

using Eigen::Vector3d;

constexpr double kHalfBreadthMm = 40.0;
constexpr double kTopMm = 60.0;
constexpr double kInsetMm = 25.0;  ///< from the left wall to where it is taken to meet the floor

/// An upright section across a foot. Its right wall was seen down to the floor, its left one down
/// to `seen_to_mm`; from there it is taken to run to the floor along a quarter of an ellipse.
struct Section {
  TapePlane plane = *TapePlane::through({0, 0, 0}, {0, 50, 0}, {0, 0, 50});
  PointCloud cloud;
  Girth girth;

  explicit Section(double seen_to_mm, double lean = 0.0) {
    for (double y = -kHalfBreadthMm + 30 * lean; y <= kHalfBreadthMm; y += 1.0)
      add(y, kTopMm, true);
    for (double z = kTopMm - 1.0; z > 0.5; z -= 1.0) add(kHalfBreadthMm, z, true);
    const double foot = -kHalfBreadthMm + lean * (kTopMm - seen_to_mm);
    for (double y = kHalfBreadthMm; y > foot + kInsetMm; y -= 1.0) add(y, 0.0, false);
    for (int degree = 1; degree < 90; ++degree) {
      const double turn = degree * std::numbers::pi / 180.0;
      add(foot + kInsetMm * (1 - std::sin(turn)), seen_to_mm * (1 - std::cos(turn)), false);
    }
    for (double z = seen_to_mm; z < kTopMm; z += 1.0) {
      add(-kHalfBreadthMm + lean * (kTopMm - z), z, true);
    }
  }

  double doubt() const { return hidden_wall(SeenSkin(cloud), plane, girth).doubt_mm; }

 private:
  void add(double y, double z, bool was_seen) {
    girth.contour.push_back(plane.project(Vector3d(0, y, z)));
    for (const double x : {-4, -3, -2, -1, 0, 1, 2, 3, 4}) {
      cloud.positions.emplace_back(x, y, z);
      cloud.origins.push_back(was_seen ? PointOrigin::kSeen : PointOrigin::kPlatform);
    }
  }
};

/// A skin, `length_mm` along a slope from the floor up in the plane x = 0 and beside it, of points
/// 2 mm apart; what lies on the floor goes on for as long again.
PointCloud guessed_slope(double length_mm, PointOrigin origin) {
  PointCloud cloud;
  for (double at = 1.0 - length_mm; at < length_mm; at += 2.0) {
    for (double x = -9.0; x < 10.0; x += 2.0) {
      cloud.positions.emplace_back(x, 0.8 * at, std::max(0.0, 0.6 * at));
      cloud.origins.push_back(origin);
    }
  }
  return cloud;
}

TEST(GuessedSkin, LeavesOpenHalfAMillimetreForEachPieceOfACentimetre) {
  const TapePlane plane = *TapePlane::through({0, 0, 0}, {0, 50, 0}, {0, 0, 50});
  for (const double pieces : {1.0, 4.0, 9.0}) {
    const auto guessed = guessed_slope(10.0 * pieces, PointOrigin::kPlatform);
    EXPECT_NEAR(doubt_of_guessed_skin(guessed, plane), 0.5 * std::sqrt(pieces), 1e-9) << pieces;
    const auto seen = guessed_slope(10.0 * pieces, PointOrigin::kSeen);
    EXPECT_EQ(doubt_of_guessed_skin(seen, plane), 0.0) << pieces;
  }
}

TEST(HiddenWall, LeavesOpenAShareOfWhatLiesBetweenACornerAndAStraightWay) {
  for (const double height : {12.0, 20.0, 30.0}) {
    Section section(height);
    // Of the ellipse what lies more than 2.5 mm below the seen wall, and not on the floor.
    const auto inwards = [&](double z) { return std::sqrt(1 - std::pow(1 - z / height, 2)); };
    const double from = height - 2.5;
    const double breadth = kInsetMm * (inwards(from) - inwards(0.3));
    const double range = from - 0.3 + breadth - std::hypot(from - 0.3, breadth);
    EXPECT_NEAR(section.doubt(), 0.6 * range, 0.03 * range) << height;
    EXPECT_NEAR(hidden_wall(SeenSkin(section.cloud), section.plane, section.girth).height_mm,
                height, 3.0);
  }
}

TEST(HiddenWall, IsTheSameWhereverTheSectionBeginsAndWhicheverWayItRuns) {
  Section section(20.0);
  const double doubt = section.doubt();
  auto& contour = section.girth.contour;
  for (std::size_t i = 0; i < contour.size(); i += 10) {
    std::rotate(contour.begin(), contour.begin() + 10, contour.end());
    EXPECT_NEAR(section.doubt(), doubt, 1e-9) << i;
  }
  std::reverse(contour.begin(), contour.end());
  EXPECT_NEAR(section.doubt(), doubt, 1e-9);
}

/// As a side of which no camera saw more than the ridge above it: it had no doubt at all.
TEST(HiddenWall, LeavesMostOpenWhereItWasLostAtItsTop) {
  EXPECT_GT(Section(kTopMm).doubt(), Section(40.0).doubt());
  EXPECT_GT(Section(40.0).doubt(), Section(20.0).doubt());
}

/// Points so far apart leave holes in a narrow band.
TEST(HiddenWall, TakesSparsePointsForASeenWall) {
  Section section(1.0);
  PointCloud sparse;
  for (double x = -37.5; x <= 40.0; x += 5.0) {
    for (std::size_t i = 0; i < section.cloud.size(); i += 45) {  // the first of nine, each fifth
      sparse.positions.push_back(section.cloud.positions[i]);
      sparse.positions.back().x() = x;
      sparse.origins.push_back(section.cloud.origins[i]);
    }
  }
  section.cloud = sparse;
  EXPECT_LT(section.doubt(), 0.2);
}

/// As where nothing told how the skin goes on, and the floor was taken to begin below the wall.
TEST(HiddenWall, LeavesOpenHowFarInItMeetsTheFloorWhereItIsTakenToStandUpright) {
  Section section(40.0);
  auto& contour = section.girth.contour;
  for (auto& corner : contour) {
    Vector3d place = section.plane.lift(corner);
    const bool is_guessed = place.y() < 0.0 && place.z() < 39.5;
    if (is_guessed) place.y() = -kHalfBreadthMm;
    corner = section.plane.project(place);
  }
  // From 37.5 mm over the floor to 15 mm inside, at once or round the corner.
  const double range = 37.2 + 15.0 - std::hypot(37.2, 15.0);
  EXPECT_NEAR(section.doubt(), 0.6 * range, 0.05 * range);
}

TEST(HiddenWall, IsNoneWhereTheWallWasSeenDownToTheFloor) {
  EXPECT_LT(Section(1.0).doubt(), 0.2);
}

TEST(HiddenWall, IsNoneWhereTheWallHadBegunToBend) {
  EXPECT_EQ(Section(15.0, 0.6).doubt(), 0.0);
  EXPECT_LT(Section(15.0, 0.25).doubt(), 0.8 * Section(15.0).doubt());
}

TEST(HiddenWall, IsNoneOfALevelTape) {
  Section section(20.0);
  section.plane = *TapePlane::through({0, 0, 0}, {0, 50, 0}, {50, 0, 0});
  EXPECT_EQ(section.doubt(), 0.0);
}

/// Half a section on z = 0 with a round lower edge, seen down to a height and level from there.
double half_way_round(double seen_to_mm) {
  constexpr double kEdgeMm = 12.0;
  constexpr int kPieces = 9000;
  Eigen::Vector2d last(0.0, seen_to_mm);
  double way = 0.0;
  for (int i = 0; i <= kPieces; ++i) {
    const double turn = 0.5 * std::numbers::pi * i / kPieces;
    const Eigen::Vector2d place(kHalfBreadthMm - kEdgeMm * (1.0 - std::sin(turn)),
                                kEdgeMm * (1.0 - std::cos(turn)));
    if (place.y() < seen_to_mm) continue;
    way += (place - last).norm();
    last = place;
  }
  return way;
}

TEST(DeeperSole, LeavesOpenWhatRoundEdgesAddBelowTheLastLine) {
  const Section section(20.0);
  for (const double below : {1.5, 3.0, 6.0}) {
    const double longer = 2.0 * (half_way_round(0.0) - half_way_round(below));
    EXPECT_NEAR(doubt_of_deeper_sole({0.0, below}, section.plane, section.girth), longer, 0.01)
        << below;
  }
}

TEST(DeeperSole, IsNoneOfATapeAboveItAndOfAKnownFloor) {
  Section section(20.0);
  EXPECT_EQ(doubt_of_deeper_sole({}, section.plane, section.girth), 0.0);
  section.plane = *TapePlane::through({0, 0, 70}, {0, 50, 70}, {50, 0, 70});
  EXPECT_EQ(doubt_of_deeper_sole({0.0, 2.0}, section.plane, section.girth), 0.0);
}

TEST(HiddenWall, BearsNoSectionAndNoSeenPoint) {
  Section section(20.0);
  section.girth.contour.clear();
  EXPECT_EQ(section.doubt(), 0.0);
  Section unseen(20.0);
  unseen.cloud.origins.assign(unseen.cloud.size(), PointOrigin::kPlatform);
  EXPECT_GE(unseen.doubt(), 0.0);
}

}  // namespace
}  // namespace instep
