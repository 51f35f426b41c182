#include "daemon/store/retention.h"

#include <algorithm>

#include "daemon/scan/scan_id.h"

namespace instep {
namespace {

constexpr std::chrono::minutes kClocksDiffer{5};
/// No result is older than this program.
constexpr std::chrono::system_clock::time_point kFirstResults =
    std::chrono::sys_days(std::chrono::year(2026) / 1 / 1);

}  // namespace

bool is_made_later(const std::string& id, std::chrono::system_clock::time_point now) {
  const auto time = time_of_scan_id(id);
  return time && *time > now + kClocksDiffer;
}

Expired expired(std::vector<std::string> ids, const Retention& retention,
                std::chrono::system_clock::time_point now, const std::string& last_stored) {
  Expired expired;
  const auto oldest = now - std::chrono::hours(24) * retention.keep_days;
  std::stable_partition(ids.begin(), ids.end(),
                        [&](const std::string& id) { return are_of_one_scan(id, last_stored); });
  int counted = 0;
  std::string_view last_kept;
  for (const auto& id : ids) {
    if (is_made_later(id, now)) {
      ++expired.made_later;
      continue;
    }
    const auto time = time_of_scan_id(id);
    const bool is_before_all = time && *time < kFirstResults;
    if (is_before_all && now >= kFirstResults) {
      ++expired.made_before_all;
      continue;
    }
    const bool is_too_old = retention.keep_days > 0 && time && *time < oldest && !is_before_all;
    const bool is_too_many = retention.keep_count > 0 && counted >= retention.keep_count &&
                             !are_of_one_scan(id, last_kept);
    if (is_too_old || is_too_many) {
      expired.ids.push_back(id);
    } else {
      ++counted;
      last_kept = id;
    }
  }
  return expired;
}

}  // namespace instep
