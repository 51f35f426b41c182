#pragma once

#include "core/foot/foot_scan.h"

namespace instep {

/// Whether an aligned body is a shoe last rather than a foot: its toes are not parted, its heel
/// stands clear of the floor (a last stands on its ball, as high as the heel of its shoe), and
/// there is no leg. A last has no toes, no arch and no ankle to be measured.
bool is_shoe_last(const FootScan& foot);

/// Whether the sole of an aligned body lies flat on the floor: of its points up to 4 mm above it at
/// least half are within 1 mm of it, and these reach over 0.8 of its length. A last's sole is
/// rounded: stood on what they rest on, three lasts have 0.33 to 0.65 of the points and 0.19 to
/// 0.77 of the length, feet 0.52 to 0.89 and 0.82 to 0.93 (1,500 to 20,000 points, up to 1 mm of
/// noise).
bool stands_flat(const FootScan& foot);

}  // namespace instep
