#include "core/foot/foot_pair.h"

#include <cmath>

namespace instep {
namespace {

const Measure* measured(const MeasureSet& set, const std::string& id) {
  const Measure* measure = set.find(id);
  return measure != nullptr && std::isfinite(measure->value_mm) ? measure : nullptr;
}

MeasurePair beside(const Measure& left, const Measure& right) {
  MeasurePair pair{left.id, left.value_mm, right.value_mm, std::nullopt};
  if (left.u95_mm && right.u95_mm) pair.u95_mm = std::hypot(*left.u95_mm, *right.u95_mm);
  return pair;
}

}  // namespace

std::optional<Side> MeasurePair::larger() const {
  if (std::abs(difference_mm()) <= u95_mm.value_or(0.0)) return {};
  return difference_mm() > 0.0 ? Side::kRight : Side::kLeft;
}

const MeasurePair* FootPair::find(const std::string& id) const {
  for (const auto& measure : measures) {
    if (measure.id == id) return &measure;
  }
  return nullptr;
}

std::optional<Side> FootPair::leading() const {
  const MeasurePair* length = find("foot_length");
  return length == nullptr ? std::nullopt : length->larger();
}

FootPair pair_feet(const MeasureSet& left, const MeasureSet& right) {
  FootPair pair;
  for (const auto& measure : left.measures) {
    if (!std::isfinite(measure.value_mm)) continue;
    if (const Measure* other = measured(right, measure.id)) {
      pair.measures.push_back(beside(measure, *other));
    } else {
      pair.of_one_foot.push_back(measure.id);
    }
  }
  for (const auto& measure : right.measures) {
    const bool only_right =
        std::isfinite(measure.value_mm) && measured(left, measure.id) == nullptr;
    if (only_right) pair.of_one_foot.push_back(measure.id);
  }
  return pair;
}

}  // namespace instep
