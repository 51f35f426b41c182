// Girths of bodies that a line scanner went over: many points on lines that are far apart.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>

#include "core/girth/girth.h"
#include "tests/support/analytic_shapes.h"
#include "tests/support/random_numbers.h"
#include "tests/support/scanned_lines.h"

namespace instep {
namespace {

using Eigen::Vector3d;
using test::ScannedLines;

/// Askew to a cylinder of these half-axes along z by so many degrees.
TapePlane plane_askew(double half_width, double half_depth, double degrees) {
  const double rise = std::tan(degrees * std::numbers::pi / 180.0);
  const auto at = [&](double angle) {
    const double x = half_width * std::cos(angle);
    const double y = half_depth * std::sin(angle);
    return Vector3d(x, y, rise * (0.8 * x + 0.6 * y));
  };
  return TapePlane::through(at(0), at(2), at(4)).value();
}

struct Errors {
  int told = 0;
  int held = 0;       ///< both intervals
  double most = 0.0;  ///< of both lengths
};

Errors errors_of(const ScannedLines& lines, std::uint64_t seeds = 4) {
  Errors errors;
  for (const double degrees : {3.0, 20.0, 45.0}) {
    const auto plane = plane_askew(lines.half_width, lines.half_depth, degrees);
    const double truth =
        test::true_girth(test::elliptic_cylinder(lines.half_width, lines.half_depth), plane);
    for (std::uint64_t seed = 1; seed <= seeds; ++seed) {
      PointCloud cloud;
      cloud.positions = lines.positions(seed);
      const auto girth = girth_by_rbf(cloud, plane);
      if (!girth) continue;
      ++errors.told;
      const double stretched = std::abs(girth->stretched_mm - truth);
      const double contact = std::abs(girth->contact_mm - truth);
      if (stretched <= *girth->stretched_u95_mm && contact <= *girth->contact_u95_mm) {
        ++errors.held;
      }
      errors.most = std::max({errors.most, stretched, contact});
    }
  }
  return errors;
}

/// The nearest points of a place are all on one line: of these most were refused.
TEST(ScannedLinesGirth, OfExactPointsIsToldByTheLinesBeside) {
  for (const bool round : {true, false}) {
    for (const double step : {0.8, 0.4, 0.25}) {
      const Errors errors = errors_of({40, 36, round, 7.0, step});
      EXPECT_EQ(errors.told, 12) << round << " " << step;
      EXPECT_LT(errors.most, 0.1) << round << " " << step;
      EXPECT_GE(errors.held, 11) << round << " " << step;
    }
  }
}

/// The slab that is looked at first holds but one of these lines.
TEST(ScannedLinesGirth, OfADenseLineIsTold) {
  const Errors errors = errors_of({40, 36, true, 8.0, 0.05});
  EXPECT_EQ(errors.told, 12);
  EXPECT_LT(errors.most, 0.05);
  EXPECT_GE(errors.held, 11);
}

/// The cells that a normal is made of held one line each, as thick as its noise, and faced
/// anywhere: contours folded.
TEST(ScannedLinesGirth, OfNoisyPointsDoesNotFold) {
  for (const bool round : {true, false}) {
    for (const double step : {1.2, 0.4}) {
      const Errors errors = errors_of({40, 36, round, 6.0, step, 0.4});
      EXPECT_EQ(errors.told, 12) << round << " " << step;
      EXPECT_LT(errors.most, 0.5) << round << " " << step;
      EXPECT_GE(errors.held, 11) << round << " " << step;
    }
  }
}

/// Cells of less than a hundredth of the section were left alone, and one row of these was seen.
TEST(ScannedLinesGirth, OfLinesNearEachOtherIsTold) {
  const Errors errors = errors_of({40, 30, false, 3.0, 0.25});
  EXPECT_EQ(errors.told, 12);
  EXPECT_GE(errors.held, 10);
  EXPECT_LT(errors.most, 0.02);
}

/// What a laser leaves: the nearest points of a line all lie on a sheet across the skin, and passed
/// for exact.
TEST(ScannedLinesGirth, OfLinesAsThickAsTheyAreNearIsTold) {
  for (const bool round : {true, false}) {
    for (const double sigma : {0.2, 0.3, 0.5}) {
      const Errors errors = errors_of({42, 30, round, 2.7, 0.15, sigma});
      EXPECT_EQ(errors.told, 12) << round << " " << sigma;
      EXPECT_LT(errors.most, 0.5) << round << " " << sigma;
      EXPECT_GE(errors.held, 10) << round << " " << sigma;
    }
  }
}

/// Averages were made of points on one side of their line; a loop of a few millimetres between two
/// lines passed for the section, and contours that were folded were told as if they were not.
TEST(ScannedLinesGirth, OfLinesAlmostAsThickAsTheyAreApartHolds) {
  for (const bool round : {true, false}) {
    for (const double sigma : {0.5, 0.6}) {
      const Errors errors = errors_of({42, 30, round, 2.7, 0.09, sigma});
      EXPECT_EQ(errors.told, 12) << round << " " << sigma;
      EXPECT_GE(errors.held, 10) << round << " " << sigma;
    }
  }
}

/// Where all points within a twelfth of the gap counted alike, noise decided which of a ring did:
/// those that it moved inwards.
TEST(ScannedLinesGirth, OfRingsIsNotDrawnInwards) {
  for (const double apart : {4.0, 6.0, 8.0}) {
    const Errors errors = errors_of({42, 30, true, apart, 0.08 * apart, 0.05 * apart});
    EXPECT_EQ(errors.told, 12) << apart;
    EXPECT_GE(errors.held, 11) << apart;
  }
}

/// Noise was kept in layers, the more points the more: contours folded.
TEST(ScannedLinesGirth, OfManyNoisyPointsIsNoWorse) {
  const Errors errors = errors_of({40, 36, true, 7.0, 0.1, 0.5});
  EXPECT_EQ(errors.told, 12);
  EXPECT_LT(errors.most, 0.6);
  EXPECT_GE(errors.held, 10);
}

/// They passed for the edges of a prism, 2 mm too long; where exact points tell an edge sooner than
/// others, 21 mm.
TEST(ScannedLinesGirth, OfFewLinesAlongABodyIsRound) {
  for (const double step : {0.5, 3.0}) {
    const Errors errors = errors_of({45, 32, false, 14.0, step});
    EXPECT_EQ(errors.told, 12) << step;
    EXPECT_LT(errors.most, 0.1) << step;
  }
  EXPECT_LT(errors_of({40, 40, false, 20.0, 1.0}).most, 0.1);
  EXPECT_LT(errors_of({40, 30, false, 20.0, 0.5}).most, 0.3);
}

/// Rows hardly further apart than their points: with bent sheets, but nothing asked of rows, 1.8 mm
/// too long.
TEST(ScannedLinesGirth, OfAWideLatticeAlongABodyIsRound) {
  for (const double apart : {8.0, 11.0, 14.0}) {
    const Errors errors = errors_of({45, 24, false, apart, apart / 1.7});
    EXPECT_EQ(errors.told, 12) << apart;
    EXPECT_LT(errors.most, 0.15) << apart;
  }
}

/// Each kept a cell of its own where hundreds of points of the lines were thinned to one: contact
/// lengths were up to 129 mm too long.
TEST(ScannedLinesGirth, OfAFewStraysIsToldByTheLines) {
  for (const bool round : {true, false}) {
    for (const auto& [apart, step, sigma] :
         {std::array{2.7, 0.15, 0.05}, {4.0, 0.15, 0.2}, {6.0, 0.4, 0.0}, {8.0, 0.4, 0.4}}) {
      const Errors errors = errors_of({42, 32, round, apart, step, sigma, 0.005}, 2);
      EXPECT_EQ(errors.told, 6) << round << " " << apart;
      EXPECT_GE(errors.held, 5) << round << " " << apart;
      EXPECT_LT(errors.most, 0.3) << round << " " << apart;
    }
  }
}

/// They were left out without a word.
TEST(ScannedLinesGirth, OfManyStraysTellsOfThese) {
  const auto warnings_with = [](double strays) {
    PointCloud cloud;
    cloud.positions = ScannedLines{42, 32, true, 6.0, 0.2, 0.05, strays}.positions(1);
    return girth_by_rbf(cloud, plane_askew(42, 32, 3)).value().warnings;
  };
  EXPECT_TRUE(warnings_with(0.005).empty());
  const auto warnings = warnings_with(0.04);
  ASSERT_EQ(warnings.size(), 1U);
  EXPECT_EQ(warnings.front().find("many points near the plane lie off the skin"), 0U);
}

/// Where nothing is thinned they dented the surface: contact lengths were up to 32 mm too long.
TEST(ScannedLinesGirth, OfAFewStraysIsToldByThePointsRound) {
  for (const bool round : {true, false}) {
    for (const auto& [apart, step, sigma] :
         {std::array{0.8, 0.8, 0.05}, {1.5, 0.4, 0.0}, {2.7, 0.4, 0.0}, {2.7, 0.8, 0.2}}) {
      const Errors errors = errors_of({42, 32, round, apart, step, sigma, 0.005}, 2);
      EXPECT_EQ(errors.told, 6) << round << " " << apart << " " << sigma;
      EXPECT_GE(errors.held, 5) << round << " " << apart << " " << sigma;
      EXPECT_LT(errors.most, 0.3) << round << " " << apart << " " << sigma;
    }
  }
}

constexpr double kSigma = 0.2;

PointCloud noisy_rings() {
  PointCloud cloud;
  cloud.positions = ScannedLines{40, 36, true, 6.0, 0.3, kSigma}.positions(1);
  return cloud;
}

Girth girth_of(const PointCloud& cloud, std::optional<double> sigma_mm) {
  return girth_by_rbf(cloud, plane_askew(40, 36, 3), {.sigma_mm = sigma_mm}).value();
}

/// Averages counted points by the noise that came with them all the same.
TEST(ScannedLinesGirth, TakesTheNoiseThatIsGivenInPlaceOfThatOfThePoints) {
  PointCloud cloud = noisy_rings();
  const Girth alone = girth_of(cloud, kSigma);
  for (std::size_t i = 0; i < cloud.size(); ++i) cloud.sigma_mm.push_back(i % 2 ? 0.02 : kSigma);
  const Girth both = girth_of(cloud, kSigma);
  EXPECT_EQ(both.stretched_mm, alone.stretched_mm);
  EXPECT_EQ(both.stretched_u95_mm, alone.stretched_u95_mm);
  EXPECT_TRUE(both.warnings.empty()) << both.warnings.front();
}

/// Points that stand alone among averages were taken for as sure as these where one noise was told
/// of all.
TEST(ScannedLinesGirth, IsTheSameWhetherTheNoiseIsToldOnceOrOfEachPoint) {
  PointCloud cloud = noisy_rings();
  test::RandomNumbers random(2);
  for (int i = 0; i < 40; ++i) {
    const double angle = random.uniform(0.0, 2.0 * std::numbers::pi);
    cloud.positions.emplace_back(40.0 * std::cos(angle), 36.0 * std::sin(angle),
                                 random.uniform(-20.0, 20.0));
  }
  const Girth once = girth_of(cloud, kSigma);
  cloud.sigma_mm.assign(cloud.size(), kSigma);
  const Girth each = girth_of(cloud, std::nullopt);
  EXPECT_NEAR(once.stretched_mm, each.stretched_mm, 1e-9);
  EXPECT_NEAR(*once.stretched_u95_mm, *each.stretched_u95_mm, 1e-9);
}

/// It was that of averages, so that whoever gave it as advised was told the same again.
TEST(ScannedLinesGirth, TellsTheNoiseOfThePoints) {
  const PointCloud cloud = noisy_rings();
  const Girth shown = girth_of(cloud, std::nullopt);
  EXPECT_NEAR(shown.sigma_mm, kSigma, 0.25 * kSigma);
  const Girth disbelieved = girth_of(cloud, 0.05);
  EXPECT_NEAR(disbelieved.sigma_mm, kSigma, 0.25 * kSigma);
  EXPECT_FALSE(disbelieved.warnings.empty());
  EXPECT_TRUE(girth_of(cloud, disbelieved.sigma_mm).warnings.empty());
}

}  // namespace
}  // namespace instep
