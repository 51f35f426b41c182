#include "core/girth/girth_in_frame.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "core/geometry/polygon.h"
#include "core/girth/band/plane_band.h"
#include "core/girth/band/section_probe.h"
#include "core/girth/contour/contour.h"
#include "core/girth/contour/control_points.h"
#include "core/girth/contour/section_gaps.h"
#include "core/girth/doubt/length_doubt.h"
#include "core/girth/section/section_evidence.h"
#include "core/girth/section/section_loops.h"
#include "core/girth/section/section_neck.h"
#include "core/girth/section/section_unknowns.h"
#include "core/girth/section/section_warnings.h"
#include "core/girth/section/smooth_section.h"
#include "core/girth/section/unseen_side.h"
#include "core/in_millimetres.h"
#include "core/surface/patches/blended_surface.h"

namespace instep {
namespace {

/// What one even skin misses, against the interval that it has without: of less, as rings of exact
/// points seem to have, it tells the section still better than patches.
constexpr double kMuchMissed = 0.5;
/// Pieces that a chord is told in, so that the contour looks round.
constexpr int kPiecesOfChord = 8;
/// A share of the points near the plane, off all loops, with which the loops may not be what was
/// scanned: of lines as thick with noise as they are near, a loop of a few millimetres between two
/// of them passed for the section. A wall beside a body is as much.
constexpr double kMostUnexplained = 0.67;
/// The same of those that may be of a larger body: as dense as this one, it has more than half.
constexpr double kOfALargerOne = 0.3;
/// A share of the patches that left out strays, with which these are looked for beforehand. Of
/// 8,363 girths of bodies without strays one has more, of cylinders with 5 % of their points some 5
/// mm off all do.
constexpr double kManyWithStrays = 0.4;
constexpr const char* kStraysLeftOutWarning =
    "points through which the section would turn to and fro were left out: see to what shines, "
    "moves or touches the body there";

/// Two readings of one section whose intervals do not even meet: one of them is wrong.
bool contradict(const MeasuredSection& one, const MeasuredSection& other) {
  return std::abs(one.contact - other.contact) > one.contact_u95 + other.contact_u95 ||
         std::abs(one.stretched - other.stretched) > one.stretched_u95 + other.stretched_u95;
}

/// What one even skin misses, less what patches follow of it.
MissedLength left_missed(const MeasuredSection& smooth, const MeasuredSection& patches) {
  return {std::max(smooth.missed.contact - (patches.contact - smooth.contact), 0.0),
          std::max(smooth.missed.stretched - (patches.stretched - smooth.stretched), 0.0)};
}

/// The section as one even skin where it is that, else as its patches tell it: they see a narrow
/// collar, which the polynomial across a ribbon levels, and follow some of the waves that it does
/// not. How far the skin may wander where nobody looked is known of the patches alone; but these,
/// of some tens of points, tell worse where it lies there, so that two readings that contradict
/// each other are no reason to believe them.
MeasuredSection measured(SlabSource& slabs, const PlaneBand& band,
                         const std::vector<SectionLoop>& loops, const BlendedSurface& surface,
                         const SectionEvidence& evidence) {
  const Contour& contour = loops.front().contour;
  MeasuredSection patches = section_by_patches(contour, surface, band.sigma);
  if (loops.size() > 1) return patches;
  const bool is_bridged = has_notable_gap(band, evidence);
  auto smooth = smooth_section(slabs, band, contour, is_bridged);
  if (!smooth) return patches;
  if (smooth->missed.stretched > kMuchMissed * smooth->stretched_u95) {
    patches.missed = left_missed(*smooth, patches);
    return patches;
  }
  if (is_bridged) {
    smooth->contact_u95 = std::max(
        {smooth->contact_u95, patches.contact_u95, std::abs(smooth->contact - patches.contact)});
    smooth->stretched_u95 = std::max({smooth->stretched_u95, patches.stretched_u95,
                                      std::abs(smooth->stretched - patches.stretched)});
  } else if (contradict(*smooth, patches)) {
    patches.is_contradicted = true;
    return patches;
  }
  return *smooth;
}

/// Two bodies pressed together look like one with a waist, where no camera sees between them.
std::string waist_warning(double width_mm) {
  return "the section has a waist of " + in_millimetres(width_mm) +
         " between two wide parts: if these are two bodies, give the points of one alone";
}

/// A section that closes but is not to be told: nothing but its course.
ToldGirth refused(const PlaneBand& band, const Contour& contour, tl::unexpected<Error> why) {
  ToldGirth told;
  for (const auto& point : contour.points) told.girth.contour.push_back(band.to_plane(point));
  told.refusal = std::move(why).value();
  return told;
}

/// For normals that let no section close, as those of which one stretch points inwards.
Result<ToldGirth> girth_without_normals(PointCloud cloud, const TapePlane& plane,
                                        const GirthOptions& options) {
  cloud.drop_normals();
  auto told = girth_in_frame(cloud, plane, options);
  if (told) {
    told->zigzags = {};  // that was looked at
    told->girth.warnings.emplace_back(
        "the section closes only without the normals that came with the points, which were not "
        "used: have them made anew, or leave them out of the file");
  }
  return told;
}

/// For a cloud in which no section closes.
Result<ToldGirth> girth_without_loops(const PlaneBand& band, const PointCloud& cloud,
                                      const TapePlane& plane, const GirthOptions& options) {
  if (cloud.has_normals() && !band.normals_dropped) {
    auto told = girth_without_normals(cloud, plane, options);
    if (is_told(told)) return told;
  }
  return does_not_close(band);
}

/// In millimetres.
void note_unsure_parts(const PlaneBand& band, const SectionUnknowns& unknowns, ToldGirth& told) {
  told.zigzags = {band.unit_mm * unknowns.zigzags.way,
                  band.unit_mm * std::max(unknowns.zigzags.contact - unknowns.folds, 0.0),
                  band.unit_mm * unknowns.zigzags.stretched};
  const auto& skin = unknowns.skin;
  const auto& beside = unknowns.beside;
  const auto& narrow = unknowns.narrow;
  told.skin = {skin.points, band.unit_mm * skin.off,
               band.unit_mm * (skin.contact + beside.contact + narrow.contact),
               band.unit_mm * (skin.stretched + beside.stretched + narrow.stretched)};
}

Result<void> check_whole(const std::vector<SectionLoop>& loops, const SectionEvidence& evidence) {
  if (!(evidence.gap > kWidestBridge * loops.front().contour.length())) return {};
  return fail(ErrorCode::kInsufficientData,
              "more than a quarter of the section at the tape plane has no points",
              "scan the body all round");
}

/// Whether the first of the loops goes round one body, and that the largest.
Result<void> check_one_body(const PlaneBand& band, const std::vector<SectionLoop>& loops,
                            const std::optional<SectionNeck>& neck, double unexplained) {
  if (neck && may_be_two_bodies(band, *neck)) {
    return fail(ErrorCode::kInvalidInput,
                "the section at the tape plane is pinched between two parts, as where two bodies "
                "touch: nothing tells whether the tape goes round both",
                "move them apart and scan again, or give the points of one alone");
  }
  if (unexplained > kOfALargerOne && has_larger_beside(band, loops)) {
    return fail(ErrorCode::kInvalidInput,
                "beside what closes at the tape plane lies something larger that does not",
                "take it away, or move it apart, and scan again");
  }
  return {};
}

/// Of several loops the one that goes by the control points.
void put_pointed_first(const PlaneBand& band, const TapePlane& plane,
                       std::vector<SectionLoop>& loops) {
  if (loops.size() < 2) return;
  std::stable_partition(loops.begin(), loops.end(), [&](const SectionLoop& loop) {
    auto corners = loop.contour.points;
    for (auto& corner : corners) corner = band.to_plane(corner);
    return goes_by_control_points(corners, plane);
  });
}

bool is_smaller_than_another(const std::vector<SectionLoop>& loops) {
  const double area = signed_area(loops.front().contour.points);
  return std::any_of(loops.begin() + 1, loops.end(), [&](const SectionLoop& loop) {
    return signed_area(loop.contour.points) > area;
  });
}

/// Of the first of the loops, if so much is known of it.
ToldGirth girth_along(const std::vector<SectionLoop>& loops, const BlendedSurface& surface,
                      const PlaneBand& band, SlabSource& slabs) {
  const Contour& contour = loops.front().contour;
  const auto evidence = evidence_for(band, loops.front().index, evidence_reach(band));
  const auto neck = SectionNeck::of(contour);
  const double unexplained = unexplained_share(band, loops, evidence);
  if (auto whole = check_whole(loops, evidence); !whole) {
    return refused(band, contour, tl::make_unexpected(whole.error()));
  }
  if (auto one = check_one_body(band, loops, neck, unexplained); !one) {
    return refused(band, contour, tl::make_unexpected(one.error()));
  }
  auto section = measured(slabs, band, loops, surface, evidence);
  const SectionUnknowns unknowns =
      unknowns_of(band, slabs.cloud(), loops, surface, evidence, section);
  widen(band, unknowns, section);
  ToldGirth told;
  if (!(section.stretched_u95 <= kMostDoubt * section.stretched)) {
    told = refused(band, contour, too_doubtful(unknowns, section));
  } else if (!(section.contact_u95 <= kMostFolded * section.contact)) {
    told = refused(band, contour, too_folded(unknowns, section));
  }
  note_unsure_parts(band, unknowns, told);
  if (told.refusal) return told;

  told.girth = girth_of(band, section, evidence);
  told.girth.points = slabs.cloud().size();
  told.strays_near_skin = surface.share_with_strays() > kManyWithStrays;
  told.is_bridged = has_notable_gap(band, evidence);
  told.is_contradicted = section.is_contradicted;
  told.has_layers = unknowns.layers && unknowns.layers->are_all_round;
  told.has_others_beside =
      unknowns.skin.is_any() || unknowns.beside.contact > 0.0 || unexplained > kNotableUnexplained;
  told.of_few = unexplained > kMostUnexplained;
  told.girth.warnings = warnings_of(band, loops, evidence, unexplained, unknowns, section);
  if (neck) told.girth.warnings.push_back(waist_warning(band.unit_mm * neck->width));
  return told;
}

/// Of slabs that are thinned already, or are here if their points ask for it.
Result<ToldGirth> girth_at(SlabSource& slabs, const GirthOptions& options,
                           bool strays_near_skin = false) {
  auto band = band_at(slabs, strays_near_skin);
  if (!band) return tl::make_unexpected(band.error());
  // The index goes with the surface; the band keeps the points.
  BlendedSurface surface(PatchFitter(band->points, std::move(band->index), band->roughness));
  auto loops = loops_on(*band, surface);
  if (loops.empty()) return girth_without_loops(*band, slabs.cloud(), slabs.plane(), options);
  put_pointed_first(*band, slabs.plane(), loops);
  ToldGirth told = girth_along(loops, surface, *band, slabs);
  told.is_smaller = is_smaller_than_another(loops);
  return told;
}

bool is_surer(const ToldGirth& one, const ToldGirth& other) {
  return one.of_few != other.of_few ? other.of_few : one.doubt() < other.doubt();
}

/// Of a section that zigzags, without the points off its skin where it is the surer one then.
/// Nothing speaks for strays where no section is told without these, or the same one.
ToldGirth girth_without_zigzags(ToldGirth told, SlabSource& slabs, const GirthOptions& options) {
  auto cleaned = girth_at(slabs, options, true);
  if (!is_told(cleaned) || is_unchanged(told, *cleaned)) {
    if (may_have_taken_in(told)) widen_by_zigzags(told);
    return told;
  }
  widen_by_lost_parts(told, *cleaned);
  widen_by_zigzags(*cleaned);
  widen_by_zigzags(told);
  if (cleaned->refusal || (!told.refusal && !is_surer(*cleaned, told))) return told;
  if (!(cleaned->zigzags.way > 0.0)) cleaned->girth.warnings.emplace_back(kStraysLeftOutWarning);
  return std::move(*cleaned);
}

}  // namespace

MeasuredSection section_by_patches(const Contour& contour, const BlendedSurface& surface,
                                   double sigma) {
  const LengthDoubt doubt = doubt_of(contour, surface, sigma);
  return {contour,
          contour.length() + doubt.waves,
          contour.tape_length() + doubt.waves,
          doubt.contact_u95,
          doubt.stretched_u95,
          {},
          false};
}

Girth girth_of(const PlaneBand& band, const MeasuredSection& section,
               const SectionEvidence& evidence) {
  Girth girth;
  girth.contact_mm = band.unit_mm * section.contact;
  for (const auto& point : section.contour.refined(kPiecesOfChord))
    girth.contour.push_back(band.to_plane(point));
  girth.stretched_mm = band.unit_mm * section.stretched;
  girth.stretched_u95_mm = band.unit_mm * section.stretched_u95;
  girth.contact_u95_mm = band.unit_mm * section.contact_u95;
  girth.band_points = band.points_taken();
  girth.sigma_mm = band.noise_mm();
  girth.largest_gap_mm = band.unit_mm * evidence.seen_gap;
  return girth;
}

Result<ToldGirth> girth_in_frame(const PointCloud& cloud, const TapePlane& plane,
                                 const GirthOptions& options) {
  SlabSource slabs(cloud, plane, options.sigma_mm);
  auto told = girth_at(slabs, options);
  // What patches leave out has spoilt the noise and the normals that their points show.
  const bool strays_near_skin = told && told->strays_near_skin;
  if (strays_near_skin) {
    auto cleaned = girth_at(slabs, options, strays_near_skin);
    if (is_told(cleaned) && !cleaned->of_few) told = std::move(cleaned);
    widen_by_zigzags(*told);
  } else if (told && told->zigzags.way > 0.0) {
    told = girth_without_zigzags(std::move(*told), slabs, options);
  }
  // The nearest points of a line that noise makes thick all lie on a sheet across the skin, and
  // seem exact.
  if ((!told || told->is_doubtful()) && thin_thick_lines(slabs)) {
    auto thinned = girth_at(slabs, options, strays_near_skin);
    if (thinned) widen_by_zigzags(*thinned);
    if (is_told(thinned) && (!is_told(told) || is_surer(*thinned, *told)))
      told = std::move(thinned);
  }
  return told;
}

}  // namespace instep
