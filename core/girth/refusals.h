#pragma once

#include "core/result.h"

namespace instep {

/// Why there is no girth, in the words that several methods and steps share: each with its remedy.

/// Of a plane beside the cloud.
tl::unexpected<Error> too_few_near_plane();

/// Of a plane with all points on one side.
tl::unexpected<Error> only_touched();

/// Of points near the plane that do not hang together as skin does.
tl::unexpected<Error> no_surface();

}  // namespace instep
