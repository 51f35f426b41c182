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
/// Of points, or one: those whose normal is neither on one sheet with any neighbour's nor square to
/// the chord to any. Right normals beside a crease can be: at most 0.6 % (lasts of 900 to 4,000
/// points). Where one in twenty is off by 35 degrees 0.6 to 5 % are. And those whose normal,
/// besides, faces as no neighbour's does: as many of right ones, but 1 to 2 % where those of a
/// twentieth of the section are set at random.
constexpr double kMostAstray = 0.0065;

/// `off_square`: the square of how far a chord is off that to the mean of its ends' normals;
/// `turned`: that of the difference of the two. Or sums of these.
bool is_square(double off_square, double turned) {
  return off_square < kMostOffSquare * kMostOffSquare * turned;
}

/// What points and pairs of neighbours say.
struct Witness {
  double points = 0.0;
  double astray = 0.0;
  double lonely = 0.0;  ///< of those that are astray
  double pairs = 0.0;
  double alike = 0.0;
  double opposed = 0.0;
  double off_square = 0.0;  ///< sum of squares, on one sheet
  double turned = 0.0;
};

void hear(const std::vector<Eigen::Vector3d>& normals, const PointIndex& index, std::size_t point,
          Witness& witness) {
  const Eigen::Vector3d& place = index.points()[point];
  const Eigen::Vector3d& one = normals[point];
  bool lonely = true;
  bool astray = true;
  for (const auto& near : index.nearest(place, kNeighbours)) {
    if (near.index == point) continue;
    const Eigen::Vector3d& other = normals[near.index];
    const Eigen::Vector3d chord = (index.points()[near.index] - place).normalized();
    const double cosine = one.dot(other);
    const double off_square = std::pow((one + other).normalized().dot(chord), 2);
    const double turned = (one - other).squaredNorm();
    witness.pairs += 1.0;
    if (cosine > kAlike) witness.alike += 1.0;
    if (cosine < -kAlike) witness.opposed += 1.0;
    if (cosine > kOneSheet) {
      witness.off_square += off_square;
      witness.turned += turned;
    }
    astray = astray && !(cosine > kOneSheet) && !is_square(off_square, turned);
    lonely = lonely && astray && !(cosine > kAlike);
  }
  witness.points += 1.0;
  if (astray) witness.astray += 1.0;
  if (lonely) witness.lonely += 1.0;
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
    hear(normals, index, i, witness);
  }
  const double most_astray = std::max(1.0, kMostAstray * witness.points);
  const bool agree = witness.alike >= kLeastAlike * witness.pairs &&
                     witness.opposed <= kMostOpposed * witness.pairs &&
                     witness.lonely <= most_astray;
  const bool outward = sum.norm() <= kOneWay * lengths && flux > kLeastFlux * distances;
  if (!agree || !outward) return NormalTrust::kNone;
  const bool exact = is_square(witness.off_square, witness.turned) && witness.astray <= most_astray;
  return exact ? NormalTrust::kSlopes : NormalTrust::kSide;
}

}  // namespace instep
