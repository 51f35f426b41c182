#include "core/girth/told_girth.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "core/geometry/polygon.h"
#include "core/girth/contour.h"
#include "core/girth/length_doubt.h"
#include "core/girth/plane_band.h"
#include "core/girth/refusals.h"
#include "core/girth/section_evidence.h"
#include "core/girth/section_gaps.h"
#include "core/girth/section_loops.h"
#include "core/girth/section_probe.h"
#include "core/girth/section_unknowns.h"
#include "core/girth/section_warnings.h"
#include "core/girth/smooth_section.h"
#include "core/surface/blended_surface.h"

namespace instep {
namespace {

/// Pieces that a chord is told in, so that the contour looks round.
constexpr int kPiecesOfChord = 8;
/// Half of a 95 % interval that leaves nothing to be told, against the length.
constexpr double kMostDoubt = 0.1;
/// The same of the contact length: with so many folds it may be no section at all. A hull of one
/// was 63 mm short.
constexpr double kMostFolded = 0.2;
/// Contact against stretched length of a section that winds more than most bodies do.
constexpr double kWinding = 1.05;
/// A share of the points near the plane, off all loops, with which the loops may not be what was
/// scanned: of lines as thick with noise as they are near, a loop of a few millimetres between two
/// of them passed for the section. A wall beside a body is as much.
constexpr double kMostUnexplained = 0.67;
/// A share of the patches that left out strays, with which these are looked for beforehand. Of
/// 8,363 girths of bodies without strays one has more, of cylinders with 5 % of their points some 5
/// mm off all do.
constexpr double kManyWithStrays = 0.4;

/// Against the way along zigzags: without points beside the skin they and the length differ by
/// more.
constexpr double kSameZigzags = 1e-3;
constexpr const char* kStraysLeftOutWarning =
    "points beside the skin, through which the section would turn to and fro, were left out: take "
    "away what shines or moves before the cameras";

/// Two readings of one section whose intervals do not even meet: one of them is wrong.
bool contradict(const MeasuredSection& one, const MeasuredSection& other) {
  return std::abs(one.contact - other.contact) > one.contact_u95 + other.contact_u95 ||
         std::abs(one.stretched - other.stretched) > one.stretched_u95 + other.stretched_u95;
}

/// The section as one even skin where it is that, else as its patches tell it: they see a narrow
/// collar, which the polynomial across a ribbon levels. How far the skin may wander where nobody
/// looked is known of the patches alone.
MeasuredSection measured(SlabSource& slabs, const PlaneBand& band,
                         const std::vector<SectionLoop>& loops, const BlendedSurface& surface,
                         const SectionEvidence& evidence) {
  const Contour& contour = loops.front().contour;
  const LengthDoubt doubt = doubt_of(contour, surface, band.sigma);
  const MeasuredSection patches{contour, contour.length() + doubt.waves,
                                contour.tape_length() + doubt.waves, doubt.contact_u95,
                                doubt.stretched_u95};
  if (loops.size() > 1) return patches;
  auto smooth = smooth_section(slabs, band, contour);
  if (!smooth || contradict(*smooth, patches)) return patches;
  if (has_notable_gap(band, evidence)) {
    smooth->contact_u95 = std::max(smooth->contact_u95, patches.contact_u95);
    smooth->stretched_u95 = std::max(smooth->stretched_u95, patches.stretched_u95);
  }
  return *smooth;
}

/// In millimetres.
Girth girth_of(const PlaneBand& band, const MeasuredSection& section,
               const SectionEvidence& evidence) {
  Girth girth;
  girth.contact_mm = band.unit_mm * section.contact;
  for (const auto& point : section.contour.refined(kPiecesOfChord))
    girth.contour.push_back(band.to_plane(point));
  girth.stretched_mm = band.unit_mm * section.stretched;
  girth.stretched_u95_mm = band.unit_mm * section.stretched_u95;
  girth.contact_u95_mm = band.unit_mm * section.contact_u95;
  girth.band_points = band.points.size() + band.thinned_out;
  girth.sigma_mm =
      band.unit_mm * std::max(band.sigma / band.usual_share, mean_scatter(band.scattered));
  girth.largest_gap_mm = band.unit_mm * evidence.seen_gap;
  return girth;
}

bool is_told(const Result<ToldGirth>& girth) {
  return girth && !girth->refusal;
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
  cloud.normals.clear();
  auto told = girth_of_all(cloud, plane, options);
  if (told) {
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

/// Of the first of the loops, if so much is known of it.
ToldGirth girth_along(const std::vector<SectionLoop>& loops, const BlendedSurface& surface,
                      const PlaneBand& band, SlabSource& slabs) {
  const Contour& contour = loops.front().contour;
  const double length = contour.length();
  const auto evidence = evidence_for(band, loops.front().index, evidence_reach(band));
  if (evidence.gap > kWidestBridge * length) {
    return refused(band, contour,
                   fail(ErrorCode::kInsufficientData,
                        "more than a quarter of the section at the tape plane has no points",
                        "scan the body all round"));
  }
  auto section = measured(slabs, band, loops, surface, evidence);
  const SectionUnknowns unknowns = unknowns_of(band, loops, surface, evidence, section.contour);
  widen(band, unknowns, section);
  ToldGirth told;
  if (!(section.stretched_u95 <= kMostDoubt * length)) {
    told = refused(band, contour, too_doubtful(unknowns, section));
  } else if (!(section.contact_u95 <= kMostFolded * length)) {
    told = refused(band, contour, too_few_or_noisy());
  }
  told.zigzags = {band.unit_mm * unknowns.zigzags.way, band.unit_mm * unknowns.zigzags.contact,
                  band.unit_mm * unknowns.zigzags.stretched};
  if (told.refusal) return told;

  told.girth = girth_of(band, section, evidence);
  told.girth.points = slabs.cloud().size();
  told.strays_near_skin = surface.share_with_strays() > kManyWithStrays;
  told.is_bridged = has_notable_gap(band, evidence);
  told.has_layers = unknowns.layers.has_value();
  const double unexplained = unexplained_share(band, loops, evidence);
  told.has_others_beside = unknowns.skin.is_any() || unexplained > kNotableUnexplained;
  told.of_few = unexplained > kMostUnexplained;
  told.girth.warnings = warnings_of(band, loops, evidence, unexplained, unknowns, section);
  return told;
}

/// Of slabs that are thinned already, or are here if their points ask for it.
Result<ToldGirth> girth_at(SlabSource& slabs, const GirthOptions& options,
                           bool strays_near_skin = false) {
  auto band = band_at(slabs, strays_near_skin);
  if (!band) return tl::make_unexpected(band.error());
  // The index goes with the surface; the band keeps the points.
  BlendedSurface surface(PatchFitter(band->points, std::move(band->index), band->roughness));
  const auto loops = loops_on(*band, surface);
  if (loops.empty()) return girth_without_loops(*band, slabs.cloud(), slabs.plane(), options);
  return girth_along(loops, surface, *band, slabs);
}

bool is_surer(const ToldGirth& one, const ToldGirth& other) {
  return one.of_few != other.of_few ? other.of_few : one.doubt() < other.doubt();
}

/// Whether it is so nearly the same without some points that none of these was on the zigzags.
bool are_same(const ToldGirth& one, const Result<ToldGirth>& other) {
  return other && std::abs(one.zigzags.way - other->zigzags.way) < kSameZigzags * one.zigzags.way &&
         one.refusal.has_value() == other->refusal.has_value() &&
         (one.refusal || std::abs(one.girth.contact_mm - other->girth.contact_mm) <
                             kSameZigzags * one.zigzags.way);
}

/// Where zigzags are made by strays, all of what they add may be too much.
void widen_by_zigzags(ToldGirth& told) {
  if (told.refusal) return;
  Girth& girth = told.girth;
  *girth.contact_u95_mm += told.zigzags.contact;
  *girth.stretched_u95_mm += told.zigzags.stretched;
  if (*girth.stretched_u95_mm > kMostDoubt * girth.contact_mm ||
      *girth.contact_u95_mm > kMostFolded * girth.contact_mm) {
    told.refusal = strays_in_section().value();
  }
}

/// Of a section that zigzags, without the points beside its skin, if there are any and it is the
/// surer one then. The same where the skin is what turns to and fro: there none lie beside it.
ToldGirth girth_without_zigzags(ToldGirth told, SlabSource& slabs, const GirthOptions& options) {
  auto cleaned = girth_at(slabs, options, true);
  if (are_same(told, cleaned)) return told;
  widen_by_zigzags(told);
  if (!cleaned) return told;
  widen_by_zigzags(*cleaned);
  if (cleaned->refusal || (!told.refusal && !is_surer(*cleaned, told))) return told;
  cleaned->girth.warnings.emplace_back(kStraysLeftOutWarning);
  return std::move(*cleaned);
}

}  // namespace

double ToldGirth::doubt() const {
  return *girth.stretched_u95_mm + *girth.contact_u95_mm;
}

double ToldGirth::area() const {
  return signed_area(girth.contour);
}

bool ToldGirth::is_plain() const {
  return !refusal && !of_few && !is_bridged && !has_layers && !has_others_beside &&
         *girth.stretched_u95_mm <= kNotableDoubt * girth.stretched_mm &&
         *girth.contact_u95_mm <= kNotableDoubt * girth.contact_mm;
}

bool ToldGirth::is_doubtful() const {
  return refusal || of_few || *girth.stretched_u95_mm > kNotableDoubt * girth.stretched_mm ||
         girth.contact_mm > kWinding * girth.stretched_mm;
}

Result<ToldGirth> girth_of_all(const PointCloud& cloud, const TapePlane& plane,
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
    if (is_told(thinned) && (!is_told(told) || is_surer(*thinned, *told)))
      told = std::move(thinned);
  }
  return told;
}

}  // namespace instep
