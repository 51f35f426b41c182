#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "core/foot/foot_scan.h"
#include "core/foot/measure_set.h"

namespace instep {

/// The section of one girth, ready to be drawn: medial to the left, dorsal up, or the front where
/// its plane is level, in millimetres with y downwards and the lowest point of the contour at y =
/// 0.
struct SectionDrawing {
  const char* upper_end = "dorsal";   ///< of the foot, as the plane lies
  const char* lower_end = "plantar";  ///< the same
  bool is_level = false;              ///< it does not stand on the floor
  std::vector<Eigen::Vector2d> contour;
  std::vector<Eigen::Vector2d> tape;             ///< hull of the contour
  std::vector<Eigen::Vector2d> seen_points;      ///< of the cloud, beside the plane
  std::vector<Eigen::Vector2d> platform_points;  ///< put under a sole that nobody saw
  double left = 0.0;
  double right = 0.0;
  double height = 0.0;
};

/// A section and the girth it is of.
struct DrawnSection {
  const Measure* measure = nullptr;
  SectionDrawing drawing;
};

/// All girths of a set that have a section to draw. They point into `measures`.
std::vector<DrawnSection> draw_sections(const FootScan& foot, const MeasureSet& measures);

/// `measure` must have a girth and a plane; what is not finite is left out.
SectionDrawing draw_section(const FootScan& foot, const Measure& measure);

/// How a page draws its sections, in its own units.
struct SectionStyle {
  const char* tape = "";      ///< class of the tape
  double outline_step = 0.0;  ///< corners of an outline nearer than this to another are left out
  double point_radius = 0.0;
};

/// Tape, skin and points over each other; the base line's zero comes to lie at `origin`.
std::string section_svg(const SectionDrawing& drawing, const Eigen::Vector2d& origin, double per_mm,
                        const SectionStyle& style);

}  // namespace instep
