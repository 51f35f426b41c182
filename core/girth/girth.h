#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "core/geometry/point_cloud.h"
#include "core/geometry/triangle_mesh.h"
#include "core/girth/tape_plane.h"
#include "core/result.h"

namespace instep {

/// What is known beforehand about a girth to be measured.
struct GirthOptions {
  /// Noise of a point along its normal. Without it the cloud's own sigma is used, and without that
  /// what the points near the plane show (core/surface/noise/noise_estimate.h).
  ///
  /// girth_by_rbf() and girth_by_mesh() believe what is told, by this or by the cloud, unless the
  /// points plainly scatter more, all of them or those of a part of the section: then they raise it
  /// to what these show and widen the interval, up to twice; a warning says so, but of noise as
  /// small as a scanner's rounding (3e-4 of the section's size). A third of the true noise would
  /// make a girth millimetres too long. They do not lower it, for noise that neighbours share does
  /// not show; too much of it at most widens the interval, but where points are few for the body
  /// smooths away what is skin (twice the true 0.5 mm over 1,500 points of a foot: three intervals
  /// in five hold), which a warning says from 1.2 % of the section on.
  std::optional<double> sigma_mm;
};

/// The gate through which the options of every girth pass: a noise above 0 and at most
/// kLargestSigmaMm, or kInvalidInput.
Result<void> check_options(const GirthOptions& options);

/// The length of a tape laid round a body in one plane, and how it came about.
struct Girth {
  /// Tape that bridges hollows: the perimeter of the section's convex hull.
  double stretched_mm = 0.0;
  /// Tape that follows the skin: the section's own perimeter.
  double contact_mm = 0.0;
  /// Half-widths of the 95 % intervals; nothing where a method has none.
  std::optional<double> stretched_u95_mm;
  std::optional<double> contact_u95_mm;

  std::size_t points = 0;  ///< points of the whole cloud
  /// Points near the plane that took part, and those of an exact crowd that would have told the
  /// same again. Of lines that are far apart those that were kept, or averages of them; of parts
  /// that were seen many times as densely as the rest those that were kept.
  std::size_t band_points = 0;
  /// Noise that was used: the usual one near the plane, or its mean; 0 by the methods that use
  /// none.
  double sigma_mm = 0.0;
  /// Longest stretch of the section without a seen point under it.
  double largest_gap_mm = 0.0;
  std::vector<std::string> warnings;

