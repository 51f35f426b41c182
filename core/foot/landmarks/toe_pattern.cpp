#include "core/foot/landmarks/toe_pattern.h"

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include "core/picked.h"

namespace instep {
namespace {

constexpr std::size_t kToes = 5;
constexpr std::size_t kBig = 0;
constexpr std::size_t kSecond = 1;
constexpr std::size_t kMostTips = 8;
// On feet in socks the folds and the noise make tips as well, which seldom lie like toes: on drawn
// feet, toes are cheaper than this.
constexpr std::ptrdiff_t kFewestToes = 4;
constexpr double kDearest = 16.0;

// Where toes stand out, seen square to the line of the lesser ones, as drawn feet have it.
constexpr std::array<double, kToes> kUsual{0.25, 0.46, 0.62, 0.78, 0.93};
constexpr double kMiddle = 0.65;         ///< of them, about which a foot is broader or narrower
constexpr double kOwnSpread = 0.025;     ///< of one toe, standard deviation
constexpr double kBigToesSpread = 0.08;  ///< broad, and its side rather than its tip stands out
constexpr double kShiftSpread = 0.04;    ///< of all together
constexpr double kStretchSpread = 0.12;  ///< of their distances
// In units of half a squared standard deviation.
constexpr std::array<double, kToes> kMissing{1.0, 3.0, 8.0, 8.0, 4.0};
constexpr double kNoToe = 6.0;
constexpr double kClearly = 3.0;  ///< dearer is what names another tip the second toe's, or none

/// A name for each tip, 0 the big toe; none for what is no tip.
using Names = std::vector<std::optional<std::size_t>>;

/// Which tip is the second toe's; their number if none is.
std::size_t second_of(const Names& names) {
  return static_cast<std::size_t>(std::find(names.begin(), names.end(), std::optional(kSecond)) -
                                  names.begin());
}

/// How unlikely tips with these names are.
double price_of(const std::vector<double>& shares, const Names& names) {
  Eigen::Matrix2d normal =
      Eigen::Vector2d(std::pow(kShiftSpread, -2), std::pow(kStretchSpread, -2)).asDiagonal();
  Eigen::Vector2d right = Eigen::Vector2d::Zero();
  double squares = 0.0;
  double price = std::accumulate(kMissing.begin(), kMissing.end(), 0.0);
  for (std::size_t i = 0; i < shares.size(); ++i) {
    if (!names[i]) {
      price += kNoToe;
      continue;
    }
    const double usual = kUsual[*names[i]];
    const double spread = *names[i] == kBig ? kBigToesSpread : kOwnSpread;
    const Eigen::Vector2d row = Eigen::Vector2d(1.0, usual - kMiddle) / spread;
    const double off = (shares[i] - usual) / spread;
    normal += row * row.transpose();
    right += off * row;
    squares += off * off;
    price -= kMissing[*names[i]];
  }
  return price + squares - right.dot(normal.ldlt().solve(right));
}

/// Tries all names in order, from the medial side on.
class Naming {
 public:
  Naming(const std::vector<double>& shares, const std::vector<bool>& may_be_second)
      : shares_(shares),
        may_be_second_(may_be_second),
        names_(shares.size()),
        least_(shares.size() + 1, 1e300) {
    name(0, 0);
  }

  const Names& likeliest() const { return best_; }

  /// The least price of names by which the second toe is this tip; of names by which it is none of
  /// them, for the number of tips.
  double least_price(std::size_t second) const { return least_[second]; }

 private:
  void name(std::size_t tip, std::size_t toe) {
    if (tip == shares_.size()) {
      const double price = price_of(shares_, names_);
      if (price < *std::min_element(least_.begin(), least_.end())) best_ = names_;
      double& least = least_[second_of(names_)];
      least = std::min(least, price);
      return;
    }
    names_[tip].reset();
    name(tip + 1, toe);
    for (std::size_t next = toe; next < kToes; ++next) {
      if (next == kSecond && !may_be_second_[tip]) continue;
      names_[tip] = next;
      name(tip + 1, next + 1);
    }
    names_[tip].reset();
  }

  const std::vector<double>& shares_;
  const std::vector<bool>& may_be_second_;
  Names names_;
  Names best_;
  std::vector<double> least_;
};

}  // namespace

std::optional<std::size_t> second_of_toes(const std::vector<double>& shares,
                                          const std::vector<bool>& may_be_second) {
  if (shares.size() > kMostTips) return std::nullopt;
  std::vector<std::size_t> order(shares.size());
  std::iota(order.begin(), order.end(), 0);
  std::sort(order.begin(), order.end(),
            [&](std::size_t a, std::size_t b) { return shares[a] < shares[b]; });
  const auto sorted = picked(shares, order);
  const auto sorted_may_be_second = picked(may_be_second, order);
  const Naming naming(sorted, sorted_may_be_second);
  const auto toes = std::count_if(naming.likeliest().begin(), naming.likeliest().end(),
                                  [](const auto& name) { return name.has_value(); });
  const std::size_t second = second_of(naming.likeliest());
  if (toes < kFewestToes || second == sorted.size()) return std::nullopt;
  const double price = naming.least_price(second);
  if (price > kDearest) return std::nullopt;
  for (std::size_t other = 0; other <= sorted.size(); ++other) {
    if (other != second && naming.least_price(other) < price + kClearly) return std::nullopt;
  }
  return order[second];
}

}  // namespace instep
