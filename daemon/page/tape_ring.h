#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "core/foot/measure_set.h"
#include "daemon/page/foot_view.h"

namespace instep {

/// The stretched tape of a girth as a ring in space.
struct TapeRing {
  const Measure* measure = nullptr;
  std::vector<Eigen::Vector3d> corners;   ///< foot frame
  std::vector<Eigen::Vector3d> outwards;  ///< of the edge from each corner to the next
};

/// A ring for each girth that has a section.
std::vector<TapeRing> tape_rings(const MeasureSet& measures);

/// The ring in a view: a thick line where it lies on what is seen, a thin one where the foot is
/// before it.
std::string ring_svg(const TapeRing& ring, const FootView& view);

/// The highest place of the ring on the page.
Eigen::Vector2d top_of(const TapeRing& ring, const FootView& view);

/// Name and length of each ring above a view, none over another, with a line down to the ring.
/// `baseline` is the y of the lower of two lines of text; they keep within `left` to `right`.
std::string ring_names(const std::vector<TapeRing>& rings, const FootView& view, double baseline,
                       double left, double right);

}  // namespace instep
