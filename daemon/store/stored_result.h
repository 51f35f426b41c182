#pragma once

#include <filesystem>
#include <string>

#include "core/foot/side.h"

namespace instep {

/// A result that is on disk.
struct StoredResult {
  std::string id;
  std::filesystem::path folder;
  Side side = Side::kRight;
};

}  // namespace instep
