#include "core/fusion/poses/bent_depths.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

#include "core/geometry/point_index.h"
#include "tests/support/random_numbers.h"
#include "tests/support/smooth_field.h"

namespace instep {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double kRadiusMm = 80.0;
constexpr double kHeightMm = 300.0;
constexpr double kHalfTurn = 1.2;                         // of the body's side that is seen
constexpr double kWidthMm = 2.0 * kHalfTurn * kRadiusMm;  // of it, unrolled

/// Half a post, unrolled from one edge: its places lie as far apart as on the skin.
Vector3d facing(const Vector2d& place) {
  const double turn = place.x() / kRadiusMm - kHalfTurn;
  return {std::cos(turn), std::sin(turn), 0.0};
}

Vector3d skin_at(const Vector2d& place) {
  return kRadiusMm * facing(place) + Vector3d(0, 0, place.y());
}

Vector3d camera_at(double degrees, double higher = 0.0) {
  const double turn = degrees * std::numbers::pi / 180.0;
  return Vector3d(std::cos(turn), std::sin(turn), higher).normalized();
}

struct Errors {
  double sigma_mm = 0.0;  ///< along the line of sight
  double reach_mm = 8.0;
  double white_mm = 0.1;  ///< of each point, along its normal
  double told_white_mm = 0.1;
};

/// Points of one view and how far each lies outwards of the skin.
struct SeenPoints {
  std::vector<Vector2d> places;
  std::vector<double> off_mm;
};

SeenPoints seen_points(std::size_t count, const Vector3d& camera, const test::SmoothField& field,
                       const Errors& errors, test::RandomNumbers& random) {
  SeenPoints seen;
  while (seen.places.size() < count) {
    const Vector2d place(random.uniform(0.0, kWidthMm), random.uniform(0.0, kHeightMm));
    const double aslant = facing(place).dot(camera);
    if (aslant < 0.3) continue;
    seen.places.push_back(place);
    seen.off_mm.push_back(errors.sigma_mm * field.at(place) * aslant +
                          errors.white_mm * random.normal());
  }
  return seen;
}

PointCloud cloud_of(const SeenPoints& seen, const Vector3d& camera, const Errors& errors) {
  PointCloud cloud;
  for (std::size_t i = 0; i < seen.places.size(); ++i) {
    const Vector3d normal = facing(seen.places[i]);
    cloud.positions.emplace_back(skin_at(seen.places[i]) + seen.off_mm[i] * normal);
    cloud.normals.push_back(normal);
    cloud.sigma_mm.push_back(errors.told_white_mm);
    cloud.view_directions.push_back(camera);
  }
  return cloud;
}

/// What some cameras make of the post, and how their views match: each query with the target that
/// is nearest on the true skin.
struct Overlap {
  std::vector<MovingView> views;
  std::vector<ViewMatch> matches;
};

struct Crowd {
  std::size_t queries = 2000;
  std::size_t targets = 4000;
};

struct Camera {
  Vector3d towards;
  SeenPoints queries;
  SeenPoints targets;
};

std::vector<Camera> see(const std::vector<Vector3d>& directions, const Errors& errors,
                        const Crowd& crowd, test::RandomNumbers& random) {
  std::vector<Camera> cameras;
  for (const Vector3d& towards : directions) {
    const test::SmoothField field(errors.reach_mm, {kWidthMm, kHeightMm}, random.below(1U << 30U));
    cameras.push_back({towards, seen_points(crowd.queries, towards, field, errors, random),
                       seen_points(crowd.targets, towards, field, errors, random)});
  }
  return cameras;
}

void match(const std::vector<Camera>& cameras, std::size_t view, std::size_t other,
           const Errors& errors, std::vector<ViewMatch>& matches) {
  constexpr double kFarMm = 6.0;
  const SeenPoints& queries = cameras[view].queries;
  const SeenPoints& targets = cameras[other].targets;
  std::vector<Vector3d> skin;
  for (const auto& place : targets.places) skin.push_back(skin_at(place));
  const PointIndex index(std::move(skin));
  for (std::size_t i = 0; i < queries.places.size(); ++i) {
    const auto found = index.nearest(skin_at(queries.places[i]), 1);
    if (found.empty() || found[0].squared_distance > kFarMm * kFarMm) continue;
    const Vector3d normal = facing(queries.places[i]);
    matches.push_back({view, other, i, found[0].index,
                       skin_at(queries.places[i]) + queries.off_mm[i] * normal, normal,
                       queries.off_mm[i] - targets.off_mm[found[0].index],
                       2.0 * errors.told_white_mm * errors.told_white_mm});
  }
}

Overlap overlap_of(const std::vector<Vector3d>& directions, const Errors& errors,
                   std::uint64_t seed, const Crowd& crowd = {}) {
  test::RandomNumbers random(seed);
  const auto cameras = see(directions, errors, crowd, random);
  Overlap overlap;
  for (const auto& camera : cameras) {
    MovingView& view = overlap.views.emplace_back();
    view.queries = cloud_of(camera.queries, camera.towards, errors);
    view.targets = cloud_of(camera.targets, camera.towards, errors);
    view.towards_camera = camera.towards;
    view.taking_part = true;
  }
  for (std::size_t view = 0; view < cameras.size(); ++view) {
    for (std::size_t other = 0; other < cameras.size(); ++other) {
      if (view != other) match(cameras, view, other, errors, overlap.matches);
    }
  }
  return overlap;
}

const std::vector<Vector3d> kThreeCameras = {camera_at(-35), camera_at(35), camera_at(0, 0.8)};

/// Of several bodies: what one of them shows of errors that reach far is a matter of chance.
BentDepths told_on_average(const std::vector<Vector3d>& cameras, const Errors& errors,
                           const Crowd& crowd = {}, std::uint64_t bodies = 5) {
  BentDepths mean;
  double variance = 0.0;
  for (std::uint64_t seed = 1; seed <= bodies; ++seed) {
    const auto overlap = overlap_of(cameras, errors, seed, crowd);
    const auto told = bent_depths(overlap.views, overlap.matches);
    variance += told.sigma_mm * told.sigma_mm / static_cast<double>(bodies);
    mean.reach_mm += told.reach_mm / static_cast<double>(bodies);
  }
  mean.sigma_mm = std::sqrt(variance);
  return mean;
}

TEST(BentDepths, AreTold) {
  for (const double sigma : {0.1, 0.3}) {
    for (const double reach : {4.0, 8.0, 20.0}) {
      const auto told = told_on_average(kThreeCameras, {sigma, reach});
      EXPECT_NEAR(told.sigma_mm, sigma, 0.2 * sigma) << reach;
      EXPECT_NEAR(told.reach_mm, reach, 0.3 * reach) << sigma;
    }
  }
}

TEST(BentDepths, AreToldByTwoViews) {
  const auto told = told_on_average({camera_at(-20), camera_at(20)}, {0.3, 8.0});
  EXPECT_NEAR(told.sigma_mm, 0.3, 0.06);
  EXPECT_NEAR(told.reach_mm, 8.0, 2.4);
}

/// Both cameras look from one side, so that all skin between is seen aslant.
TEST(BentDepths, AreThoseAlongTheLineOfSight) {
  const auto told = told_on_average({camera_at(0, 1.2), camera_at(0, -1.2)}, {0.3, 8.0});
  EXPECT_NEAR(told.sigma_mm, 0.3, 0.06);
  EXPECT_NEAR(told.reach_mm, 8.0, 2.4);
}

TEST(BentDepths, AreNotWhiteNoise) {
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    const auto overlap = overlap_of(kThreeCameras, {}, seed);
    EXPECT_LT(bent_depths(overlap.views, overlap.matches).sigma_mm, 0.03) << seed;
  }
}

