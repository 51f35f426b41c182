#pragma once

#include <string>

#include "core/result.h"
#include "daemon/cloud_files/raw_cloud.h"

namespace instep {

/// Leaves out the points of which a coordinate is no number (NaN or infinite): so organised clouds
/// say that a pixel saw nothing. A few whose coordinates are absurd in any unit are left out too;
/// many are damage, and the file is refused (kInvalidInput). All that is known of the others stays
/// with them, and faces that name a point left out go with it. A note counts both. Fails with
/// kInsufficientData where no point is left. O(points + faces).
Result<void> leave_out_unseen(RawCloud& raw, const std::string& file);

}  // namespace instep
