#include "core/foot/standing/things_beside.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/foot/alignment.h"
#include "tests/support/foot_body.h"
#include "tests/support/random_numbers.h"

namespace instep {
namespace {

using Eigen::Vector3d;
using test::FootBody;
using Points = std::vector<Vector3d>;

const FootBody kFoot{260.0, 2.0};

/// Upright, from one corner to the other, with points as far apart as those of the foot.
Points wall(const Vector3d& from, const Vector3d& to) {
  Points points;
  const Vector3d along(to.x() - from.x(), to.y() - from.y(), 0.0);
  for (double at = 0.0; at <= along.norm(); at += kFoot.spacing_mm) {
    for (double z = from.z(); z <= to.z(); z += kFoot.spacing_mm) {
      points.push_back(from + at * along.normalized() + Vector3d(0.0, 0.0, z - from.z()));
    }
  }
  return points;
}

double rearmost(const Points& points) {
  double least = 1e300;
  for (const auto& point : points) least = std::min(least, point.x());
  return least;
}

double leftmost(const Points& points) {
  double most = -1e300;
  for (const auto& point : points) most = std::max(most, point.y());
  return most;
}

Points joined(Points points, const Points& others) {
  points.insert(points.end(), others.begin(), others.end());
  return points;
}

bool warns(const Result<FootScan>& foot, const std::string& words) {
  return foot && std::any_of(foot->warnings.begin(), foot->warnings.end(),
                             [&](const auto& one) { return one.find(words) != std::string::npos; });
}

/// The heel of FootBody is at x = 0 and its toes end at its length.
void expect_whole_foot(const Points& points, double within_mm, const std::string& warning) {
  PointCloud cloud;
  cloud.positions = points;
  const auto foot = align_foot(cloud);
  ASSERT_TRUE(foot) << foot.error().line();
  EXPECT_NEAR(foot->landmarks.at("acropodion").position_mm.x(), kFoot.length_mm, within_mm);
  EXPECT_TRUE(warns(foot, warning)) << warning;
}

TEST(ThingsBeside, AreNoneByAFootAlone) {
  const auto things = things_beside(kFoot.points().positions, 1.0);
  EXPECT_TRUE(things.points.empty());
  EXPECT_EQ(things.gap_mm, 0.0);
  EXPECT_TRUE(things_beside({}, 1.0).points.empty());
}

TEST(ThingsBeside, IsAHeelStopAtAnyDistanceThatPointsShow) {
  const auto foot = kFoot.points().positions;
  for (const double gap : {5.0, 8.0, 12.0}) {
    const double x = rearmost(foot) - gap;
    const auto stop = wall({x, -45.0, 0.0}, {x, 45.0, 50.0});
    const auto things = things_beside(joined(foot, stop), 1.0);
    EXPECT_EQ(things.points.size(), stop.size()) << gap;
    EXPECT_NEAR(things.gap_mm, gap, 0.5);
    EXPECT_TRUE(things.is_gap_seen);
    expect_whole_foot(joined(foot, stop), 1.5, "beside the foot and is left out");
  }
}

TEST(ThingsBeside, IsAStripOfTheOtherFoot) {
  const auto foot = kFoot.points().positions;
  const auto other = test::mirrored(kFoot.points()).positions;
  for (const double gap : {5.0, 8.0}) {
    Points strip;
    for (const auto& point : other) {
      const Vector3d place = point + Vector3d(6.0, 2.0 * leftmost(foot) + gap, 0.0);
      if (place.y() < leftmost(foot) + gap + 20.0) strip.push_back(place);
    }
    const auto things = things_beside(joined(foot, strip), 1.0);
    EXPECT_NEAR(static_cast<double>(things.points.size()), static_cast<double>(strip.size()),
                0.02 * static_cast<double>(strip.size()));
    expect_whole_foot(joined(foot, strip), 1.5, "beside the foot and is left out");
  }
}

TEST(ThingsBeside, IsARulerThatLiesBeside) {
  const auto foot = kFoot.points().positions;
  for (const double gap : {5.0, 10.0, 14.0}) {
    const double y = leftmost(foot) + gap;
    expect_whole_foot(joined(foot, wall({-20.0, y, 0.0}, {280.0, y, 14.0})), 1.5,
                      "beside the foot and is left out");
  }
}

/// Points as far apart as those of the foot do not tell where it ends, but the rest of the wall
/// that it is one.
TEST(ThingsBeside, IsToldToTouchWhereNoGapIsSeen) {
  const auto foot = kFoot.points().positions;
  for (const double gap : {0.3, 1.0}) {
    const double x = rearmost(foot) - gap;
    const auto all = joined(foot, wall({x, -45.0, 0.0}, {x, 45.0, 50.0}));
    EXPECT_FALSE(things_beside(all, 1.0).is_gap_seen);
    expect_whole_foot(all, 6.0, "touches the foot, or nearly does");
  }
}

/// What a strip that no camera saw cuts off lies along the skin, however narrow the strip is.
TEST(ThingsBeside, IsNoPartOfTheFootItself) {
  const auto whole = kFoot.points().positions;
  test::RandomNumbers random(3);
  for (int trial = 0; trial < 20; ++trial) {
    const Vector3d across =
        Vector3d(random.normal(), random.normal(), random.normal()).normalized();
    const Vector3d& place = whole[static_cast<std::size_t>(trial) * 37 % whole.size()];
    const double width = 4.0 + trial;
    Points left;
    for (const auto& point : whole) {
      if (std::abs(across.dot(point - place)) > 0.5 * width) left.push_back(point);
    }
    EXPECT_TRUE(things_beside(left, 1.0).points.empty()) << trial;
  }
}

/// A sole under glass and the upper above it, of which no camera saw the side between.
TEST(ThingsBeside, IsNoSoleUnderAnUpper) {
  Points both;
  for (const auto& point : kFoot.points().positions) {
    if (point.z() < 1.0 || point.z() > 14.0) both.push_back(point);
  }
  EXPECT_TRUE(things_beside(both, 1.0).points.empty());
}

TEST(ThingsBeside, OfAFootsSizeThatTouchIsRefused) {
  PointCloud both = kFoot.points();
  for (const auto& point : test::mirrored(kFoot.points()).positions) {
    both.positions.emplace_back(point - Vector3d(0.0, 92.0, 0.0));
  }
  EXPECT_FALSE(align_foot(both));
}

TEST(ThingsBeside, AreNotSoughtAmongLargeParts) {
  const auto foot = kFoot.points().positions;
  const double x = rearmost(foot) - 8.0;
  const auto stop = wall({x, -45.0, 0.0}, {x, 45.0, 50.0});
  const double share = static_cast<double>(stop.size()) / static_cast<double>(foot.size());
  EXPECT_TRUE(things_beside(joined(foot, stop), 0.9 * share).points.empty());
}

}  // namespace
}  // namespace instep
