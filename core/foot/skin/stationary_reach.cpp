#include "core/foot/skin/stationary_reach.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "core/median.h"
#include "core/normal_spread.h"

namespace instep {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr int kMostRounds = 6;
constexpr double kStandsStillMm = 0.03;
constexpr double kDeepestMm = 5.0;  ///< off the start: beyond is another face
constexpr std::size_t kFewestPoints = 24;
constexpr double kLeastLimitMm = 0.05;
constexpr double kMostAround = 0.8;  ///< of the patch, within which a place is looked for
constexpr double kSearchStep = 0.1;

/// A point seen round the axis: the way round and across in halves of the patch, and how far it
/// reaches beyond the patch's middle.
struct SeenPoint {
  double around = 0.0;
  double across = 0.0;
  double reach = 0.0;
};

using SeenPatch = std::vector<SeenPoint>;

/// The patch round a place, and the way back into the frame of the points.
struct View {
  Vector3d axis_place;
  ReachPatch size;
  double angle = 0.0;
  double reach = 0.0;
  double across = 0.0;

  View(const Vector3d& axis, const Vector3d& middle, const ReachPatch& patch)
      : axis_place(axis), size(patch), across(middle.y()) {
    const Vector3d from = middle - axis;
    angle = std::atan2(from.z(), from.x());
    reach = std::hypot(from.x(), from.z());
  }

  SeenPatch of(const std::vector<Vector3d>& points) const {
    SeenPatch seen;
    for (const auto& point : points) {
      const double aside = (point.y() - across) / size.across_mm;
      if (std::abs(aside) > 1.0) continue;
      const Vector3d from = point - axis_place;
      const double beyond = std::hypot(from.x(), from.z()) - reach;
      if (std::abs(beyond) > kDeepestMm) continue;
      const double turn =
          std::remainder(std::atan2(from.z(), from.x()) - angle, 2.0 * std::numbers::pi);
      const double around = turn * reach / size.around_mm;
      if (std::abs(around) < 1.0) seen.push_back({around, aside, beyond});
    }
    return seen;
  }

  /// Whether a place is no further than the patch reaches.
  bool holds(const Vector3d& place) const {
    const Vector3d from = place - axis_place;
    const double turn =
        std::remainder(std::atan2(from.z(), from.x()) - angle, 2.0 * std::numbers::pi);
    return std::abs(turn) * reach <= size.around_mm &&
           std::abs(place.y() - across) <= size.across_mm;
  }

  Vector3d place_of(const SeenPoint& point) const {
    const double turned = angle + point.around * size.around_mm / reach;
    const double away = reach + point.reach;
    return {axis_place.x() + away * std::cos(turned), across + point.across * size.across_mm,
            axis_place.z() + away * std::sin(turned)};
  }
};

/// A surface over a patch that is linear in its terms.
template <int Count, typename Row>
struct Fit {
  using Terms = Eigen::Matrix<double, Count, 1>;
  Terms terms = Terms::Zero();
  double misfit = 0.0;  ///< sum of squares, but for a part that is the same for all surfaces

  static std::optional<Fit> to(const SeenPatch& patch, const Row& row) {
    Eigen::Matrix<double, Count, Count> normal = Eigen::Matrix<double, Count, Count>::Zero();
    Terms right = Terms::Zero();
    for (const auto& point : patch) {
      const Terms own = row(point);
      normal += own * own.transpose();
      right += point.reach * own;
    }
    Fit fit;
    fit.terms = normal.ldlt().solve(right);
    fit.misfit = -fit.terms.dot(right);
    return fit.terms.allFinite() ? std::optional(fit) : std::nullopt;
  }
};

/// The points that lie on a surface as most do.
template <typename Surface>
SeenPatch without_strays(const SeenPatch& patch, const Surface& surface) {
  std::vector<double> off;
  off.reserve(patch.size());
  for (const auto& point : patch) off.push_back(std::abs(point.reach - surface(point)));
  const double limit = std::max(kThreeSigmasInMedians * median(off), kLeastLimitMm);
  SeenPatch kept;
  for (std::size_t i = 0; i < patch.size(); ++i) {
    if (off[i] <= limit) kept.push_back(patch[i]);
  }
  return kept;
}

using SmoothTerms = Eigen::Matrix<double, 8, 1>;

SmoothTerms smooth_terms(const SeenPoint& at) {
  const double u = at.around;
  const double v = at.across;
  return (SmoothTerms() << 1.0, u, u * u, u * u * u, v, v * v, u * v, u * v * v).finished();
}

using SmoothFit = Fit<8, decltype(&smooth_terms)>;

/// Second derivative of a smooth surface on the way round.
double bend_around(const SmoothTerms& c, const Vector2d& place) {
  return 2.0 * c(2) + 6.0 * c(3) * place.x();
}

/// Newton's way to where a smooth surface is level, and nearest on the way round.
std::optional<Vector2d> nearest_place(const SmoothTerms& c) {
  constexpr int kSteps = 8;
  Vector2d place = Vector2d::Zero();
  for (int step = 0; step < kSteps; ++step) {
    const double u = place.x();
    const double v = place.y();
    const Vector2d slope(c(1) + 2.0 * c(2) * u + 3.0 * c(3) * u * u + c(6) * v + c(7) * v * v,
                         c(4) + 2.0 * c(5) * v + c(6) * u + 2.0 * c(7) * u * v);
    Eigen::Matrix2d bend;
    bend << bend_around(c, place), c(6) + 2.0 * c(7) * v, c(6) + 2.0 * c(7) * v,
        2.0 * c(5) + 2.0 * c(7) * u;
    if (!(std::abs(bend.determinant()) > 1e-12)) return std::nullopt;
    place -= bend.inverse() * slope;
    if (!(place.cwiseAbs().maxCoeff() < 1.0)) return std::nullopt;
  }
  return bend_around(c, place) > 0.0 ? std::optional(place) : std::nullopt;
}

std::optional<SeenPoint> nearest_point(const SeenPatch& patch) {
  const auto first = SmoothFit::to(patch, smooth_terms);
  if (!first) return std::nullopt;
  const auto kept = without_strays(
      patch, [&](const SeenPoint& point) { return first->terms.dot(smooth_terms(point)); });
  if (kept.size() < kFewestPoints) return std::nullopt;
  const auto fit = SmoothFit::to(kept, smooth_terms);
  const auto nearest = fit ? nearest_place(fit->terms) : std::nullopt;
  if (!nearest) return std::nullopt;
  SeenPoint point{nearest->x(), nearest->y(), 0.0};
  point.reach = fit->terms.dot(smooth_terms(point));
  return point;
}

/// Terms of two parabolas that meet level at a place on the way round.
struct EdgeTerms {
  double place = 0.0;

