#include "core/girth/band/thinned_lines.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <iterator>
#include <optional>
#include <tuple>
#include <utility>
#include <vector>

#include "core/geometry/cell_crowds.h"
#include "core/geometry/moments.h"
#include "core/geometry/moments_round.h"
#include "core/geometry/near_copies.h"
#include "core/geometry/point_index.h"
#include "core/median.h"

namespace instep {
namespace {

/// So many cells with a point each, or stretches with an average, lie in every gap between two
/// lines; lines cross cells askew, and leave more points than that. With four stretches girths of
/// noisy rings and rows 6 to 10 mm apart were a tenth further off.
constexpr double kCells = 4.0;
constexpr double kStretches = 6.0;
/// A line shows where it leads within this part of the gap: so far off no other begins.
constexpr double kReach = 0.45;
constexpr std::size_t kFewestOnLine = 6;
/// Within so many gaps several lines are seen.
constexpr double kSeveralLines = 1.5;
/// Points off their line by less than this part of the gap, as a rule, are exact.
constexpr double kExact = 1e-3;
/// Points that noise puts beside their line are moved onto it, so many times or until they move by
/// less than this part of the gap: round them as they are, averages would be of few points, of
/// those on their own side. Of lines 2.7 mm apart, 0.09 mm from point to point, with 0.5 mm of
/// noise, averages of five points were 0.40 mm off; the least that they could be is 0.22.
constexpr int kMostMoves = 8;
constexpr double kOnLine = 0.01;
/// Points further off a line than so many times as most of them, and than this part of the gap, are
/// strays; which they are is asked so many times at most, for one may hide another.
constexpr double kFarOff = 6.0;
constexpr double kBesideLine = 0.1;
constexpr int kMostRounds = 4;
/// Of lines that scatter by this part of the gap noise puts points as far off as strays are: all
/// stay.
constexpr double kThickLine = 0.1;
/// A point on no line is a stray if it stands so many times as far from others as some of those
/// round it: others may stand beside gaps, or be strays too. The last ones of a line stand twice as
/// far.
constexpr double kStraysApart = 4.0;
constexpr std::size_t kAskedRoundStray = 9;
constexpr double kFewRoundStray = 0.25;
/// Those nearer to each other than this part of a stretch share too many points.
constexpr double kSameStretch = 0.75;

/// A place on a line.
struct Stretch {
  std::size_t number;  ///< in the slab, of the point that it was made round
  Eigen::Vector3d place;
  double share = 1.0;        ///< its noise against the point's
  double scatter = 0.0;      ///< of points round their line; none of a point that stands alone
  bool is_of_stray = false;  ///< so it seems; of thick lines noise does that too
};

/// Arms from a place to those of a line by how far along it they are, in gaps between lines.
struct BentLine {
  std::vector<std::size_t> points;  ///< that it leads through
  double thickness;                 ///< what is further off is a stray
  Eigen::Vector3d along;            ///< one over a gap long
  Eigen::Matrix3d coefficients;     ///< a row for each term

  Eigen::Vector3d beside_place() const { return coefficients.row(0); }

  Eigen::Vector3d terms_at(const Eigen::Vector3d& arm) const {
    const double way = along.dot(arm);
    return {1.0, way, way * way};
  }
  Eigen::Vector3d off(const Eigen::Vector3d& arm) const {
    return arm - coefficients.transpose() * terms_at(arm);
  }
  bool leads_through(const Eigen::Vector3d& arm) const { return off(arm).norm() <= thickness; }
};

/// How much a point counts in the average of a stretch by how far along the line it is from its
/// middle, in gaps between lines. Less and less: if all within some distance counted alike, those
/// of a ring that noise moved inwards, which are nearer, would count and the others at that
/// distance not; rings of points a twelfth of the gap from each other were half a millimetre too
/// short.
double near_middle(double way) {
  return std::max(1.0 - std::abs(way) * kStretches / kSameStretch, 0.0);
}

/// Averages points of a slab along their lines.
class LineAverages {
 public:
  LineAverages(const PointCloud& cloud, const PlaneSlab& slab, double apart, bool weighed)
      : cloud_(cloud),
        slab_(slab),
        index_(slab.places),
        apart_(apart),
        weighed_(weighed && cloud.has_sigma()) {}

