#include "daemon/store/put_together.h"

#include <cstddef>
#include <utility>

namespace instep {

Result<std::vector<std::filesystem::path>> put_together(ResultStore& store,
                                                        const std::vector<NamedContent>& results,
                                                        const std::function<void()>& step) {
  std::vector<std::filesystem::path> folders;
  std::size_t bytes = 0;
  for (const auto& result : results) bytes += result.content.bytes();
  store.expect(bytes);
  for (const auto& [id, content] : results) {
    step();
    auto folder = store.put(id, content);
    if (folder) {
      folders.push_back(std::move(*folder));
      continue;
    }
    Error error = std::move(folder).error();
    for (std::size_t before = 0; before < folders.size(); ++before) {
      if (store.remove(results[before].id)) continue;
      error.message += "; of this scan, " + results[before].id + " is stored and cannot be removed";
    }
    return tl::make_unexpected(std::move(error));
  }
  return folders;
}

}  // namespace instep
