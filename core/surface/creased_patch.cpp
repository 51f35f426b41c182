#include "core/surface/creased_patch.h"

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <utility>

#include "core/geometry/moments.h"

namespace instep {
namespace {

/// Sheets whose planes turn less (radians) are not worth a closer look.
constexpr double kLeastTurn = 0.6;
/// And where quadratics through them turn less: nearly as the sheets do, at a fraction of the work.
constexpr double kLeastTurnOfQuadratics = 0.55;
constexpr double kLeastToldTurn = 0.4;
constexpr std::size_t kFewestOnASheet = 6;
/// Of more than twice as many points so many are asked first whether they turn at all.
constexpr std::size_t kEnoughPoints = 160;
constexpr int kRounds = 6;
/// A point of one sheet that lies this part of the radius under the other one, beyond what noise
/// explains, is cut off by it; a crease that cuts off more than such a part of all its points, of
/// few not even one, is none: of lasts of 902 points with told normals a girth lay 4 mm beside the
/// nearest ones.
constexpr double kHidden = 0.05;
constexpr double kHiddenInSigmas = 2.0;
constexpr double kMostHidden = 0.05;
/// Points nearest to both sheets, round which the crease is looked for; and to their planes, among
/// which they are.
constexpr std::size_t kPointsAtCrease = 6;
constexpr std::size_t kCandidatesAtCrease = 48;

/// Which of the two sheets each point lies on.
using Sides = std::vector<std::uint8_t>;

/// The plane of the points on one side.
struct SheetPlane {
  Eigen::Vector3d middle = Eigen::Vector3d::Zero();
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();
  std::size_t count = 0;

  double height(const Eigen::Vector3d& place) const { return normal.dot(place - middle); }
};

/// The planes of the points on either side. One with too few points has no normal.
std::array<SheetPlane, 2> planes_of(const std::vector<OrientedPoint>& points, const Sides& sides) {
  const Eigen::Vector3d& origin = points.front().position;
  std::array<Moments, 2> moments;
  std::array<Eigen::Vector3d, 2> facing = {Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero()};
  for (std::size_t i = 0; i < points.size(); ++i) {
    moments[sides[i]].add(points[i].position - origin);
    facing[sides[i]] += points[i].normal;
  }
  std::array<SheetPlane, 2> planes;
  for (std::size_t side = 0; side < planes.size(); ++side) {
    SheetPlane& plane = planes[side];
    plane.count = static_cast<std::size_t>(moments[side].count);
    if (plane.count < kFewestOnASheet) continue;
    plane.middle = origin + moments[side].middle();
    plane.normal = moments[side].flattest();
    if (plane.normal.dot(facing[side]) < 0.0) plane.normal *= -1.0;
  }
  return planes;
}

/// The direction in which the normals differ most.
Eigen::Vector3d direction_of_bend(const std::vector<OrientedPoint>& points) {
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  for (const auto& point : points) mean += point.normal;
  mean /= static_cast<double>(points.size());
  Eigen::Matrix3d spread = Eigen::Matrix3d::Zero();
  for (const auto& point : points) {
    const Eigen::Vector3d arm = point.normal - mean;
    spread += arm * arm.transpose();
  }
  return Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(spread).eigenvectors().col(2);
}

/// Two clusters of the normals along that direction.
Sides split_by_normals(const std::vector<OrientedPoint>& points) {
  const Eigen::Vector3d across = direction_of_bend(points);
  std::vector<double> bends;
  for (const auto& point : points) bends.push_back(across.dot(point.normal));
  const auto [least, most] = std::minmax_element(bends.begin(), bends.end());
  double limit = 0.5 * (*least + *most);
  for (int round = 0; round < kRounds; ++round) {
    std::array<double, 2> sums{};
    std::array<double, 2> counts{};
    for (const double bend : bends) {
      sums[bend > limit] += bend;
      counts[bend > limit] += 1.0;
    }
    if (counts[0] == 0.0 || counts[1] == 0.0) break;
    limit = 0.5 * (sums[0] / counts[0] + sums[1] / counts[1]);
  }
  Sides sides;
  for (const double bend : bends) sides.push_back(bend > limit);
  return sides;
}

struct TwoSheets {
  std::array<SheetPlane, 2> planes;
  Sides sides;
  bool convex = true;

