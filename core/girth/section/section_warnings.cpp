#include "core/girth/section/section_warnings.h"

#include <algorithm>
#include <cstdio>
#include <string>
#include <utility>

#include "core/girth/contour/loop_choice.h"
#include "core/girth/contour/section_gaps.h"
#include "core/in_millimetres.h"

namespace instep {
namespace {

/// Noise beyond what depth cameras have, against the section.
constexpr double kNotableNoise = 0.012;
/// What is this part of a doubt is its reason: half of its square.
constexpr double kMostOfDoubt = 0.7;
/// What finer skin may add, against the section, that whoever reads the girth should know of.
constexpr double kNotableFinerSkin = 0.005;
constexpr const char* kFinerSkin =
    "the points show waves or ribs finer than a surface through them follows, as of a ribbed sock "
    "or of frames that do not fit each other";
constexpr const char* kSeeToFinerSkin =
    "scan bare skin, or from nearer, and see to the cameras' poses";
/// Of points that lead away from a section.
constexpr const char* kNoSkinFound =
    ", but no skin through them was found: a part too thin for them, or something that touches the "
    "body";

std::string warning_of(const SkinLayers& layers, double unit_mm) {
  return "the points lie in two layers, " +
         in_millimetres(unit_mm * (layers.outer - layers.inner)) +
         " apart: the tape was laid between them and may belong on either; see to the cameras' "
         "poses, or scan one layer alone";
}

std::string warning_of(const std::vector<ScatteredPlace>& scattered, double unit_mm) {
  char figure[32];
  std::snprintf(figure, sizeof figure, "%.2f mm", unit_mm * most_scatter(scattered));
  return "in a part of the section the points scatter by " + std::string(figure) +
         ", elsewhere hardly: see to what the camera sees there, such as an edge, a shine or two "
         "layers";
}

std::string warning_of(const UnfollowedSkin& skin, double unit_mm) {
  return "points lead " + in_millimetres(unit_mm * skin.off) + " away from the section" +
         kNoSkinFound + "; take it away, or scan from nearer";
}

std::string warning_of_zigzags(double way_mm) {
  char figure[32];
  std::snprintf(figure, sizeof figure, "%.0f mm", way_mm);
  return "over " + std::string(figure) +
         " the section turns to and fro more than its points can tell: strays beside the skin, "
         "views that do not fit each other, or ribs too fine; see to what lies there and to the "
         "cameras' poses, or scan from nearer";
}

std::string warning_of(const MissedLength& finer, double unit_mm) {
  return std::string(kFinerSkin) + ": a tape over them may be " +
         in_millimetres(unit_mm * finer.stretched) + " longer, and the contact length " +
         in_millimetres(unit_mm * finer.contact) + "; " + kSeeToFinerSkin;
}

std::string near_loop_warning(double length_mm, double gap_mm) {
  return "the plane cuts another closed loop, " + in_millimetres(length_mm) + " long and " +
         in_millimetres(gap_mm) +
         " beside the section, which was left out but may be part of the body: look at it, or scan "
         "from nearer";
}

std::string warning_of(const NarrowPart& narrow, double unit_mm) {
  return "points lie up to " + in_millimetres(unit_mm * narrow.off) +
         " off one place of the section, as of a slot or a rib too narrow for a surface through "
         "them: the contact length may be " +
         in_millimetres(unit_mm * narrow.contact) + " longer; scan from nearer";
}

tl::unexpected<Error> may_be_one_body() {
  return fail(ErrorCode::kInsufficientData,
              "beside the section at the tape plane lies another closed loop, so near that it may "
              "be part of the body",
              "scan from nearer, or give the points of one body alone");
}

tl::unexpected<Error> too_narrow() {
  return fail(
      ErrorCode::kInsufficientData,
      "points lie off one place of the section at the tape plane, as of a slot or a rib too "
      "narrow for a surface through them",
      "scan from nearer");
}

tl::unexpected<Error> too_few_or_noisy() {
  return fail(ErrorCode::kInsufficientData,
              "the points near the tape plane are too few or too noisy to tell the girth",
              "scan again, with more or better frames");
}

bool is_most_of(double doubt, const MeasuredSection& section) {
  return doubt > kMostOfDoubt * section.stretched_u95;
}

bool is_most_of_contact(double doubt, const MeasuredSection& section) {
  return doubt > kMostOfDoubt * section.contact_u95;
}

/// Whether a length is more doubtful than it should be, and nothing that is named explains it.
bool is_unexplained(const SectionUnknowns& unknowns, const MeasuredSection& section,
                    double length) {
  if (is_most_of(unknowns.skin.stretched + unknowns.beside.stretched + unknowns.narrow.stretched,
                 section))
    return false;
  if (is_most_of(unknowns.reach, section)) return false;
  const double notable = kNotableDoubt * length;
  const bool stretched =
      section.stretched_u95 > notable && !is_most_of(unknowns.finer.stretched, section);
  // Of a folded one the contact length was warned of.
  const bool contact =
      section.contact_u95 > notable && !(unknowns.folds > 0.0) &&
      !is_most_of_contact(unknowns.finer.contact, section) &&
      !is_most_of_contact(unknowns.beside.contact + unknowns.narrow.contact, section);
  return stretched || contact;
}

const char* reason_of_doubt(const SectionUnknowns& unknowns, const MeasuredSection& section) {
  if (is_most_of(unknowns.bends.stretched_u95, section)) {
    return "the section may bend more sharply where no camera saw it, so that the girth is "
           "uncertain: scan the body from there too";
  }
  if (is_most_of(unknowns.between_lines.stretched_u95, section)) {
    return "the section may have edges between the lines that the points stand in, so that the "
           "girth is uncertain: scan with closer lines, or from more sides";
  }
  if (is_most_of(unknowns.in_space.stretched_u95, section)) {
    return "the points do not show how sharp the tip of a thin part is, so that the girth is "
           "uncertain: scan it from nearer, or from more sides";
  }
  if (is_most_of(unknowns.between_points.stretched_u95, section)) {
    return "the section may bend more sharply between the points than they show, so that the girth "
           "is uncertain: scan from nearer, or with more frames";
  }
  return "the points are so few or noisy that the girth is uncertain: scan again, with more or "
         "better "
         "frames";
}

using Warnings = std::vector<std::string>;

void warn_of_other_loops(const PlaneBand& band, const std::vector<SectionLoop>& loops,
                         const SectionUnknowns& unknowns, Warnings& warnings) {
  for (std::size_t i = 1; i < loops.size(); ++i) {
    const double length_mm = band.unit_mm * loops[i].contour.length();
    const auto& gap = unknowns.beside.gaps[i - 1];
    warnings.push_back(gap ? near_loop_warning(length_mm, band.unit_mm * *gap)
                           : other_loop_warning(length_mm));
  }
}

/// Of those that the section does not follow.
void warn_of_points_off(const PlaneBand& band, double unexplained, const SectionUnknowns& unknowns,
                        Warnings& warnings) {
  const UnfollowedSkin& skin = unknowns.skin;
  if (skin.is_any()) warnings.push_back(warning_of(skin, band.unit_mm));
  if (unknowns.narrow.is_any()) warnings.push_back(warning_of(unknowns.narrow, band.unit_mm));
  if (!skin.is_any() && unexplained > kNotableUnexplained) {
    warnings.emplace_back(
        "points beside the section lie on no skin that closes: strays, a second layer or another "
        "body");
  }
  if (band.stray_share > kNotableUnexplained) {
    warnings.emplace_back(
        "many points near the plane lie off the skin and were left out: take away what shines or "
        "moves before the cameras");
  }
}

void warn_of_layers(const PlaneBand& band, const SectionUnknowns& unknowns, Warnings& warnings) {
  const auto& layers = unknowns.layers;
  const bool is_layered = layers && layers->are_all_round;
  if (!is_layered && !band.scattered.empty()) {
    warnings.push_back(warning_of(band.scattered, band.unit_mm));
  }
  if (layers) warnings.push_back(warning_of(*layers, band.unit_mm));
}

void warn_of_fine_skin(const PlaneBand& band, double length, const SectionUnknowns& unknowns,
                       Warnings& warnings) {
  const MissedLength& finer = unknowns.finer;
  const bool shows_finer = std::max(finer.contact, finer.stretched) > kNotableFinerSkin * length;
  if (shows_finer) warnings.push_back(warning_of(finer, band.unit_mm));
  if (unknowns.zigzags.way > 0.0 && unknowns.folds == 0.0) {
    warnings.push_back(warning_of_zigzags(band.unit_mm * unknowns.zigzags.way));
  }
  if (unknowns.folds > 0.0) {
    warnings.emplace_back(
        "the section is folded, by noise or by ribs too fine for it: the contact length is "
        "uncertain; scan again, with more or better frames");
  }
}

void warn_of_noise(const PlaneBand& band, const SectionUnknowns& unknowns, Warnings& warnings) {
  const bool scattered = !unknowns.layers && band.shown_sigma > kNotableNoise * band.usual_share;
  if (scattered) {
    warnings.emplace_back(
        "the points scatter so much that they may be two layers of skin; the middle was taken");
  }
  const bool is_overtold = !scattered && !unknowns.layers && band.told_scale == 1.0 &&
                           band.sigma > kNotableNoise * band.usual_share;
  if (is_overtold) {
    warnings.push_back(
        std::string("so much noise is told of the points that what is skin may be smoothed away: "
                    "they scatter far less; ") +
        (band.own_sigma ? "have the file's sigma_mm made anew, or leave it out"
                        : "leave --sigma-mm out, or give a smaller one"));
  }
}

}  // namespace

std::vector<std::string> warnings_of(const PlaneBand& band, const std::vector<SectionLoop>& loops,
                                     const SectionEvidence& evidence, double unexplained,
                                     const SectionUnknowns& unknowns,
                                     const MeasuredSection& section) {
  const double length = loops.front().contour.length();
  Warnings warnings;
  warn_of_other_loops(band, loops, unknowns, warnings);
  if (has_notable_gap(band, evidence)) warnings.emplace_back(kBridgedWarning);
  warn_of_points_off(band, unexplained, unknowns, warnings);
  for (auto& disbelief : disbelief_of(band)) warnings.push_back(std::move(disbelief));
  warn_of_layers(band, unknowns, warnings);
  warn_of_fine_skin(band, length, unknowns, warnings);
  warn_of_noise(band, unknowns, warnings);
  if (is_unexplained(unknowns, section, length)) {
    warnings.emplace_back(reason_of_doubt(unknowns, section));
  }
  return warnings;
}

tl::unexpected<Error> too_many_zigzags() {
  return fail(ErrorCode::kInsufficientData,
              "the section at the tape plane turns to and fro more than its points can tell",
              "see to what shines, moves or touches the body there, or scan from nearer");
}

tl::unexpected<Error> too_doubtful(const SectionUnknowns& unknowns,
                                   const MeasuredSection& section) {
  if (is_most_of(unknowns.reach, section)) {
    return fail(ErrorCode::kInsufficientData,
                "the points at the tape plane lie in two layers or scatter in a part of the "
                "section, so far that nothing tells where the tape belongs",
                "see to the cameras' poses and to what shines there, or scan one layer alone");
  }
  if (is_most_of(unknowns.finer.stretched, section)) {
    return fail(ErrorCode::kInsufficientData, kFinerSkin, kSeeToFinerSkin);
  }
  if (is_most_of(unknowns.skin.stretched, section)) {
    return fail(ErrorCode::kInsufficientData,
                std::string("points lead away from the section at the tape plane") + kNoSkinFound,
                "take it away, or scan from nearer");
  }
  if (is_most_of(unknowns.beside.stretched, section)) return may_be_one_body();
  if (is_most_of(unknowns.narrow.stretched, section)) return too_narrow();
  return too_few_or_noisy();
}

tl::unexpected<Error> too_folded(const SectionUnknowns& unknowns, const MeasuredSection& section) {
  if (is_most_of_contact(unknowns.finer.contact, section)) {
    return fail(ErrorCode::kInsufficientData, kFinerSkin, kSeeToFinerSkin);
  }
  if (is_most_of_contact(unknowns.beside.contact, section)) return may_be_one_body();
  if (is_most_of_contact(unknowns.narrow.contact, section)) return too_narrow();
  return too_few_or_noisy();
}

}  // namespace instep
