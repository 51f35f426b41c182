#include "core/foot/landmarks/standing_heel.h"

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>

#include "core/median.h"
#include "core/normal_spread.h"

namespace instep {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double kTopShare = 0.11;         ///< of the foot's length: the wall's height
constexpr double kHalfWidthShare = 0.065;  ///< of the foot's length, beside the axis
constexpr double kBehindMm = 6.0;          ///< the pternion, where points are looked for
constexpr double kBeforeMm = 25.0;
constexpr double kUnderFloorMm = 3.0;
constexpr std::size_t kFewestPoints = 24;

/// Between drawn feet (tests/bench/feet), which have 7.5, and scanned ones that show their edge,
/// which fit 6 to 6.5. Of simulated scans, which do not show it, furthest places are out by 0.8 mm.
constexpr double kUsualEdgeMm = 7.0;
constexpr double kEdgeSpreadMm = 1.2;
constexpr double kLeastEdgeMm = 2.0;
constexpr double kMostEdgeMm = 14.0;
/// From above: an edge that begins under all points would never find its way up to them.
constexpr double kFirstEdgeMm = 10.0;
constexpr double kFloorSpreadMm = 0.3;

constexpr int kMostRounds = 12;
constexpr double kNudgeMm = 1e-4;
constexpr double kLeastDetermined = 1e-14;  ///< less is what rounding makes of nothing
constexpr double kStandsStillMm = 1e-3;
constexpr double kMostStepMm = 3.0;
constexpr double kFirstLimitMm = 6.0;
constexpr double kSecondLimitMm = 3.0;
constexpr double kLeastLimitMm = 0.3;
constexpr double kLeastSigmaMm = 0.05;

constexpr double kSearchStepMm = 0.02;
constexpr double kHighestMm = 16.0;  ///< over the floor, where a furthest place is looked for

constexpr int kWallTerms = 7;
constexpr int kEdge = kWallTerms;
constexpr int kFloor = kWallTerms + 1;
constexpr int kUnknowns = kWallTerms + 2;
using WallTerms = Eigen::Matrix<double, kWallTerms, 1>;
using Unknowns = Eigen::Matrix<double, kUnknowns, 1>;

/// A place of the wall: height and distance aside, in shares of what is fitted.
struct Share {
  double up = 0.0;
  double aside = 0.0;
};

WallTerms wall_terms(const Share& at) {
  const double u = at.up;
  const double v = at.aside;
  return (WallTerms() << 1.0, u, u * u, v, u * v, v * v, u * v * v).finished();
}

struct WeighedPoint {
  Vector3d place;
  double weight = 0.0;
};

enum class EdgeHeight { kKept, kFitted };

/// Wall and edge. Nearer than the edge's height to both wall and floor the skin lies where what
/// either depth leaves of that height has squares that add up to its own: in an arc where the two
/// meet square, in a piece of an ellipse where the wall leans in. The unknowns are the wall's
/// terms, the height at which the edge begins, and that of the floor.
class Heel {
 public:
  Heel() = default;

  explicit Heel(double foot_length_mm)
      : top_(kTopShare * foot_length_mm), half_width_(kHalfWidthShare * foot_length_mm) {}

  std::vector<WeighedPoint> points_of(const std::vector<Vector3d>& points) const {
    std::vector<WeighedPoint> own;
    for (const auto& point : points) {
      const Share at = share_of(point.y(), point.z());
      const bool is_near = at.up < 1.0 && std::abs(at.aside) < 1.0 && point.z() > -kUnderFloorMm &&
                           point.x() > -kBehindMm && point.x() < kBeforeMm;
      if (!is_near) continue;
      // The further from the edge, the less does the wall tell of how it gets there.
      const double below_top = std::min(1.0, 1.0 - at.up);
      own.push_back({point, below_top * below_top * (1.0 - at.aside * at.aside)});
    }
    return own;
  }

  bool settles(const std::vector<WeighedPoint>& points);
  std::optional<Vector3d> furthest_from(const Vector3d& place) const;
  std::optional<Heel> with_edge_one_deviation_higher(const std::vector<WeighedPoint>& points) const;

 private:
  using Square = Eigen::Matrix<double, kUnknowns, kUnknowns>;
  struct Equations {
    Square normal = Square::Zero();
    Unknowns right = Unknowns::Zero();
    double sigma_mm = 0.0;  ///< of a point of full weight
  };

  double edge() const { return unknowns_(kEdge); }
  double floor() const { return unknowns_(kFloor); }
  Share share_of(double y, double z) const { return {z / top_, y / half_width_}; }
  double wall(const Share& at) const { return unknowns_.head<kWallTerms>().dot(wall_terms(at)); }

