#include "core/girth/band/section_probe.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

#include "core/geometry/ordered_spacing.h"
#include "core/geometry/point_index.h"
#include "core/geometry/scan_lines.h"
#include "core/girth/band/section_box.h"
#include "core/girth/refusals.h"

namespace instep {
namespace {

/// Of the slab that is looked at first, against the extent of the cloud. Points of a slab thinner
/// than their spacing seem farther apart than they are.
constexpr double kFirstHalfWidth = 0.004;
constexpr double kWidening = 2.0;
/// Lines are looked for in a slab so many spacings to each side at least, and up to this part of
/// the cloud's extent wide, and must be seen within this part of the slab.
constexpr double kLookInSpacings = 10.0;
constexpr double kWidestForLines = 0.4;
constexpr double kReachInSlab = 0.7;
/// Those that are so thick that their nearest points do not show them.
constexpr double kWidestForThick = 0.1;
/// Lines are far apart if more steps along them than this lie between two: patches of the nearest
/// points would see but one or two. Of exact rows 12 steps apart girths were up to 0.06 mm off, and
/// are 0.003 thinned; of rings of 30 points whose columns are 8 apart 0.0005, and thinned 0.002.
constexpr double kFarApart = 8.0;
/// A slab of lines reaches so many gaps to each side to hold several all round the section.
constexpr double kGapsOfSlab = 2.0;
/// Added before a middle is rounded down to whole steps, so that one half-way between two always
/// goes to the lower.
constexpr double kSpareOfHalf = 0.25;
/// How far beside the box round the section points may belong to it, for the body may be wider
/// above the plane and below it; of the unit.
constexpr double kBeside = 0.25;

/// The lines that points within `half_width` or some more stand in, if they are far apart.
std::optional<ScanLines> lines_far_apart(SlabSource& slabs, double half_width, double widest) {
  for (double wide = half_width; wide < widest; wide *= kWidening) {
    const auto lines = scan_lines(PointIndex(slabs.slab(wide).places), kReachInSlab * wide);
    if (!lines) continue;
    return lines->apart > kFarApart * lines->step ? lines : std::nullopt;
  }
  return std::nullopt;
}

/// Which places lie further from the origin than the reach, to either side.
std::vector<bool> beyond(const Eigen::Array2d& reach, const std::vector<Eigen::Vector3d>& places) {
  std::vector<bool> beyond;
  beyond.reserve(places.size());
  for (const auto& place : places) beyond.push_back((place.head<2>().array().abs() > reach).any());
  return beyond;
}

/// The section that points lie round, which are fewer than make a surface or within less than
/// their spacing of the plane: nothing. Its unit and middle are whole numbers of `step`.
std::optional<SectionProbe> probe_of(SlabSource& slabs, double half_width, double step) {
  PlaneSlab slab = slabs.slab(half_width);
  if (slab.places.size() < kFewestPoints) return std::nullopt;
  const auto box = section_box(slab.places, 2.0 * half_width, step,
                               [&](double height) { return slabs.slab(0.5 * height).places; });
  const double unit = std::round(box.diagonal().norm() / step) * step;
  const Eigen::Array2d middle = (box.center().array() / step + kSpareOfHalf).floor() * step;
  SectionProbe found{.middle_mm = {middle.x(), middle.y(), 0.0}, .unit_mm = unit};
  const Eigen::Array2d reach = box.sizes().array() / 2.0 + kBeside * unit;
  auto arms = slab.places;
  for (auto& arm : arms) arm -= found.middle_mm;
  const auto strays = beyond(reach, arms);
  if (std::find(strays.begin(), strays.end(), true) != strays.end()) {
    const auto all = static_cast<double>(slab.places.size());
    slab = without(strays, slab);
    found.reach = reach / unit;
    found.stray_share = 1.0 - static_cast<double>(slab.places.size()) / all;
  }
  const double spacing = usual_spacing_in_order(slab.places, kSpacingSample);
  // What is narrower than its points are apart is a line or a speck.
  if (half_width < spacing || !(spacing < unit)) return std::nullopt;
  found.spacing = spacing / unit;
  return found;
}

}  // namespace

PlaneSlab SectionProbe::slab(SlabSource& slabs, double half_width) const {
  PlaneSlab slab = slabs.slab(half_width * unit_mm);
  // In whole steps, which are the same numbers whichever unit the cloud is told in.
  const double step = rounding_step(slabs.plane());
  const double unit = std::round(unit_mm / step);
  for (auto& place : slab.places) {
    place = ((place - middle_mm) / step).array().round() / unit;
  }
  return stray_share > 0.0 ? without(beyond(reach, slab.places), slab) : slab;
}

Result<SectionProbe> probe_section(SlabSource& slabs) {
  const double size = slabs.size();
  const double step = rounding_step(slabs.plane());
  bool found_some = false;
  for (double half_width = kFirstHalfWidth * size; half_width < size; half_width *= kWidening) {
    found_some = found_some || slabs.slab(half_width).places.size() >= kFewestPoints;
    const auto found = probe_of(slabs, half_width, step);
    if (!found) continue;
    const double look = std::max(kLookInSpacings * found->spacing * found->unit_mm, half_width);
    if (slabs.is_thinned() || !stand_in_lines(slabs.slab(look).places, kReachInSlab * look)) {
      return *found;
    }
    const auto lines = lines_far_apart(slabs, look, kWidestForLines * slabs.size());
    if (!lines) return *found;
    slabs.thin_lines(lines->apart);
    const double several_lines = kGapsOfSlab * lines->apart;
    return probe_of(slabs, several_lines, step).value_or(*found);
  }
  if (found_some) return no_surface();
  return too_few_near_plane();
}

bool thin_thick_lines(SlabSource& slabs) {
  if (slabs.is_thinned()) return false;
  const double size = slabs.size();
  const auto lines = lines_far_apart(slabs, kFirstHalfWidth * size, kWidestForThick * size);
  if (lines) slabs.thin_lines(lines->apart);
  return lines.has_value();
}

}  // namespace instep
