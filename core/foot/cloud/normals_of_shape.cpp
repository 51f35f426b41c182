#include "core/foot/cloud/normals_of_shape.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "core/geometry/moments.h"
#include "core/geometry/moments_round.h"
#include "core/geometry/place_hash.h"
#include "core/geometry/point_index.h"
#include "core/picked.h"

namespace instep {
namespace {

using Eigen::Vector3d;

constexpr std::size_t kMostPlaces = 4000;
constexpr std::size_t kFewestPlaces = 100;
constexpr std::size_t kNeighbours = 12;
/// Within 60 degrees of the skin's own, of directions at random half are.
constexpr double kStands = 0.5;
constexpr double kLeastStanding = 0.65;
/// Away from the middle of the body: of right normals of feet and lasts 92 to 100 % point there, of
/// those that all point up, as towards a viewer above, 54 to 62 %.
constexpr double kLeastOutwards = 0.75;
/// Of pairs of near neighbours, so many may face opposite ways: of right ones at most one in 1,000
/// does, of those of which a tenth is flipped 18 %, of those with signs at random half.
constexpr std::size_t kNearest = 4;  ///< itself included
constexpr double kOpposite = -0.5;   ///< cosine
constexpr double kMostOpposite = 0.1;

/// What the normals at places that lie flat say.
struct Witness {
  double flat = 0.0;
  double standing = 0.0;
  double outwards = 0.0;
  double pairs = 0.0;
  double opposite = 0.0;  ///< of the pairs

  bool contradicts() const {
    return standing < kLeastStanding * flat || outwards < kLeastOutwards * flat ||
           opposite > kMostOpposite * pairs;
  }
};

/// One of the points of `index`, which have these normals and this middle.
void hear(const std::vector<Vector3d>& normals, const PointIndex& index, const Vector3d& middle,
          std::size_t i, Witness& witness) {
  const auto& places = index.points();
  const auto nearest = index.nearest(places[i], kNeighbours);
  const SpreadAxes axes = moments_round(index, places[i], nearest).axes();
  if (!lies_as_skin(axes)) return;
  const Vector3d& told = normals[i];
  witness.flat += 1.0;
  if (std::abs(told.dot(axes.eigenvectors().col(0))) > kStands) witness.standing += 1.0;
  if (told.dot(places[i] - middle) > 0.0) witness.outwards += 1.0;
  for (std::size_t k = 0; k < std::min(kNearest, nearest.size()); ++k) {
    if (nearest[k].index == i) continue;
    witness.pairs += 1.0;
    if (told.dot(normals[nearest[k].index]) < kOpposite) witness.opposite += 1.0;
  }
}

}  // namespace

bool normals_contradict_shape(const PointCloud& cloud) {
  if (!cloud.has_normals()) return false;
  const auto numbers = some_by_place(cloud.positions, kMostPlaces);
  const PointIndex index(picked(cloud.positions, numbers));
  const std::vector<Vector3d> normals = picked(cloud.normals, numbers);
  Vector3d middle = Vector3d::Zero();
  for (const auto& place : index.points()) middle += place / static_cast<double>(numbers.size());
  Witness witness;
  for (std::size_t i = 0; i < numbers.size(); ++i) hear(normals, index, middle, i, witness);
  return witness.flat >= static_cast<double>(kFewestPlaces) && witness.contradicts();
}

}  // namespace instep
