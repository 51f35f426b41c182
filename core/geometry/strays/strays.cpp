#include "core/geometry/strays/strays.h"

#include <algorithm>
#include <numeric>
#include <utility>

#include "core/geometry/strays/hovering_points.h"
#include "core/geometry/strays/off_skin_points.h"
#include "core/geometry/strays/stray_points.h"
#include "core/picked.h"

namespace instep {
namespace {

/// Shares of the points that are strays, with which those over the skin, and those near it, are
/// looked for. Of 7,984 girths of lasts, feet and drawn bodies none differs from what it is with
/// four times the first share.
constexpr double kSomeStrays = 0.0005;
constexpr double kManyStrays = 0.005;

/// Points of which some were found to be strays, and those that are left.
class Sieve {
 public:
  Sieve(const PointIndex& index, double known_share)
      : index_(index),
        left_(index.points().size()),
        all_(static_cast<double>(left_.size()) / (1.0 - known_share)) {
    std::iota(left_.begin(), left_.end(), std::size_t{0});
  }

  double share() const { return 1.0 - static_cast<double>(left_.size()) / all_; }

  template <class Finder>
  void take_out(const Finder& strays_in) {
    const auto strays = left_.size() == index_.points().size()
                            ? strays_in(index_)
                            : strays_in(PointIndex(picked(index_.points(), left_)));
    std::size_t kept = 0;
    for (std::size_t i = 0; i < left_.size(); ++i) {
      if (!strays[i]) left_[kept++] = left_[i];
    }
    left_.resize(kept);
  }

  std::vector<bool> taken_out() const {
    std::vector<bool> taken(index_.points().size(), true);
    for (const std::size_t i : left_) taken[i] = false;
    return taken;
  }

 private:
  const PointIndex& index_;
  std::vector<std::size_t> left_;
  double all_;
};

}  // namespace

std::vector<bool> strays_among(const PointIndex& index, double spacing, const StrayHunt& hunt) {
  Sieve sieve(index, hunt.known_share);
  sieve.take_out([&](const PointIndex& points) { return stray_points(points, spacing); });
  if (sieve.share() > kSomeStrays) {
    sieve.take_out([&](const PointIndex& points) { return hovering_points(points, spacing); });
  }
  if (hunt.near_skin || sieve.share() > kManyStrays) {
    sieve.take_out([&](const PointIndex& points) { return off_skin_points(points, spacing); });
  }
  return sieve.taken_out();
}

}  // namespace instep
