#include <algorithm>
#include <cmath>
#include <cstdio>
#include <utility>

#include "core/geometry/polygon.h"
#include "core/girth/contour_index.h"
#include "core/girth/contour_trace.h"
#include "core/girth/girth.h"
#include "core/girth/length_doubt.h"
#include "core/girth/loop_choice.h"
#include "core/girth/plane_band.h"
#include "core/girth/section_evidence.h"
#include "core/girth/section_gaps.h"
#include "core/girth/section_probe.h"
#include "core/girth/section_unknowns.h"
#include "core/girth/smooth_section.h"
#include "core/surface/blended_surface.h"

namespace instep {
namespace {

/// Steps in grains: short ones place the patches evenly, longer ones read the finished field. Of a
/// thinned crowd patches reach as far in any case.
constexpr double kDraftStep = 0.4;
constexpr double kDraftStepInThinned = 0.8;
constexpr double kReadingStep = 0.6;
/// Points further from the contour or the plane than this many grains are no evidence for it.
constexpr double kEvidenceInGrains = 2.5;
/// Loops of two bodies, or of both sides of a thin part, are further apart than this.
constexpr double kSameInGrains = 0.3;
/// Of a section, against the width of the body.
constexpr double kLongestSection = 6.0;
/// A stretch without a seen point that is worth a warning, in grains.
constexpr double kNotableGapInGrains = 6.0;
/// Pieces that a chord is told in, so that the contour looks round.
constexpr int kPiecesOfChord = 8;
/// Points along a loop, against those along the best founded one.
constexpr double kLeastFounded = 0.25;
/// Half of a 95 % interval that leaves nothing to be told, and one that is worth a warning, against
/// the length.
constexpr double kMostDoubt = 0.1;
constexpr double kNotableDoubt = 0.02;
/// The same of the contact length: with so many folds it may be no section at all. A hull of one
/// was 63 mm short.
constexpr double kMostFolded = 0.2;
/// Contact against stretched length of a section that winds more than most bodies do.
constexpr double kWinding = 1.05;
/// What is this part of a doubt is its reason: half of its square.
constexpr double kMostOfDoubt = 0.7;
/// A share of the points near the plane, off all loops, that is worth a warning, and one with which
/// the loops may not be what was scanned: of lines as thick with noise as they are near, a loop of
/// a few millimetres between two of them passed for the section. A wall beside a body is as much.
constexpr double kNotableUnexplained = 0.02;
constexpr double kMostUnexplained = 0.67;
/// A share of the patches that left out strays, with which these are looked for beforehand. Of
/// 8,363 girths of bodies without strays one has more, of cylinders with 5 % of their points some 5
/// mm off all do.
constexpr double kManyWithStrays = 0.4;
/// Noise beyond what depth cameras have, against the section.
constexpr double kNotableNoise = 0.012;
/// Of points that lead away from a section.
constexpr const char* kNoSkinFound =
    ", but no skin through them was found: a part too thin for them, or something that touches the "
    "body";
constexpr int kMostLoops = 8;
constexpr int kMostStarts = 40;
/// One in so many points, the nearest to the plane, is a start at least.
constexpr std::size_t kStartShare = 30;

/// A loop of the section with what is known of it.
struct Loop {
  Contour contour;
  ContourIndex index;

