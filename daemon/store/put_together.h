#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "core/result.h"
#include "daemon/store/result_content.h"
#include "daemon/store/result_store.h"

namespace instep {

struct NamedContent {
  std::string id;
  ResultContent content;
};

/// Stores all results of a scan or none of them, for whoever scans again has no foot twice; gives
/// their folders. `step` is called before each. Where one that was stored cannot be removed again,
/// the error names it.
Result<std::vector<std::filesystem::path>> put_together(ResultStore& store,
                                                        const std::vector<NamedContent>& results,
                                                        const std::function<void()>& step);

}  // namespace instep
