#pragma once

#include <optional>
#include <string>
#include <vector>

#include "drivers/openni2/child_messages.h"

namespace instep {

/// The size of image that is asked of a sensor whose lens nobody has calibrated.
inline constexpr int kUsualWidth = 640;
inline constexpr int kUsualHeight = 480;

struct ImageSize {
  int width = 0;
  int height = 0;
};

/// Of the modes that a sensor offers the best one of this size: the finest depth unit, since whole
/// millimetres are truncated and so half a millimetre too near on average, then 30 frames a second
/// or what is next to it. With no size, kUsualWidth x kUsualHeight or else the most pixels, but
/// never more than FrameRing::kMostPixels. Fails with kUnsupported, naming what there is.
Result<DepthMode> choose_mode(const std::vector<DepthMode>& offered,
                              const std::optional<ImageSize>& size);

}  // namespace instep
