#include "core/girth/doubt/cloud_edge.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <vector>

namespace instep {
namespace {

/// How far off skin is at an edge, in standard deviations of its points: of cylinders whose cut is
/// level and whose plane leans by 26 degrees 0.4 of one.
constexpr double kOffAtEdge = 0.5;
/// Against the length: less is not looked for.
constexpr double kLeastDoubt = 1e-5;
/// An edge is looked for in pieces of the contour so many grains long, of which a random cloud puts
/// a score of points on each side.
constexpr double kPieceInGrains = 3.0;
constexpr double kFewestPieces = 8.0;
constexpr double kMostPieces = 72.0;
/// So many grains from the plane it hardly matters. Of those cylinders with 1 mm of noise girths
/// are 0.20 mm short where the edge is one grain away, 0.12 where it is two, 0.08 where it is
/// three.
constexpr double kFarInGrains = 4.0;
/// Points further from the contour are of other skin, but for as much as skin leans.
constexpr double kNearInGrains = 2.5;
constexpr double kLean = 1.0;
/// As many points tell an edge as well as more.
constexpr std::size_t kMostAsked = 8000;

/// How far from the plane points reach, below and above it.
using Reaches = std::array<double, 2>;

/// For pieces of the contour, all as long.
std::vector<Reaches> reaches_along(const PlaneBand& band, const ContourIndex& contour) {
  const double length = contour.length();
  const auto pieces = static_cast<std::size_t>(
      std::clamp(length / (kPieceInGrains * band.grain), kFewestPieces, kMostPieces));
  std::vector<Reaches> reaches(pieces, Reaches{0.0, 0.0});
  const std::size_t stride = 1 + band.points.size() / kMostAsked;
  for (std::size_t i = 0; i < band.points.size(); i += stride) {
    const Eigen::Vector3d& place = band.points[i].position;
    const double off = std::abs(place.z());
    const auto foot = contour.foot_of(place.head<2>());
    if (foot.distance > kNearInGrains * band.grain + kLean * off) continue;
    const auto piece = static_cast<std::size_t>(foot.way / length * static_cast<double>(pieces));
    double& reach = reaches[std::min(piece, pieces - 1)][place.z() > 0.0 ? 1 : 0];
    reach = std::max(reach, off);
  }
  return reaches;
}

/// From one where points end at the plane to none where they reach far from it.
double weight_of(double reach, double grain) {
  const double left = std::max(0.0, 1.0 - reach / (kFarInGrains * grain));
  return left * left;
}

}  // namespace

double doubt_of_edge(const PlaneBand& band, const ContourIndex& contour) {
  // By as much as skin moves out a line is longer for each radian that it turns there.
  const double all_round = kOffAtEdge * band.sigma * 2.0 * std::numbers::pi;
  if (!(all_round > kLeastDoubt * contour.length())) return 0.0;
  const auto reaches = reaches_along(band, contour);
  double weights = 0.0;
  for (const auto& [below, above] : reaches) {
    weights += std::max(weight_of(below, band.grain), weight_of(above, band.grain));
  }
  return all_round * weights / static_cast<double>(reaches.size());
}

}  // namespace instep
