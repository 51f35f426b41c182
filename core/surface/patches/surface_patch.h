#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <variant>
#include <vector>

#include "core/surface/heights/quintic_patch.h"
#include "core/surface/oriented_point.h"
#include "core/surface/patches/creased_patch.h"
#include "core/surface/patches/height_patch.h"
#include "core/surface/patches/hermite_patch.h"

namespace instep {

/// A piece of surface round one place.
struct SurfacePatch {
  Eigen::Vector3d centre;
  Eigen::Vector3d middle;  ///< of its points; off the centre at the edge of a hole
  double radius;
  std::variant<HeightPatch, QuinticPatch, CreasedPatch, HermitePatch> field;
  std::vector<std::size_t> members;  ///< the points it was fitted to
  double variance = 0.0;             ///< of the surface round the true one, where no sheet can tell
  double rounding = 0.0;    ///< likely error (standard deviation) of a length over its crease
  bool has_strays = false;  ///< beside the members, which were left out

  FieldValue at(const Eigen::Vector3d& place) const;

  /// The one smooth surface that the patch is at some place, seen from there. Borrows the patch.
  struct Sheet {
    const SurfacePatch* owner = nullptr;
    const HeightPatch* patch = nullptr;                ///< null where it is no such one
    const std::vector<std::size_t>* chosen = nullptr;  ///< of the owner's members; null for all

    bool is_same(const Sheet& other) const { return owner == other.owner && patch == other.patch; }
    std::size_t size() const { return chosen ? chosen->size() : owner->members.size(); }
    /// The index of the i-th point of the sheet.
    std::size_t member(std::size_t i) const { return owner->members[chosen ? (*chosen)[i] : i]; }
  };
  Sheet sheet_at(const Eigen::Vector3d& place) const;
};

}  // namespace instep
