#include "daemon/report/mended_text.h"

#include <nlohmann/json.hpp>

namespace instep {

std::string mended_text(std::string_view text) {
  using nlohmann::json;
  // By the writer of JSON, so that a page shows a name as its result.json does.
  const std::string written = json(text).dump(-1, ' ', false, json::error_handler_t::replace);
  std::string mended = json::parse(written).get<std::string>();
  for (const std::string_view no_character : {"\xEF\xBF\xBE", "\xEF\xBF\xBF"}) {
    for (auto at = mended.find(no_character); at != std::string::npos;
         at = mended.find(no_character, at)) {
      mended.replace(at, no_character.size(), "\xEF\xBF\xBD");
    }
  }
  return mended;
}

}  // namespace instep