TEST(BentDepths, AreNotWhiteNoiseThatIsMoreThanTold) {
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    const auto overlap = overlap_of(kThreeCameras, {0.0, 8.0, 0.3, 0.1}, seed);
    EXPECT_LT(bent_depths(overlap.views, overlap.matches).sigma_mm, 0.1) << seed;
  }
}

/// Few targets: many queries share one, and its noise with it, which is more than told.
TEST(BentDepths, AreNotTheNoiseOfSharedPartners) {
  const auto told = told_on_average(kThreeCameras, {0.3, 20.0, 0.5, 0.3}, {3000, 500});
  EXPECT_NEAR(told.sigma_mm, 0.3, 0.06);
  EXPECT_NEAR(told.reach_mm, 20.0, 6.0);
}

TEST(BentDepths, AreNoneWhereNothingIsMatched) {
  EXPECT_FALSE(bent_depths({}, {}).is_any());
  const auto overlap = overlap_of(kThreeCameras, {0.3, 8.0}, 1);
  EXPECT_FALSE(bent_depths(overlap.views, {}).is_any());
}

TEST(BentDepths, AreNotToldByFewMatches) {
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    const auto overlap = overlap_of(kThreeCameras, {0.3, 20.0}, seed, {8, 4000});
    ASSERT_LT(overlap.matches.size(), 50U);
    EXPECT_FALSE(bent_depths(overlap.views, overlap.matches).is_any()) << seed;
  }
}