  double turn() const {
    return std::acos(std::clamp(planes[0].normal.dot(planes[1].normal), -1.0, 1.0));
  }
};

/// Gives each point to the sheet that faces as its told normal does, until nothing changes.
std::optional<TwoSheets> told_sheets(const std::vector<OrientedPoint>& points) {
  TwoSheets sheets;
  sheets.sides = split_by_normals(points);
  for (int round = 0; round < kRounds; ++round) {
    sheets.planes = {};
    for (std::size_t i = 0; i < points.size(); ++i) {
      SheetPlane& plane = sheets.planes[sheets.sides[i]];
      plane.middle += points[i].position;
      plane.normal += points[i].normal;
      ++plane.count;
    }
    auto& [first, second] = sheets.planes;
    if (std::min(first.count, second.count) < kFewestOnASheet) return std::nullopt;
    for (SheetPlane& plane : sheets.planes) {
      plane.middle /= static_cast<double>(plane.count);
      plane.normal.normalize();
    }
    if (sheets.turn() < kLeastToldTurn) return std::nullopt;
    const Sides before = sheets.sides;
    for (std::size_t i = 0; i < points.size(); ++i) {
      sheets.sides[i] = (second.normal - first.normal).dot(points[i].normal) > 0.0;
    }
    if (sheets.sides != before) continue;
    sheets.convex = second.height(first.middle) + first.height(second.middle) < 0.0;
    return sheets;
  }
  return std::nullopt;
}

/// Gives each point to the sheet that bounds the body there, until nothing changes. Nothing as soon
/// as the sheets hardly turn, as those of a smooth bend do from the first.
std::optional<TwoSheets> two_sheets(const std::vector<OrientedPoint>& points) {
  TwoSheets sheets;
  sheets.sides = split_by_normals(points);
  for (int round = 0; round < kRounds; ++round) {
    sheets.planes = planes_of(points, sheets.sides);
    const auto& [first, second] = sheets.planes;
    if (std::min(first.count, second.count) < kFewestOnASheet) return std::nullopt;
    if (sheets.turn() < kLeastTurn) return std::nullopt;
    sheets.convex = second.height(first.middle) + first.height(second.middle) < 0.0;
    const Sides before = sheets.sides;
    for (std::size_t i = 0; i < points.size(); ++i) {
      const double over_first = first.height(points[i].position);
      const double over_second = second.height(points[i].position);
      sheets.sides[i] = sheets.convex ? over_second > over_first : over_second < over_first;
    }
    if (sheets.sides == before) return sheets;
  }
  const auto on_second =
      static_cast<std::size_t>(std::count(sheets.sides.begin(), sheets.sides.end(), 1));
  if (std::min(on_second, points.size() - on_second) < kFewestOnASheet) return std::nullopt;
  return sheets;
}

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

/// A sheet as the quadratic that fits its points best.
class QuadraticSheet {
 public:
  QuadraticSheet(const std::vector<OrientedPoint>& points, const Eigen::Vector3d& outward,
                 const Eigen::Vector3d& centre, double radius)
      : base_(axes_over(outward), centre, radius),
        terms_(least_squares(samples_over(points, base_))) {}

  FieldValue at(const Eigen::Vector3d& position) const {
    const auto spot = base_.see(position);
    const double x = spot.place.x();
    const double y = spot.place.y();
    const double height = terms_[0] + x * (terms_[1] + x * terms_[3] + y * terms_[4]) +
                          y * (terms_[2] + y * terms_[5]);
    const Eigen::Vector2d slope(terms_[1] + 2.0 * x * terms_[3] + y * terms_[4],
                                terms_[2] + x * terms_[4] + 2.0 * y * terms_[5]);
    return {base_.radius() * (spot.height - height), base_.gradient(slope, spot)};
  }

