#include "core/foot/measures/foot_tapes.h"

#include <Eigen/Geometry>
#include <cmath>

#include "core/degree.h"
#include "core/foot/landmarks/midfoot_points.h"
#include "core/foot/measures/foot_lengths.h"

namespace instep {
namespace {

using Eigen::Vector3d;

constexpr double kApartMm = 50.0;  ///< of control points that only give a direction

/// The control points of a tape, named by where they touch the foot.
struct TapePoints {
  Vector3d medial;
  Vector3d lateral;
  Vector3d dorsal;

  Result<TapePlane> plane() const { return TapePlane::through(medial, lateral, dorsal); }
};

Result<TapePoints> ball_points(const Landmarks& landmarks) {
  const auto tibiale = position_of(landmarks, "metatarsale_tibiale");
  if (!tibiale) return tl::unexpected(tibiale.error());
  const auto fibulare = position_of(landmarks, "metatarsale_fibulare");
  if (!fibulare) return tl::unexpected(fibulare.error());
  const Vector3d medial = on_floor(*tibiale);
  const Vector3d lateral = on_floor(*fibulare);
  return TapePoints{medial, lateral, (medial + lateral) / 2.0 + kApartMm * Vector3d::UnitZ()};
}

Result<TapePoints> instep_points(const Landmarks& landmarks) {
  const auto instep = position_of(landmarks, "instep_point");
  if (!instep) return tl::unexpected(instep.error());
  const auto arch = position_of(landmarks, "medial_arch");
  if (!arch) return tl::unexpected(arch.error());
  const auto lateral = position_of(landmarks, "lateral_midfoot");
  if (!lateral) return tl::unexpected(lateral.error());
  return TapePoints{on_floor(*arch), on_floor(*lateral), *instep};
}

/// The plane over two points that is square to the side view.
Result<TapePlane> heel_tape(const Landmarks& landmarks, const char* dorsal) {
  const auto heel = position_of(landmarks, "heel_point");
  if (!heel) return tl::unexpected(heel.error());
  const auto back = position_of(landmarks, dorsal);
  if (!back) return tl::unexpected(back.error());
  return TapePlane::through(*heel, *back, *heel + kApartMm * Vector3d::UnitY());
}

}  // namespace

Result<TapePlane> ball_tape(const Landmarks& landmarks) {
  return ball_points(landmarks).and_then([](const TapePoints& points) { return points.plane(); });
}

Result<TapePlane> leaning_ball_tape(const Landmarks& landmarks, double forward_deg) {
  const auto tibiale = position_of(landmarks, "metatarsale_tibiale");
  if (!tibiale) return tl::unexpected(tibiale.error());
  const auto fibulare = position_of(landmarks, "metatarsale_fibulare");
  if (!fibulare) return tl::unexpected(fibulare.error());
  const Vector3d across = (*fibulare - *tibiale).normalized();
  const Vector3d up = (Vector3d::UnitZ() - across.z() * across).normalized();
  const Vector3d either = across.cross(up);
  const Vector3d forward = either.x() > 0.0 ? either : Vector3d(-either);
  const double lean = forward_deg * kDegree;
  const Vector3d leaning = std::cos(lean) * up + std::sin(lean) * forward;
  return TapePlane::through(*tibiale, *fibulare, *tibiale + kApartMm * leaning);
}

Result<TapePlane> upright_instep_tape(const Landmarks& landmarks) {
  return position_of(landmarks, "instep_point").and_then([](const Vector3d& instep) {
    return TapePlane::through(on_floor(instep) + kApartMm * Vector3d::UnitY(),
                              on_floor(instep) - kApartMm * Vector3d::UnitY(), instep);
  });
}

Result<TapePlane> instep_tape(const Landmarks& landmarks) {
  return instep_points(landmarks).and_then([](const TapePoints& points) { return points.plane(); });
}

Result<TapePlane> waist_tape(const Landmarks& landmarks) {
  const auto ball = ball_points(landmarks);
  if (!ball) return tl::unexpected(ball.error());
  const auto instep = instep_points(landmarks);
  if (!instep) return tl::unexpected(instep.error());
  // Both dorsal points as high as the instep.
  const Vector3d over_ball = on_floor(ball->dorsal) + instep->dorsal.z() * Vector3d::UnitZ();
  const TapePoints middle{(ball->medial + instep->medial) / 2.0,
                          (ball->lateral + instep->lateral) / 2.0,
                          (over_ball + instep->dorsal) / 2.0};
  return middle.plane();
}

Result<TapePlane> short_heel_tape(const Landmarks& landmarks) {
  return heel_tape(landmarks, "junction");
}

Result<TapePlane> long_heel_tape(const Landmarks& landmarks) {
  return heel_tape(landmarks, "instep_point");
}

Result<TapePlane> ankle_tape(const Landmarks& landmarks) {
  return position_of(landmarks, "medial_malleolus").and_then([](const Vector3d& ankle) {
    return TapePlane::through(ankle, ankle + kApartMm * Vector3d::UnitX(),
                              ankle + kApartMm * Vector3d::UnitY());
  });
}

}  // namespace instep
