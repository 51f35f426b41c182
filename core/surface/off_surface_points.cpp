#include "core/surface/off_surface_points.h"

#include <cstddef>

#include "core/geometry/point_index.h"

namespace instep {

SignedSamples with_off_surface_points(const std::vector<Eigen::Vector3d>& points,
                                      const std::vector<Eigen::Vector3d>& normals,
                                      double distance) {
  SignedSamples samples;
  samples.positions = points;
  samples.values.assign(points.size(), 0.0);
  for (std::size_t i = 0; i < points.size(); ++i) {
    samples.positions.emplace_back(points[i] + distance * normals[i]);
    samples.values.push_back(-distance);
  }
  return samples;
}

std::vector<Eigen::Vector3d> without_near_duplicates(const std::vector<Eigen::Vector3d>& points,
                                                     double distance) {
  const PointIndex index(points);
  std::vector<bool> dropped(points.size(), false);
  std::vector<Eigen::Vector3d> kept;
  kept.reserve(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (dropped[i]) continue;
    kept.push_back(points[i]);
    for (const auto& near : index.within(points[i], distance)) dropped[near.index] = true;
  }
  return kept;
}

}  // namespace instep
