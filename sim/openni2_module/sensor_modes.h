#pragma once

#include <OniCTypes.h>

#include <vector>

#include "sim/openni2_module/bus_folder.h"

namespace instep {

/// The depth modes that a sensor offers: its size and half its size, in millimetres and, where the
/// sensor has them, tenths. The first is the one it begins with.
std::vector<OniVideoMode> sensor_modes(const BusDevice& device);

}  // namespace instep
