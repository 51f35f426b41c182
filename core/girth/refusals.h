#pragma once

#include "core/girth/band/plane_band.h"
#include "core/result.h"

namespace instep {

/// Why there is no girth, in the words that several methods and steps share: each with its remedy.

/// Of a plane beside the cloud.
tl::unexpected<Error> too_few_near_plane();

/// Of a plane with all points on one side.
tl::unexpected<Error> only_touched();

/// Of points near the plane that do not hang together as skin does.
tl::unexpected<Error> no_surface();

/// Of points round which no loop closes: how much of it none of them shows.
tl::unexpected<Error> does_not_close(const PlaneBand& band);

}  // namespace instep
