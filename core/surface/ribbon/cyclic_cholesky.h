#pragma once

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <cmath>
#include <cstddef>
#include <optional>
#include <vector>

namespace instep {

/// A symmetric system of blocks in which each meets the next and the last meets the first, as
/// neighbours round a closed line do.
template <int kSide>
struct CyclicSystem {
  using Block = Eigen::Matrix<double, kSide, kSide>;

  std::vector<Block> own;   ///< each block with itself
  std::vector<Block> next;  ///< each with the one that follows it; the last with the first
};

/// Cholesky's method for such a system: what the last block shares with the first is carried along,
/// so that no block is filled but those beside the diagonal and those of the last. Eigen has none
/// for bands.
template <int kSide>
class CyclicCholesky {
 public:
  using Block = typename CyclicSystem<kSide>::Block;

  /// At least three blocks. Nothing if the system is not positive definite. O(blocks x side^3).
  static std::optional<CyclicCholesky> of(const CyclicSystem<kSide>& system) {
    const std::size_t end = system.own.size() - 1;
    CyclicCholesky result;
    Block own = system.own.front();
    Block to_last = system.next.back().transpose();
    Block last = system.own.back();
    for (std::size_t i = 0; i < end; ++i) {
      if (!result.add(own)) return std::nullopt;
      if (i + 1 == end) to_last += system.next[i];
      result.last_.push_back(result.own_.back().matrixL().solve(to_last));
      last.noalias() -= result.last_.back().transpose() * result.last_.back();
      if (i + 1 == end) break;
      result.next_.push_back(result.own_.back().matrixL().solve(system.next[i]));
      own = system.own[i + 1];
      own.noalias() -= result.next_.back().transpose() * result.next_.back();
      to_last.noalias() = -result.next_.back().transpose() * result.last_.back();
    }
    if (!result.add(last)) return std::nullopt;
    return result;
  }

  double log_determinant() const { return log_determinant_; }

  /// As many rows as all blocks together. O(blocks x side^2).
  Eigen::VectorXd solve(Eigen::VectorXd right) const {
    const std::size_t end = own_.size() - 1;
    const auto part = [&](std::size_t i) {
      return right.template segment<kSide>(static_cast<Eigen::Index>(i) * kSide);
    };
    for (std::size_t i = 0; i < end; ++i) {
      own_[i].matrixL().solveInPlace(part(i));
      if (i + 1 < end) part(i + 1) -= next_[i].transpose() * part(i);
      part(end) -= last_[i].transpose() * part(i);
    }
    own_[end].solveInPlace(part(end));
    for (std::size_t i = end; i-- > 0;) {
      part(i) -= last_[i] * part(end);
      if (i + 1 < end) part(i) -= next_[i] * part(i + 1);
      own_[i].matrixU().solveInPlace(part(i));
    }
    return right;
  }

 private:
  CyclicCholesky() = default;

  bool add(const Block& block) {
    own_.emplace_back(block);
    if (own_.back().info() != Eigen::Success) return false;
    log_determinant_ += 2.0 * own_.back().matrixLLT().diagonal().array().log().sum();
    return std::isfinite(log_determinant_);
  }

  std::vector<Eigen::LLT<Block>> own_;  ///< lower triangles
  std::vector<Block> next_;             ///< rows of each block against the following one
  std::vector<Block> last_;             ///< and against the last one
  double log_determinant_ = 0.0;
};

}  // namespace instep
