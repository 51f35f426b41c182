#include "core/foot/toe_pattern.h"

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

namespace instep {
namespace {

constexpr std::size_t kToes = 5;
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
constexpr double kShiftSpread = 0.04;    ///< of all together
constexpr double kStretchSpread = 0.12;  ///< of their distances
// In units of half a squared standard deviation.
constexpr std::array<double, kToes> kMissing{1.0, 3.0, 8.0, 8.0, 4.0};
constexpr double kNoToe = 6.0;

/// A name for each tip, 0 the big toe; none for what is no tip.
using Names = std::vector<std::optional<std::size_t>>;

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
    const Eigen::Vector2d row = Eigen::Vector2d(1.0, usual - kMiddle) / kOwnSpread;
    const double off = (shares[i] - usual) / kOwnSpread;
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
  explicit Naming(const std::vector<double>& shares) : shares_(shares), names_(shares.size()) {}

  Names likeliest() {
    name(0, 0);
    return best_;
  }

 private:
  void name(std::size_t tip, std::size_t toe) {
    if (tip == shares_.size()) {
      const double price = price_of(shares_, names_);
      if (price < least_) {
        least_ = price;
        best_ = names_;
      }
      return;
    }
    names_[tip].reset();
    name(tip + 1, toe);
    for (std::size_t next = toe; next < kToes; ++next) {
      names_[tip] = next;
      name(tip + 1, next + 1);
    }
    names_[tip].reset();
  }

  const std::vector<double>& shares_;
  Names names_;
  Names best_;
  double least_ = 1e300;
};

}  // namespace

std::optional<std::size_t> second_of_toes(const std::vector<double>& shares) {
  if (shares.size() > kMostTips) return std::nullopt;
  std::vector<std::size_t> order(shares.size());
  std::iota(order.begin(), order.end(), 0);
  std::sort(order.begin(), order.end(),
            [&](std::size_t a, std::size_t b) { return shares[a] < shares[b]; });
  std::vector<double> sorted;
  for (const std::size_t i : order) sorted.push_back(shares[i]);
  const Names names = Naming(sorted).likeliest();
  const auto toes = std::count_if(names.begin(), names.end(), [](auto& name) { return !!name; });
  if (toes < kFewestToes || price_of(sorted, names) > kDearest) return std::nullopt;
  const auto second = std::find(names.begin(), names.end(), std::optional(kSecond));
  if (second == names.end()) return std::nullopt;
  return order[static_cast<std::size_t>(second - names.begin())];
}

}  // namespace instep
