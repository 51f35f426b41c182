#pragma once

#include <atomic>
#include <memory>

#include "sim/openni2_module/plug.h"

namespace oni::driver {
class DeviceBase;
class StreamBase;
}  // namespace oni::driver

namespace instep {

/// The parts of the driver module, each behind the base class that the OpenNI2 library calls.

/// An opened sensor; made and deleted as the library asks. Nothing while another process has it, or
/// this one has it open already, as with a real one.
std::unique_ptr<oni::driver::DeviceBase> make_device(std::shared_ptr<const Plug> plug);

/// Its depth stream, which sends 30 images a second. As out of the box of a PrimeSense sensor it
/// begins at half the size and in whole millimetres, mirrored, with holes filled; `registered`
/// (owned by the device) shifts the image, as a projection into another camera does.
std::unique_ptr<oni::driver::StreamBase> make_depth_stream(std::shared_ptr<const Plug> plug,
                                                           const std::atomic<bool>& registered);

}  // namespace instep