  /// Derivatives of the wall's x by height and aside.
  Vector2d wall_slope(const Share& at) const {
    const auto& c = unknowns_;
    const double u = at.up;
    const double v = at.aside;
    return {(c(1) + 2.0 * c(2) * u + c(4) * v + c(6) * v * v) / top_,
            (c(3) + c(4) * u + 2.0 * (c(5) + c(6) * u) * v) / half_width_};
  }

  double distance(const Vector3d& point) const;
  double usual_distance(const std::vector<WeighedPoint>& points) const;
  double limit_of(const std::vector<WeighedPoint>& points) const;
  std::optional<Equations> equations(const std::vector<WeighedPoint>& points, double limit) const;
  void hold(int unknown, double usual, double spread, Equations& all) const;
  static std::optional<Unknowns> solved(const Square& normal, const Unknowns& right);
  std::optional<Unknowns> step(const std::vector<WeighedPoint>& points, double limit,
                               EdgeHeight height) const;
  bool settles(const std::vector<WeighedPoint>& points, double limit, EdgeHeight height);
  Vector3d rear(double z) const;

  double top_ = 0.0;
  double half_width_ = 0.0;
  Unknowns unknowns_ = Unknowns::Zero();
};

/// Of a point from the skin, outwards, as far as the skin's own bend does not matter.
double Heel::distance(const Vector3d& point) const {
  const Share at = share_of(point.y(), point.z());
  const Vector2d slope = wall_slope(at);
  const double lean = std::sqrt(1.0 + slope.squaredNorm());
  const double off_wall = (wall(at) - point.x()) / lean;
  const double off_floor = floor() - point.z();
  const Vector2d from_middle(off_wall + edge(), off_floor + edge());
  if (from_middle.minCoeff() <= 0.0) return std::max(off_wall, off_floor);
  // Wall and floor do not meet at a right angle where the wall leans in.
  const Vector2d out = from_middle.normalized();
  const double steepness = std::sqrt(1.0 - 2.0 * out.x() * out.y() * slope.x() / lean);
  return (from_middle.norm() - edge()) / steepness;
}

double Heel::usual_distance(const std::vector<WeighedPoint>& points) const {
  std::vector<double> sizes;
  sizes.reserve(points.size());
  for (const auto& point : points) sizes.push_back(std::abs(distance(point.place)));
  return median(std::move(sizes));
}

/// Of Gauss and Newton, for the least squares of what is within the limit, and for what is known of
/// edge and floor beforehand. Nothing of too few points.
std::optional<Heel::Equations> Heel::equations(const std::vector<WeighedPoint>& points,
                                               double limit) const {
  std::array<Heel, kUnknowns> moved;
  moved.fill(*this);
  for (int i = 0; i < kUnknowns; ++i) moved[static_cast<std::size_t>(i)].unknowns_(i) += kNudgeMm;
  Equations all;
  std::size_t count = 0;
  for (const auto& point : points) {
    const double off = distance(point.place);
    if (std::abs(off) > limit) continue;
    ++count;
    Unknowns slope;
    for (int i = 0; i < kUnknowns; ++i) {
      slope(i) = (moved[static_cast<std::size_t>(i)].distance(point.place) - off) / kNudgeMm;
    }
    all.normal += point.weight * slope * slope.transpose();
    all.right -= point.weight * off * slope;
  }
  if (count < kFewestPoints) return std::nullopt;
  all.sigma_mm = std::max(kThreeSigmasInMedians / 3.0 * usual_distance(points), kLeastSigmaMm);
  hold(kEdge, kUsualEdgeMm, kEdgeSpreadMm, all);
  hold(kFloor, 0.0, kFloorSpreadMm, all);
  return all;
}

void Heel::hold(int unknown, double usual, double spread, Equations& all) const {
  const double weight = std::pow(all.sigma_mm / spread, 2);
  all.normal(unknown, unknown) += weight;
  all.right(unknown) += weight * (usual - unknowns_(unknown));
}

/// What solves the equations; nothing where they leave something undetermined.
std::optional<Unknowns> Heel::solved(const Square& normal, const Unknowns& right) {
  const Eigen::LDLT<Square> solver(normal);
  const auto sizes = solver.vectorD().cwiseAbs();
  if (!(sizes.minCoeff() > kLeastDetermined * sizes.maxCoeff())) return std::nullopt;
  const Unknowns found = solver.solve(right);
  return found.allFinite() ? std::optional(found) : std::nullopt;
}

std::optional<Unknowns> Heel::step(const std::vector<WeighedPoint>& points, double limit,
                                   EdgeHeight height) const {
  auto all = equations(points, limit);
  if (!all) return std::nullopt;
  if (height == EdgeHeight::kKept) hold(kEdge, edge(), kNudgeMm, *all);
  const auto found = solved(all->normal, all->right);
  if (!found) return std::nullopt;
  return std::min(1.0, kMostStepMm / found->cwiseAbs().maxCoeff()) * *found;
}

bool Heel::settles(const std::vector<WeighedPoint>& points, double limit, EdgeHeight height) {
  for (int round = 0; round < kMostRounds; ++round) {
    const auto found = step(points, limit, height);
    if (!found) return false;
    unknowns_ += *found;
    unknowns_(kEdge) = std::clamp(edge(), kLeastEdgeMm, kMostEdgeMm);
    if (found->cwiseAbs().maxCoeff() < kStandsStillMm) break;
  }
  return true;
}

/// Beyond it a point is a stray.
double Heel::limit_of(const std::vector<WeighedPoint>& points) const {
  return std::max(kThreeSigmasInMedians * usual_distance(points), kLeastLimitMm);
}

/// Strays are told once the skin is known about.
bool Heel::settles(const std::vector<WeighedPoint>& points) {
  unknowns_(kEdge) = kFirstEdgeMm;
  return settles(points, kFirstLimitMm, EdgeHeight::kKept) &&
         settles(points, kSecondLimitMm, EdgeHeight::kFitted) &&
         settles(points, limit_of(points), EdgeHeight::kFitted);
}

/// Of what points and what is usual together leave open of it. All else goes along as it is bound
/// to it, to first order.
std::optional<Heel> Heel::with_edge_one_deviation_higher(
    const std::vector<WeighedPoint>& points) const {
  const auto all = equations(points, limit_of(points));
  const auto bound = all ? solved(all->normal, Unknowns::Unit(kEdge)) : std::nullopt;
  if (!bound || !((*bound)(kEdge) > 0.0)) return std::nullopt;
  Heel higher = *this;
  higher.unknowns_ += all->sigma_mm / std::sqrt((*bound)(kEdge)) * *bound;
  return higher;
}

/// The rearmost skin at a height over the floor.
Vector3d Heel::rear(double z) const {
  const double up = z / top_;
  const double bend = unknowns_(5) + unknowns_(6) * up;
  const double across = unknowns_(3) + unknowns_(4) * up;
  const double aside = bend > 0.0 ? std::clamp(-across / (2.0 * bend), -1.0, 1.0) : 0.0;
  const Share at{up, aside};
  Vector3d skin(wall(at), aside * half_width_, z);
  const double in_edge = floor() + edge() - z;
  if (in_edge > 0.0) {
    const double lean = std::sqrt(1.0 + wall_slope(at).squaredNorm());
    skin.x() += lean * (edge() - std::sqrt(std::max(0.0, edge() * edge() - in_edge * in_edge)));
  }
  return skin;
}

std::optional<Vector3d> Heel::furthest_from(const Vector3d& place) const {
  const auto reach = [&](const Vector3d& skin) {
    return std::hypot(skin.x() - place.x(), skin.z() - place.z());
  };
  constexpr int kSteps = static_cast<int>(kHighestMm / kSearchStepMm);
  std::optional<Vector3d> furthest;
  int best = 0;
  for (int step = 0; step <= kSteps; ++step) {
    const Vector3d skin = rear(floor() + step * kSearchStepMm);
    if (furthest && reach(skin) <= reach(*furthest)) continue;
    furthest = skin;
    best = step;
  }
  return best > 0 && best < kSteps ? furthest : std::nullopt;
}

}  // namespace

std::optional<StandingHeelPoint> furthest_of_standing_heel(const std::vector<Vector3d>& points,
                                                           double foot_length_mm,
                                                           const Vector3d& place) {
  if (!(foot_length_mm > 0.0) || !std::isfinite(foot_length_mm)) return std::nullopt;
  Heel heel(foot_length_mm);
  const auto own = heel.points_of(points);
  if (own.size() < kFewestPoints || !heel.settles(own)) return std::nullopt;
  const auto furthest = heel.furthest_from(place);
  const auto higher = heel.with_edge_one_deviation_higher(own);
  const auto elsewhere = higher ? higher->furthest_from(place) : std::nullopt;
  if (!furthest || !elsewhere) return std::nullopt;
  return StandingHeelPoint{*furthest, *elsewhere - *furthest};
}

}  // namespace instep
