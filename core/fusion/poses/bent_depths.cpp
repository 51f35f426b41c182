#include "core/fusion/poses/bent_depths.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <map>
#include <utility>

#include "core/median.h"
#include "core/normal_spread.h"
#include "core/picked.h"
#include "core/some_of.h"

namespace instep {
namespace {

/// As many products of two matches are asked of all pairs of views together: some 15 ms of work.
constexpr double kMostProducts = 2e6;
/// Further off than so many standard deviations they are no measure of how others err.
constexpr double kMostOff = 3.0;
/// Skin that faces so much aside is another side of the body.
constexpr double kLeastAlike = 0.7;
/// Ends of the classes of distances between two matches, mm.
constexpr std::array<double, 11> kClasses = {2, 3, 4.5, 6, 9, 12, 18, 24, 36, 48, 72};
constexpr std::size_t kFewestInClass = 50;
/// Chance alone makes independent matches explain more in one case of a thousand (chi square of
/// one degree).
constexpr double kLeastSure = 12.0;
/// Reaches that are tried: none shorter than distances that are asked of, or what chance made of
/// the nearest would be drawn out to much more. Of pessimistic noise alone it was 0.3 mm.
constexpr double kShortestReach = 4.0;
constexpr double kLongestReach = 80.0;
constexpr double kReachStep = 1.15;

/// What a match says of depths along the line of sight.
struct DepthMatch {
  std::size_t target;
  Eigen::Vector3d point;
  Eigen::Vector3d normal;
  double off = 0.0;
};

using PairOfViews = std::pair<std::size_t, std::size_t>;

std::map<PairOfViews, std::vector<DepthMatch>> depth_matches(
    const std::vector<MovingView>& views, const std::vector<ViewMatch>& matches) {
  std::map<PairOfViews, std::vector<DepthMatch>> pairs;
  for (const auto& match : matches) {
    const double seen = std::hypot(match.normal.dot(views[match.view].towards_camera),
                                   match.normal.dot(views[match.other].towards_camera));
    if (!(seen > 0.0)) continue;
    pairs[{match.view, match.other}].push_back(
        {match.target, match.point, match.normal, match.distance / seen});
  }
  const auto most = static_cast<std::size_t>(
      std::sqrt(2.0 * kMostProducts / static_cast<double>(std::max<std::size_t>(1, pairs.size()))));
  for (auto& [views_of, own] : pairs) own = picked(own, some_of(own.size(), most));
  return pairs;
}

/// How two matches of the same views err alike, by how far they lie apart.
struct Class {
  double products = 0.0;
  double distances = 0.0;
  std::size_t count = 0;

  double distance() const { return distances / static_cast<double>(count); }
};
using Covariogram = std::array<Class, kClasses.size() - 1>;

void add_products(const std::vector<DepthMatch>& matches, double most, Covariogram& covariogram) {
  const auto held = [most](double off) { return std::clamp(off, -most, most); };
  for (std::size_t i = 0; i < matches.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      if (matches[i].target == matches[j].target) continue;  // they share its noise
      const double square = (matches[i].point - matches[j].point).squaredNorm();
      if (square >= kClasses.back() * kClasses.back()) continue;
      if (matches[i].normal.dot(matches[j].normal) < kLeastAlike) continue;
      const double distance = std::sqrt(square);
      const auto end = std::upper_bound(kClasses.begin(), kClasses.end(), distance);
      // The root of what is hardly less than the last end's square may be that end.
      if (end == kClasses.begin() || end == kClasses.end()) continue;
      Class& own = covariogram[static_cast<std::size_t>(end - kClasses.begin()) - 1];
      own.products += held(matches[i].off) * held(matches[j].off);
      own.distances += distance;
      ++own.count;
    }
  }
}

/// The bell that fits best, each class by how surely it is known; none where chance may make it.
/// `variance`: of a match.
BentDepths bell_through(const Covariogram& covariogram, double variance) {
  BentDepths best;
  double most = kLeastSure * variance * variance;  // of the squares that a bell takes away
  for (double reach = kShortestReach; reach <= kLongestReach; reach *= kReachStep) {
    double products = 0.0;
    double squares = 0.0;
    for (const auto& own : covariogram) {
      if (own.count < kFewestInClass) continue;
      const double alike = std::exp(-std::pow(own.distance() / reach, 2));
      products += alike * own.products;
      squares += alike * alike * static_cast<double>(own.count);
    }
    if (!(products > 0.0) || !(products * products / squares > most)) continue;
    most = products * products / squares;
    best = {std::sqrt(products / squares), reach};
  }
  return best;
}

}  // namespace

BentDepths bent_depths(const std::vector<MovingView>& views,
                       const std::vector<ViewMatch>& matches) {
  const auto pairs = depth_matches(views, matches);
  std::vector<double> sizes;
  for (const auto& [views_of, own] : pairs) {
    for (const auto& match : own) sizes.push_back(std::abs(match.off));
  }
  const double sigma = kSigmaInMedians * median(std::move(sizes));
  Covariogram covariogram;
  for (const auto& [views_of, own] : pairs) add_products(own, kMostOff * sigma, covariogram);
  return bell_through(covariogram, sigma * sigma);
}

LocalErrors local_errors_of(const PointCloud& cloud, const Eigen::MatrixXd& shares,
                            const std::vector<Eigen::Vector3d>& cameras, const BentDepths& bent) {
  LocalErrors errors;
  if (!bent.is_any()) return errors;
  errors.reach_mm = bent.reach_mm;
  errors.sigma_mm.reserve(cloud.size());
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    double squares = 0.0;
    for (std::size_t v = 0; v < cameras.size(); ++v) {
      const double share = shares(static_cast<Eigen::Index>(v), static_cast<Eigen::Index>(i));
      if (share == 0.0) continue;
      const Eigen::Vector3d sight = (cameras[v] - cloud.positions[i]).normalized();
      squares += std::pow(share * sight.dot(cloud.normals[i]), 2);
    }
    errors.sigma_mm.push_back(bent.sigma_mm * std::sqrt(squares));
  }
  return errors;
}

}  // namespace instep
