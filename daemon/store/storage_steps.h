#pragma once

#include <filesystem>
#include <string_view>

#include "core/result.h"
#include "daemon/store/storage.h"

namespace instep {

/// A new file with all of `bytes`, durable but for its name.
Result<void> write_file(Storage& storage, const std::filesystem::path& path,
                        std::string_view bytes);

/// A folder and all within it; of a link in it, the link alone.
Result<void> remove_whole(Storage& storage, const std::filesystem::path& folder);

}  // namespace instep
