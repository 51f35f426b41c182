#include "core/foot/skin/border_crest.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <utility>

#include "core/median.h"
#include "core/normal_spread.h"

namespace instep {
namespace {

using Eigen::Vector3d;
constexpr int kOfSecondOrder = 6;
constexpr int kOfThirdOrder = 10;
template <int kTerms>
using TermsOf = Eigen::Matrix<double, kTerms, 1>;
using Terms = TermsOf<kOfSecondOrder>;
using ThirdTerms = TermsOf<kOfThirdOrder>;

constexpr int kMostRounds = 12;
constexpr double kStandsStillMm = 0.01;
constexpr double kDeepestMm = 8.0;  ///< under the start: beyond is another face
constexpr std::size_t kFewestPoints = 12;
constexpr std::size_t kFewestOnASide = 4;
/// Points have less say the further they are off a first fit, and none so far off or further.
constexpr double kStrayInThreeSigmas = 1.5;
constexpr double kLeastLimitMm = 2.25;
/// So much longer than the patch is that which tells the third order, by so many points at least,
/// and so many beyond the patch on either side.
constexpr double kLonger = 1.8;
constexpr std::size_t kFewestForThird = 40;
constexpr std::size_t kFewestBeyond = 8;

/// A point as seen from a patch's middle: along, across, outwards.
using Local = Vector3d;

/// Those of the second order, and those of the third.
ThirdTerms terms(const Local& at) {
  const double x = at.x();
  const double y = at.y();
  return (ThirdTerms() << 1.0, x, y, x * x, x * y, y * y, x * x * x, x * x * y, x * y * y,
          y * y * y)
      .finished();
}

/// Falls from 1 in the middle to 0 at a half-width off it, and smoothly there: a point that comes
/// in or goes as the patch moves has no say yet.
double weight_at(double off, double half_width) {
  const double share = off / half_width;
  return std::pow(1.0 - share * share, 2);
}

/// Least squares by weight_at() both along and across, and by how far each point is `off` a first
/// fit, against `limit`; by none of it where `off` is empty.
template <int kTerms>
std::optional<TermsOf<kTerms>> fitted(const std::vector<Local>& points, const CrestPatch& patch,
                                      const std::vector<double>& off = {}, double limit = 1.0) {
  using Square = Eigen::Matrix<double, kTerms, kTerms>;
  // By half-widths: all powers of them weigh alike.
  const TermsOf<kTerms> unit = terms({patch.along_mm, patch.across_mm, 0.0}).head<kTerms>();
  Square normal = Square::Zero();
  TermsOf<kTerms> right = TermsOf<kTerms>::Zero();
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Local& point = points[i];
    if (!off.empty() && off[i] >= limit) continue;
    const TermsOf<kTerms> row = terms(point).head<kTerms>().cwiseQuotient(unit);
    const double weight = weight_at(point.x(), patch.along_mm) *
                          weight_at(point.y(), patch.across_mm) *
                          (off.empty() ? 1.0 : weight_at(off[i], limit));
    normal.noalias() += (weight * row) * row.transpose();
    right += weight * point.z() * row;
  }
  const Eigen::LDLT<Square> solver(normal);
  const auto sizes = solver.vectorD().cwiseAbs();
  if (!(sizes.minCoeff() > 1e-10 * sizes.maxCoeff())) return std::nullopt;
  const TermsOf<kTerms> solution = solver.solve(right).cwiseQuotient(unit);
  return solution.allFinite() ? std::optional(solution) : std::nullopt;
}

/// Fitted again with less say of what is off, and none of strays; nothing where `are_enough` denies
/// it of all points or of the rest.
template <int kTerms, typename AreEnough>
std::optional<TermsOf<kTerms>> fitted_without_strays(const std::vector<Local>& points,
                                                     const CrestPatch& patch,
                                                     const AreEnough& are_enough) {
  if (!are_enough(points)) return std::nullopt;
  const auto first = fitted<kTerms>(points, patch);
  if (!first) return std::nullopt;
  std::vector<double> off;
  off.reserve(points.size());
  for (const auto& point : points) {
    off.push_back(std::abs(point.z() - first->dot(terms(point).head<kTerms>())));
  }
  const double limit =
      std::max(kStrayInThreeSigmas * kThreeSigmasInMedians * median(off), kLeastLimitMm);
  std::vector<Local> kept;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (off[i] < limit) kept.push_back(points[i]);
  }
  if (!are_enough(kept)) return std::nullopt;
  return fitted<kTerms>(points, patch, off, limit);
}

/// How many lie further along than `beyond_mm`, and behind as far.
std::pair<std::size_t, std::size_t> on_both_sides(const std::vector<Local>& points,
                                                  double beyond_mm) {
  std::pair<std::size_t, std::size_t> sides{0, 0};
  for (const auto& point : points) {
    if (point.x() >= beyond_mm) ++sides.first;
    if (point.x() < -beyond_mm) ++sides.second;
  }
  return sides;
}

/// The skin in third order, by points of a longer patch; none where too few lie on either end of
/// it.
ThirdTerms third_order_of(const std::vector<Local>& points, const CrestPatch& patch) {
  const CrestPatch longer{kLonger * patch.along_mm, patch.across_mm};
  const auto skin =
      fitted_without_strays<kOfThirdOrder>(points, longer, [&](const std::vector<Local>& some) {
        const auto [ahead, behind] = on_both_sides(some, patch.along_mm);
        return some.size() >= kFewestForThird && std::min(ahead, behind) >= kFewestBeyond;
      });
  ThirdTerms third = skin.value_or(ThirdTerms::Zero());
  third.head<kOfSecondOrder>().setZero();
  return third;
}

/// The skin of second order through the points of the patch, freed of what a longer one shows of
/// the third: that would pull a crest aside.
std::optional<Terms> skin_of(const std::vector<Local>& points, const CrestPatch& patch) {
  const ThirdTerms third = third_order_of(points, patch);
  std::vector<Local> close;
  for (const auto& point : points) {
    if (std::abs(point.x()) >= patch.along_mm) continue;
    close.emplace_back(point.x(), point.y(), point.z() - third.dot(terms(point)));
  }
  return fitted_without_strays<kOfSecondOrder>(close, patch, [](const std::vector<Local>& some) {
    const auto [ahead, behind] = on_both_sides(some, 0.0);
    return some.size() >= kFewestPoints && std::min(ahead, behind) >= kFewestOnASide;
  });
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
    const bool is_near = std::abs(seen.x()) < (1.0 + kLonger) * patch.along_mm &&
                         std::abs(seen.y()) < 3.0 * patch.across_mm && seen.z() > -kDeepestMm;
    if (is_near) near.push_back(seen);
  }
  return near;
}

/// Those of them that lie in the longer patch at a place, as seen from it.
std::vector<Local> patch_at(const SkinBorder::Place& place, const std::vector<Local>& points,
                            const CrestPatch& patch) {
  std::vector<Local> close;
  for (const auto& point : points) {
    const Local seen = point - Local(place.along, place.across, 0.0);
    const bool is_close =
        std::abs(seen.x()) < kLonger * patch.along_mm && std::abs(seen.y()) < patch.across_mm;
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
