#include "core/surface/noise/scattered_places.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "core/mean.h"
#include "core/surface/heights/tangent_view.h"
#include "core/surface/noise/neighbourhood.h"

namespace instep {
namespace {

/// Places of which two views next to each other see all.
constexpr std::size_t kPlacesInView = 24;
/// Noise, against the spacing, that shape passes for: round ramps and steps of exact crowds up to
/// 0.2 of it seems likeliest, but is at most so much likelier than the lesser one (of twice the log
/// likelihood), but for one in 100 views of them. Noise of 0.2 spacings is 150 likelier as a rule.
constexpr double kLikeShape = 0.05;
constexpr double kPlainScatter = 0.1;
constexpr double kPlainGain = 60.0;
/// Noise that is even shows twice as much in some views as in others.
constexpr double kPlainlyMore = 3.0;
/// Less, against the body, is the texture of skin or a scanner's rounding.
constexpr double kTexture = 3e-4;
/// Views that are thicker, or wider than this part of the body, show both sides of a thin part.
/// Noise of 1 mm is thicker in one view of 20 where points lie 0.7 mm apart, in most where they lie
/// nearer than 0.3 mm.
constexpr double kThickest = 0.36;
constexpr double kWidest = 0.09;

/// The noise that is plainly in a view, a standard deviation; else 0.
double scatter_in(const TangentView& view, double usual) {
  if (view.thickness > kThickest || view.radius() > kWidest) return 0.0;
  const double least = std::max({kPlainScatter * view.spacing(), kPlainlyMore * usual, kTexture});
  if (most_variance_in(view) <= least * least || is_plain(view)) return 0.0;
  const auto here = neighbourhood_of(view);
  if (!here) return 0.0;
  const double scatter = std::sqrt(here->variance);
  if (scatter <= least) return 0.0;
  const auto misfit_at = [&](double variance) {
    return here->misfit(variance, here->likely_roughness(variance, std::nullopt));
  };
  const double gain =
      misfit_at(std::pow(kLikeShape * view.spacing(), 2)) - misfit_at(here->variance);
  return gain > kPlainGain ? scatter : 0.0;
}

}  // namespace

std::vector<ScatteredPlace> scattered_places(const PointIndex& index,
                                             const std::vector<std::size_t>& places, double usual) {
  std::vector<ScatteredPlace> known;
  for (std::size_t i = 0; i < places.size(); i += kPlacesInView) {
    const Eigen::Vector3d& place = index.points()[places[i]];
    const TangentView view = flattest_view(index, place);
    if (!view.crowded || usual > kPlainScatter * view.spacing()) return {};
    known.push_back({place, scatter_in(view, usual)});
  }
  return most_scatter(known) > 0.0 ? known : std::vector<ScatteredPlace>();
}

double scatter_at(const std::vector<ScatteredPlace>& known, const Eigen::Vector3d& place) {
  const ScatteredPlace* nearest = nullptr;
  const ScatteredPlace* second = nullptr;
  double least = std::numeric_limits<double>::infinity();
  double next = least;
  for (const auto& one : known) {
    const double square = (one.place - place).squaredNorm();
    if (square < least) {
      second = nearest;
      next = least;
      nearest = &one;
      least = square;
    } else if (square < next) {
      second = &one;
      next = square;
    }
  }
  return second == nullptr ? 0.0 : std::max(nearest->sigma, second->sigma);
}

double most_scatter(const std::vector<ScatteredPlace>& known) {
  double most = 0.0;
  for (const auto& one : known) most = std::max(most, one.sigma);
  return most;
}

double mean_scatter(const std::vector<ScatteredPlace>& known) {
  return mean_of(known, &ScatteredPlace::sigma);
}

}  // namespace instep