 private:
  static Eigen::Matrix3d axes_over(const Eigen::Vector3d& outward) {
    Eigen::Matrix3d axes;
    axes.row(0) = outward.unitOrthogonal();
    axes.row(1) = outward.cross(axes.row(0));
    axes.row(2) = outward;
    return axes;
  }

  HeightBase base_;
  Quadratic terms_;
};

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
  places = least_high(places, kPointsAtCrease, [&](const Eigen::Vector3d& place) {
    return std::abs(first.at(place).value) + std::abs(second.at(place).value);
  });
  Eigen::Vector3d middle = Eigen::Vector3d::Zero();
  for (const auto& place : places) middle += place;
  return middle / static_cast<double>(places.size());
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

/// Points parted by the sheets that they lie on.
struct Parts {
  TwoSheets sheets;
  std::array<std::vector<OrientedPoint>, 2> points;
  std::array<std::vector<std::size_t>, 2> members;
};

/// Nothing if the sheets hardly turn where they meet, as quadratics tell it, or as is told.
std::optional<Parts> turning_parts(const std::vector<OrientedPoint>& points,
                                   const Eigen::Vector3d& centre, double radius) {
  const bool told = all_tell_normals(points);
  auto sheets = told ? told_sheets(points) : two_sheets(points);
  if (!sheets) return std::nullopt;
  Parts parts{std::move(*sheets), {}, {}};
  for (std::size_t i = 0; i < points.size(); ++i) {
    parts.points[parts.sheets.sides[i]].push_back(points[i]);
    parts.members[parts.sheets.sides[i]].push_back(i);
  }
  if (told) return parts;
  const auto& [one, other] = parts.sheets.planes;
  const Crease rough = crease_between(
      points, parts.sheets, QuadraticSheet(parts.points[0], one.normal, centre, radius),
      QuadraticSheet(parts.points[1], other.normal, centre, radius));
  if (rough.turn < kLeastTurnOfQuadratics) return std::nullopt;
  return parts;
}

std::vector<OrientedPoint> one_in(std::size_t stride, const std::vector<OrientedPoint>& points) {
  std::vector<OrientedPoint> some;
  for (std::size_t i = 0; i < points.size(); i += stride) some.push_back(points[i]);
  return some;
}

}  // namespace

CreasedPatch::CreasedPatch(Sheet first, Sheet second, bool convex)
    : first_(std::move(first)), second_(std::move(second)), convex_(convex) {}

std::optional<CreasedPatch> CreasedPatch::fit(const std::vector<OrientedPoint>& points,
                                              const Eigen::Vector3d& centre, double radius,
                                              double roughness) {
  if (points.size() < 2 * kFewestOnASheet) return std::nullopt;
  const std::size_t stride = points.size() / kEnoughPoints;
  if (stride > 1 && !turning_parts(one_in(stride, points), centre, radius)) return std::nullopt;
  auto turning = turning_parts(points, centre, radius);
  if (!turning) return std::nullopt;
  auto& [sheets, parts, members] = *turning;
  const auto& [one, other] = sheets.planes;
  auto first = HeightPatch::fit(parts[0], centre, one.normal, radius, roughness);
  if (!first) return std::nullopt;
  auto second = HeightPatch::fit(parts[1], centre, other.normal, radius, roughness);
  if (!second) return std::nullopt;
  const Crease crease = crease_between(points, sheets, *first, *second);
  CreasedPatch patch({std::move(*first), std::move(members[0])},
                     {std::move(*second), std::move(members[1])}, sheets.convex);
  if (patch.hides_points(points, radius)) return std::nullopt;
  patch.turn_ = crease.turn;
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
