#include "core/fusion/views/overruled.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "core/fusion/frames/lens.h"

namespace instep {
namespace {

using Eigen::Vector3d;

/// Side of the window that a sensor matches: nearer than this to the rim of what it saw, part of
/// the window lies beyond the silhouette, and the surface bends away from the true one by some
/// millimetres.
constexpr float kMatchingWindowPx = 10.0F;
constexpr double kReachMm = 12.0;    // surfaces further apart are not of the same place
constexpr double kLeastGapMm = 1.0;  // nearer ones agree whatever their noise
constexpr double kNoiseSigmas = 2.0;
constexpr double kLeastFacing = -0.2;  // cosine; a tail stands square to the surface it leaves

/// The pixel that sees a place of the station, if any.
std::optional<std::size_t> pixel_at(const SeenSurface& view, const Vector3d& place) {
  const auto pixel = pixel_seeing(*view.intrinsics, view.camera_from_station * place);
  if (!pixel) return std::nullopt;
  return static_cast<std::size_t>(pixel->y()) * static_cast<std::size_t>(view.intrinsics->width) +
         static_cast<std::size_t>(pixel->x());
}

/// Steps, along rows and columns, from each pixel to the nearest one without data.
std::vector<float> steps_to_rim(const FusedDepth& depth) {
  const auto width = static_cast<std::size_t>(depth.width);
  const std::size_t pixels = depth.depth_mm.size();
  std::vector<float> steps(pixels);
  const auto step = [&](std::size_t pixel, std::size_t from) {
    steps[pixel] = std::min(steps[pixel], steps[from] + 1.0F);
  };
  for (std::size_t pixel = 0; pixel < pixels; ++pixel) {
    steps[pixel] = depth.depth_mm[pixel] > 0.0F ? std::numeric_limits<float>::max() : 0.0F;
    if (pixel % width > 0) step(pixel, pixel - 1);
    if (pixel >= width) step(pixel, pixel - width);
  }
  for (std::size_t pixel = pixels; pixel-- > 0;) {
    if (pixel % width + 1 < width) step(pixel, pixel + 1);
    if (pixel + width < pixels) step(pixel, pixel + width);
  }
  return steps;
}

/// What the other views say of one point.
struct Vote {
  double agreeing = 0.0;       ///< sum of trust
  double contradicting = 0.0;  ///< highest trust
};

void ask(const SeenSurface& witness, const PointCloud& cloud, std::size_t point, Vote& vote) {
  const auto pixel = pixel_at(witness, cloud.positions[point]);
  if (!pixel || witness.point_at[*pixel] < 0) return;
  const auto other = static_cast<std::size_t>(witness.point_at[*pixel]);
  const Vector3d& normal = witness.points->normals[other];
  if (!(normal.dot(cloud.normals[point]) > kLeastFacing)) return;
  const double gap =
      std::abs(normal.dot(cloud.positions[point] - witness.points->positions[other]));
  if (gap > kReachMm) return;
  const double noise = std::hypot(cloud.sigma_mm[point], witness.points->sigma_mm[other]);
  const double allowed = std::max(kLeastGapMm, kNoiseSigmas * noise);
  const double trust = witness.trust[other];
  if (gap <= allowed) {
    vote.agreeing += trust;
  } else {
    vote.contradicting = std::max(vote.contradicting, trust);
  }
}

}  // namespace

SeenSurface seen_surface(const PosedDepth& view, const PointCloud& points) {
  SeenSurface seen{view.intrinsics, &points, view.station_from_camera.inverse(),
                   std::vector<std::int32_t>(view.depth->depth_mm.size(), -1),
                   std::vector<float>(points.size(), 0.0F)};
  const auto steps = steps_to_rim(*view.depth);
  for (std::size_t i = 0; i < points.size(); ++i) {
    const auto pixel = pixel_at(seen, points.positions[i]);
    if (!pixel) continue;
    seen.point_at[*pixel] = static_cast<std::int32_t>(i);
    const auto cosine = static_cast<float>(points.normals[i].dot(points.view_directions[i]));
    const float inside = std::min(1.0F, steps[*pixel] / kMatchingWindowPx);
    seen.trust[i] = cosine * inside * inside;
  }
  return seen;
}

std::vector<std::size_t> points_not_overruled(const std::vector<SeenSurface>& views,
                                              std::size_t number) {
  const SeenSurface& own = views[number];
  std::vector<std::size_t> kept;
  for (std::size_t i = 0; i < own.points->size(); ++i) {
    Vote vote;
    for (std::size_t view = 0; view < views.size(); ++view) {
      if (view != number) ask(views[view], *own.points, i, vote);
    }
    if (vote.contradicting <= double{own.trust[i]} + vote.agreeing) kept.push_back(i);
  }
  return kept;
}

}  // namespace instep
