#include "core/foot/border_crest.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <utility>

#include "core/median.h"

namespace instep {
namespace {

using Eigen::Vector3d;
using Terms = Eigen::Matrix<double, 6, 1>;

constexpr int kMostRounds = 12;
constexpr double kStandsStillMm = 0.01;
constexpr double kDeepestMm = 8.0;  ///< under the start: beyond is another face
constexpr std::size_t kFewestPoints = 12;
constexpr std::size_t kFewestOnASide = 4;
constexpr double kLeastLimitMm = 1.5;

/// A point as seen from a patch's middle: along, across, outwards.
using Local = Vector3d;

Terms terms(const Local& at) {
  const double x = at.x();
  const double y = at.y();
  return (Terms() << 1.0, x, y, x * x, x * y, y * y).finished();
}

/// Falls from 1 in the middle to 0 at a half-width off it, and smoothly there: a point that comes
/// in or goes as the patch moves has no say yet.
double weight_at(double off, double half_width) {
  const double share = off / half_width;
  return std::pow(1.0 - share * share, 2);
}

/// Least squares by weight_at() both along and across.
std::optional<Terms> fitted(const std::vector<Local>& points, const CrestPatch& patch) {
  Eigen::Matrix<double, 6, 6> normal = Eigen::Matrix<double, 6, 6>::Zero();
  Terms right = Terms::Zero();
  for (const auto& point : points) {
    const Terms row = terms(point);
    const double weight =
        weight_at(point.x(), patch.along_mm) * weight_at(point.y(), patch.across_mm);
    normal.selfadjointView<Eigen::Lower>().rankUpdate(row, weight);
    right += weight * point.z() * row;
  }
  normal = normal.selfadjointView<Eigen::Lower>();
  const Eigen::LDLT<Eigen::Matrix<double, 6, 6>> solver(normal);
  const auto sizes = solver.vectorD().cwiseAbs();
  if (!(sizes.minCoeff() > 1e-14 * sizes.maxCoeff())) return std::nullopt;
  const Terms solution = solver.solve(right);
  return solution.allFinite() ? std::optional(solution) : std::nullopt;
}

bool are_enough(const std::vector<Local>& points) {
  const auto behind = std::count_if(points.begin(), points.end(),
                                    [](const Local& point) { return point.x() < 0.0; });
  const auto of_them = static_cast<std::size_t>(behind);
  return points.size() >= kFewestPoints && of_them >= kFewestOnASide &&
         points.size() - of_them >= kFewestOnASide;
}

std::optional<Terms> skin_of(std::vector<Local> points, const CrestPatch& patch) {
  if (!are_enough(points)) return std::nullopt;
  const auto first = fitted(points, patch);
  if (!first) return std::nullopt;
  const auto off = [&](const Local& point) {
    return std::abs(point.z() - first->dot(terms(point)));
  };
  std::vector<double> sizes;
  sizes.reserve(points.size());
  for (const auto& point : points) sizes.push_back(off(point));
  const double limit = std::max(kThreeSigmasInMedians * median(std::move(sizes)), kLeastLimitMm);
  std::erase_if(points, [&](const Local& point) { return off(point) > limit; });
  return are_enough(points) ? fitted(points, patch) : std::nullopt;
}

/// The crest of a skin over the line along: how far it reaches there, a parabola.
struct Crest {
  double across = 0.0;        ///< at the patch's middle
  double across_slope = 0.0;  ///< what it moves across by on the way along
  Vector3d reach;             ///< coefficients of 1, x, x^2

  Crest(const Terms& c, double from, double to) {
    const double vertex = c(5) < 0.0 ? -c(2) / (2.0 * c(5)) : (c(2) > 0.0 ? to : from);
    across = std::clamp(vertex, from, to);
    if (across == vertex) across_slope = -c(4) / (2.0 * c(5));
    const double y = across;
    const double s = across_slope;
    reach = {c(0) + (c(2) + c(5) * y) * y, c(1) + c(4) * y + (c(2) + 2.0 * c(5) * y) * s,
             c(3) + c(4) * s + c(5) * s * s};
  }
};

/// The points that any patch near `origin` can hold, as seen from there.
std::vector<Local> seen_near(const Local& origin, const std::vector<Vector3d>& points,
                             const BorderView& view, const CrestPatch& patch) {
  std::vector<Local> near;
  for (const auto& point : points) {
    const Local seen =
        Local(view.along.dot(point), view.across.dot(point), view.outwards.dot(point)) - origin;
    const bool is_near = std::abs(seen.x()) < 2.0 * patch.along_mm &&
                         std::abs(seen.y()) < 3.0 * patch.across_mm && seen.z() > -kDeepestMm;
    if (is_near) near.push_back(seen);
  }
  return near;
}

/// Those of them that lie close to a place, as seen from it.
std::vector<Local> patch_at(const SkinBorder::Place& place, const std::vector<Local>& points,
                            const CrestPatch& patch) {
  std::vector<Local> close;
  for (const auto& point : points) {
    const Local seen = point - Local(place.along, place.across, 0.0);
    const bool is_close =
        std::abs(seen.x()) < patch.along_mm && std::abs(seen.y()) < patch.across_mm;
    if (is_close) close.push_back(seen);
  }
  return close;
}

}  // namespace

std::optional<SkinBorder::Place> crest_near(const std::vector<Vector3d>& points,
                                            const BorderView& view, const SkinBorder::Place& start,
                                            const CrestPatch& patch,
                                            const std::optional<UsualPlace>& usual) {
  const auto in_view = [&](double across) {
    return std::clamp(across, view.across_from_mm, view.across_to_mm);
  };
  const Local origin(start.along, start.across, start.reach);
  if (std::abs(origin.y() - in_view(origin.y())) > patch.across_mm) return std::nullopt;
  const std::vector<Local> near = seen_near(origin, points, view, patch);
  SkinBorder::Place place;  // counted from the origin
  for (int round = 0; round < kMostRounds; ++round) {
    const auto skin = skin_of(patch_at(place, near, patch), patch);
    if (!skin) return std::nullopt;
    const double middle = origin.y() + place.across;
    const Crest crest(*skin, std::max(view.across_from_mm - middle, -patch.across_mm),
                      std::min(view.across_to_mm - middle, patch.across_mm));
    double slope = crest.reach(1);
    double bend = 2.0 * crest.reach(2);
    place.bend = bend;
    if (usual) {
      const double pull = 2.0 / (usual->spread_mm * usual->spread_mm);
      slope -= pull * (origin.x() + place.along - usual->along);
      bend -= pull;
    }
    if (!(bend < 0.0)) return std::nullopt;
    const double step = std::clamp(-slope / bend, -0.5 * patch.along_mm, 0.5 * patch.along_mm);
    place.along += step;
    // A slanting crest may lead out of the view.
    place.across = in_view(middle + crest.across + step * crest.across_slope) - origin.y();
    place.reach = crest.reach.dot(Vector3d(1.0, step, step * step));
    const bool is_near =
        std::abs(place.along) < patch.along_mm && std::abs(place.across) < 2.0 * patch.across_mm;
    if (!is_near) return std::nullopt;
    if (std::abs(step) < kStandsStillMm) break;
  }
  place.along += origin.x();
  place.across = in_view(place.across + origin.y());
  place.reach += origin.z();
  return place;
}

}  // namespace instep
