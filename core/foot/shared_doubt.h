#pragma once

#include <functional>
#include <vector>

#include "core/foot/foot_scan.h"
#include "core/foot/seen_skin.h"
#include "core/girth/girth.h"

namespace instep {

/// What the errors that many points share (PointCloud::shared_errors_mm) leave open of the measures
/// of a foot: half-widths of 95 % intervals, 0 for a cloud that knows of none. To first order: the
/// skin moves, with the landmarks on it, while the floor and the tapes' planes stay. Skin that was
/// not seen errs as the seen skin beside it, from which it goes on. Borrows the foot and what was
/// seen of it.
class SharedDoubt {
 public:
  SharedDoubt(const FootScan& foot, const SeenSkin& seen);

  /// Of a measure that is read off the landmarks, in its own unit.
  double of_landmarks(const std::function<Result<double>(const Landmarks&)>& measure) const;

  /// Of the stretched length: each corner of the tape lengthens it by as much as it turns there.
  double of_girth(const Girth& girth, const TapePlane& plane) const;

 private:
  const FootScan& foot_;
  const SeenSkin& seen_;
  std::vector<Landmarks> moved_;  ///< the landmarks by each of the errors
};

}  // namespace instep
