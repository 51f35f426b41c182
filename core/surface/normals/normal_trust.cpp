#include "core/surface/normals/normal_trust.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <utility>

#include "core/stride.h"

namespace instep {
namespace {

constexpr std::size_t kSample = 500;
/// Of a few normals that are turned over more would see nothing.
constexpr std::size_t kLargeSample = 3000;
/// Of each, itself included.
constexpr std::size_t kNeighbours = 4;
/// Cosine of normals that face alike, how many neighbours have to, and how many may face away, but
/// for those of a thin part. Of right ones, however sparse and creased, 94 % face alike and 1 %
/// away; of those set at random a quarter and another, and of those of which one in ten is flipped
/// 82 % and 18 %.
constexpr double kAlike = 0.5;
constexpr double kLeastAlike = 0.85;
constexpr double kMostOpposed = 0.03;
/// Two neighbours along the skin never face opposite ways, as those of the two sides of a thin part
/// do, and those on both sides of where normals are turned over: cosine of their normals, that of
/// the chord to either, and how many of all pairs may. Of right ones, however sparse, creased or
/// noisy, none did in 484 drawn bodies; one point that is turned over makes three to six, and only
/// where many lie round it, it does no harm.
constexpr double kTurnedOver = -0.9;
constexpr double kAlongTheSkin = 0.35;
constexpr double kMostTurnedOver = 5e-4;
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
/// Neighbours of one that is on a sheet with none of its own, among which those of a crease find
/// their sheet, and how far off square the chord to one there may be to either normal.
constexpr std::size_t kMoreNeighbours = 16;
constexpr double kOnSheet = 0.1;
/// Of points, or one: those whose normal is neither on one sheet with any neighbour's nor square to
/// the chord to any, and on a sheet with none of more. Of right normals none to 0.3 % are (864
/// bands of 900 to 4,000 points on lasts, each with one at most), where one in twenty is off by 35
/// degrees 0.3 to 5 %, by 20 degrees 1 % in the mean. And those whose normal, besides, faces as no
/// neighbour's does, as where those of a stretch are set at random.
constexpr double kMostAstray = 0.003;

/// `off_square`: the square of how far a chord is off that to the mean of its ends' normals;
/// `turned`: that of the difference of the two. Or sums of these.
bool is_square(double off_square, double turned) {
  return off_square < kMostOffSquare * kMostOffSquare * turned;
}

/// Whether two points lie each behind the other, as those on both sides of a thin part do. Of two
/// neighbours along the skin of which one normal is turned over one does, or where that is flat
/// half of the pairs do, by their noise: some_are_turned_over() hears these.
bool are_back_to_back(const Eigen::Vector3d& one, const Eigen::Vector3d& other,
                      const Eigen::Vector3d& chord) {
  return one.dot(chord) < 0.0 && other.dot(chord) > 0.0;
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

/// Whether a point lies on one sheet with one of more than its nearest neighbours: beside a crease
/// these may all be on the other side.
bool shares_a_sheet(const std::vector<Eigen::Vector3d>& normals, const PointIndex& index,
                    std::size_t point) {
  const auto nearest = index.nearest(index.points()[point], kMoreNeighbours);
  return std::any_of(nearest.begin(), nearest.end(), [&](const auto& near) {
    if (near.index == point || !(normals[point].dot(normals[near.index]) > kOneSheet)) return false;
    const Eigen::Vector3d chord = (index.points()[near.index] - index.points()[point]).normalized();
    return std::abs(normals[point].dot(chord)) < kOnSheet &&
           std::abs(normals[near.index].dot(chord)) < kOnSheet;
  });
}

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
    if (cosine < -kAlike && are_back_to_back(one, other, chord)) continue;
    witness.pairs += 1.0;
    if (cosine > kAlike) witness.alike += 1.0;
    if (cosine < -kAlike) witness.opposed += 1.0;
    if (cosine > kOneSheet) {
      witness.off_square += off_square;
      witness.turned += turned;
    }
    astray = astray && !(cosine > kOneSheet) && !is_square(off_square, turned);
    lonely = lonely && !(cosine > kAlike);
  }
  astray = astray && !shares_a_sheet(normals, index, point);
  lonely = lonely && astray;
  witness.points += 1.0;
  if (astray) witness.astray += 1.0;
  if (lonely) witness.lonely += 1.0;
}

/// Whether normals of neighbours face opposite ways, though the chord between them runs along the
/// skin.
bool is_turned_over(const std::vector<Eigen::Vector3d>& normals, const PointIndex& index,
                    std::size_t one, std::size_t other) {
  if (!(normals[one].dot(normals[other]) < kTurnedOver)) return false;
  const Eigen::Vector3d chord = (index.points()[other] - index.points()[one]).normalized();
  return std::abs(normals[one].dot(chord)) < kAlongTheSkin &&
         std::abs(normals[other].dot(chord)) < kAlongTheSkin;
}

bool some_are_turned_over(const std::vector<Eigen::Vector3d>& normals, const PointIndex& index) {
  const std::size_t count = normals.size();
  double pairs = 0.0;
  double turned_over = 0.0;
  const std::size_t stride = stride_to_at_most(kLargeSample, count);
  for (std::size_t i = 0; i < count; i += stride) {
    for (const auto& near : index.nearest(index.points()[i], kNeighbours)) {
      if (near.index == i) continue;
      pairs += 1.0;
      if (is_turned_over(normals, index, i, near.index)) turned_over += 1.0;
    }
  }
  return turned_over > kMostTurnedOver * pairs;
}

/// The mean of its neighbours' normals, if these all face alike and it faces away from all of them,
/// from one as if turned over.
std::optional<Eigen::Vector3d> righted(const std::vector<Eigen::Vector3d>& normals,
                                       const PointIndex& index, std::size_t point) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  bool turned_over = false;
  const auto nearest = index.nearest(index.points()[point], kNeighbours);
  for (const auto& near : nearest) {
    if (near.index == point) continue;
    if (!(normals[point].dot(normals[near.index]) < 0.0)) return std::nullopt;
    turned_over = turned_over || is_turned_over(normals, index, point, near.index);
    sum += normals[near.index];
  }
  if (!turned_over) return std::nullopt;
  const Eigen::Vector3d mean = sum.normalized();
  for (const auto& near : nearest) {
    if (near.index != point && !(normals[near.index].dot(mean) > kAlike)) return std::nullopt;
  }
  return mean;
}

}  // namespace

