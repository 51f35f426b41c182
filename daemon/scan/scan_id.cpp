#include "daemon/scan/scan_id.h"

#include <fmt/chrono.h>
#include <fmt/format.h>

#include <random>
#include <set>
#include <utility>

namespace instep {
namespace {

constexpr std::string_view kLetters = "abcdefghijkmnpqrstuvwxyz23456789";
constexpr std::string_view kShape = "dddddddd-ddddddddd-";  // 'T' and 'Z' stand at the dashes
constexpr std::size_t kIdLength = 24;                       // 20261121T091502417Z-k3f9
constexpr std::size_t kRandomLetters = 4;

bool is_digit(char letter) {
  return letter >= '0' && letter <= '9';
}

int number(std::string_view id, std::size_t begin, std::size_t length) {
  int value = 0;
  for (const char digit : id.substr(begin, length)) value = 10 * value + (digit - '0');
  return value;
}

}  // namespace

std::vector<std::string> new_scan_ids(std::chrono::system_clock::time_point time,
                                      std::size_t count) {
  std::random_device random;
  const auto milliseconds =
      std::chrono::floor<std::chrono::milliseconds>(time.time_since_epoch()).count() % 1000;
  const std::string stamp =
      fmt::format("{:%Y%m%dT%H%M%S}{:03}Z-",
                  fmt::gmtime(std::chrono::system_clock::to_time_t(time)), milliseconds);
  std::set<std::string> ids;
  while (ids.size() < count) {
    std::string id = stamp;
    for (std::size_t i = 0; i < kRandomLetters; ++i) id += kLetters[random() % kLetters.size()];
    ids.insert(std::move(id));
  }
  return {ids.begin(), ids.end()};
}

bool is_scan_id(std::string_view id) {
  if (id.size() != kIdLength || id[8] != 'T' || id[18] != 'Z' || id[19] != '-') return false;
  for (std::size_t i = 0; i < kShape.size(); ++i) {
    if (kShape[i] == 'd' && !is_digit(id[i])) return false;
  }
  return id.substr(20).find_first_not_of(kLetters) == std::string_view::npos;
}

std::filesystem::path day_folder(std::string_view id) {
  return std::filesystem::path(id.substr(0, 4)) / id.substr(4, 2) / id.substr(6, 2);
}

bool are_of_one_scan(std::string_view one, std::string_view other) {
  return is_scan_id(one) && is_scan_id(other) &&
         one.substr(0, kIdLength - kRandomLetters) == other.substr(0, kIdLength - kRandomLetters);
}

std::optional<std::chrono::system_clock::time_point> time_of_scan_id(std::string_view id) {
  if (!is_scan_id(id)) return std::nullopt;
  using namespace std::chrono;
  const year_month_day date{year(number(id, 0, 4)), month(static_cast<unsigned>(number(id, 4, 2))),
                            day(static_cast<unsigned>(number(id, 6, 2)))};
  if (!date.ok()) return std::nullopt;
  return sys_days(date) + hours(number(id, 9, 2)) + minutes(number(id, 11, 2)) +
         seconds(number(id, 13, 2)) + milliseconds(number(id, 15, 3));
}

}  // namespace instep
