#include "core/surface/paper/off_surface_points.h"

#include <cstddef>

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

}  // namespace instep
