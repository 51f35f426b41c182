#include "daemon/page/paper.h"

#include <algorithm>
#include <cmath>
#include <string_view>

#include "daemon/report/mended_text.h"

namespace instep::paper {
namespace {

/// Of the letter that begins with a byte, in hundredths of the letters' size; bytes of UTF-8 that
/// continue a letter have none. Beyond the umlauts there are letters of any script, many of them as
/// wide as they are tall, and more.
std::size_t hundredths(char byte) {
  constexpr std::size_t kSmall = 58;
  constexpr std::size_t kFigure = 64;
  constexpr std::size_t kCapital = 88;
  constexpr std::size_t kWide = 103;
  constexpr std::size_t kSquare = 116;
  constexpr std::string_view kWideLetters = "MW@m%";
  constexpr std::string_view kAsWideAsCapitals = "w&#+<=>^~\xC2\xC3";
  const auto code = static_cast<unsigned char>(byte);
  if ((code & 0xC0U) == 0x80U) return 0;
  if (code > 0xC3U) return kSquare;
  if (kWideLetters.find(byte) != std::string_view::npos) return kWide;
  const bool is_capital = code >= 'A' && code <= 'Z';
  if (is_capital || kAsWideAsCapitals.find(byte) != std::string_view::npos) return kCapital;
  return code >= '0' && code <= '9' ? kFigure : kSmall;
}

std::size_t hundredths(const std::string& text) {
  std::size_t sum = 0;
  for (const char byte : text) sum += hundredths(byte);
  return sum;
}

/// Where the letter begins that `room` is too small for; it is not the first one.
std::size_t end_of(const std::string& text, std::size_t room) {
  std::size_t at = 0;
  for (std::size_t taken = 0; at < text.size(); ++at) {
    taken += hundredths(text[at]);
    if (taken > room && hundredths(text[at]) > 0 && at > 0) break;
  }
  return at;
}

/// Whether a number and its "%" would be parted.
bool parts_share(const std::string& text, std::size_t space) {
  return space > 0 && text[space - 1] >= '0' && text[space - 1] <= '9' &&
         text.compare(space + 1, 1, "%") == 0;
}

/// The last space up to `limit` that may end a line; npos without any.
std::size_t last_break(const std::string& text, std::size_t limit) {
  std::size_t space = text.rfind(' ', limit);
  while (space != std::string::npos && parts_share(text, space)) {
    space = text.rfind(' ', space - 1);
  }
  return space;
}

}  // namespace

double scale_that_fits(double extent_mm, double room) {
  for (const double scale : kScales) {
    if (extent_mm * per_foot_mm(scale) <= room) return scale;
  }
  return kScales.back();
}

double text_width(const std::string& text, double letter_size) {
  return 0.01 * letter_size * static_cast<double>(hundredths(text));
}

std::vector<std::string> wrapped(const std::string& text, double width, double letter_size) {
  const auto room = static_cast<std::size_t>(std::max(1.0, 100.0 * width / letter_size));
  std::vector<std::string> lines;
  std::string rest = mended_text(text);
  while (hundredths(rest) > room) {
    const std::size_t limit = end_of(rest, room);
    const std::size_t space = last_break(rest, limit);
    const bool has_space = space != std::string::npos && space > 0;
    lines.push_back(rest.substr(0, has_space ? space : limit));
    rest.erase(0, has_space ? space + 1 : limit);
  }
  if (!rest.empty()) lines.push_back(rest);
  return lines;
}

}  // namespace instep::paper
