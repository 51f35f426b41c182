#include "core/foot/foot_lengths.h"

#include "core/foot/foot_outline.h"

namespace instep {

Result<double> foot_length(const FootScan& foot) {
  return foot.landmarks.at("acropodion").position_mm.x() -
         foot.landmarks.at("pternion").position_mm.x();
}

Result<double> foot_breadth(const FootScan& foot) {
  const auto tibiale = foot.landmarks.find("metatarsale_tibiale");
  const auto fibulare = foot.landmarks.find("metatarsale_fibulare");
  if (tibiale == foot.landmarks.end() || fibulare == foot.landmarks.end()) {
    return fail(ErrorCode::kInsufficientData, "the sides of the ball were not found",
                "scan the foot again, from all sides");
  }
  return (tibiale->second.position_mm - fibulare->second.position_mm).head<2>().norm();
}

Result<double> foot_breadth_horizontal(const FootScan& foot) {
  const FootOutline outline(foot);
  const double from = 0.5 * outline.length_mm();
  const double to = 0.85 * outline.length_mm();
  const auto medial = outline.medial().furthest(from, to);
  const auto lateral = outline.lateral().furthest(from, to);
  if (!medial || !lateral) {
    return fail(ErrorCode::kInsufficientData, "the outline has no points beside the ball",
                "scan the foot again, from all sides");
  }
  return medial->reach + lateral->reach;
}

}  // namespace instep
