#pragma once

#include <memory>

#include "core/result.h"
#include "drivers/usb_watch.h"

namespace instep {

/// The kernel's USB hot-plug events, by libusb, which hears of them from udev: without a running
/// udevd no event ever comes. Fails with kNotFound on a machine without USB.
Result<std::unique_ptr<UsbWatch>> open_libusb_watch();

/// Resets the port of a device, as if it was unplugged and plugged in: it leaves the bus, comes
/// back and has to be opened anew. Takes up to some seconds: not for the thread of an event loop.
/// Fails with kDeviceGone if it is not there, kPermissionDenied if its /dev/bus/usb node may not be
/// written, kInvalidInput if several devices are meant, as an address without a place may do.
Result<void> reset_usb_device(const UsbAddress& address);

}  // namespace instep
