#include "sim/fault_script.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <charconv>

namespace instep {
namespace {

constexpr std::uint64_t kMostFrames = 1'000'000'000;
constexpr double kLongestSeconds = 86400.0;

using Words = std::vector<std::string_view>;

/// Words end at blanks; colons and commas are words of their own.
Words words_of(std::string_view line) {
  Words words;
  line = line.substr(0, line.find('#'));
  std::size_t at = 0;
  while (at < line.size()) {
    if (std::string_view(" \t\r").find(line[at]) != std::string_view::npos) {
      ++at;
      continue;
    }
    const bool mark = line[at] == ':' || line[at] == ',';
    const std::size_t end =
        mark ? at + 1 : std::min(line.find_first_of(" \t\r:,", at), line.size());
    words.push_back(line.substr(at, end - at));
    at = end;
  }
  return words;
}

/// Reads the words of one line from left to right; the first that does not fit makes the line bad.
class LineReader {
 public:
  explicit LineReader(Words words) : words_(std::move(words)) {}

  bool accept(std::string_view word) {
    if (at_ >= words_.size() || words_[at_] != word) return false;
    ++at_;
    return true;
  }

  bool accept_all(std::initializer_list<std::string_view> expected) {
    if (words_.size() - at_ < expected.size()) return false;
    const auto begin = words_.begin() + static_cast<std::ptrdiff_t>(at_);
    if (!std::equal(expected.begin(), expected.end(), begin)) return false;
    at_ += expected.size();
    return true;
  }

  bool number(std::uint64_t& value) {
    return at_ < words_.size() && parsed(words_[at_], value) && value <= kMostFrames && ++at_ > 0;
  }

  std::string_view any() { return at_ < words_.size() ? words_[at_++] : std::string_view(); }

  /// `2 s`, `2s`, `20 ms`.
  bool duration(FaultTime& value) {
    std::string_view figure = any();
    const std::size_t unit_at = std::min(figure.find_first_not_of("0123456789."), figure.size());
    const std::string_view unit = unit_at < figure.size() ? figure.substr(unit_at) : any();
    figure = figure.substr(0, unit_at);
    double amount = 0.0;
    if (!parsed(figure, amount) || (unit != "s" && unit != "ms")) return false;
    const double seconds = unit == "s" ? amount : amount / 1000.0;
    if (!(seconds >= 0.0 && seconds <= kLongestSeconds)) return false;
    value = FaultTime(static_cast<std::int64_t>(seconds * 1e6 + 0.5));
    return true;
  }

  bool frames(FrameRange& range) {
    if (accept("frame")) {
      if (!number(range.first)) return false;
      range.last = range.first;
    } else {
      if (!accept("frames")) return false;
      const std::string_view both = any();
      const std::size_t dash = both.find('-');
      if (dash == std::string_view::npos || !parsed(both.substr(0, dash), range.first) ||
          !parsed(both.substr(dash + 1), range.last)) {
        return false;
      }
    }
    return range.first >= 1 && range.last >= range.first && range.last <= kMostFrames;
  }

  bool at_end() const { return at_ == words_.size(); }

 private:
  template <typename Number>
  static bool parsed(std::string_view text, Number& value) {
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    return error == std::errc() && end == text.data() + text.size() && !text.empty();
  }