  Stretch round(std::size_t number) const {
    const Stretch alone{number, slab_.places[number]};
    const Eigen::Vector3d up = across_the_skin(alone.place);
    Stretch stretch = alone;
    auto line = line_beside(stretch, up);
    for (int moves = 0; line && moves < kMostMoves; ++moves) {
      const Eigen::Vector3d move = line->beside_place();
      if (move.norm() < kOnLine * apart_) break;
      stretch.place += move;
      line = line_beside(stretch, up);
    }
    // Of a line as thick as points are looked for none of them lies beside it.
    const bool is_thick = line && line->thickness >= kReach * apart_;
    if (!is_thick) line = line_without_strays(stretch, up);
    const bool is_off = line && !line->leads_through(alone.place - stretch.place);
    if (!line || !average(*line, stretch)) stretch = alone;
    stretch.is_of_stray = is_off || (!line && is_stray(number));
    return stretch;
  }

 private:
  /// Whether a point that is on no line stands further from others than those round it do.
  bool is_stray(std::size_t number) const {
    std::vector<double> usual;
    for (const auto& one : index_.nearest(slab_.places[number], kAskedRoundStray)) {
      usual.push_back(next_to(one.index));
    }
    return next_to(number) > kStraysApart * quantile(std::move(usual), kFewRoundStray);
  }

  /// How far off the next but one point is.
  double next_to(std::size_t number) const {
    return std::sqrt(index_.nearest(slab_.places[number], 3).back().squared_distance);
  }

  double weight_of(std::size_t point) const {
    if (!weighed_) return 1.0;
    const double sigma = std::max(cloud_.sigma_mm[slab_.indices[point]], 1e-9);
    return 1.0 / (sigma * sigma);
  }

  /// Those that were seen if it was, or else those that were not.
  std::vector<std::size_t> beside(const Stretch& stretch) const {
    const bool seen = cloud_.was_seen(slab_.indices[stretch.number]);
    std::vector<std::size_t> beside;
    for (const auto& one : index_.around(stretch.place, kReach * apart_)) {
      if (cloud_.was_seen(slab_.indices[one.index]) == seen) beside.push_back(one.index);
    }
    return beside;
  }

  /// In which several lines spread least: that of the noise, in which a thick one may spread more
  /// than along itself.
  Eigen::Vector3d across_the_skin(const Eigen::Vector3d& place) const {
    return moments_round(index_, place, index_.around(place, kSeveralLines * apart_)).flattest();
  }

  /// The line beside a place as it bends evenly, `up` across the skin. Nothing where too few points
  /// are there, or where they tell none.
  std::optional<BentLine> line_beside(const Stretch& stretch, const Eigen::Vector3d& up) const {
    return line_through(beside(stretch), stretch, up);
  }

  /// The same of those of its points that are no strays. The place's own is not asked at first: few
  /// others could not tell it from one.
  std::optional<BentLine> line_without_strays(const Stretch& stretch,
                                              const Eigen::Vector3d& up) const {
    const auto found = beside(stretch);
    auto others = found;
    std::erase(others, stretch.number);
    auto line = line_through(std::move(others), stretch, up);
    for (int rounds = 1; line && rounds < kMostRounds; ++rounds) {
      std::vector<std::size_t> near;
      std::copy_if(found.begin(), found.end(), std::back_inserter(near), [&](std::size_t point) {
        return line->leads_through(slab_.places[point] - stretch.place);
      });
      if (near == line->points) break;
      line = line_through(std::move(near), stretch, up);
    }
    return line;
  }

  std::optional<BentLine> line_through(std::vector<std::size_t> points, const Stretch& stretch,
                                       const Eigen::Vector3d& up) const {
    if (points.size() < kFewestOnLine) return std::nullopt;
    BentLine line{std::move(points), 0.0, {}, {}};
    lead_through_points(stretch, up, line);
    if (!(line.beside_place().norm() <= kReach * apart_)) return std::nullopt;
    return line;
  }

