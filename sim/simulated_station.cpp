#include "sim/simulated_station.h"

#include <fmt/format.h>

#include <algorithm>
#include <numbers>
#include <thread>

#include "core/degree.h"
#include "sim/random.h"
#include "sim/solids/cylinder_solid.h"
#include "sim/solids/foot_solid.h"
#include "sim/solids/last_solid.h"
#include "sim/station_layout.h"
#include "sim/truth.h"

namespace instep {
namespace {

using Eigen::Vector3d;

/// Parts of a simulation that draw on their own; see seed_for().
enum SeedPart : std::uint64_t { kShape = 1, kStance = 2, kNoise = 100 };

constexpr double kFootSpacingMm = 140.0;  ///< between the middles of two feet
constexpr double kLargestTurnDeg = 4.0;
constexpr double kLargestShiftMm = 8.0;

/// People do not stand square to the platform: each foot is turned outwards a little and shifted.
RigidTransform stance(Random& random, Side side, double middle_y, double length) {
  const double outwards = random.uniform(0.0, kLargestTurnDeg) * kDegree;
  RigidTransform station_from_solid = RigidTransform::Identity();
  station_from_solid.linear() =
      Eigen::AngleAxisd(side == Side::kRight ? -outwards : outwards, Vector3d::UnitZ())
          .toRotationMatrix();
  const Vector3d shift(random.uniform(-kLargestShiftMm, kLargestShiftMm),
                       middle_y + random.uniform(-kLargestShiftMm, kLargestShiftMm), 0.0);
  station_from_solid.translation() =
      shift - station_from_solid.linear() * Vector3d(0.5 * length, 0.0, 0.0);
  return station_from_solid;
}

/// Both feet of a person have nearly the same shape; between two legs there is room.
FootParameters person_foot(const SimulationSettings& settings, Side side) {
  FootParameters foot = draw_foot(seed_for(settings.seed, kShape), side);
  if (settings.subject != Subject::kFeet) return foot;
  foot.lean_medial_deg = std::min(foot.lean_medial_deg, 0.0);
  if (side == Side::kLeft) {
    foot.length_mm += 2.0;
    foot.ball_breadth_mm += 1.0;
  }
  return foot;
}

void place_foot(const SimulationSettings& settings, Side side, double middle_y,
                SimulatedStation& station) {
  const FootParameters parameters = person_foot(settings, side);
  Random random(seed_for(seed_for(settings.seed, kStance), side == Side::kLeft ? 0 : 1));
  const auto foot = std::make_shared<FootSolid>(parameters);
  station.scene.solids.push_back({foot, stance(random, side, middle_y, parameters.length_mm)});
}

void place_subject(const SimulationSettings& settings, SimulatedStation& station) {
  switch (settings.subject) {
    case Subject::kFoot:
      place_foot(settings, settings.side, 0.0, station);
      return;
    case Subject::kFeet:
      place_foot(settings, Side::kLeft, 0.5 * kFootSpacingMm, station);
      place_foot(settings, Side::kRight, -0.5 * kFootSpacingMm, station);
      return;
    case Subject::kCylinder: {
      const auto cylinder = std::make_shared<CylinderSolid>(40.0, 150.0);
      station.scene.solids.push_back({cylinder, RigidTransform::Identity()});
      return;
    }
    case Subject::kLast: {
      RigidTransform station_from_solid = RigidTransform::Identity();
      station_from_solid.translation() = Vector3d(-130.0, 0.0, 0.0);
      station.scene.solids.push_back({std::make_shared<LastSolid>(), station_from_solid});
      return;
    }
  }
}

std::vector<std::shared_ptr<const ExactView>> render_all(
    const Scene& scene, const std::vector<CameraGeometry>& cameras) {
  std::vector<std::shared_ptr<const ExactView>> views(cameras.size());
  std::vector<std::thread> threads;
  for (std::size_t i = 0; i < cameras.size(); ++i) {
    threads.emplace_back([&scene, &cameras, &views, i] {
      views[i] = std::make_shared<const ExactView>(render_depth(scene, cameras[i]));
    });
  }
  for (std::thread& thread : threads) thread.join();
  return views;
}

}  // namespace

std::optional<Subject> subject_from_string(std::string_view name) {
  if (name == "foot") return Subject::kFoot;
  if (name == "feet") return Subject::kFeet;
  if (name == "cylinder") return Subject::kCylinder;
  if (name == "last") return Subject::kLast;
  return std::nullopt;
}

Result<std::vector<SubjectTruth>> SimulatedStation::truth() const {
  return subjects_truth(scene);
}

Result<std::vector<SubjectTruth>> subjects_truth(const Scene& scene) {
  std::vector<SubjectTruth> truths;
  for (const PlacedSolid& placed : scene.solids) {
    if (const auto* foot = dynamic_cast<const FootSolid*>(placed.solid.get())) {
      auto truth = foot_truth(*foot);
      if (!truth) return tl::make_unexpected(truth.error());
      truths.push_back({truth->side, std::move(truth->measures)});
    }
    if (const auto* cylinder = dynamic_cast<const CylinderSolid*>(placed.solid.get())) {
      truths.push_back({std::nullopt, {{"girth", 2.0 * std::numbers::pi * cylinder->radius_mm()}}});
    }
  }
  return truths;
}

std::map<std::string, double> truth_by_id(const std::vector<SubjectTruth>& bodies) {
  std::map<std::string, double> truth;
  for (const auto& body : bodies) {
    const bool apart = bodies.size() > 1 && body.side;
    const std::string prefix = apart ? std::string(to_string(*body.side)) + "_" : "";
    for (const auto& [id, value] : body.measures) truth[prefix + id] = value;
  }
  return truth;
}

Result<SimulatedStation> build_station(const SimulationSettings& settings) {
  LayoutSettings layout;
  layout.cameras = settings.cameras;
  layout.width_px = settings.width_px;
  layout.height_px = settings.height_px;
  const auto cameras = lay_out_station(layout);
  if (!cameras) return tl::make_unexpected(cameras.error());

  const auto script = parse_fault_script(settings.fault_script);
  if (!script) return tl::make_unexpected(script.error());
  std::vector<std::string> names;
  for (const CameraGeometry& camera : *cameras) names.push_back(camera.id);
  if (auto known = check_fault_cameras(*script, names); !known) {
    return tl::make_unexpected(known.error());
  }

  SimulatedStation station;
  place_subject(settings, station);
  const auto views = render_all(station.scene, *cameras);
  for (std::size_t i = 0; i < cameras->size(); ++i) {
    const SimulatedCamera::Settings camera{(*cameras)[i],
                                           fmt::format("sim-{}-{}", settings.seed, names[i]),
                                           NoiseSettings::for_law(settings.noise),
                                           settings.pacing,
                                           seed_for(settings.seed, kNoise + i),
                                           script->of_camera(names[i])};
    station.cameras.push_back(std::make_unique<SimulatedCamera>(camera, views[i]));
  }
  return station;
}

}  // namespace instep
