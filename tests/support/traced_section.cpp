#include "tests/support/traced_section.h"

#include <algorithm>
#include <optional>
#include <utility>

#include "core/girth/band/slab_source.h"
#include "core/girth/section/section_loops.h"
#include "tests/support/cylinder_tape.h"

namespace instep::test {
namespace {

PlaneBand band_of(const PointCloud& cloud) {
  SlabSource slabs(cloud, level_plane());
  return band_at(slabs).value();
}

}  // namespace

TracedSection::TracedSection(const PointCloud& cloud) : TracedSection(band_of(cloud)) {}

TracedSection::TracedSection(PlaneBand band)
    : spacing(band.spacing),
      surface(PatchFitter(band.points, std::move(band.index), band.roughness)),
      contour(loops_on(band, surface).front().contour) {}

void TracedSection::begin_later(int corners) {
  std::rotate(contour.points.begin(), contour.points.begin() + corners, contour.points.end());
  std::rotate(contour.outward.begin(), contour.outward.begin() + corners, contour.outward.end());
}

}  // namespace instep::test
