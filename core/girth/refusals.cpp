#include "core/girth/refusals.h"

namespace instep {

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

}  // namespace instep
