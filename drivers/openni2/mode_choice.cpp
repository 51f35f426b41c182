#include "drivers/openni2/mode_choice.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <tuple>

#include "drivers/openni2/frame_ring.h"

namespace instep {
namespace {

constexpr int kUsualRate = 30;

bool has_size(const DepthMode& mode, const ImageSize& size) {
  return mode.width == size.width && mode.height == size.height;
}

bool is_usable(const DepthMode& mode) {
  const auto pixels = static_cast<std::int64_t>(mode.width) * mode.height;
  return mode.depth_unit_mm > 0.0 && pixels > 0 &&
         pixels <= static_cast<std::int64_t>(FrameRing::kMostPixels);
}

/// Smaller is better.
auto rank(const DepthMode& mode) {
  const bool usual = has_size(mode, {kUsualWidth, kUsualHeight});
  return std::tuple(usual ? 0 : 1, -mode.width * mode.height, mode.depth_unit_mm,
                    std::abs(mode.frames_per_second - kUsualRate));
}

std::string listed(const std::vector<DepthMode>& modes) {
  std::string text;
  for (const DepthMode& mode : modes) {
    text += fmt::format("{}{}x{} at {}/s in {} mm", text.empty() ? "" : ", ", mode.width,
                        mode.height, mode.frames_per_second, mode.depth_unit_mm);
  }
  return text.empty() ? "no depth at all" : text;
}

}  // namespace

Result<DepthMode> choose_mode(const std::vector<DepthMode>& offered,
                              const std::optional<ImageSize>& size) {
  std::vector<DepthMode> suitable;
  std::copy_if(
      offered.begin(), offered.end(), std::back_inserter(suitable),
      [&](const DepthMode& mode) { return is_usable(mode) && (!size || has_size(mode, *size)); });
  const auto best =
      std::min_element(suitable.begin(), suitable.end(),
                       [](const DepthMode& a, const DepthMode& b) { return rank(a) < rank(b); });
  if (best != suitable.end()) return *best;
  return fail(ErrorCode::kUnsupported,
              size ? fmt::format("the sensor has no depth of {}x{} pixels, but {}", size->width,
                                 size->height, listed(offered))
                   : fmt::format("the sensor offers {}", listed(offered)),
              "give the intrinsics of a size that it has, or use another sensor");
}

}  // namespace instep
