#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>

namespace instep {

/// The kinds of number that binary cloud formats have.
enum class ScalarType { kInt8, kUint8, kInt16, kUint16, kInt32, kUint32, kFloat32, kFloat64 };

std::size_t size_of(ScalarType type);

/// True for all kinds but the floating ones.
bool is_whole(ScalarType type);

/// One number at any address. Whole numbers of 32 bits are exact in a double.
using ScalarLoader = double (*)(const char* address);

/// The function that loads a number of that type; `swapped` for the other byte order.
ScalarLoader scalar_loader(ScalarType type, bool swapped);

/// Where the numbers of one property go: to first, first + step, first + 2 * step ...
struct ColumnTarget {
  double* first = nullptr;
  std::size_t step = 1;
};

/// Copies a column out of records of `stride` bytes, beginning at `column`. The kind of number is
/// told apart once, not for each value.
void copy_column(const char* column, std::size_t stride, std::size_t count, ScalarType type,
                 bool swapped, const ColumnTarget& target);

}  // namespace instep
