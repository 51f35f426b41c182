#include "core/surface/patches/creased_patch.h"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "core/mean.h"
#include "core/stride.h"
#include "core/surface/heights/quadratic_sheet.h"
#include "core/surface/patches/crease_rule.h"
#include "core/surface/patches/sheet_rows.h"
#include "core/surface/patches/two_sheets.h"

namespace instep {
namespace {

/// Of more than twice as many points so many are asked first whether they turn at all.
constexpr std::size_t kEnoughPoints = 160;
/// A point of one sheet that lies this part of the radius under the other one, beyond what noise
/// explains, is cut off by it; a crease that cuts off more than such a part of all its points, of
/// few not even one, is none: of lasts of 902 points with told normals a girth lay 4 mm beside the
/// nearest ones.
constexpr double kHidden = 0.05;
constexpr double kHiddenInSigmas = 2.0;
constexpr double kMostHidden = 0.05;
/// Rows along a crease tell it if each sheet has so many, and if they come within this part of what
/// is between two of them or the crease turns so much more than a sheet does from row to row. Of
/// exact points on rows 1.3 and 1.6 spacings apart girths err 0.7 and 0.3 mm on flat elliptic
/// cylinders and 0.002 on round feet; where rows count as points at random do, 2.1, 2.7 and 0.2.
constexpr std::size_t kFewestRows = 3;
constexpr double kBesideRows = 0.4;
constexpr double kSharp = 16.0;
constexpr double kLeastSine = 0.3;
/// Points nearest to both sheets, round which the crease is looked for; and to their planes, among
/// which they are.
constexpr std::size_t kPointsAtCrease = 6;
constexpr std::size_t kCandidatesAtCrease = 48;

/// The places with the least of some height over both sheets.
template <class HeightOverBoth>
std::vector<Eigen::Vector3d> least_high(const std::vector<Eigen::Vector3d>& places,
                                        std::size_t count, const HeightOverBoth& height) {
  std::vector<std::pair<double, std::size_t>> heights;
  for (std::size_t i = 0; i < places.size(); ++i) heights.emplace_back(height(places[i]), i);
  count = std::min(count, heights.size());
  std::partial_sort(heights.begin(), heights.begin() + static_cast<std::ptrdiff_t>(count),
                    heights.end());
  std::vector<Eigen::Vector3d> least;
  for (std::size_t i = 0; i < count; ++i) least.push_back(places[heights[i].second]);
  return least;
}

/// The points that lie nearest to both patches, of those that lie near both planes; their middle.
template <class Patch>
Eigen::Vector3d near_crease(const std::vector<OrientedPoint>& points, const TwoSheets& sheets,
                            const Patch& first, const Patch& second) {
  std::vector<Eigen::Vector3d> places;
  places.reserve(points.size());
  for (const auto& point : points) places.push_back(point.position);
  places = least_high(places, kCandidatesAtCrease, [&](const Eigen::Vector3d& place) {
    return std::abs(sheets.planes[0].height(place)) + std::abs(sheets.planes[1].height(place));
  });
  return mean_of(least_high(places, kPointsAtCrease, [&](const Eigen::Vector3d& place) {
    return std::abs(first.at(place).value) + std::abs(second.at(place).value);
  }));
}

struct Crease {
  Eigen::Vector3d place;
  double turn = 0.0;
};

/// The nearest place, found by Newton's steps, where both patches vanish, and their angle there.
template <class Patch>
Crease crease_between(const std::vector<OrientedPoint>& points, const TwoSheets& sheets,
                      const Patch& first, const Patch& second) {
  Eigen::Vector3d place = near_crease(points, sheets, first, second);
  double turn = 0.0;
  for (int step = 0; step < 4; ++step) {
    const FieldValue one = first.at(place);
    const FieldValue two = second.at(place);
    const double cosine = one.gradient.normalized().dot(two.gradient.normalized());
    turn = std::acos(std::clamp(cosine, -1.0, 1.0));
    Eigen::Matrix<double, 2, 3> slopes;
    slopes << one.gradient.transpose(), two.gradient.transpose();
    const Eigen::Matrix2d square = slopes * slopes.transpose();
    if (!(square.determinant() > 1e-4)) break;
    place -= slopes.transpose() * square.inverse() * Eigen::Vector2d(one.value, two.value);
  }
  return {place, turn};
}

double distance_to(const Eigen::Vector3d& place, const std::vector<OrientedPoint>& points) {
  double nearest = std::numeric_limits<double>::infinity();
  for (const auto& point : points) {
    nearest = std::min(nearest, (point.position - place).norm());
  }
  return nearest;
}

/// What the points of a sheet show of how it goes on to the crease.
struct Edgewise {
  double approach = 0.0;  ///< of the nearest point to where the other sheet vanishes
  double bend = 0.0;      ///< from there to the farthest point, in radians
};

Edgewise edgewise(const std::vector<OrientedPoint>& points, const QuadraticSheet& own,
                  const QuadraticSheet& other, double turn) {
  const auto height = [&](const OrientedPoint& point) {
    return std::abs(other.at(point.position).value);
  };
  const auto [nearest, farthest] =
      std::minmax_element(points.begin(), points.end(),
                          [&](const auto& a, const auto& b) { return height(a) < height(b); });
  const Eigen::Vector3d near = own.at(nearest->position).gradient.normalized();
  const Eigen::Vector3d far = own.at(farthest->position).gradient.normalized();
  return {height(*nearest) / std::max(kLeastSine, std::sin(turn)),
          std::acos(std::clamp(near.dot(far), -1.0, 1.0))};
}

/// Whether the points lie on rows along the crease of which there are too few to tell the bend of a
/// sheet, or none comes near it where these bend: rows along a round body look like the sheets of a
/// prism.
bool runs_between_rows(const TwoSheets& sheets,
                       const std::array<std::vector<OrientedPoint>, 2>& parts,
                       const std::array<QuadraticSheet, 2>& bent, double turn) {
  const Eigen::Vector3d along = sheets.planes[0].normal.cross(sheets.planes[1].normal).normalized();
  double apart = 0.0;
  double approach = 0.0;
  double bend = 0.0;  // from row to row
  for (const std::size_t side : {0U, 1U}) {
    const Edgewise sheet = edgewise(parts[side], bent[side], bent[1 - side], turn);
    approach = std::max(approach, sheet.approach);
    const auto rows = rows_along(parts[side], along, sheets.planes[side].normal);
    if (!rows) continue;
    if (rows->count < kFewestRows) return true;
    apart = std::max(apart, rows->apart);
    bend = std::max(bend, sheet.bend / static_cast<double>(rows->count - 1));
  }
  return approach > kBesideRows * apart && apart > 0.0 && turn < kSharp * bend;
}

/// Nothing if the sheets hardly turn where they meet, as quadratics tell it, or as is told.
std::optional<TwoSheets> turning_sheets(const std::vector<OrientedPoint>& points,
                                        const Eigen::Vector3d& centre, double radius, bool clear) {
  if (all_tell_normals(points)) return TwoSheets::by_told_normals(points);
  auto sheets = TwoSheets::by_planes(points);
  if (!sheets) return std::nullopt;
  if (clear) sheets->part_by_quadratics(points, centre, radius);
  const auto parts = sheets->parted(points);
  const auto& [one, other] = sheets->planes;
  const std::array<QuadraticSheet, 2> bent = {
      QuadraticSheet(parts[0], one.normal, centre, radius),
      QuadraticSheet(parts[1], other.normal, centre, radius)};
  const Crease rough = crease_between(points, *sheets, bent[0], bent[1]);
  if (rough.turn < kLeastTurnOfQuadratics) return std::nullopt;
  if (clear && runs_between_rows(*sheets, parts, bent, rough.turn)) return std::nullopt;
  return sheets;
}

}  // namespace

CreasedPatch::CreasedPatch(Sheet first, Sheet second, bool convex)
    : first_(std::move(first)), second_(std::move(second)), convex_(convex) {}

std::optional<CreasedPatch> CreasedPatch::fit(const std::vector<OrientedPoint>& points,
                                              const Eigen::Vector3d& centre, double radius,
                                              double roughness, bool clear) {
  const std::size_t stride = points.size() / kEnoughPoints;
  if (stride > 1 && !turning_sheets(one_in(stride, points), centre, radius, clear))
    return std::nullopt;
  const auto sheets = turning_sheets(points, centre, radius, clear);
  if (!sheets) return std::nullopt;
  const auto parts = sheets->parted(points);
  auto members = sheets->members();
  const auto& [one, other] = sheets->planes;
  auto first = HeightPatch::fit(parts[0], centre, one.normal, radius, roughness);
  if (!first) return std::nullopt;
  auto second = HeightPatch::fit(parts[1], centre, other.normal, radius, roughness);
  if (!second) return std::nullopt;
  const Crease crease = crease_between(points, *sheets, *first, *second);
  CreasedPatch patch({std::move(*first), std::move(members[0])},
                     {std::move(*second), std::move(members[1])}, sheets->convex);
  if (patch.hides_points(points, radius)) return std::nullopt;
  patch.turn_ = crease.turn;
  patch.bend_ = sheets->turn() - crease.turn;
  patch.gap_ = std::max(distance_to(crease.place, parts[0]), distance_to(crease.place, parts[1]));
  return patch;
}

bool CreasedPatch::hides_points(const std::vector<OrientedPoint>& points, double radius) const {
  const auto hidden = [&](const Sheet& own, const Sheet& other) {
    return std::count_if(own.members.begin(), own.members.end(), [&](std::size_t i) {
      const Eigen::Vector3d& place = points[i].position;
      const double over = other.patch.at(place).value - own.patch.at(place).value;
      const double most = kHidden * radius + kHiddenInSigmas * std::sqrt(points[i].variance);
      return (convex_ ? over : -over) > most;
    });
  };
  const auto all = static_cast<double>(hidden(first_, second_) + hidden(second_, first_));
  return all > kMostHidden * static_cast<double>(points.size());
}

FieldValue CreasedPatch::at(const Eigen::Vector3d& position) const {
  const FieldValue first = first_.patch.at(position);
  const FieldValue second = second_.patch.at(position);
  return (second.value > first.value) == convex_ ? second : first;
}

const CreasedPatch::Sheet& CreasedPatch::sheet_at(const Eigen::Vector3d& position) const {
  const double first = first_.patch.at(position).value;
  const double second = second_.patch.at(position).value;
  return (second > first) == convex_ ? second_ : first_;
}

}  // namespace instep
