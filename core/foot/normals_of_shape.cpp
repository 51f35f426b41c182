#include "core/foot/normals_of_shape.h"

#include <cmath>
#include <cstddef>
#include <vector>

#include "core/geometry/moments.h"
#include "core/geometry/point_index.h"
#include "core/picked.h"
#include "core/some_of.h"

namespace instep {
namespace {

using Eigen::Vector3d;

constexpr std::size_t kMostPlaces = 4000;
constexpr std::size_t kFewestPlaces = 100;
constexpr std::size_t kNeighbours = 12;
constexpr double kFlat = 0.15;  ///< squared spread across a skin, of that along it
/// The same across a line: of a sample that takes lines of a file it tells no skin.
constexpr double kOnALine = 0.15;
/// Within 60 degrees of the skin's own, of directions at random half are.
constexpr double kStands = 0.5;
constexpr double kLeastStanding = 0.65;
constexpr double kLeastOutwards = 0.35;

}  // namespace

bool normals_contradict_shape(const PointCloud& cloud) {
  if (!cloud.has_normals()) return false;
  const auto numbers = some_of(cloud.size(), kMostPlaces);
  const std::vector<Vector3d> places = picked(cloud.positions, numbers);
  Vector3d middle = Vector3d::Zero();
  for (const auto& place : places) middle += place / static_cast<double>(places.size());
  const PointIndex index(places);
  double flat = 0.0;
  double standing = 0.0;
  double outwards = 0.0;
  for (std::size_t i = 0; i < places.size(); ++i) {
    Moments moments;
    for (const auto& other : index.nearest(places[i], kNeighbours)) {
      moments.add(places[other.index] - places[i]);
    }
    const SpreadAxes axes = moments.axes();
    if (!are_flat(axes, kFlat) || are_on_a_line(axes, kOnALine)) continue;
    const Vector3d& told = cloud.normals[numbers[i]];
    flat += 1.0;
    if (std::abs(told.dot(axes.eigenvectors().col(0))) > kStands) standing += 1.0;
    if (told.dot(places[i] - middle) > 0.0) outwards += 1.0;
  }
  if (flat < static_cast<double>(kFewestPlaces)) return false;
  return standing < kLeastStanding * flat || outwards < kLeastOutwards * flat;
}

}  // namespace instep