  explicit Loop(Contour traced) : contour(std::move(traced)), index(contour) {}
};

/// The points nearest to the plane: the outermost one, then in an order that spreads over all of
/// them. Most lie on the largest body, so a lump beside it does not use up the starts.
std::vector<std::size_t> starts_of(const PlaneBand& band) {
  std::vector<double> heights;
  for (const auto& point : band.points) heights.push_back(std::abs(point.position.z()));
  std::vector<double> order = heights;
  const auto share = order.begin() + static_cast<std::ptrdiff_t>(order.size() / kStartShare);
  std::nth_element(order.begin(), share, order.end());
  const double near = std::max(band.spacing, *share);
  std::vector<std::size_t> candidates;
  for (std::size_t i = 0; i < heights.size(); ++i) {
    if (heights[i] <= near) candidates.push_back(i);
  }
  std::vector<std::size_t> starts = {candidates.front()};
  const std::size_t count = candidates.size();
  for (std::size_t stride = std::size_t{1} << 20; stride > 0; stride /= 2) {
    for (std::size_t i = stride; i <= count; i += 2 * stride) starts.push_back(candidates[i - 1]);
  }
  return starts;
}

/// Whether one of the loops passes within a distance of a place.
bool pass_near(const std::vector<Loop>& loops, const Eigen::Vector2d& place, double distance) {
  return std::any_of(loops.begin(), loops.end(), [&](const Loop& loop) {
    return loop.index.foot_of(place).distance < distance;
  });
}

/// Follows every loop that starts near a point on the plane and round which the body lies inside.
std::vector<Loop> trace_all(const PlaneBand& band, BlendedSurface& surface) {
  std::vector<Loop> loops;
  const double draft_step = band.thinned_out > 0 ? kDraftStepInThinned : kDraftStep;
  int starts = 0;
  for (const std::size_t candidate : starts_of(band)) {
    const Eigen::Vector2d start = band.points[candidate].position.head<2>();
    if (pass_near(loops, start, kEvidenceInGrains * band.grain)) continue;
    if (++starts > kMostStarts || loops.size() >= kMostLoops) break;
    // The first round places the patches, the second reads the finished field.
    const auto draft =
        trace_contour(surface, start, draft_step * band.grain, kWidestBridge, kLongestSection);
    // Where the plane cuts the skin at a slant, points beside a known loop lead to it too.
    if (!draft || pass_near(loops, draft->points.front(), kSameInGrains * band.grain)) continue;
    auto contour = trace_contour(surface, draft->points.front(), kReadingStep * band.grain,
                                 kWidestBridge, kLongestSection);
    if (contour && signed_area(contour->points) > 0.0) loops.emplace_back(std::move(*contour));
  }
  return loops;
}

/// Leaves out loops that far fewer points make than the best founded one, for their length: strays
/// can lie so that a surface passes through them.
void drop_unfounded(const PlaneBand& band, std::vector<Loop>& loops) {
  if (loops.size() < 2) return;
  std::vector<double> densities;
  for (const auto& loop : loops) {
    const auto evidence = evidence_for(band, loop.index, kEvidenceInGrains * band.grain);
    densities.push_back(static_cast<double>(evidence.ways.size()) / loop.index.length());
  }
  const double best = *std::max_element(densities.begin(), densities.end());
  std::vector<Loop> founded;
  for (std::size_t i = 0; i < loops.size(); ++i) {
    if (densities[i] >= kLeastFounded * best) founded.push_back(std::move(loops[i]));
  }
  loops = std::move(founded);
}

/// Whether more than a share of the points near the plane lie on no loop.
bool leaves_points_unexplained(const PlaneBand& band, const std::vector<Loop>& loops,
                               const SectionEvidence& of_first, double share) {
  const double near = kEvidenceInGrains * band.grain;
  const double most = share * static_cast<double>(of_first.beside + of_first.ways.size());
  // The other loops can only explain some of what the first one does not.
  if (static_cast<double>(of_first.beside) <= most) return false;
  const auto unexplained =
      std::count_if(band.points.begin(), band.points.end(), [&](const OrientedPoint& point) {
        if (std::abs(point.position.z()) > near) return false;
        return std::none_of(loops.begin(), loops.end(),
                            [&](const Loop& loop) { return may_run_to(loop.index, point, near); });
      });
  return static_cast<double>(unexplained) > most;
}

/// The loop round the largest area first.
void largest_first(std::vector<Loop>& loops) {
  std::stable_sort(loops.begin(), loops.end(), [](const Loop& a, const Loop& b) {
    return signed_area(a.contour.points) > signed_area(b.contour.points);
  });
}

/// Two readings of one section whose intervals do not even meet: one of them is wrong.
bool contradict(const MeasuredSection& one, const MeasuredSection& other) {
  return std::abs(one.contact - other.contact) > one.contact_u95 + other.contact_u95 ||
         std::abs(one.stretched - other.stretched) > one.stretched_u95 + other.stretched_u95;
}

/// A stretch without a seen point.
bool has_notable_gap(const PlaneBand& band, const SectionEvidence& evidence) {
  return evidence.seen_gap > kNotableGapInGrains * band.grain;
}

/// The section as one even skin where it is that, else as its patches tell it: they see a narrow
/// collar, which the polynomial across a ribbon levels. How far the skin may wander where nobody
/// looked is known of the patches alone.
MeasuredSection measured(SlabSource& slabs, const PlaneBand& band, const std::vector<Loop>& loops,
                         const BlendedSurface& surface, const SectionEvidence& evidence) {
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

std::string warning_of(const SkinLayers& layers, double unit_mm) {
  char figure[32];
  std::snprintf(figure, sizeof figure, "%.1f mm", unit_mm * (layers.outer - layers.inner));
  return "the points lie in two layers, " + std::string(figure) +
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
  char figure[32];
  std::snprintf(figure, sizeof figure, "%.1f mm", unit_mm * skin.off);
  return "points lead " + std::string(figure) + " away from the section" + kNoSkinFound +
         "; take it away, or scan from nearer";
}

bool is_most_of(double doubt, const MeasuredSection& section) {
  return doubt > kMostOfDoubt * section.stretched_u95;
}

/// What whoever reads the girth should know.
void add_warnings(const PlaneBand& band, const std::vector<Loop>& loops,
                  const SectionEvidence& evidence, const SectionUnknowns& unknowns,
                  const MeasuredSection& section, Girth& girth) {
  const auto& [bends, layers, skin, folds, edge] = unknowns;
  const auto warn_if = [&](bool so, const char* warning) {
    if (so) girth.warnings.emplace_back(warning);
  };
  for (std::size_t i = 1; i < loops.size(); ++i) {
    girth.warnings.push_back(other_loop_warning(band.unit_mm * loops[i].contour.length()));
  }
  warn_if(has_notable_gap(band, evidence), kBridgedWarning);
  if (skin.is_any()) girth.warnings.push_back(warning_of(skin, band.unit_mm));
  warn_if(!skin.is_any() && leaves_points_unexplained(band, loops, evidence, kNotableUnexplained),
          "points beside the section lie on no skin that closes: strays, a second layer or another "
          "body");
  warn_if(band.stray_share > kNotableUnexplained,
          "many points near the plane lie off the skin and were left out: take away what shines or "
          "moves before the cameras");
  for (auto& disbelief : disbelief_of(band)) girth.warnings.push_back(std::move(disbelief));
  if (!layers && !band.scattered.empty()) {
    girth.warnings.push_back(warning_of(band.scattered, band.unit_mm));
  }
  if (layers) girth.warnings.push_back(warning_of(*layers, band.unit_mm));
  warn_if(folds > 0.0,
          "the section is folded, by noise or by ribs too fine for it: the contact length is "
          "uncertain; scan again, with more or better frames");
  const bool scattered = !layers && band.shown_sigma > kNotableNoise * band.usual_share;
  warn_if(scattered,
          "the points scatter so much that they may be two layers of skin; the middle was taken");
  warn_if(
      !scattered && !layers && band.told_scale == 1.0 &&
          band.sigma > kNotableNoise * band.usual_share,
      "so much noise is told of the points that what is skin may be smoothed away: they scatter "
      "far less; leave --sigma-mm out, or give a smaller one");
  const bool out_of_sight = is_most_of(bends.stretched_u95, section);
  // Of a folded one the contact length was warned of.
  const double doubt =
      folds > 0.0 ? section.stretched_u95 : std::max(section.stretched_u95, section.contact_u95);
  warn_if(!is_most_of(skin.stretched, section) &&
              doubt > kNotableDoubt * loops.front().contour.length(),
          out_of_sight ? "the section may bend more sharply where no camera saw it, so that the "
                         "girth is uncertain: scan the body from there too"
                       : "the points are so few or noisy that the girth is uncertain");
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

tl::unexpected<Error> too_few_or_noisy() {
  return fail(ErrorCode::kInsufficientData,
              "the points near the tape plane are too few or too noisy to tell the girth",
              "scan again, with more or better frames");
}

tl::unexpected<Error> too_doubtful(const SectionUnknowns& unknowns,
                                   const MeasuredSection& section) {
  if (!is_most_of(unknowns.skin.stretched, section)) return too_few_or_noisy();
  return fail(ErrorCode::kInsufficientData,
              std::string("points lead away from the section at the tape plane") + kNoSkinFound,
              "take it away, scan from nearer, or move the plane");
}

/// For normals that let no section close, as those of which one stretch points inwards.
Result<Girth> girth_without_normals(PointCloud cloud, const TapePlane& plane,
                                    const GirthOptions& options) {
  cloud.normals.clear();
  auto girth = girth_by_rbf(cloud, plane, options);
  if (girth) {
    girth->warnings.emplace_back(
        "the section closes only without the normals that came with the points, which were not "
        "used: have them made anew, or leave them out of the file");
  }
  return girth;
}

struct ToldGirth {
  Girth girth;
  bool of_few = false;            ///< most of the points near the plane lie on no loop
  bool strays_near_skin = false;  ///< many of its patches left some out

  double doubt() const { return *girth.stretched_u95_mm + *girth.contact_u95_mm; }

  /// Uncertain, of few, or so winding that noise may have folded it.
  bool is_doubtful() const {
    return of_few || *girth.stretched_u95_mm > kNotableDoubt * girth.stretched_mm ||
           girth.contact_mm > kWinding * girth.stretched_mm;
  }
};

/// Of slabs that are thinned already, or are here if their points ask for it.
Result<ToldGirth> girth_at(SlabSource& slabs, const GirthOptions& options,
                           bool strays_near_skin = false) {
  const PointCloud& cloud = slabs.cloud();
  auto band = band_at(slabs, options.sigma_mm, strays_near_skin);
  if (!band) return tl::make_unexpected(band.error());
  // The index goes with the surface; the band keeps the points.
  BlendedSurface surface(PatchFitter(band->points, std::move(band->index), band->roughness));
  auto loops = trace_all(*band, surface);
  if (loops.empty()) {
    if (cloud.has_normals() && !band->normals_dropped) {
      if (auto girth = girth_without_normals(cloud, slabs.plane(), options)) {
        return ToldGirth{std::move(*girth)};
      }
    }
    return fail(ErrorCode::kInsufficientData, "the section at the tape plane does not close",
                "scan the body all round, or move the plane");
  }
  drop_unfounded(*band, loops);
  largest_first(loops);
  const Contour& contour = loops.front().contour;
  const double near = kEvidenceInGrains * band->grain;
  const auto evidence = evidence_for(*band, loops.front().index, near);
  const double length = contour.length();
  if (evidence.gap > kWidestBridge * length) {
    return fail(ErrorCode::kInsufficientData,
                "more than a quarter of the section at the tape plane has no points",
                "scan the body all round");
  }
  auto section = measured(slabs, *band, loops, surface, evidence);
  std::vector<const ContourIndex*> indices;
  for (const auto& loop : loops) indices.push_back(&loop.index);
  const SectionUnknowns unknowns = unknowns_of(*band, contour, indices, surface, evidence, near);
  widen(*band, unknowns, section);
  if (!(section.stretched_u95 <= kMostDoubt * length)) return too_doubtful(unknowns, section);
  if (!(section.contact_u95 <= kMostFolded * length)) return too_few_or_noisy();

  ToldGirth told{girth_of(*band, section, evidence)};
  told.girth.points = cloud.size();
  told.strays_near_skin = surface.share_with_strays() > kManyWithStrays;
  told.of_few = leaves_points_unexplained(*band, loops, evidence, kMostUnexplained);
  add_warnings(*band, loops, evidence, unknowns, section, told.girth);
  return told;
}

bool is_surer(const ToldGirth& one, const ToldGirth& other) {
  return one.of_few != other.of_few ? other.of_few : one.doubt() < other.doubt();
}

}  // namespace

Result<Girth> girth_by_rbf(const PointCloud& cloud, const TapePlane& plane,
                           const GirthOptions& options) {
  if (auto sound = check_cloud(cloud); !sound) return tl::make_unexpected(sound.error());
  if (auto sound = check_options(options); !sound) return tl::make_unexpected(sound.error());
  SlabSource slabs(cloud, plane, !options.sigma_mm);
  auto told = girth_at(slabs, options);
  // What patches leave out has spoilt the noise and the normals that their points show.
  const bool strays_near_skin = told && told->strays_near_skin;
  if (strays_near_skin) {
    auto cleaned = girth_at(slabs, options, strays_near_skin);
    if (cleaned && !cleaned->of_few) told = std::move(cleaned);
  }
  // The nearest points of a line that noise makes thick all lie on a sheet across the skin, and
  // seem exact.
  if ((!told || told->is_doubtful()) && thin_thick_lines(slabs)) {
    auto thinned = girth_at(slabs, options, strays_near_skin);
    if (thinned && (!told || is_surer(*thinned, *told))) told = std::move(thinned);
  }
  if (!told) return tl::make_unexpected(std::move(told).error());
  return std::move(told->girth);
}

}  // namespace instep
