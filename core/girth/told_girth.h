#pragma once

#include <optional>

#include "core/girth/contour/contour_zigzags.h"
#include "core/girth/girth.h"
#include "core/girth/section/unfollowed_skin.h"
#include "core/result.h"

namespace instep {

/// A girth, and what speaks against it.
struct ToldGirth {
  Girth girth;
  /// Why it is not to be told, though the section closes: then it has a contour alone.
  std::optional<Error> refusal;
  bool of_few = false;            ///< most of the points near the plane lie on no loop
  bool strays_near_skin = false;  ///< many of its patches left some out
  Zigzags zigzags;                ///< mm; of the contact length without what folds add
  UnfollowedSkin skin;            ///< mm; the lengths with those of near loops and narrow parts
  bool is_bridged = false;        ///< over a stretch without seen points
  bool has_layers = false;        ///< of skin, or of skin and sock
  bool is_smaller = false;        ///< another loop is larger, but does not go by the control points
  bool is_contradicted = false;   ///< by one even skin through more points
  /// Of the points near the plane more than a fiftieth lies on no loop, or leads away from one.
  bool has_others_beside = false;

  /// Half of both intervals, mm. Of one that is told.
  double doubt() const;
  /// That the section encloses, mm^2.
  double area() const;
  /// Uncertain, of few, or so winding that noise may have folded it.
  bool is_doubtful() const;
  /// A section that closes over seen points, all of them, with little doubt.
  bool is_plain() const;
};

/// Half of a 95 % interval that leaves nothing to be told, against the stretched length.
inline constexpr double kMostDoubt = 0.1;
/// The same of the contact length: with so many folds it may be no section at all. A hull of one
/// was 63 mm short.
inline constexpr double kMostFolded = 0.2;

/// Whether the intervals of a girth that has both leave nothing to be told.
bool is_too_doubtful(const Girth& girth);

/// Leaves nothing of a girth but its course.
void refuse(Error why, ToldGirth& told);

/// Adds to both intervals, mm; `why` it is not to be told if too little is known of it then.
void widen(double contact, double stretched, const tl::unexpected<Error>& why, ToldGirth& told);

bool is_told(const Result<ToldGirth>& girth);

/// Of a section that zigzags, by all that these add, where they may be made by strays.
void widen_by_zigzags(ToldGirth& told);

/// By what a section may have lost with some points: a part of the body that others of them are of
/// still, or skin that led away from it before.
void widen_by_lost_parts(const ToldGirth& before, ToldGirth& told);

/// Whether a section that zigzags has about the same lengths without some points: then the skin is
/// what turns to and fro.
bool is_unchanged(const ToldGirth& zigzagging, const ToldGirth& other);

/// Whether a section that zigzags may have taken in what lies beside its body, as a strip of floor
/// that it stands on, rather than be of a body that turns so.
bool may_have_taken_in(const ToldGirth& told);

}  // namespace instep
