#pragma once

#include <string>

#include "core/result.h"

namespace instep {

/// The error of a camera, with its name, unless it begins with that already: a driver need not know
/// what its camera is called.
Error named_after_camera(const std::string& camera, Error error);

/// What is wrong with a camera that neither gives a frame nor fails.
Error silent_camera(const std::string& camera);

}  // namespace instep
