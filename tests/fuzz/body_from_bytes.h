#pragma once

#include <cstddef>
#include <cstdint>

#include "core/geometry/point_cloud.h"
#include "core/geometry/triangle_mesh.h"
#include "core/girth/tape_plane.h"
#include "core/result.h"

namespace instep::test {

/// A body that is to be measured, and whatever has become of it.
struct FuzzedBody {
  PointCloud cloud;
  TriangleMesh mesh;  ///< over the points of the cloud before any were taken from it or added
  Result<TapePlane> plane;
};

/// Makes a body of any bytes: a simple one (tube, ball, sheet, line, nothing), then what the bytes
/// say is done to it, one step after the other: points doubled, crowded, flattened, snapped to a
/// grid, scaled, thrown about, taken away, made no numbers; normals, noise and origins told truly
/// or not. The first bytes choose the body and the plane, so that a change of one byte is a small
/// change. At most some 300 points. The same bytes make the same body.
FuzzedBody body_from_bytes(const std::uint8_t* data, std::size_t size);

}  // namespace instep::test