/// A point at the origin that faces upwards.
PointCloud one_point() {
  PointCloud cloud;
  cloud.positions = {Vector3d::Zero()};
  cloud.normals = {Vector3d::UnitZ()};
  return cloud;
}

constexpr BentDepths kBent{0.2, 9.0};
const Vector3d kAbove(0, 0, 600);
const Vector3d kAslant = 500.0 * Vector3d(std::sqrt(0.75), 0.0, 0.5);

double local_sigma(const std::vector<double>& shares, const std::vector<Vector3d>& cameras) {
  const Eigen::MatrixXd column =
      Eigen::Map<const Eigen::VectorXd>(shares.data(), static_cast<Eigen::Index>(shares.size()));
  const auto errors = local_errors_of(one_point(), column, cameras, kBent);
  EXPECT_EQ(errors.reach_mm, kBent.reach_mm);
  return errors.sigma_mm.at(0);
}

TEST(BentDepths, MoveSkinThatIsSeenAslantLess) {
  EXPECT_NEAR(local_sigma({1.0}, {kAbove}), 0.2, 1e-12);
  EXPECT_NEAR(local_sigma({1.0}, {kAslant}), 0.2 * 0.5, 1e-12);
}

TEST(BentDepths, MoveSkinLessThatMoreCamerasSee) {
  EXPECT_NEAR(local_sigma({0.5, 0.5}, {kAbove, 2.0 * kAbove}), 0.2 / std::sqrt(2.0), 1e-12);
  EXPECT_NEAR(local_sigma({0.5, 0.5}, {kAbove, kAslant}), 0.2 * std::hypot(0.5, 0.25), 1e-12);
  EXPECT_NEAR(local_sigma({0.0, 1.0}, {kAbove, kAslant}), 0.2 * 0.5, 1e-12);
}

/// As its cameras stand about it, not about the origin.
TEST(BentDepths, MoveEachPointByItsOwnViews) {
  PointCloud cloud = one_point();
  cloud.append(one_point());
  cloud.positions[1] = Vector3d(300, 0, 0);
  cloud.normals[1] = Vector3d::UnitX();
  Eigen::MatrixXd shares(2, 2);
  shares << 1.0, 0.25, 0.0, 0.75;
  const auto errors = local_errors_of(cloud, shares, {kAbove, {700, 0, 300}}, kBent);
  ASSERT_EQ(errors.sigma_mm.size(), 2U);
  EXPECT_NEAR(errors.sigma_mm[0], 0.2, 1e-12);
  // The first camera is behind it by 300 to 600, the second before it by 400 to 300.
  EXPECT_NEAR(errors.sigma_mm[1], 0.2 * std::hypot(0.25 / std::sqrt(5.0), 0.75 * 0.8), 1e-12);
}

TEST(BentDepths, ThatAreNoneMoveNothing) {
  const Eigen::MatrixXd alone = Eigen::MatrixXd::Ones(1, 1);
  EXPECT_TRUE(local_errors_of(one_point(), alone, {kAbove}, {}).empty());
  EXPECT_TRUE(local_errors_of({}, Eigen::MatrixXd(1, 0), {kAbove}, kBent).empty());
}

/// Its square is the last number below 72^2, the root of which is rounded to 72.
TEST(BentDepths, TakesTwoMatchesHardlyNearerThanTheLastClassEnds) {
  const Vector3d apart(71.99888888031536, 0.4, 0.0);
  ASSERT_LT(apart.squaredNorm(), 72.0 * 72.0);
  ASSERT_EQ(std::sqrt(apart.squaredNorm()), 72.0);
  std::vector<MovingView> views(2);
  for (auto& view : views) view.towards_camera = Vector3d::UnitZ();
  const std::vector<ViewMatch> matches = {
      {0, 1, 0, 0, Vector3d::Zero(), Vector3d::UnitZ(), 1.0, 1.0},
      {0, 1, 1, 1, apart, Vector3d::UnitZ(), 1.0, 1.0}};
  EXPECT_FALSE(bent_depths(views, matches).is_any());
}

}  // namespace
}  // namespace instep
