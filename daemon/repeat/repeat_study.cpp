#include "daemon/repeat/repeat_study.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <utility>

#include "daemon/json/untrusted_json.h"

namespace instep {
namespace {

using nlohmann::json;

/// Below this the standard deviation is itself known to no better than a third.
constexpr std::size_t kFewScans = 6;
/// No measure of a foot is beyond this, in millimetres or degrees.
constexpr double kLargestValue = 10000.0;

struct Value {
  double value = 0.0;
  bool is_angle = false;
  std::optional<double> u95;
  std::string definition;
};

std::optional<Value> value_of(const json& result, const std::string& id) {
  for (const auto& measure : list_at(result, "measures")) {
    if (string_at(measure, "id") != id) continue;
    const auto millimetres = number_at(measure, "value_mm");
    const auto degrees = number_at(measure, "value_deg");
    const auto number = millimetres ? millimetres : degrees;
    if (!number || !(std::abs(*number) <= kLargestValue)) return {};
    const bool is_angle = !millimetres;
    return Value{*number, is_angle, number_at(measure, is_angle ? "u95_deg" : "u95_mm"),
                 string_at(measure, "definition")};
  }
  return {};
}

/// The ids of all results, measured or withheld, in the order in which they first come.
std::vector<std::string> ids_of(const std::vector<const StudiedResult*>& scans) {
  std::vector<std::string> ids;
  for (const auto* scan : scans) {
    for (const char* list : {"measures", "withheld"}) {
      for (const auto& measure : list_at(scan->result, list)) {
        const auto id = string_at(measure, "id");
        const bool is_new = !id.empty() && std::find(ids.begin(), ids.end(), id) == ids.end();
        if (is_new) ids.push_back(id);
      }
    }
  }
  return ids;
}

std::optional<double> mean_interval(const std::vector<Value>& values) {
  double sum = 0.0;
  for (const auto& value : values) {
    if (!value.u95) return {};
    sum += *value.u95;
  }
  return sum / static_cast<double>(values.size());
}

class Study {
 public:
  explicit Study(const std::vector<StudiedResult>& results) : results_(results) {}

  Result<RepeatStudy> run() {
    for (const auto& result : results_) {
      if (list_at(result.result, "measures").empty()) {
        return fail(ErrorCode::kInvalidInput, result.name + " holds no measures",
                    "give folders of results, their result.json, or what instep measure printed");
      }
    }
    if (const auto one = check_axis(); !one) return tl::make_unexpected(one.error());
    const auto scans = once_each();
    for (const char* side : {"left", "right", "unknown"}) add_foot(side, scans);
    if (study_.feet.empty()) {
      return fail(ErrorCode::kInvalidInput, "there are no two different results of one foot",
                  "scan the same foot at least twice");
    }
    if (study_.feet.size() > 1) {
      study_.warnings.emplace_back("there are results of both sides: each is taken by itself");
    }
    warn_if_mixed(scans, "station", "stations");
    warn_if_mixed(scans, "version", "versions of the software");
    return std::move(study_);
  }

 private:
  static std::string side_of(const StudiedResult& scan) {
    const auto side = string_at(scan.result, "side");
    return side == "left" || side == "right" ? side : "unknown";
  }

  /// All measures hang on it, though only that of the length names it.
  Result<void> check_axis() const {
    std::set<std::string> axes;
    for (const auto& result : results_) axes.insert(string_at(result.result, "axis"));
    axes.erase("");
    if (axes.size() < 2) return {};
    return fail(
        ErrorCode::kInvalidInput,
        fmt::format("the feet were measured along different axes: {}", fmt::join(axes, ", ")),
        "give results of one axis, or measure their clouds again with one --axis");
  }

  /// A copy would make the scans look better than they are.
  std::vector<const StudiedResult*> once_each() {
    std::vector<const StudiedResult*> scans;
    std::set<std::string> known;
    for (const auto& result : results_) {
      const auto id = string_at(result.result, "id");
      if (known.insert(id.empty() ? result.result.dump() : id).second) {
        scans.push_back(&result);
      } else {
        study_.warnings.push_back(result.name + " is the same scan as another one: it counts once");
      }
    }
    return scans;
  }

  /// One recording replayed twice makes two results; two scans never come out the same.
  void warn_of_same_measures(const std::vector<const StudiedResult*>& scans) {
    std::map<std::string, std::string> first_with;
    for (const auto* scan : scans) {
      const auto [first, is_new] =
          first_with.emplace(list_at(scan->result, "measures").dump(), scan->name);
      if (is_new) continue;
      study_.warnings.push_back(fmt::format(
          "{} has the very same measures as {}: if both were made of one recording, that "
          "they agree tells nothing",
          scan->name, first->second));
    }
  }

  void add_foot(const std::string& side, const std::vector<const StudiedResult*>& all) {
    std::vector<const StudiedResult*> scans;
    for (const auto* scan : all) {
      if (side_of(*scan) == side) scans.push_back(scan);
    }
    if (scans.empty()) return;
    if (scans.size() < 2) {
      study_.warnings.push_back(
          fmt::format("there is one result of the {} side alone: it is left out", side));
      return;
    }
    if (scans.size() < kFewScans) {
      study_.warnings.push_back(
          fmt::format("{} scans of the {} side are few: their standard deviation is a rough guess",
                      scans.size(), side));
    }
    warn_of_same_measures(scans);
    RepeatedFoot foot{side, {}, {}};
    for (const auto* scan : scans) {
      const auto id = string_at(scan->result, "id");
      foot.scans.push_back(id.empty() ? scan->name : id);
    }
    for (const auto& id : ids_of(scans)) add_measure(id, scans, foot);
    study_.feet.push_back(std::move(foot));
  }

  void add_measure(const std::string& id, const std::vector<const StudiedResult*>& scans,
                   RepeatedFoot& foot) {
    std::vector<Value> values;
    for (const auto* scan : scans) {
      if (const auto value = value_of(scan->result, id)) values.push_back(*value);
    }
    if (values.size() < scans.size()) {
      study_.warnings.push_back(fmt::format("{} of the {} side is missing in {} of {} scans", id,
                                            foot.side, scans.size() - values.size(), scans.size()));
    }
    if (values.size() < 2) return;
    const auto& first = values.front();
    std::vector<double> numbers;
    for (const auto& value : values) {
      if (value.is_angle != first.is_angle) {
        study_.warnings.push_back(id + " comes in different units: it is left out");
        return;
      }
      numbers.push_back(value.value);
    }
    const bool one_rule = std::all_of(values.begin(), values.end(), [&](const Value& value) {
      return value.definition == first.definition;
    });
    if (!one_rule) {
      study_.warnings.push_back(id + " follows different definitions: it is left out");
      return;
    }
    foot.measures.push_back(
        {id, first.is_angle, repeatability(std::move(numbers)), mean_interval(values)});
  }

  void warn_if_mixed(const std::vector<const StudiedResult*>& scans, const char* key,
                     const char* what) {
    std::set<std::string> found;
    for (const auto* scan : scans) {
      const auto software = scan->result.find("software");
      const bool in_software = software != scan->result.end() && software->contains(key);
      found.insert(string_at(in_software ? *software : scan->result, key));
    }
    if (found.size() > 1) {
      study_.warnings.push_back(fmt::format("the results come from different {}", what));
    }
  }

  const std::vector<StudiedResult>& results_;
  RepeatStudy study_;
};

}  // namespace

Result<RepeatStudy> study_repeats(const std::vector<StudiedResult>& results) {
  return Study(results).run();
}

}  // namespace instep
