#include "core/foot/landmarks/midfoot_points.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <vector>

#include "core/foot/skin/robust_extreme.h"
#include "core/foot/skin/skin_round.h"
#include "core/geometry/quadratic_skin.h"
#include "core/girth/rough_tape.h"
#include "core/girth/tape_plane.h"

namespace instep {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double kInstepShare = 0.50;
constexpr double kRidgeHalfWidthMm = 8.0;
constexpr double kRidgeSlabMm = 3.0;
constexpr std::size_t kFewestRidgePoints = 12;
constexpr double kSteepestRidge = 0.5;  ///< across; on whole feet it is level, by how it is found

constexpr double kArchFrom = 0.35;
constexpr double kArchTo = 0.60;
constexpr double kArchPrior = 0.48;
/// Between tapes, which take points 4 mm to either side.
constexpr double kArchStep = 0.01;
constexpr double kArchWindow = 0.08;
constexpr std::size_t kFewestTapes = 5;

std::vector<Vector3d> near_place(const std::vector<Vector3d>& points, double place, double width) {
  std::vector<Vector3d> slab;
  for (const auto& point : points) {
    if (std::abs(point.x() - place) <= width) slab.push_back(point);
  }
  return slab;
}

/// The back where it is highest near a place.
struct Ridge {
  Vector3d place;
  double slope = 0.0;  ///< across; none but where it rises on
};

/// Of the back near (place, y), by a plane in x and a quadratic in y through points near by.
std::optional<Ridge> ridge(const std::vector<Vector3d>& points, double place, double y) {
  std::vector<Vector3d> close;
  double highest = -1e300;
  for (const auto& point : near_place(points, place, kRidgeHalfWidthMm)) {
    if (std::abs(point.y() - y) > 2.0 * kRidgeHalfWidthMm) continue;
    close.push_back(point);
    highest = std::max(highest, point.z());
  }
  // The sole lies under the same place.
  std::erase_if(close, [&](const Vector3d& point) { return point.z() < 0.6 * highest; });
  if (close.size() < kFewestRidgePoints) return std::nullopt;
  Eigen::MatrixXd matrix(static_cast<Eigen::Index>(close.size()), 5);
  Eigen::VectorXd height(static_cast<Eigen::Index>(close.size()));
  for (std::size_t i = 0; i < close.size(); ++i) {
    const double a = close[i].x() - place;
    const double b = close[i].y() - y;
    const auto row = static_cast<Eigen::Index>(i);
    matrix.row(row) << 1.0, a, b, a * b, b * b;
    height(row) = close[i].z();
  }
  const Eigen::VectorXd fitted = matrix.colPivHouseholderQr().solve(height);
  const double aside = fitted(4) < 0.0 ? -fitted(2) / (2.0 * fitted(4)) : 0.0;
  const double step = std::clamp(aside, -kRidgeHalfWidthMm, kRidgeHalfWidthMm);
  return Ridge{{place, y + step, fitted(0) + step * (fitted(2) + step * fitted(4))},
               fitted(2) + 2.0 * step * fitted(4)};
}

/// Where the cubic through (place, length) pairs is lowest, if it is so inside their range.
std::optional<double> lowest_place(const std::vector<Vector2d>& lengths) {
  if (lengths.size() < kFewestTapes) return std::nullopt;
  const double middle = (lengths.front().x() + lengths.back().x()) / 2.0;
  const double half = (lengths.back().x() - lengths.front().x()) / 2.0;
  Eigen::MatrixXd matrix(static_cast<Eigen::Index>(lengths.size()), 4);
  Eigen::VectorXd right(static_cast<Eigen::Index>(lengths.size()));
  for (std::size_t i = 0; i < lengths.size(); ++i) {
    const double t = (lengths[i].x() - middle) / half;
    matrix.row(static_cast<Eigen::Index>(i)) << 1.0, t, t * t, t * t * t;
    right(static_cast<Eigen::Index>(i)) = lengths[i].y();
  }
  const Eigen::VectorXd fitted = matrix.colPivHouseholderQr().solve(right);
  // Of the two places where it is level, the one where it bends upwards.
  const double square = fitted(2) * fitted(2) - 3.0 * fitted(1) * fitted(3);
  if (!(square > 0.0)) return std::nullopt;
  const double divisor = fitted(2) + std::sqrt(square);
  if (!(divisor > std::abs(fitted(1)))) return std::nullopt;
  return middle - fitted(1) / divisor * half;
}

/// By the places near the shortest length, for where the plane comes to the leg the tape jumps; by
/// a cubic, for towards the heel the tape grows faster than towards the ball, so that a parabola's
/// lowest place is a millimetre nearer to the heel than the shortest tape.
std::optional<double> lowest_near(const std::vector<Vector2d>& lengths, double window) {
  if (lengths.empty()) return std::nullopt;
  const auto through_those_near = [&](double place) {
    std::vector<Vector2d> close;
    for (const auto& length : lengths) {
      if (std::abs(length.x() - place) <= window) close.push_back(length);
    }
    return lowest_place(close);
  };
  const auto shortest =
      std::min_element(lengths.begin(), lengths.end(),
                       [](const Vector2d& a, const Vector2d& b) { return a.y() < b.y(); });
  const auto rough = through_those_near(shortest->x());
  if (!rough) return std::nullopt;
  // Once more, with as many places to either side.
  const auto fine = through_those_near(*rough);
  return fine ? fine : rough;
}

}  // namespace

Vector3d on_floor(const Vector3d& point) {
  return {point.x(), point.y(), 0.0};
}

