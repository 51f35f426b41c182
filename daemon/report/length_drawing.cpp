#include "daemon/report/length_drawing.h"

#include "daemon/report/number_text.h"

namespace instep {

std::optional<DrawnLength> draw_length(const FootScan& foot, const MeasureSet& measures) {
  const auto rear = foot.landmarks.find("pternion");
  const auto front = foot.landmarks.find("acropodion");
  const Measure* length = measures.find("foot_length");
  const bool is_known = rear != foot.landmarks.end() && front != foot.landmarks.end() &&
                        length != nullptr && rear->second.position_mm.allFinite() &&
                        front->second.position_mm.allFinite();
  if (!is_known) return std::nullopt;
  return DrawnLength{rear->second.position_mm, front->second.position_mm,
                     interval_text(length->value_mm, length->u95_mm)};
}

}  // namespace instep
