#include <algorithm>
#include <cmath>
#include <utility>

#include "core/geometry/polygon.h"
#include "core/girth/contour_trace.h"
#include "core/girth/girth.h"
#include "core/girth/loop_choice.h"
#include "core/girth/plane_band.h"
#include "core/girth/section_gaps.h"
#include "core/surface/blended_surface.h"

namespace instep {
namespace {

/// Steps in spacings: short ones place the patches evenly, longer ones read the finished field.
constexpr double kDraftStep = 0.4;
constexpr double kReadingStep = 0.6;
/// Points further from the contour or the plane than this many spacings are no evidence for it.
constexpr double kEvidenceInSpacings = 2.5;
/// The surface bridges no wider hole, against the length of the contour.
constexpr double kWidestBridge = 0.25;
/// Of a section, against the width of the body.
constexpr double kLongestSection = 6.0;
/// A stretch without a seen point that is worth a warning, in spacings.
constexpr double kNotableGapInSpacings = 6.0;
/// Chords are refined so that the hull loses less than 0.001 mm to them.
constexpr int kPiecesOfChord = 8;
/// Points along a loop, against those along the best founded one.
constexpr double kLeastFounded = 0.25;
constexpr int kMostLoops = 8;
constexpr int kMostStarts = 40;

bool is_near(const Contour& contour, const Eigen::Vector2d& point, double distance) {
  return std::any_of(contour.points.begin(), contour.points.end(),
                     [&](const auto& corner) { return (corner - point).norm() < distance; });
}

/// Follows every loop that starts near a point on the plane and round which the body lies inside.
std::vector<Contour> trace_all(const PlaneBand& band, BlendedSurface& surface) {
  std::vector<Contour> contours;
  int starts = 0;
  for (const auto& point : band.points) {
    if (std::abs(point.position.z()) > band.spacing) continue;
    const Eigen::Vector2d start = point.position.head<2>();
    const bool known = std::any_of(contours.begin(), contours.end(), [&](const Contour& contour) {
      return is_near(contour, start, kEvidenceInSpacings * band.spacing);
    });
    if (known) continue;
    if (++starts > kMostStarts || contours.size() >= kMostLoops) break;
    // The first round places the patches, the second reads the finished field.
    const auto draft =
        trace_contour(surface, start, kDraftStep * band.spacing, kWidestBridge, kLongestSection);
    if (!draft) continue;
    auto contour = trace_contour(surface, draft->points.front(), kReadingStep * band.spacing,
                                 kWidestBridge, kLongestSection);
    if (contour && signed_area(contour->points) > 0.0) contours.push_back(std::move(*contour));
  }
  return contours;
}

/// Places on the plane of the points that are evidence for the contour there.
std::vector<Eigen::Vector2d> evidence(const PlaneBand& band, const Contour& contour,
                                      bool only_seen) {
  const double near = kEvidenceInSpacings * band.spacing;
  std::vector<Eigen::Vector2d> places;
  for (std::size_t i = 0; i < band.points.size(); ++i) {
    const auto& position = band.points[i].position;
    if (only_seen && !band.seen[i]) continue;
    if (std::abs(position.z()) > near) continue;
    if (is_near(contour, position.head<2>(), near)) places.push_back(position.head<2>());
  }
  return places;
}

/// Leaves out loops that far fewer points make than the best founded one, for their length: strays
/// can lie so that a surface passes through them.
void drop_unfounded(const PlaneBand& band, std::vector<Contour>& contours) {
  std::vector<double> densities;
  for (const auto& contour : contours) {
    const auto points = static_cast<double>(evidence(band, contour, false).size());
    densities.push_back(points / contour.length());
  }
  const double best = *std::max_element(densities.begin(), densities.end());
  std::vector<Contour> founded;
  for (std::size_t i = 0; i < contours.size(); ++i) {
    if (densities[i] >= kLeastFounded * best) founded.push_back(std::move(contours[i]));
  }
  contours = std::move(founded);
}

/// The loop round the largest area first.
void largest_first(std::vector<Contour>& contours) {
  std::stable_sort(contours.begin(), contours.end(), [](const auto& a, const auto& b) {
    return signed_area(a.points) > signed_area(b.points);
  });
}

}  // namespace

Result<Girth> girth_by_rbf(const PointCloud& cloud, const TapePlane& plane,
                           const GirthOptions& options) {
  if (auto sound = check_cloud(cloud); !sound) return tl::make_unexpected(sound.error());
  const auto band = band_at(cloud, plane, options.sigma_mm);
  if (!band) return tl::make_unexpected(band.error());
  BlendedSurface surface(band->points, band->roughness);
  auto contours = trace_all(*band, surface);
  if (contours.empty()) {
    return fail(ErrorCode::kInsufficientData, "the section at the tape plane does not close",
                "scan the body all round, or move the plane");
  }
  drop_unfounded(*band, contours);
  largest_first(contours);
  const Contour& contour = contours.front();
  const double length = contour.length();
  if (largest_gap(contour.points, evidence(*band, contour, false)) > kWidestBridge * length) {
    return fail(ErrorCode::kInsufficientData,
                "more than a quarter of the section at the tape plane has no points",
                "scan the body all round");
  }

  Girth girth;
  girth.contact_mm = band->unit_mm * length;
  for (const auto& point : contour.refined(kPiecesOfChord))
    girth.contour.push_back(band->to_plane(point));
  girth.stretched_mm = perimeter(convex_hull(girth.contour));
  girth.points = cloud.size();
  girth.band_points = band->used;
  girth.sigma_mm = band->unit_mm * band->sigma;
  const double gap = largest_gap(contour.points, evidence(*band, contour, true));
  girth.largest_gap_mm = band->unit_mm * gap;
  for (std::size_t i = 1; i < contours.size(); ++i) {
    girth.warnings.push_back(other_loop_warning(band->unit_mm * contours[i].length()));
  }
  if (gap > kNotableGapInSpacings * band->spacing) {
    girth.warnings.push_back("a part of the section that no camera saw was bridged");
  }
  return girth;
}

}  // namespace instep