std::optional<Landmark> find_instep_point(const FootOutline& outline) {
  const double place = kInstepShare * outline.length_mm();
  const auto slab = near_place(outline.points(), place, kRidgeSlabMm);
  if (slab.empty()) return std::nullopt;
  const Vector3d top = robust_extreme(slab, Vector3d::UnitZ());
  const auto fitted = ridge(outline.points(), place, top.y());
  // Beside a hole in the back its side is highest.
  if (fitted && std::abs(fitted->slope) > kSteepestRidge) return std::nullopt;
  const Landmark instep =
      fitted
          ? Landmark{fitted->place, 0.8, "ridge of the foot's back at 0.50 of the foot's length"}
          : Landmark{{place, top.y(), top.z()}, 0.5, "highest point at 0.50 of the foot's length"};
  if (!is_skin_all_round(outline.points(), instep.position_mm, Vector3d::UnitZ())) {
    return std::nullopt;
  }
  return instep;
}

std::optional<Landmark> find_lateral_midfoot(const FootOutline& outline, const Landmark& instep) {
  const Vector2d target = instep.position_mm.head<2>();
  std::optional<Vector3d> nearest;
  for (double share = 0.25; share <= 0.45 + 1e-9; share += 0.005) {
    const auto place = outline.lateral().at(share * outline.length_mm());
    if (!place) continue;
    const Vector3d point = outline.lateral().position(*place);
    const auto distance = [&](const Vector3d& at) { return (at.head<2>() - target).norm(); };
    if (!nearest || distance(point) < distance(*nearest)) nearest = point;
  }
  if (!nearest || !is_skin_all_round(outline.points(), *nearest, -Vector3d::UnitY())) {
    return std::nullopt;
  }
  return Landmark{*nearest, 0.8,
                  "lateral outline in 0.25-0.45 of the foot's length nearest the instep"};
}

std::optional<Landmark> find_medial_arch(const FootOutline& outline, const Landmark& instep,
                                         const Landmark& lateral) {
  const auto midfoot =
      near_place(outline.points(), 0.45 * outline.length_mm(), 0.25 * outline.length_mm());
  // Where the medial side was not seen, what is left of a section ends on the lateral one.
  const auto medial_at = [&](double along) {
    const auto place = outline.medial().at(along);
    const bool is_seen =
        place && place->reach > instep.position_mm.y() &&
        is_skin_all_round(midfoot, outline.medial().position(*place), Vector3d::UnitY());
    return is_seen ? place : std::nullopt;
  };
  std::vector<Vector2d> lengths;
  for (double share = kArchFrom; share <= kArchTo + 1e-9; share += kArchStep) {
    const auto place = medial_at(share * outline.length_mm());
    if (!place) continue;
    const auto plane = TapePlane::through(instep.position_mm, on_floor(lateral.position_mm),
                                          on_floor(outline.medial().position(*place)));
    if (!plane) continue;
    if (const auto tape = rough_tape(midfoot, *plane)) {
      lengths.emplace_back(place->along, *tape);
    }
  }
  const auto lowest = lowest_near(lengths, kArchWindow * outline.length_mm());
  const auto place = medial_at(lowest.value_or(kArchPrior * outline.length_mm()));
  if (!place) return std::nullopt;
  const Vector3d point = outline.medial().position(*place);
  return lowest ? Landmark{point, 0.7,
                           "medial outline in 0.35-0.60 of the foot's length where the instep "
                           "tape is shortest"}
                : Landmark{point, 0.3, "no shortest tape: outline at 0.48 of the foot's length"};
}

std::optional<Landmark> find_arch_point(const FootOutline& outline) {
  constexpr double kInwards = 0.25;
  constexpr double kRadiusMm = 8.0;
  constexpr double kUndersideShare = 0.12;
  constexpr std::size_t kFewest = 12;
  constexpr double kMostAside = 0.35;
  const double length = outline.length_mm();
  std::vector<Vector3d> underside;
  for (const auto& point : outline.points()) {
    const bool is_near =
        point.x() > kArchFrom * length - kRadiusMm && point.x() < kArchTo * length + kRadiusMm;
    if (is_near && point.z() < kUndersideShare * length) underside.push_back(point);
  }
  std::optional<Vector3d> highest;
  for (double share = kArchFrom; share <= kArchTo + 1e-9; share += kArchStep) {
    const auto inner = outline.medial().reach(share * length);
    const auto outer = outline.lateral().reach(share * length);
    if (!inner || !outer) continue;
    const Vector3d place(share * length, *inner - kInwards * (*inner + *outer), 0.0);
    SkinPatch patch;
    Vector2d middle = Vector2d::Zero();
    for (const auto& point : underside) {
      const Vector3d offset = point - place;
      if (offset.head<2>().squaredNorm() > kRadiusMm * kRadiusMm) continue;
      patch.push_back(offset);
      middle += offset.head<2>();
    }
    // Skin on one side only is the wall beside an underside that was not seen.
    const bool is_round =
        middle.norm() < kMostAside * kRadiusMm * static_cast<double>(patch.size());
    if (patch.size() < kFewest || !is_round) continue;
    const auto skin = QuadraticSkin::through(patch);
    if (!skin) continue;
    const double height = skin->at(0.0, 0.0);
    if (!highest || height > highest->z()) highest = place + height * Vector3d::UnitZ();
  }
  if (!highest) return std::nullopt;
  return Landmark{*highest, 0.7,
                  "highest place of the underside a quarter of the breadth from the medial border"};
}

}  // namespace instep
