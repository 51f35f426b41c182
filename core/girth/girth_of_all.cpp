#include "core/girth/girth_of_all.h"

#include <Eigen/Geometry>
#include <cmath>
#include <utility>

#include "core/girth/girth_in_frame.h"

namespace instep {
namespace {

/// From one frame to the other (radians): by no part of a right angle, as bodies and lines of
/// points are often laid.
constexpr double kTurn = 0.7;

/// A plain girth that one even skin contradicts, or the one in another frame if that agrees with
/// such a skin there. Waves that are there contradict it in both; a patch that noise has folded is
/// none in the other.
ToldGirth surer_of(ToldGirth told, const PointCloud& cloud, const TapePlane& plane,
                   const GirthOptions& options) {
  auto other = girth_in_frame(cloud, plane.turned(kTurn), options);
  const bool is_surer = is_told(other) && other->is_plain() && !other->is_contradicted &&
                        other->doubt() < told.doubt();
  if (is_surer) {
    const Eigen::Rotation2Dd back(kTurn);
    for (auto& point : other->girth.contour) point = back * point;
    return std::move(*other);
  }
  return told;
}

}  // namespace

/// Of 2,000 drawn girths 169 are read again; of 16 the readings lie further apart than an interval.
/// Of 600 boxes above strips of floor 152 were told without, 16 of them outside of their intervals,
/// and 137 and 10 are.
Result<ToldGirth> girth_of_all(const PointCloud& cloud, const TapePlane& plane,
                               const GirthOptions& options) {
  auto told = girth_in_frame(cloud, plane, options);
  if (!is_told(told)) return told;
  if (told->is_plain()) {
    return told->is_contradicted ? surer_of(std::move(*told), cloud, plane, options) : told;
  }
  auto other = girth_in_frame(cloud, plane.turned(kTurn), options);
  if (!other) return told;
  if (other->refusal) {
    refuse(std::move(*other->refusal), *told);
    return told;
  }
  widen(std::abs(told->girth.contact_mm - other->girth.contact_mm),
        std::abs(told->girth.stretched_mm - other->girth.stretched_mm),
        fail(ErrorCode::kInsufficientData,
             "the points at the tape plane let a section run in more ways than one",
             "take away what touches the body there, or scan from nearer"),
        *told);
  return told;
}

}  // namespace instep
