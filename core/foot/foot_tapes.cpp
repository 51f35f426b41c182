#include "core/foot/foot_tapes.h"

#include <string>

#include "core/foot/midfoot_points.h"

namespace instep {
namespace {

using Eigen::Vector3d;

/// The control points of a tape, named by where they touch the foot.
struct TapePoints {
  Vector3d medial;
  Vector3d lateral;
  Vector3d dorsal;

  Result<TapePlane> plane() const { return TapePlane::through(medial, lateral, dorsal); }
};

Result<Vector3d> position(const FootScan& foot, const std::string& name) {
  const auto found = foot.landmarks.find(name);
  if (found == foot.landmarks.end()) {
    return fail(ErrorCode::kInsufficientData, "the landmark " + name + " was not found",
                "scan the foot again, from all sides");
  }
  return found->second.position_mm;
}

Result<TapePoints> ball_points(const FootScan& foot) {
  const auto tibiale = position(foot, "metatarsale_tibiale");
  if (!tibiale) return tl::unexpected(tibiale.error());
  const auto fibulare = position(foot, "metatarsale_fibulare");
  if (!fibulare) return tl::unexpected(fibulare.error());
  const auto instep = position(foot, "instep_point");
  if (!instep) return tl::unexpected(instep.error());
  const Vector3d medial = on_floor(*tibiale);
  const Vector3d lateral = on_floor(*fibulare);
  return TapePoints{medial, lateral, (medial + lateral) / 2.0 + instep->z() * Vector3d::UnitZ()};
}

Result<TapePoints> instep_points(const FootScan& foot) {
  const auto instep = position(foot, "instep_point");
  if (!instep) return tl::unexpected(instep.error());
  const auto arch = position(foot, "medial_arch");
  if (!arch) return tl::unexpected(arch.error());
  const auto lateral = position(foot, "lateral_midfoot");
  if (!lateral) return tl::unexpected(lateral.error());
  return TapePoints{on_floor(*arch), on_floor(*lateral), *instep};
}

}  // namespace

Result<TapePlane> ball_tape(const FootScan& foot) {
  return ball_points(foot).and_then([](const TapePoints& points) { return points.plane(); });
}

Result<TapePlane> instep_tape(const FootScan& foot) {
  return instep_points(foot).and_then([](const TapePoints& points) { return points.plane(); });
}

Result<TapePlane> waist_tape(const FootScan& foot) {
  const auto ball = ball_points(foot);
  if (!ball) return tl::unexpected(ball.error());
  const auto instep = instep_points(foot);
  if (!instep) return tl::unexpected(instep.error());
  const TapePoints middle{(ball->medial + instep->medial) / 2.0,
                          (ball->lateral + instep->lateral) / 2.0,
                          (ball->dorsal + instep->dorsal) / 2.0};
  return middle.plane();
}

}  // namespace instep
