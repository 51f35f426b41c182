#include "core/surface/ribbon/cyclic_cholesky.h"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <limits>

#include "tests/support/random_numbers.h"

namespace instep {
namespace {

constexpr int kSide = 3;
using System = CyclicSystem<kSide>;

System random_system(std::size_t blocks, double diagonal, std::uint64_t seed) {
  test::RandomNumbers random(seed);
  const auto block = [&] {
    return System::Block(System::Block::NullaryExpr([&] { return random.normal(); }));
  };
  System system;
  for (std::size_t i = 0; i < blocks; ++i) {
    const System::Block own = block();
    system.own.push_back(own * own.transpose() + diagonal * System::Block::Identity());
    system.next.push_back(block());
  }
  return system;
}

Eigen::MatrixXd dense(const System& system) {
  const auto blocks = static_cast<Eigen::Index>(system.own.size());
  Eigen::MatrixXd matrix = Eigen::MatrixXd::Zero(blocks * kSide, blocks * kSide);
  for (Eigen::Index i = 0; i < blocks; ++i) {
    const Eigen::Index next = (i + 1) % blocks;
    const auto at = static_cast<std::size_t>(i);
    matrix.block<kSide, kSide>(i * kSide, i * kSide) = system.own[at];
    matrix.block<kSide, kSide>(i * kSide, next * kSide) += system.next[at];
    matrix.block<kSide, kSide>(next * kSide, i * kSide) += system.next[at].transpose();
  }
  return matrix;
}

TEST(CyclicCholesky, SolvesAsADenseOneDoes) {
  for (const std::size_t blocks : {3U, 4U, 9U}) {
    const System system = random_system(blocks, 12.0, blocks);
    const Eigen::MatrixXd matrix = dense(system);
    const Eigen::VectorXd right =
        Eigen::VectorXd::LinSpaced(static_cast<Eigen::Index>(blocks) * kSide, -1.0, 2.0);
    const auto cholesky = CyclicCholesky<kSide>::of(system);
    ASSERT_TRUE(cholesky) << blocks;
    EXPECT_LT((matrix * cholesky->solve(right) - right).norm(), 1e-12) << blocks;
    EXPECT_NEAR(
        cholesky->log_determinant(),
        Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(matrix).eigenvalues().array().log().sum(),
        1e-10)
        << blocks;
  }
}

TEST(CyclicCholesky, IsNotMadeWhereTheSystemIsNotPositiveDefinite) {
  // Whichever block shows it: the first, one in between, or the last.
  for (const std::size_t place : {0U, 2U, 4U}) {
    System system = random_system(5, 12.0, 7);
    ASSERT_TRUE(CyclicCholesky<kSide>::of(system));
    system.own[place](1, 1) = -1.0;
    EXPECT_FALSE(CyclicCholesky<kSide>::of(system)) << place;
  }
  System nothing = random_system(4, 12.0, 3);
  nothing.own[1].setConstant(std::numeric_limits<double>::quiet_NaN());
  EXPECT_FALSE(CyclicCholesky<kSide>::of(nothing));
}

}  // namespace
}  // namespace instep
