#include "core/error_names.h"

namespace instep {
namespace {

/// The one of that name among all up to `last`.
template <typename Named>
std::optional<Named> named(std::string_view name, Named last) {
  for (int i = 0; i <= static_cast<int>(last); ++i) {
    if (name == to_string(static_cast<Named>(i))) return static_cast<Named>(i);
  }
  return std::nullopt;
}

}  // namespace

std::optional<ErrorCode> error_code_from(std::string_view name) {
  return named(name, ErrorCode::kInternal);
}

std::optional<Remedy> remedy_from(std::string_view name) {
  return named(name, Remedy::kBug);
}

}  // namespace instep
