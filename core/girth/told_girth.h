#pragma once

#include <optional>

#include "core/geometry/point_cloud.h"
#include "core/girth/band/plane_band.h"
#include "core/girth/contour/contour_zigzags.h"
#include "core/girth/girth.h"
#include "core/girth/section/section_evidence.h"
#include "core/girth/section/smooth_section.h"
#include "core/girth/section/unfollowed_skin.h"
#include "core/girth/tape_plane.h"
#include "core/result.h"
#include "core/surface/patches/blended_surface.h"

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

/// What the patches of a surface tell of a contour on it (doubt_of()), whose points are `sigma`
/// off.
MeasuredSection section_by_patches(const Contour& contour, const BlendedSurface& surface,
                                   double sigma);

/// What a section of that band tells, in millimetres and on the plane; without the number of the
/// cloud's points, and without warnings.
Girth girth_of(const PlaneBand& band, const MeasuredSection& section,
               const SectionEvidence& evidence);

/// Whether the intervals of a girth that has both leave nothing to be told.
bool is_too_doubtful(const Girth& girth);

/// Leaves nothing of a girth but its course.
void refuse(Error why, ToldGirth& told);

/// Adds to both intervals, mm; `why` it is not to be told if too little is known of it then.
void widen(double contact, double stretched, const tl::unexpected<Error>& why, ToldGirth& told);

bool is_told(const Result<ToldGirth>& girth);

/// The girth of a cloud that passed check_cloud(), all points near the plane taken together, as the
/// plane's u and v let a surface through them run; see girth_of_all().
Result<ToldGirth> girth_in_frame(const PointCloud& cloud, const TapePlane& plane,
                                 const GirthOptions& options);

}  // namespace instep
