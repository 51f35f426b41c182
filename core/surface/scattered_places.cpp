#include "core/surface/scattered_places.h"

#include <algorithm>
#include <cmath>
#include <limits>

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
/// Views that are thicker, or wider than this part of the body, show both sides of a thin part:
/// noise of 1 mm hardly makes one in 20 so thick.
constexpr double kThickest = 0.36;
constexpr double kWidest = 0.09;

}  // namespace

double plain_scatter(const Neighbourhood& here) {
  if (!here.crowded || here.thickness > kThickest || here.radius > kWidest) return 0.0;
  const double scatter = std::sqrt(here.variance);
  if (scatter <= kPlainScatter * here.spacing) return 0.0;
  const auto misfit_at = [&](double variance) {
    return here.misfit(variance, here.likely_roughness(variance, std::nullopt));
  };
  const double like_shape = std::pow(kLikeShape * here.spacing, 2);
  const double gain = misfit_at(like_shape) - misfit_at(here.variance);
  return gain > kPlainGain ? scatter : 0.0;
}

std::vector<ScatteredPlace> scattered_places(const std::vector<Eigen::Vector3d>& points,
                                             const PointIndex& index,
                                             const std::vector<std::size_t>& places) {
  std::vector<ScatteredPlace> known;
  for (std::size_t i = 0; i < places.size(); i += kPlacesInView) {
    const TangentView view = flattest_view(points, index, points[places[i]]);
    if (!view.crowded) return {};
    const auto here = is_plain(view) ? std::nullopt : neighbourhood_of(view, places[i]);
    known.push_back({points[places[i]], here ? plain_scatter(*here) : 0.0});
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

double usual_scatter(const std::vector<ScatteredPlace>& known) {
  double squares = 0.0;
  for (const auto& one : known) squares += one.sigma * one.sigma;
  return known.empty() ? 0.0 : std::sqrt(squares / static_cast<double>(known.size()));
}

}  // namespace instep
