#pragma once

#include <functional>
#include <vector>

#include "core/foot/foot_scan.h"
#include "core/geometry/seen_skin.h"

namespace instep {

/// What the errors that many points share (PointCloud::shared_errors_mm) leave open of the measures
/// that are read off the landmarks of a foot (girths: core/girth/doubt/shared_length_doubt.h). To
/// first order: the landmarks move with the skin that they are on, while the floor stays. Skin that
/// was not seen errs as the seen skin beside it, from which it goes on. Borrows the foot.
class SharedDoubt {
 public:
  SharedDoubt(const FootScan& foot, const SeenSkin& seen);

  /// Half-width of the 95 % interval, in the measure's own unit; 0 for a cloud that knows of none.
  double of(const std::function<Result<double>(const Landmarks&)>& measure) const;

 private:
  const FootScan& foot_;
  std::vector<Landmarks> moved_;  ///< the landmarks by each of the errors
};

}  // namespace instep
