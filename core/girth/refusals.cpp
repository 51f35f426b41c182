#include "core/girth/refusals.h"

#include <cstdio>
#include <string>

#include "core/girth/section/section_evidence.h"
#include "core/girth/section/unseen_side.h"

namespace instep {
namespace {

/// A side (radians) on which no point lies, from the middle of them all, that keeps a section open.
constexpr double kNotableSide = 0.5;

}  // namespace

tl::unexpected<Error> too_few_near_plane() {
  return fail(ErrorCode::kInvalidInput, "too few points lie near the tape plane",
              "give control points on the body, or a denser cloud");
}

tl::unexpected<Error> only_touched() {
  return fail(ErrorCode::kInvalidInput, "the tape plane only touches the body",
              "give control points that cut the body");
}

tl::unexpected<Error> no_surface() {
  return fail(ErrorCode::kInsufficientData, "the points near the tape plane form no surface",
              "give control points that cut the body, or scan again");
}

tl::unexpected<Error> does_not_close(const PlaneBand& band) {
  const std::string what = "the section at the tape plane does not close";
  const UnseenSide side = widest_unseen_side(band);
  // From the middle of a thin body neighbours beside it lie at far different angles.
  if (side.angle < kNotableSide || side.across < evidence_reach(band)) {
    return fail(ErrorCode::kInsufficientData, what + ", though there are points all round it",
                "take away strays, a floor or what else touches the body, or scan from nearer");
  }
  char figure[32];
  std::snprintf(figure, sizeof figure, "%.0f mm", band.unit_mm * side.across);
  return fail(ErrorCode::kInsufficientData,
              what + ": there are no points over some " + figure + " of it",
              "scan the body from there too");
}

}  // namespace instep
