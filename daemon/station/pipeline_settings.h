#pragma once

#include "config/settings.h"
#include "daemon/scan/scan_pipeline.h"

namespace instep {

/// How the scans of a station with these settings are measured.
PipelineSettings pipeline_settings(const Settings& settings);

}  // namespace instep
