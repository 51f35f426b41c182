#include "core/girth/section/section_unknowns.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/girth/band/rounded_places.h"
#include "core/girth/contour/contour_course.h"
#include "core/girth/contour/contour_turns.h"
#include "core/girth/doubt/bends_between_lines.h"
#include "core/girth/doubt/bends_between_points.h"
#include "core/girth/doubt/bends_in_space.h"
#include "core/girth/doubt/cloud_edge.h"

namespace instep {
namespace {

/// Intervals are wider by as much as the noise is more than was told, up to this.
constexpr double kMostDistrust = 2.0;
/// Folds that go no deeper than so many standard deviations of the noise may be made by it: those
/// of lines a sixth to a quarter as thick with noise as they are apart went seven to eight deep,
/// and made contact lengths up to a half too long.
constexpr double kFoldInSigmas = 12.0;
/// Folds that add less than this part of a length may be the body's: of 55 lobed bodies that wind
/// less, all but one were told within the interval as it was.
constexpr double kLeastFolds = 0.15;
/// Two sides of a thin part that noise makes so thick, each, tell nothing of where they meet.
constexpr double kTipInSigmas = 4.0;
/// Zigzags are looked for within so many grains. All 27 clumps of strays that kMostToAndFro is set
/// by turn to and fro there more than 99.7 % of other sections, within four grains 26 do.
constexpr double kZigzagInGrains = 8.0;

double folds_by_noise(const PlaneBand& band, const Contour& section) {
  // Folds are no finer than the grain.
  if (kFoldInSigmas * band.sigma < band.grain) return 0.0;
  const double more = section.length() - section.tape_length();
  if (!(more > kLeastFolds * section.length())) return 0.0;
  return mean_fold_depth(section, more) < kFoldInSigmas * band.sigma ? more : 0.0;
}

/// What scatters in a part may be ribs, or two layers and the skin either of them.
double reach_of_layers(const PlaneBand& band, const std::optional<SkinLayers>& layers) {
  const double scatter = 2.0 * std::numbers::pi * mean_scatter(band.scattered);
  return layers ? std::max(reach_of(*layers), scatter) : scatter;
}

/// As one even skin through all points of a ribbon shows it, or the surface in the band: of each
/// length whichever shows more.
MissedLength missed_of_finer_skin(const PlaneBand& band, const PointCloud& cloud,
                                  const BlendedSurface& surface, const SectionLoop& section,
                                  const MeasuredSection& measured) {
  const auto finer = finer_skin_at(band, surface, section.index);
  if (!finer || may_be_rounding(*finer, band.unit_mm, cloud)) return measured.missed;
  const MissedLength missed = missed_length(*finer, measured.contact);
  return {std::max(missed.contact, measured.missed.contact),
          std::max(missed.stretched, measured.missed.stretched)};
}

}  // namespace

SectionUnknowns unknowns_of(const PlaneBand& band, const PointCloud& cloud,
                            const std::vector<SectionLoop>& loops, const BlendedSurface& surface,
                            const SectionEvidence& evidence, const MeasuredSection& measured) {
  const SectionLoop& section = loops.front();
  const ContourCourse course(section.contour);
  const double near = evidence_reach(band);
  SectionUnknowns unknowns{
      unseen_bends_of(course, evidence.ways, near),
      bends_between_lines(course, surface, band.spacing),
      bends_in_space(course, surface, band.spacing + kTipInSigmas * band.sigma),
      bends_between_points(course, surface, band.spacing),
      layers_near_plane(band, surface, near),
      0.0,
      {},
      loops_beside(band, loops),
      {},
      {},
      zigzags_of(ContourCourse(measured.contour), kZigzagInGrains * band.grain),
      folds_by_noise(band, section.contour),
      doubt_of_edge(band, section.index),
      doubt_of_rounding(band, cloud, measured.contact)};
  unknowns.reach = reach_of_layers(band, unknowns.layers);
  // What lies off the one layer is the other one, which counts already.
  const bool is_layered = unknowns.layers && unknowns.layers->are_all_round;
  if (is_layered) {
    unknowns.beside.contact = unknowns.beside.stretched = 0.0;
    return unknowns;
  }
  unknowns.skin = unfollowed_skin(band, loops);
  if (!unknowns.skin.is_any() && loops.size() == 1) {
    unknowns.narrow = narrow_part_beside(band, section);
  }
  unknowns.finer = missed_of_finer_skin(band, cloud, surface, section, measured);
  return unknowns;
}

/// Bends between points count no more than all that was told, which knows of the points' spacing
/// too: else girths of scanned feet of 1,080 points would have intervals 1.8 times as wide, not
/// 1.4, though 96 % of them hold without.
void widen(const PlaneBand& band, const SectionUnknowns& unknowns, MeasuredSection& section) {
  // Noise that is not what was told of it is hardly independent from point to point either.
  const double distrust = std::min(band.told_scale, kMostDistrust);
  const auto with_bends = [&](double told, double UnseenBends::*length) {
    double squares = std::pow(distrust * told, 2) + std::pow(unknowns.edge, 2) +
                     std::pow(unknowns.rounding, 2) +
                     std::pow(std::min(told, unknowns.between_points.*length), 2);
    for (const auto& bends : {unknowns.bends, unknowns.between_lines, unknowns.in_space}) {
      squares += std::pow(bends.*length, 2);
    }
    return std::sqrt(squares) + unknowns.reach;
  };
  // Folds are waves too.
  section.contact_u95 = with_bends(section.contact_u95, &UnseenBends::contact_u95) +
                        unknowns.skin.contact + unknowns.beside.contact + unknowns.narrow.contact +
                        std::max(unknowns.finer.contact, unknowns.folds);
  section.stretched_u95 = with_bends(section.stretched_u95, &UnseenBends::stretched_u95) +
                          unknowns.skin.stretched + unknowns.beside.stretched +
                          unknowns.narrow.stretched + unknowns.finer.stretched;
}

}  // namespace instep
