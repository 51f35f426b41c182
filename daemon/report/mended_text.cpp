#include "daemon/report/mended_text.h"

#include <nlohmann/json.hpp>

#include "config/reading/printable_text.h"

namespace instep {
namespace {

void replace_all(std::string& text, std::string_view what) {
  for (auto at = text.find(what); at != std::string::npos; at = text.find(what, at)) {
    text.replace(at, what.size(), "\xEF\xBF\xBD");
  }
}

}  // namespace

std::string mended_text(std::string_view text) {
  using nlohmann::json;
  // By the writer of JSON, so that a page shows a name as its result.json does.
  const std::string written = json(text).dump(-1, ' ', false, json::error_handler_t::replace);
  std::string mended = json::parse(written).get<std::string>();
  for (const std::string_view no_character : {"\xEF\xBF\xBE", "\xEF\xBF\xBF"}) {
    replace_all(mended, no_character);
  }
  for (const auto mark : kDirectionMarks) replace_all(mended, mark);
  return mended;
}

}  // namespace instep