  /// The section as a closed polygon (the first point is not repeated), in the plane's own
  /// coordinates, counter-clockwise; fine enough to draw and to compare. girth_by_rbf()'s lengths
  /// differ from its by up to 0.1 %, by the waves that the points tell of but do not show.
  std::vector<Eigen::Vector2d> contour;
};

/// The best method of this project: a local RBF implicit surface where the plane passes (see
/// core/surface), its zero contour traced on the plane.
///
/// Refuses, with the reason, where no closed section can be told from the points: too few points
/// (kInsufficientData), a plane that misses the cloud or runs along its edge (kInvalidInput). A
/// hole is bridged by the surface and reported, as far as patches span it: up to a quarter of the
/// section, a slit along the body up to a tenth or so. Over a wider opening, as of a sole that no
/// camera saw, the tape is laid straight across, and the interval reaches to a body that is round
/// there, which a warning says (girth_over_opening()); where some two fifths are missing it is
/// refused. So is a closed section whose 95 % interval is wider than a tenth of it to each side, or
/// that of its contact length than a fifth, and an open one from 15 % on. Strays and loops
/// that far fewer points make are left out; of several loops the one that all three control points
/// lie on counts (control_points.h), or if none has them that round the largest area, and the
/// others are named in a warning. A crease such as a last's featherline stays sharp, and so does
/// the edge of a thin part down to some 15 degrees; how round a tip may be that no point shows is
/// in the interval. Of thin parts with noise, and of slots, many are refused.
///
/// Where nothing closes, or what does leaves much doubt or many points beside it, the bodies near
/// the plane are looked at alone (core/girth/band/bodies_apart.h), for a wall or a floor beside a
/// body takes part in its noise and its normals. The one that the control points lie on counts,
/// else that with the largest section, unless a larger one closes alone but leaves doubt; a warning
/// says so. It takes several times as long.
///
/// Normals that come with exact points too far apart to tell the skin between them count with their
/// slopes, where they agree with the points as right ones do; others only tell inside from outside,
/// and those that do not even do that, or with which the section does not close though without them
/// it does, are dropped with a warning (trust_in()). Where nothing is told of the noise it may
/// differ along the section, as where one side was seen at a grazing angle
/// (core/surface/noise/uneven_noise.h); a stretch of less than a seventh of the section is not told
/// apart, unless the points crowd and are exact elsewhere (core/surface/noise/scattered_places.h),
/// which is named in a warning, and the interval reaches as far as if it were two layers.
///
/// Where the points are noisy and the skin even, the lengths and their intervals are read off one
/// surface through far more points, laid along that contour (smooth_section()), unless the two
/// contradict each other; elsewhere the intervals are LengthDoubt's. Where a hole is reported they
/// are no narrower than both, and reach from one reading to the other. They take the noise of
/// points to be independent: what is common to neighbours, such as a bent depth map, is not in
/// them, but for the shared and local errors that the cloud tells of (shared_doubt_of()).
///
/// Points in two layers (core/girth/section/skin_layers.h), all round as of a skin and a sock or
/// over a good part of the section, are named in a warning, and the interval reaches both. Those of
/// cameras with wrong poses are where they lie plainly apart, by some five of their own deviations:
/// they do so as the cosine of the direction, and where views overlap only. Points that lead away
/// from the section though no skin through them was found (core/girth/section/unfollowed_skin.h),
/// as of a part too thin for them or of what touches the body, are named too, and the interval
/// reaches round them.
///
/// A section that turns to and fro within a few points (core/girth/contour/contour_zigzags.h), as
/// where it goes through a clump of strays that reaches the skin, or from one view to another one
/// that does not fit it, is named, and looked at again without the points that lie off the skin of
/// most. If it is the same, the skin is what turns, or folds or ribs too fine for the points. Else
/// its interval reaches straight across, or the points are left out, with a warning, where it is
/// surer so; the interval reaches what other points beside it say it may have lost. A fin or a rib
/// only a few points wide may be cut short with those that are left out.
///
/// A girth that leaves doubt is read once more with the plane's u and v turned (girth_of_all()):
/// its interval reaches that reading too, and where that one closes but is refused, so is it.
///
/// Intervals also know that noise may lie along normals or along a camera's rays, and that a noisy
/// cloud's edge beside the plane bends the skin (doubt_of_direction(), doubt_of_edge()).
///
/// Deterministic: the same cloud gives the same bytes each time and with any number of threads; on
/// processors of another kind the same to 1e-7 mm, for the C library rounds functions as each
/// computes them fastest; but of 1,920 girths of prisms, fins, slots and the like two differ, by
/// 0.004 and 0.05 mm, and of 122 of plates and wedges three did, by 0.001 to 0.3 mm, within a fifth
/// of their intervals.
Result<Girth> girth_by_rbf(const PointCloud& cloud, const TapePlane& plane,
                           const GirthOptions& options = {});

/// The paper's Method 3 as it is written (sections 3 to 5), for comparison: its octree of RBF
/// surfaces (see OctreeSurface), steps 1 to 8 and eq. 10, with all of their weaknesses. It goes
/// through noise instead of averaging it (10 mm too long for 0.5 mm), takes a hole for the spacing
/// of the points, and may be wrong by tens of millimetres where the points are few or uneven and
/// not know it. Its contact length joins the intersections of all rows of points in the order in
/// which they lie round the middle: right only where every ray from there meets the skin once, and
/// too long by all that neighbours differ.
///
/// What the paper leaves open is chosen in girth_by_paper.cpp. It has no interval, and a sigma that
/// is known changes nothing. Refuses with kInsufficientData where the surface is torn so that no
/// ring is left, or swells far beyond its points, or where the points crowd in a part of the ring,
/// with kInvalidInput where the plane misses the cloud or only touches it. Warns where the contact
/// length jumps to and fro between bodies, strays or noise.
Result<Girth> girth_by_paper(const PointCloud& cloud, const TapePlane& plane,
                             const GirthOptions& options = {});

/// The paper's Method 1 (section 2.1): the points near the plane, projected on it, and their convex
/// hull. Knows no skin, so contact equals stretched, with a warning; has no interval.
///
/// Goes round whatever lies at the plane: where points lie deep inside the hull (hollows, another
/// body, strays that stick out), where the skin leans or the points are few, so that a wider band
/// has a longer hull, and where more than a tenth of the hull has no points, a warning says so.
/// Refuses with kInvalidInput a plane that misses the cloud or only touches it, with
/// kInsufficientData points that form no ring, that crowd in a part of it, or that leave more than
/// a quarter of it open. O(n), m log m of the m points near the plane, and little memory beside the
/// cloud.
Result<Girth> girth_by_hull(const PointCloud& cloud, const TapePlane& plane,
                            const GirthOptions& options = {});

/// The paper's Method 2 (section 2.2): a triangle mesh grown from the points near the plane
/// (core/surface/mesh/grown_mesh.h) and cut with it. The points are the band of girth_by_rbf():
/// strays and duplicates gone, crowds averaged. The mesh neither needs nor uses normals; known ones
/// only keep the two sides of a thin part from being averaged.
///
/// Chords cut off what bulges between the points, so exact points give a girth that is too short,
/// by about the square of their spacing; noise roughens the mesh, so noisy points give one that is
/// too long, contact far more than stretched, with a warning. Holes up to a quarter of the tape are
/// bridged by a straight line and count in largest_gap_mm; what is more open is refused, as in
/// girth_by_rbf(). Has no interval. Deterministic.
Result<Girth> girth_by_mesh(const PointCloud& cloud, const TapePlane& plane,
                            const GirthOptions& options = {});

/// Cuts the faces that a mesh already has; no surface is fitted. All loops are chained; of several
/// the one counts that girth_by_rbf() would choose, and the others are named in a warning. An open
/// section is bridged for the stretched length, and the contact length is that of the pieces, with
/// a warning. What encloses no area is refused.
Result<Girth> girth_by_section(const TriangleMesh& mesh, const TapePlane& plane);

}  // namespace instep