  Eigen::Matrix<double, 7, 1> operator()(const SeenPoint& at) const {
    const double u = at.around - place;
    const double v = at.across;
    const double ahead = u > 0.0 ? u * u : 0.0;
    const double behind = u > 0.0 ? 0.0 : u * u;
    return (Eigen::Matrix<double, 7, 1>() << 1.0, ahead, behind, v, v * v, u * v, u * v * v)
        .finished();
  }
};

struct Edge {
  EdgeTerms row;
  Fit<7, EdgeTerms> fit;

  double operator()(const SeenPoint& point) const { return fit.terms.dot(row(point)); }
};

std::optional<Edge> edge_at(const SeenPatch& patch, double place) {
  const EdgeTerms row{place};
  const auto fit = Fit<7, EdgeTerms>::to(patch, row);
  return fit ? std::optional(Edge{row, *fit}) : std::nullopt;
}

/// Step by step, and then between the steps.
std::optional<Edge> likeliest_edge(const SeenPatch& patch) {
  std::optional<Edge> best;
  const auto search = [&](double from, double to, double step) {
    for (double place = from; place <= to; place += step) {
      const auto edge = edge_at(patch, place);
      if (edge && (!best || edge->fit.misfit < best->fit.misfit)) best = edge;
    }
  };
  search(-kMostAround, kMostAround, kSearchStep);
  if (!best) return best;
  const double rough = best->row.place;
  search(rough - kSearchStep, rough + kSearchStep, kSearchStep / 5.0);
  return best;
}

std::optional<SeenPoint> furthest_point(const SeenPatch& patch) {
  const auto first = likeliest_edge(patch);
  if (!first) return std::nullopt;
  const auto kept = without_strays(patch, *first);
  if (kept.size() < kFewestPoints) return std::nullopt;
  const auto edge = likeliest_edge(kept);
  if (!edge || std::abs(edge->row.place) > kMostAround - kSearchStep) return std::nullopt;
  const auto& terms = edge->fit.terms;
  const bool falls_off = terms(1) < 0.0 && terms(2) < 0.0 && terms(4) < 0.0;
  if (!falls_off) return std::nullopt;
  const double across = std::clamp(-terms(3) / (2.0 * terms(4)), -1.0, 1.0);
  SeenPoint point{edge->row.place, across, 0.0};
  point.reach = (*edge)(point);
  return point;
}

template <typename Finder>
std::optional<Vector3d> found_from(const std::vector<Vector3d>& points, const Vector3d& axis_place,
                                   const Vector3d& start, const ReachPatch& patch,
                                   const Finder& find) {
  const View beginning(axis_place, start, patch);
  const bool has_extent = patch.around_mm > 0.0 && patch.across_mm > 0.0 && beginning.reach > 0.0;
  if (!has_extent) return std::nullopt;
  Vector3d place = start;
  for (int round = 0; round < kMostRounds; ++round) {
    const View view(axis_place, place, patch);
    const SeenPatch seen = view.of(points);
    if (seen.size() < kFewestPoints) return std::nullopt;
    const std::optional<SeenPoint> found = find(seen);
    if (!found) return std::nullopt;
    const Vector3d before = std::exchange(place, view.place_of(*found));
    if (!beginning.holds(place)) return std::nullopt;
    if ((place - before).norm() < kStandsStillMm) break;
  }
  return place;
}

}  // namespace

std::optional<Vector3d> nearest_reach(const std::vector<Vector3d>& points,
                                      const Vector3d& axis_place, const Vector3d& start,
                                      const ReachPatch& patch) {
  return found_from(points, axis_place, start, patch, nearest_point);
}

std::optional<Vector3d> furthest_reach(const std::vector<Vector3d>& points,
                                       const Vector3d& axis_place, const Vector3d& start,
                                       const ReachPatch& patch) {
  return found_from(points, axis_place, start, patch, furthest_point);
}

}  // namespace instep
