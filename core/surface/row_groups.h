#pragma once

#include <Eigen/Core>

namespace instep {

/// Rows of small systems are worked on in groups of so many, the first from a multiple of it on and
/// the last filled up with zeros: whole groups cost less than exact ends.
inline constexpr Eigen::Index kRowGroup = 4;
using RowGroup = Eigen::Array<double, kRowGroup, 1>;

/// First row of the group in which a row is.
inline Eigen::Index group_of(Eigen::Index row) {
  return row - row % kRowGroup;
}

/// Rows of so many whole groups that `rows` have room.
inline Eigen::Index whole_groups(Eigen::Index rows) {
  return group_of(rows + kRowGroup - 1);
}

/// The group from row `first` on, of a column that begins at an aligned address.
inline auto rows_at(double* column, Eigen::Index first) {
  return RowGroup::MapAligned(column + first);
}
inline auto rows_at(const double* column, Eigen::Index first) {
  return RowGroup::MapAligned(column + first);
}
inline auto rows_at(Eigen::VectorXd& column, Eigen::Index first) {
  return rows_at(column.data(), first);
}
inline auto rows_at(const Eigen::VectorXd& column, Eigen::Index first) {
  return rows_at(column.data(), first);
}

}  // namespace instep
