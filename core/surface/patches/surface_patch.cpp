#include "core/surface/patches/surface_patch.h"

namespace instep {

FieldValue SurfacePatch::at(const Eigen::Vector3d& place) const {
  return std::visit([&](const auto& surface) { return surface.at(place); }, field);
}

SurfacePatch::Sheet SurfacePatch::sheet_at(const Eigen::Vector3d& place) const {
  if (const auto* smooth = std::get_if<HeightPatch>(&field)) {
    return {this, smooth, nullptr};
  }
  if (const auto* creased = std::get_if<CreasedPatch>(&field)) {
    const auto& sheet = creased->sheet_at(place);
    return {this, &sheet.patch, &sheet.members};
  }
  return {this, nullptr, nullptr};
}

}  // namespace instep
