#include "daemon/cloud_files/scalar_column.h"

#include <algorithm>
#include <array>
#include <cstring>

namespace instep {
namespace {

template <typename T, bool kSwapped>
double load(const char* address) {
  std::array<char, sizeof(T)> bytes;
  std::memcpy(bytes.data(), address, sizeof(T));
  if constexpr (kSwapped) std::reverse(bytes.begin(), bytes.end());
  T value;
  std::memcpy(&value, bytes.data(), sizeof(T));
  return static_cast<double>(value);
}

template <typename T, bool kSwapped>
void copy(const char* column, std::size_t stride, std::size_t count, const ColumnTarget& target) {
  double* out = target.first;
  for (std::size_t i = 0; i < count; ++i, column += stride, out += target.step) {
    *out = load<T, kSwapped>(column);
  }
}

/// Calls `work` with a value of the C++ type that belongs to `type`.
template <typename Work>
auto with_type(ScalarType type, const Work& work) {
  switch (type) {
    case ScalarType::kInt8:
      return work(std::int8_t{});
    case ScalarType::kUint8:
      return work(std::uint8_t{});
    case ScalarType::kInt16:
      return work(std::int16_t{});
    case ScalarType::kUint16:
      return work(std::uint16_t{});
    case ScalarType::kInt32:
      return work(std::int32_t{});
    case ScalarType::kUint32:
      return work(std::uint32_t{});
    case ScalarType::kFloat32:
      return work(float{});
    case ScalarType::kFloat64:
      break;
  }
  return work(double{});
}

}  // namespace

std::size_t size_of(ScalarType type) {
  return with_type(type, [](auto value) { return sizeof(value); });
}

bool is_whole(ScalarType type) {
  return type != ScalarType::kFloat32 && type != ScalarType::kFloat64;
}

ScalarLoader scalar_loader(ScalarType type, bool swapped) {
  return with_type(type, [swapped](auto value) -> ScalarLoader {
    return swapped ? &load<decltype(value), true> : &load<decltype(value), false>;
  });
}

void copy_column(const char* column, std::size_t stride, std::size_t count, ScalarType type,
                 bool swapped, const ColumnTarget& target) {
  with_type(type, [&](auto value) {
    using T = decltype(value);
    swapped ? copy<T, true>(column, stride, count, target)
            : copy<T, false>(column, stride, count, target);
    return 0;
  });
}

}  // namespace instep
