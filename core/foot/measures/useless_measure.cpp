#include "core/foot/measures/useless_measure.h"

#include <algorithm>
#include <cmath>

namespace instep {
namespace {

// Feet of one length differ in breadths and girths by an eighth to either side at the most: a wider
// interval says less than that length. Of an arch or a toe an eighth is hardly more than the doubt
// of a floor, and toes point within twenty degrees.
constexpr double kUselessShare = 0.125;
constexpr double kUselessMm = 5.0;
constexpr double kUselessDegrees = 10.0;
constexpr const char* kTakeALongerAxis =
    "measure along another axis, for the middle of a heel is a line too short to tell this by, or ";

bool is_useless(const Measure& measure) {
  if (!measure.u95()) return false;
  const double limit = measure.value_deg
                           ? kUselessDegrees
                           : std::max(kUselessMm, kUselessShare * std::abs(measure.value_mm));
  return *measure.u95() > limit;
}

}  // namespace

std::optional<std::string> why_useless(const Measure& measure, const FootScan& foot) {
  if (!is_useless(measure)) return std::nullopt;
  // Of a side that is not sure the interval holds the other foot's too, whatever the frames.
  return "it is told to no better than +-" + std::to_string(std::lround(*measure.u95())) +
         (measure.value_deg ? " degrees" : " mm") + ": " +
         (foot.is_side_sure() ? "" : std::string(kSayWhichFoot) + ", or ") +
         (foot.rules.axis == AxisRule::kHeelCentre ? kTakeALongerAxis : "") +
         "scan again with more frames, and one foot alone in full view of all cameras";
}

}  // namespace instep
