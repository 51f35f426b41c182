#include "core/surface/normal_trust.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace instep {
namespace {

constexpr std::size_t kSample = 500;
/// Of each, itself included.
constexpr std::size_t kNeighbours = 4;
/// Cosine of normals that face alike, how many neighbours have to, and how many may face away. Of
/// right ones, however sparse and creased, 94 % face alike and 1 % away; of those set at random a
/// quarter and another, and of those of which one in ten is flipped 82 % and 18 %.
constexpr double kAlike = 0.5;
constexpr double kLeastAlike = 0.85;
constexpr double kMostOpposed = 0.03;
/// Round an evenly covered closed section normals add up to nothing, whatever way the skin leans,
/// and their flux is that of its area: against the distances from its middle more than this, if it
/// is less than ten times as long as wide.
constexpr double kOneWay = 0.8;
constexpr double kLeastFlux = 0.15;
/// Cosine of normals on one sheet.
constexpr double kOneSheet = 0.95;
/// Root mean square of how far chords are off square to normals, against how far these turn.
/// Measured: at most 0.14 for exact normals (sparse simulated feet; 0.04 to 0.08 on lasts), 0.13 to
/// 0.22 with a degree of noise, 0.37 with five, 0.47 and more where normals are averaged over four
/// neighbours or more.
constexpr double kMostOffSquare = 0.15;

/// What pairs of neighbours say.
struct Witness {
  double pairs = 0.0;
  double alike = 0.0;
  double opposed = 0.0;
  double off_square = 0.0;  ///< sum of squares, on one sheet
  double turned = 0.0;
};

void hear(const Eigen::Vector3d& arm, const Eigen::Vector3d& one, const Eigen::Vector3d& other,
          Witness& witness) {
  witness.pairs += 1.0;
  if (one.dot(other) > kAlike) witness.alike += 1.0;
  if (one.dot(other) < -kAlike) witness.opposed += 1.0;
  if (!(one.dot(other) > kOneSheet)) return;
  witness.off_square += std::pow((one + other).normalized().dot(arm.normalized()), 2);
  witness.turned += (one - other).squaredNorm();
}

}  // namespace

NormalTrust trust_in(const std::vector<Eigen::Vector3d>& normals, const PointIndex& index) {
  const auto& points = index.points();
  const std::size_t stride = (points.size() + kSample - 1) / kSample;
  Witness witness;
  Eigen::Vector2d sum = Eigen::Vector2d::Zero();
  double lengths = 0.0;
  double flux = 0.0;
  double distances = 0.0;
  for (std::size_t i = 0; i < points.size(); i += stride) {
    sum += normals[i].head<2>();
    lengths += normals[i].head<2>().norm();
    flux += normals[i].head<2>().dot(points[i].head<2>());
    distances += normals[i].head<2>().norm() * points[i].head<2>().norm();
    for (const auto& near : index.nearest(points[i], kNeighbours)) {
      if (near.index == i) continue;
      hear(points[near.index] - points[i], normals[i], normals[near.index], witness);
    }
  }
  const bool agree = witness.alike >= kLeastAlike * witness.pairs &&
                     witness.opposed <= kMostOpposed * witness.pairs;
  const bool outward = sum.norm() <= kOneWay * lengths && flux > kLeastFlux * distances;
  if (!agree || !outward) return NormalTrust::kNone;
  const bool square = witness.off_square < kMostOffSquare * kMostOffSquare * witness.turned;
  return square ? NormalTrust::kSlopes : NormalTrust::kSide;
}

}  // namespace instep
