#include "core/surface/noise/asked_places.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/median.h"
#include "core/stride.h"

namespace instep {
namespace {

constexpr std::size_t kEvenly = 24;
/// Against the way from one to the next as a rule: those of a sparse part lie plainly further
/// apart; those further yet are strays, or have a hole between them.
constexpr double kPlainlyFurther = 2.0;
constexpr double kFurthest = 8.0;
/// The same: beside a hole, or a stray, there are many between that lie in one place, and would be
/// heard as if they were as many witnesses.
constexpr double kApart = 0.5;

/// Asks among the places round a body, which wrap round.
class Asking {
 public:
  Asking(const PointIndex& index, const std::vector<std::size_t>& places)
      : index_(index), places_(places) {}

  std::size_t point(std::size_t i) const { return places_[i % places_.size()]; }
  double way(std::size_t i, std::size_t k) const { return way_of(point(i), point(k)); }

  void ask(std::size_t i) { asked_.push_back({point(i), false}); }

  /// Up to `more` of those between the one asked last, `from`, and `to`, each so far apart.
  void ask_between(std::size_t from, std::size_t to, std::size_t more, double apart) {
    for (std::size_t k = 1; k <= more; ++k) {
      const std::size_t between = point(from + k * (to - from) / (more + 1));
      const bool is_apart =
          way_of(asked_.back().point, between) > apart && way_of(between, point(to)) > apart;
      if (is_apart) asked_.push_back({between, true});
    }
  }

  std::vector<AskedPlace> asked() && { return std::move(asked_); }

 private:
  double way_of(std::size_t a, std::size_t b) const {
    return (index_.points()[b] - index_.points()[a]).norm();
  }

  const PointIndex& index_;
  const std::vector<std::size_t>& places_;
  std::vector<AskedPlace> asked_;
};

}  // namespace

std::vector<AskedPlace> asked_places(const PointIndex& index,
                                     const std::vector<std::size_t>& places) {
  const std::size_t stride = stride_to_at_least(kEvenly, places.size());
  std::vector<std::size_t> even;
  for (std::size_t i = stride / 2; i < places.size(); i += stride) even.push_back(i);
  if (even.empty()) return {};
  even.push_back(even.front() + places.size());
  Asking asking(index, places);
  std::vector<double> ways;
  for (std::size_t i = 0; i + 1 < even.size(); ++i) {
    ways.push_back(asking.way(even[i], even[i + 1]));
  }
  const double usual = median(ways);
  for (std::size_t i = 0; i < ways.size(); ++i) {
    asking.ask(even[i]);
    if (!(ways[i] > kPlainlyFurther * usual && ways[i] < kFurthest * usual)) continue;
    const auto missing = static_cast<std::size_t>(std::lround(ways[i] / usual)) - 1;
    asking.ask_between(even[i], even[i + 1], std::min(missing, even[i + 1] - even[i] - 1),
                       kApart * usual);
  }
  return std::move(asking).asked();
}

}  // namespace instep