  Words words_;
  std::size_t at_ = 0;
};

/// `after N <counted>`, then, if `joint` comes, a duration.
bool read_interruption(LineReader& line, std::string_view counted,
                       std::initializer_list<std::string_view> joint, Interruption& interruption) {
  if (!line.accept("after") || !line.number(interruption.after) || !line.accept(counted)) {
    return false;
  }
  if (!line.accept_all(joint)) return true;
  FaultTime duration{0};
  if (!line.duration(duration)) return false;
  interruption.duration = duration;
  return true;
}

bool read_frames(LineReader& line, std::vector<FrameRange>& ranges) {
  FrameRange range;
  if (!line.frames(range)) return false;
  ranges.push_back(range);
  return true;
}

bool read_camera_fault(LineReader& line, CameraFaults& faults) {
  if (line.accept("corrupt")) return read_frames(line, faults.corrupt);
  if (line.accept("shorten")) return read_frames(line, faults.shortened);
  if (line.accept("zero")) return read_frames(line, faults.zero);
  if (line.accept_all({"never", "starts"})) return faults.never_starts = true;
  if (line.accept_all({"never", "streams"})) return faults.never_streams = true;
  Interruption interruption;
  if (line.accept("stall")) {
    if (!read_interruption(line, "frames", {"for"}, interruption)) return false;
    faults.stalls.push_back(interruption);
    return true;
  }
  if (!line.accept("vanish")) return false;
  if (!read_interruption(line, "frames", {",", "return", "after"}, interruption)) return false;
  faults.absences.push_back(interruption);
  return true;
}

bool read_pedal_fault(LineReader& line, PedalFaults& faults) {
  if (line.accept("stuck")) return faults.stuck = true;
  if (line.accept("bounce")) {
    return line.number(faults.bounce_edges) && faults.bounce_edges <= 1000 &&
           line.accept_all({"edges", "in"}) && line.duration(faults.bounce_time);
  }
  Interruption interruption;
  if (!line.accept("vanish")) return false;
  if (!read_interruption(line, "edges", {",", "return", "after"}, interruption)) return false;
  faults.absence = interruption;
  return true;
}

bool read_line(LineReader line, FaultScript& script) {
  if (line.at_end()) return true;
  if (line.accept("pedal")) {
    return line.accept(":") && read_pedal_fault(line, script.pedal) && line.at_end();
  }
  if (!line.accept("camera")) return false;
  const std::string name(line.any());
  return !name.empty() && line.accept(":") && read_camera_fault(line, script.cameras[name]) &&
         line.at_end();
}

template <typename Item>
void append(std::vector<Item>& to, const std::vector<Item>& from) {
  to.insert(to.end(), from.begin(), from.end());
}

}  // namespace

CameraFaults FaultScript::of_camera(const std::string& name) const {
  CameraFaults joined;
  for (const std::string& key : {name, std::string("all")}) {
    const auto found = cameras.find(key);
    if (found == cameras.end()) continue;
    const CameraFaults& faults = found->second;
    append(joined.stalls, faults.stalls);
    append(joined.absences, faults.absences);
    append(joined.corrupt, faults.corrupt);
    append(joined.shortened, faults.shortened);
    append(joined.zero, faults.zero);
    joined.never_starts = joined.never_starts || faults.never_starts;
    joined.never_streams = joined.never_streams || faults.never_streams;
  }
  return joined;
}

Result<FaultScript> parse_fault_script(std::string_view text) {
  FaultScript script;
  int number = 0;
  while (!text.empty()) {
    ++number;
    const std::size_t end = std::min(text.find('\n'), text.size());
    const std::string_view line = text.substr(0, end);
    text.remove_prefix(std::min(end + 1, text.size()));
    if (!read_line(LineReader(words_of(line)), script)) {
      return fail(ErrorCode::kInvalidInput,
                  fmt::format("line {} of the fault script cannot be understood: \"{}\"", number,
                              line.substr(0, 120)),
                  "write it like \"camera left: stall after 5 frames for 2 s\" or \"pedal: bounce "
                  "12 edges in 20 ms\"; sim/fault_script.h lists all faults");
    }
  }
  return script;
}

Result<void> check_fault_cameras(const FaultScript& script,
                                 const std::vector<std::string>& cameras) {
  for (const auto& [name, faults] : script.cameras) {
    if (name == "all" || std::find(cameras.begin(), cameras.end(), name) != cameras.end()) continue;
    return fail(ErrorCode::kInvalidInput,
                fmt::format("the fault script names a camera \"{}\" that is not there", name),
                fmt::format("use all or one of: {}", fmt::join(cameras, ", ")));
  }
  return {};
}

}  // namespace instep
