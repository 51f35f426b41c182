#include "daemon/store/retention.h"

#include "daemon/scan/scan_id.h"

namespace instep {
namespace {

constexpr std::chrono::minutes kClocksDiffer{5};

}  // namespace

bool is_made_later(const std::string& id, std::chrono::system_clock::time_point now) {
  const auto time = time_of_scan_id(id);
  return time && *time > now + kClocksDiffer;
}

Expired expired(const std::vector<std::string>& ids, const Retention& retention,
                std::chrono::system_clock::time_point now) {
  Expired expired;
  const auto oldest = now - std::chrono::hours(24) * retention.keep_days;
  int counted = 0;
  std::string_view last_kept;
  for (const auto& id : ids) {
    if (is_made_later(id, now)) {
      ++expired.made_later;
      continue;
    }
    const auto time = time_of_scan_id(id);
    const bool is_too_old = retention.keep_days > 0 && time && *time < oldest;
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
