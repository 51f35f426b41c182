#pragma once

#include "core/foot/foot_scan.h"

namespace instep {

/// Whether an aligned body is a shoe last rather than a foot: its toes are not parted, its heel
/// stands clear of the floor (a last stands on its ball, as high as the heel of its shoe), and
/// there is no leg. A last has no toes, no arch and no ankle to be measured.
bool is_shoe_last(const FootScan& foot);

}  // namespace instep
