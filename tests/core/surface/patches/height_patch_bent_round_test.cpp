#include "core/surface/patches/height_patch.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>

#include "tests/support/oriented_points.h"

namespace instep {
namespace {

using Eigen::Vector3d;

/// Skin whose outward direction is x, so that y leads round the body and z along it, with waves in
/// one of the two directions.
struct WavySkin {
  Vector3d waves;  ///< radians for each unit

  double rise_at(const Vector3d& place) const { return 0.05 * std::sin(waves.dot(place)); }

  HeightPatch patch(double sigma, std::uint64_t seed) const {
    auto points = test::disc_points(Vector3d::Zero(), Vector3d::UnitX(), 1.0, 60, sigma, seed);
    for (auto& point : points) point.position.x() += rise_at(point.position);
    return HeightPatch::fit(points, Vector3d::Zero(), Vector3d::UnitX(), 1.0, 0.05).value();
  }

  /// Root mean square, amid a patch, over some draws.
  double error(double sigma) const {
    constexpr std::uint64_t kDraws = 40;
    double squares = 0.0;
    int count = 0;
    for (std::uint64_t seed = 1; seed <= kDraws; ++seed) {
      const HeightPatch fitted = patch(sigma, seed);
      for (const double y : {-0.3, 0.0, 0.3}) {
        for (const double z : {-0.3, 0.0, 0.3}) {
          const Vector3d place(0.0, y, z);
          squares += std::pow(fitted.at(place).value + rise_at(place), 2);
          ++count;
        }
      }
    }
    return std::sqrt(squares / count);
  }
};

const WavySkin kBentRound{{0.0, 5.0, 0.0}};
const WavySkin kBentAlong{{0.0, 0.0, 5.0}};

TEST(HeightPatchBentRound, NoisySkinIsToldBetterThanSkinThatBendsAlong) {
  EXPECT_LT(kBentRound.error(0.02), 0.9 * kBentAlong.error(0.02));
}

/// Random on a piece of a cylinder that is bent round the body, towards its inside or from it.
std::vector<OrientedPoint> cylinder_points(double bend, std::size_t count, std::uint64_t seed) {
  auto points = test::disc_points(Vector3d::Zero(), Vector3d::UnitX(), 1.0, count, 0.0, seed);
  for (auto& point : points) {
    const double turned = bend * point.position.y();
    const double z = point.position.z();
    point.position = Vector3d((std::cos(turned) - 1.0) / bend, std::sin(turned) / bend, z);
    point.normal = Vector3d(std::cos(turned), std::sin(turned), 0.0);
  }
  return points;
}

/// Root mean square distance from the cylinder of other points of it.
double off_cylinder(const HeightPatch& patch, double bend) {
  double squares = 0.0;
  const auto others = cylinder_points(bend, 100, 99);
  for (const auto& other : others) squares += std::pow(patch.at(other.position).value, 2);
  return std::sqrt(squares / static_cast<double>(others.size()));
}

/// The same points turned about the outward direction are a cylinder along which the body bends,
/// and told by kernels alone.
TEST(HeightPatchBentRound, ExactSkinIsToldFarBetterThanSkinThatBendsAlong) {
  const Eigen::Matrix3d quarter =
      Eigen::AngleAxisd(0.5 * std::numbers::pi, Vector3d::UnitX()).toRotationMatrix();
  const auto fit = [](const std::vector<OrientedPoint>& points) {
    return HeightPatch::fit(points, Vector3d::Zero(), Vector3d::UnitX(), 1.0, 0.05).value();
  };
  for (const double bend : {0.6, 0.3, -0.4}) {
    const auto points = cylinder_points(bend, 40, 1);
    auto turned = points;
    for (auto& point : turned) point.position = quarter * point.position;
    const auto along = fit(turned);
    double squares = 0.0;
    for (const auto& other : cylinder_points(bend, 100, 99))
      squares += std::pow(along.at(quarter * other.position).value, 2) / 100.0;
    EXPECT_LT(off_cylinder(fit(points), bend), 0.1 * std::sqrt(squares)) << bend;
  }
}

TEST(HeightPatchBentRound, FewExactPointsHaveAPlaneForABase) {
  const auto off = [](std::size_t count) {
    const auto points = cylinder_points(0.6, count, 1);
    return off_cylinder(
        HeightPatch::fit(points, Vector3d::Zero(), Vector3d::UnitX(), 1.0, 0.05).value(), 0.6);
  };
  EXPECT_LT(off(23), 0.01);
  EXPECT_GT(off(23), 20.0 * off(24));
}

/// What is thought to be outwards is that but roughly.
TEST(HeightPatchBentRound, ExactSkinIsToldAlikeByAPlaneThatLeans) {
  const auto points = cylinder_points(0.5, 50, 1);
  for (const double lean : {-0.4, 0.4}) {
    const Vector3d outward(std::cos(lean), std::sin(lean), 0.0);
    const auto patch = HeightPatch::fit(points, Vector3d::Zero(), outward, 1.0, 0.05);
    ASSERT_TRUE(patch);
    EXPECT_LT(off_cylinder(*patch, 0.5), 2e-4) << lean;
  }
}

/// They seem straight from above, and so they tell a bend along them alone.
TEST(HeightPatchBentRound, PointsOnABentLineAreNoSurface) {
  std::vector<OrientedPoint> points;
  for (int i = -20; i <= 20; ++i) {
    const double way = 0.05 * i;
    points.push_back({{-0.25 * way * way, 0.8 * way, 0.6 * way}, Vector3d::UnitX(), 0.0});
  }
  EXPECT_FALSE(HeightPatch::fit(points, Vector3d::Zero(), Vector3d::UnitX(), 1.0, 0.05));
}

/// Moving a point's height moves a sum of heights by its influence, but for what it bends the base.
TEST(HeightPatchBentRound, InfluenceOfExactPointsIsNearlyThatOnTheSum) {
  auto points = cylinder_points(0.6, 50, 3);
  for (auto& point : points) {
    const Vector3d at = point.position;
    point.position += 0.03 * std::sin(6.0 * at.y()) * std::cos(5.0 * at.z()) * point.normal;
  }
  const auto fit = [&] {
    return HeightPatch::fit(points, Vector3d::Zero(), Vector3d::UnitX(), 1.0, 0.05).value();
  };
  const HeightPatch before = fit();
  const Vector3d place(-0.07, 0.47, 0.2);
  const auto sums = before.sums({place}, Eigen::MatrixXd::Ones(1, 1));
  constexpr double kMove = 1e-6;
  for (std::size_t moved = 0; moved < points.size(); ++moved) {
    points[moved].position += kMove * points[moved].normal;
    const double rise = before.at(place).value - fit().at(place).value;
    EXPECT_NEAR(rise / kMove, sums.influence(static_cast<Eigen::Index>(moved), 0), 0.01) << moved;
    points[moved].position -= kMove * points[moved].normal;
  }
}

TEST(HeightPatchBentRound, GradientOfNoisySkinIsThatOfItsValue) {
  const HeightPatch patch = kBentRound.patch(0.02, 3);
  const auto value = [&](const Vector3d& place) { return patch.at(place).value; };
  for (const double y : {-0.4, 0.1, 0.5}) {
    const Vector3d place(0.02, y, 0.2);
    const Vector3d expected = test::slope_by_differences(value, place, 1e-5);
    EXPECT_NEAR((patch.at(place).gradient - expected).norm(), 0.0, 1e-7);
  }
}

/// Moving a point's height moves a sum of heights by its influence.
TEST(HeightPatchBentRound, InfluenceOfNoisyPointsIsThatOnTheSum) {
  auto points = test::disc_points(Vector3d::Zero(), Vector3d::UnitX(), 1.0, 40, 0.05, 4);
  const auto fit = [&] {
    return HeightPatch::fit(points, Vector3d::Zero(), Vector3d::UnitX(), 1.0, 0.05).value();
  };
  const HeightPatch before = fit();
  const Vector3d place(0.0, 0.1, -0.2);
  const auto sums = before.sums({place}, Eigen::MatrixXd::Ones(1, 1));
  constexpr double kMove = 1e-6;
  for (const std::size_t moved : {0U, 7U, 31U}) {
    points[moved].position.x() += kMove;
    const double rise = before.at(place).value - fit().at(place).value;
    EXPECT_NEAR(rise / kMove, sums.influence(static_cast<Eigen::Index>(moved), 0), 1e-4);
    points[moved].position.x() -= kMove;
  }
}

}  // namespace
}  // namespace instep
