#include "daemon/station/pipeline_settings.h"

namespace instep {

PipelineSettings pipeline_settings(const Settings& settings) {
  PipelineSettings pipeline;
  pipeline.station = settings.station.name;
  pipeline.point_spacing_mm = settings.station.point_spacing_mm;
  pipeline.refine_views = settings.station.refine_views;
  pipeline.side = settings.station.side;
  pipeline.sizes = settings.sizes;
  pipeline.measures = settings.measures;
  return pipeline;
}

}  // namespace instep