  void lead_through_points(const Stretch& stretch, const Eigen::Vector3d& up,
                           BentLine& line) const {
    Moments moments;
    for (const auto point : line.points) {
      const Eigen::Vector3d arm = slab_.places[point] - stretch.place;
      moments.add(arm - up.dot(arm) * up);
    }
    line.along = moments.axes().eigenvectors().col(2) / apart_;
    Eigen::Matrix3d normal = Eigen::Matrix3d::Zero();
    Eigen::Matrix3d sides = Eigen::Matrix3d::Zero();
    for (const auto point : line.points) {
      const Eigen::Vector3d arm = slab_.places[point] - stretch.place;
      const Eigen::Vector3d terms = line.terms_at(arm);
      const double weight = weight_of(point);
      normal += weight * terms * terms.transpose();
      sides += weight * terms * arm.transpose();
    }
    line.coefficients = normal.ldlt().solve(sides);
    std::vector<double> offs;
    for (const auto point : line.points) {
      offs.push_back(line.off(slab_.places[point] - stretch.place).norm());
    }
    line.thickness = std::max(kFarOff * median(std::move(offs)), kBesideLine * apart_);
  }

  /// Moves a place onto the mean of its stretch, as a line bent evenly leads there: the bend of the
  /// line would draw a plain mean inwards. False where it has no points.
  bool average(const BentLine& line, Stretch& stretch) const {
    Eigen::Vector3d rest = Eigen::Vector3d::Zero();
    double weights = 0.0;
    double variance = 0.0;
    double squares = 0.0;
    for (const auto point : line.points) {
      const Eigen::Vector3d arm = slab_.places[point] - stretch.place;
      const Eigen::Vector3d off = line.off(arm);
      squares += off.squaredNorm();
      const double near = near_middle(line.along.dot(arm));
      const double weight = near * weight_of(point);
      rest += weight * off;
      weights += weight;
      variance += weight * near;
    }
    if (!(weights > 0.0)) return false;
    stretch.place += line.beside_place() + rest / weights;
    stretch.share = std::sqrt(weight_of(stretch.number) * variance) / weights;
    stretch.scatter = std::sqrt(squares / static_cast<double>(line.points.size()));
    return true;
  }

  const PointCloud& cloud_;
  const PlaneSlab& slab_;
  PointIndex index_;
  double apart_;
  bool weighed_;
};

double usual_scatter(const std::vector<Stretch>& stretches) {
  std::vector<double> scatters;
  for (const auto& stretch : stretches) scatters.push_back(stretch.scatter);
  return median(std::move(scatters));
}

/// In the order of all slabs.
PlaneSlab slab_of(std::vector<Stretch> stretches, const PlaneSlab& slab) {
  std::sort(stretches.begin(), stretches.end(), [](const Stretch& a, const Stretch& b) {
    const auto key = [](const Stretch& one) {
      return std::tuple(one.place.x(), one.place.y(), one.place.z(), one.number);
    };
    return key(a) < key(b);
  });
  PlaneSlab averaged;
  for (const auto& stretch : stretches) {
    averaged.indices.push_back(slab.indices[stretch.number]);
    averaged.places.push_back(stretch.place);
    averaged.shares.push_back(stretch.share);
    if (!slab.errors_mm.empty()) averaged.errors_mm.push_back(slab.errors_mm[stretch.number]);
  }
  return averaged;
}

}  // namespace

ThinnedLines thinned_lines(const PointCloud& cloud, const PlaneSlab& slab, double apart,
                           bool weighed) {
  if (slab.places.empty()) return {};
  auto left_out = crowds_in_cells(slab.places, apart / kCells).crowding;
  const LineAverages averages(cloud, slab, apart, weighed);
  std::vector<Stretch> stretches;
  for (std::size_t i = 0; i < left_out.size(); ++i) {
    if (!left_out[i]) stretches.push_back(averages.round(i));
  }
  const double scatter = usual_scatter(stretches);
  std::size_t strays = 0;
  if (scatter < kThickLine * apart) {
    for (const auto& stretch : stretches) {
      if (stretch.is_of_stray) left_out[stretch.number] = true;
    }
    strays = std::erase_if(stretches, [](const Stretch& stretch) { return stretch.is_of_stray; });
  }
  const double stray_share = static_cast<double>(strays) / static_cast<double>(slab.places.size());
  if (scatter < kExact * apart) return {without(left_out, slab), stray_share};
  const PlaneSlab averaged = slab_of(std::move(stretches), slab);
  const auto repeated = near_copies(averaged.places, kSameStretch * apart / kStretches);
  return {without(repeated, averaged), stray_share};
}

}  // namespace instep
