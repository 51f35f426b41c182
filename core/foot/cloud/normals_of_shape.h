#pragma once

#include "core/geometry/point_cloud.h"

namespace instep {

/// Whether the normals that came with a cloud of one body are none of its shape's: where points lie
/// flat most of them do not stand on these, many face the opposite way of their neighbours', or
/// many point inwards. False without normals. O(n), and m log m for the few thousand points that it
/// looks at.
bool normals_contradict_shape(const PointCloud& cloud);

}  // namespace instep
