#include "daemon/page/paper.h"

#include <algorithm>
#include <cmath>

#include "daemon/report/mended_text.h"

namespace instep::paper {
namespace {

constexpr double kLetterWidth = 0.58;

/// Letters, not bytes: the bytes that continue a letter of UTF-8 do not count.
std::size_t letters(const std::string& text) {
  return static_cast<std::size_t>(std::count_if(text.begin(), text.end(), [](char byte) {
    return (static_cast<unsigned>(byte) & 0xC0U) != 0x80U;
  }));
}

/// Where the letter after `count` letters begins.
std::size_t end_of(const std::string& text, std::size_t count) {
  std::size_t at = 0;
  for (std::size_t seen = 0; at < text.size(); ++at) {
    if ((static_cast<unsigned>(text[at]) & 0xC0U) != 0x80U && seen++ == count) break;
  }
  return at;
}

}  // namespace

double scale_that_fits(double extent_mm, double room) {
  for (const double scale : kScales) {
    if (extent_mm * per_foot_mm(scale) <= room) return scale;
  }
  return kScales.back();
}

double text_width(const std::string& text, double letter_size) {
  return kLetterWidth * letter_size * static_cast<double>(letters(text));
}

std::vector<std::string> wrapped(const std::string& text, double width, double letter_size) {
  const auto longest =
      static_cast<std::size_t>(std::max(1.0, std::floor(width / (kLetterWidth * letter_size))));
  std::vector<std::string> lines;
  std::string rest = mended_text(text);
  while (letters(rest) > longest) {
    const std::size_t limit = end_of(rest, longest);
    const std::size_t space = rest.rfind(' ', limit);
    const bool has_space = space != std::string::npos && space > 0;
    lines.push_back(rest.substr(0, has_space ? space : limit));
    rest.erase(0, has_space ? space + 1 : limit);
  }
  if (!rest.empty()) lines.push_back(rest);
  return lines;
}

}  // namespace instep::paper
