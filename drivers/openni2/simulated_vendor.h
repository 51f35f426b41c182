#pragma once

namespace instep {

/// How the driver module of the simulation calls its maker: by it a camera is known as simulated.
inline constexpr const char* kSimulatedVendor = "Instep";

}  // namespace instep
