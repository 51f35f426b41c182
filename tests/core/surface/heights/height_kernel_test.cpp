#include "core/surface/heights/height_kernel.h"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <Eigen/QR>
#include <cmath>

#include "core/surface/heights/height_samples.h"
#include "tests/support/random_numbers.h"

namespace instep {
namespace {

using Eigen::Index;
using Eigen::Matrix2Xd;
using Eigen::MatrixXd;
using Eigen::Vector2d;
using Eigen::VectorXd;

constexpr HeightKernel kKernels[] = {HeightKernel::kCubic, HeightKernel::kQuintic,
                                     HeightKernel::kSeptic};
constexpr double kStep = 1e-4;
/// Of what differences over that step tell.
constexpr double kOff = 1e-6;

double plain(HeightKernel kernel, const Vector2d& a, const Vector2d& b) {
  const double distance = (a - b).norm();
  if (kernel == HeightKernel::kCubic) return std::pow(distance, 3);
  return kernel == HeightKernel::kQuintic ? -std::pow(distance, 5) : std::pow(distance, 7);
}

/// What a height (0) or a slope (1, 2) at a place means for a field: by central differences.
template <class Field>
double read(Index what, const Vector2d& place, const Field& field) {
  if (what == 0) return field(place);
  const Vector2d step = kStep * Vector2d::Unit(what - 1);
  return (field(place + step) - field(place - step)) / (2.0 * kStep);
}

/// What two readings share.
double shared(HeightKernel kernel, Index one, const Vector2d& a, Index other, const Vector2d& b) {
  return read(one, a, [&](const Vector2d& near_a) {
    return read(other, b, [&](const Vector2d& near_b) { return plain(kernel, near_a, near_b); });
  });
}

Matrix2Xd random_places(Index count, std::uint64_t seed) {
  test::RandomNumbers random(seed);
  Matrix2Xd places(2, count);
  for (double& coordinate : places.reshaped()) coordinate = random.uniform(-0.7, 0.7);
  return places;
}

VectorXd random_vector(Index count, std::uint64_t seed) {
  test::RandomNumbers random(seed);
  VectorXd vector(count);
  for (double& entry : vector) entry = random.uniform(0.5, 2.0);
  return vector;
}

MatrixXd whole(const MatrixXd& lower) {
  return lower.selfadjointView<Eigen::Lower>();
}

TEST(HeightKernel, OfHeightsIsThePowerOfTheirDistance) {
  const Matrix2Xd places = random_places(9, 1);
  const Eigen::ArrayXd scales = random_vector(9, 2);
  for (const auto kernel : kKernels) {
    const MatrixXd matrix = kernel_between(kernel, places, scales);
    for (Index i = 0; i < 9; ++i) {
      for (Index j = 0; j <= i; ++j) {
        const double expected = scales[i] * scales[j] * plain(kernel, places.col(i), places.col(j));
        EXPECT_NEAR(matrix(i, j), expected, 1e-13);
      }
    }
  }
}

TEST(HeightKernel, OfSlopesIsTheDerivativeByDifferences) {
  const Index count = 8;
  const Matrix2Xd places = random_places(count, 3);
  const Eigen::ArrayXd scales = random_vector(3 * count, 4);
  for (const auto kernel : kKernels) {
    const MatrixXd matrix = sloped_kernel_between(kernel, places, scales);
    ASSERT_EQ(matrix.rows(), 3 * count);
    for (Index row = 0; row < 3 * count; ++row) {
      for (Index column = 0; column <= row; ++column) {
        const Index i = row % count;
        const Index j = column % count;
        if (i == j) continue;
        const double expected =
            scales[row] * scales[column] *
            shared(kernel, row / count, places.col(i), column / count, places.col(j));
        EXPECT_NEAR(matrix(row, column), expected, kOff * (1.0 + std::abs(expected)))
            << power_of(kernel) << ": " << row << " " << column;
      }
    }
  }
}

/// The kernels' derivatives up to the second vanish where there is no distance: r^3's fade in
/// proportion to it.
TEST(HeightKernel, OfASampleWithItselfOrACopyIsNothing) {
  Matrix2Xd places(2, 2);
  places << 0.3, 0.3, -0.2, -0.2;
  for (const auto kernel : kKernels) {
    const MatrixXd matrix = whole(sloped_kernel_between(kernel, places, Eigen::ArrayXd::Ones(6)));
    for (const double entry : matrix.reshaped()) EXPECT_NEAR(entry, 0.0, 1e-30);
    const MatrixXd at_first = sloped_kernels_at(kernel, places, places.col(0));
    for (const double entry : at_first.reshaped()) EXPECT_NEAR(entry, 0.0, 1e-30);
    for (Index one = 0; one < 3; ++one) {
      for (Index other = 0; other < 3; ++other) {
        EXPECT_LT(std::abs(shared(kernel, one, places.col(0), other, places.col(1))), 10.0 * kStep);
      }
    }
  }
}

TEST(HeightKernel, DoesNotDependOnWhichSampleComesFirst) {
  const Index count = 7;
  const Matrix2Xd places = random_places(count, 5);
  const Matrix2Xd reversed = places.rowwise().reverse();
  const Eigen::ArrayXd one = Eigen::ArrayXd::Ones(3 * count);
  for (const auto kernel : kKernels) {
    const MatrixXd matrix = whole(sloped_kernel_between(kernel, places, one));
    const MatrixXd other = whole(sloped_kernel_between(kernel, reversed, one));
    for (Index row = 0; row < 3 * count; ++row) {
      for (Index column = 0; column < 3 * count; ++column) {
        const auto there = [](Index at) { return at / count * count + count - 1 - at % count; };
        EXPECT_NEAR(other(there(row), there(column)), matrix(row, column), 1e-13);
      }
    }
  }
}

/// Off the polynomials that go with it, sums of readings have positive variance.
TEST(HeightKernel, IsConditionallyPositiveDefiniteWithSlopes) {
  const Index count = 12;
  const Matrix2Xd places = random_places(count, 6);
  for (const auto kernel : kKernels) {
    const Index terms = fewest_terms(kernel);
    MatrixXd block(3 * count, terms);
    for (Index i = 0; i < 3 * count; ++i) {
      for (Index term = 0; term < terms; ++term) {
        block(i, term) = read(i / count, places.col(i % count),
                              [&](const Vector2d& place) { return monomials(place, 10)(0, term); });
      }
    }
    const MatrixXd orthogonal = Eigen::HouseholderQR<MatrixXd>(block).householderQ();
    const MatrixXd rest = orthogonal.rightCols(3 * count - terms);
    const MatrixXd matrix =
        whole(sloped_kernel_between(kernel, places, Eigen::ArrayXd::Ones(3 * count)));
    const Eigen::SelfAdjointEigenSolver<MatrixXd> solver(rest.transpose() * matrix * rest);
    EXPECT_GT(solver.eigenvalues().minCoeff(), 0.0) << power_of(kernel);
  }
}

TEST(HeightKernel, SumsAreThoseOfKernelsOneByOne) {
  const Matrix2Xd samples = random_places(10, 7);
  const Matrix2Xd places = random_places(4, 8);
  const VectorXd shares = Eigen::Vector4d(0.5, -1.2, 2.0, 0.3);
  for (const auto kernel : kKernels) {
    const auto kernels = [&](const Vector2d& sample) {
      double sum = 0.0;
      for (Index i = 0; i < 4; ++i) sum += shares[i] * plain(kernel, sample, places.col(i));
      return sum;
    };
    const Eigen::ArrayXd heights = kernels_at(kernel, samples, places) * shares;
    const Eigen::ArrayXd readings = sloped_kernels_at(kernel, samples, places) * shares;
    ASSERT_EQ(heights.size(), 10);
    ASSERT_EQ(readings.size(), 30);
    for (Index i = 0; i < 10; ++i) {
      EXPECT_NEAR(heights[i], kernels(samples.col(i)), 1e-12);
      for (Index what = 0; what < 3; ++what) {
        const double expected = read(what, samples.col(i), kernels);
        EXPECT_NEAR(readings[10 * what + i], expected, kOff * (1.0 + std::abs(expected)));
      }
    }
  }
}

TEST(HeightKernel, GoesWithThePolynomialsOfItsOrder) {
  for (const auto kernel : kKernels) {
    const double order = (power_of(kernel) + 1.0) / 2.0;  // monomials of less degree, in the plane
    EXPECT_DOUBLE_EQ(static_cast<double>(fewest_terms(kernel)), order * (order + 1.0) / 2.0);
    EXPECT_DOUBLE_EQ(std::log2(std::abs(plain(kernel, {0, 0}, {2, 0}))), power_of(kernel));
  }
}

}  // namespace
}  // namespace instep