NormalTrust trust_in(const std::vector<Eigen::Vector3d>& normals, const PointIndex& index) {
  const auto& points = index.points();
  const std::size_t stride = stride_to_at_most(kSample, points.size());
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
  const bool agree = witness.pairs > 0.0 && witness.alike >= kLeastAlike * witness.pairs &&
                     witness.opposed <= kMostOpposed * witness.pairs &&
                     witness.lonely <= most_astray;
  const bool outward = sum.norm() <= kOneWay * lengths && flux > kLeastFlux * distances;
  if (!agree || !outward || some_are_turned_over(normals, index)) return NormalTrust::kNone;
  const bool exact = is_square(witness.off_square, witness.turned) && witness.astray <= most_astray;
  return exact ? NormalTrust::kSlopes : NormalTrust::kSide;
}

bool right_lone_normals(std::vector<Eigen::Vector3d>& normals, const PointIndex& index) {
  if (normals.size() > kLargeSample) return false;
  std::vector<std::pair<std::size_t, Eigen::Vector3d>> found;
  for (std::size_t i = 0; i < normals.size(); ++i) {
    if (const auto right = righted(normals, index, i)) found.emplace_back(i, *right);
  }
  for (const auto& [point, right] : found) normals[point] = right;
  return !found.empty();
}

}  // namespace instep
