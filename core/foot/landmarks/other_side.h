#pragma once

#include <optional>

#include "core/foot/foot_scan.h"

namespace instep {

/// The landmarks as they would be if the foot were the other one of the two, where its shape hardly
/// tells which it is (FootScan::is_side_sure()), as where no camera saw its borders: what was told
/// by the first toe may then be the little one's. Nothing of a foot whose side is sure. `foot` has
/// its landmarks; find_landmarks() asks for them. Once more the cost of the landmarks, without
/// redraws.
std::optional<RedrawnLandmarks> landmarks_of_other_side(const FootScan& foot);

}  // namespace instep
