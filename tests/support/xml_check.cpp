#include "tests/support/xml_check.h"

#include <vector>

namespace instep::test {

std::string fault_in_xml(const std::string& xml) {
  std::vector<std::string> open;
  for (std::size_t at = xml.find('<'); at != std::string::npos; at = xml.find('<', at + 1)) {
    const std::size_t end = xml.find('>', at);
    if (end == std::string::npos) return "a tag has no end";
    const std::string tag = xml.substr(at + 1, end - at - 1);
    if (tag.find('<') != std::string::npos) return "a stray < in " + tag;
    const std::string name = tag.substr(0, tag.find_first_of(" /", 1));
    if (tag.front() == '/') {
      if (open.empty() || "/" + open.back() != tag) return tag + " closes nothing";
      open.pop_back();
    } else if (tag.back() != '/') {
      open.push_back(name);
    }
  }
  if (!open.empty()) return open.back() + " is not closed";
  for (const char* word : {"nan", "inf,", "inf\"", "infM", "inf "}) {
    if (xml.find(word) != std::string::npos) return std::string("holds ") + word;
  }
  return {};
}

}  // namespace instep::test
