#include "core/geometry/strays/haze_points.h"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numeric>

#include "core/geometry/moments_round.h"
#include "core/geometry/place_hash.h"
#include "core/median.h"
#include "core/picked.h"

namespace instep {
namespace {

constexpr std::size_t kNeighbours = 12;
constexpr std::size_t kAsked = 2000;
/// Of sums of squares, across the plane and along it. Points in space have .2 to .35; of clean
/// skins seen by 8,000 points and more two thousandths have more than this and stand apart.
constexpr double kThick = 0.12;
/// Noise thickens a skin everywhere: of what is usual, added.
constexpr double kTimesUsual = 2.0;
/// Against the usual reach. Between toes and at rims two skins are near each other, not far apart.
constexpr double kFarApart = 1.2;
/// Where there is haze, what stands yet further apart is of it if it is but somewhat thick: of thin
/// layers of haze the points that are left when most is gone.
constexpr double kSomewhatThick = 0.03;
constexpr double kFurtherApart = 1.5;
constexpr double kFewestShare = 0.005;
constexpr double kFewest = 50.0;
constexpr int kMostRounds = 6;

/// How a point and its nearest lie.
struct Surroundings {
  double thickness = 0.0;  ///< across their plane, against along it, squared
  double reach = 0.0;      ///< to the furthest of them, squared
};

Surroundings surroundings_of(const PointIndex& index, const Eigen::Vector3d& place) {
  const auto nearest = index.nearest(place, kNeighbours + 1);
  const Eigen::Vector3d spread = moments_round(index, place, nearest).axes().eigenvalues();
  return {spread[2] > 0.0 ? spread[0] / spread[2] : 0.0, nearest.back().squared_distance};
}

double median_of(double Surroundings::*member, const std::vector<Surroundings>& all) {
  std::vector<double> values;
  values.reserve(all.size());
  for (const auto& one : all) values.push_back(one.*member);
  return median(std::move(values));
}

/// What lies as points of a skin do not, by what is usual among those asked.
class Haze {
 public:
  explicit Haze(const std::vector<Surroundings>& asked)
      : noise_(kTimesUsual * median_of(&Surroundings::thickness, asked)),
        reach_(median_of(&Surroundings::reach, asked)) {}

  bool has(const Surroundings& point) const { return is_beyond(point, kThick, kFarApart); }

  /// Or what is left of it.
  bool has_rest(const Surroundings& point) const {
    return has(point) || is_beyond(point, kSomewhatThick, kFurtherApart);
  }

 private:
  bool is_beyond(const Surroundings& point, double thickness, double apart) const {
    return point.thickness > thickness + noise_ && point.reach > apart * apart * reach_;
  }

  double noise_;
  double reach_;
};

/// The positions of what lies so among the points.
template <typename IsHaze>
std::vector<std::size_t> haze_among(const PointIndex& index, const IsHaze& is_haze) {
  std::vector<std::size_t> found;
  for (std::size_t i = 0; i < index.points().size(); ++i) {
    if (is_haze(surroundings_of(index, index.points()[i]))) found.push_back(i);
  }
  return found;
}

std::vector<Surroundings> ask_some(const PointIndex& index) {
  std::vector<Surroundings> asked;
  for (const std::size_t point : some_by_place(index.points(), kAsked)) {
    asked.push_back(surroundings_of(index, index.points()[point]));
  }
  return asked;
}

/// Whether half as many as would do are found among those asked.
bool may_have_haze(const std::vector<Surroundings>& asked, const Haze& haze) {
  const auto found =
      std::count_if(asked.begin(), asked.end(), [&](const auto& point) { return haze.has(point); });
  return static_cast<double>(found) > 0.5 * kFewestShare * static_cast<double>(asked.size());
}

}  // namespace

std::vector<bool> haze_points(const PointIndex& index) {
  std::vector<bool> is_haze(index.points().size(), false);
  if (index.points().size() <= kNeighbours) return is_haze;
  const auto asked = ask_some(index);
  const Haze haze(asked);
  if (!may_have_haze(asked, haze)) return is_haze;
  auto found = haze_among(index, [&](const auto& point) { return haze.has(point); });
  const double fewest =
      std::max(kFewest, kFewestShare * static_cast<double>(index.points().size()));
  if (static_cast<double>(found.size()) < fewest) return is_haze;
  std::vector<std::size_t> left(index.points().size());
  std::iota(left.begin(), left.end(), std::size_t{0});
  // Where the thickest is gone the rest of it stands out.
  for (int round = 1; !found.empty(); ++round) {
    for (const std::size_t position : found) is_haze[left[position]] = true;
    if (round == kMostRounds) break;
    std::erase_if(left, [&](std::size_t point) { return is_haze[point]; });
    found = haze_among(PointIndex(picked(index.points(), left)),
                       [&](const auto& point) { return haze.has_rest(point); });
  }
  return is_haze;
}

}  // namespace instep
