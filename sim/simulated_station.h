#pragma once

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/foot/side.h"
#include "core/result.h"
#include "sim/scene.h"
#include "sim/simulated_camera.h"

namespace instep {

/// What stands on the simulated platform.
enum class Subject { kFoot, kFeet, kCylinder, kLast };

std::optional<Subject> subject_from_string(std::string_view name);  ///< foot feet cylinder last

struct SimulationSettings {
  std::uint64_t seed = 1;  ///< of the foot's shape, its stance and the noise
  Subject subject = Subject::kFoot;
  Side side = Side::kRight;  ///< of a single foot
  int cameras = 4;
  int width_px = 640;
  int height_px = 480;
  NoiseLaw noise = NoiseLaw::kTypical;
  Pacing pacing = Pacing::kRealTime;
  std::string fault_script;  ///< text (sim/fault_script.h)
};

/// What is true of one body on the platform: measure id -> value in mm.
struct SubjectTruth {
  std::optional<Side> side;                ///< nothing = not a foot
  std::map<std::string, double> measures;  ///< ids as in sim/truth.h; `girth` of a cylinder
};

/// A whole station: what stands on it, its cameras, and the truth about the measures.
struct SimulatedStation {
  Scene scene;
  std::vector<std::unique_ptr<DepthCamera>> cameras;
  double platform_height_mm = 0.0;

  /// subjects_truth() of its scene.
  Result<std::vector<SubjectTruth>> truth() const;
};

/// The truth about what stands in a scene, the left foot first; empty for a last. Cost: a second or
/// two a foot, so ask only when it is wanted.
Result<std::vector<SubjectTruth>> subjects_truth(const Scene& scene);

/// The same as one list, as a recording and Capture::truth hold it: two feet are told apart by
/// their side before each id.
std::map<std::string, double> truth_by_id(const std::vector<SubjectTruth>& bodies);

/// Builds it. The same settings give the same feet, frames and truth. Fails with kInvalidInput on
/// settings out of range or a fault script that cannot be read. Cost: about a second on two cores
/// for four cameras and one foot.
Result<SimulatedStation> build_station(const SimulationSettings& settings);

}  // namespace instep
