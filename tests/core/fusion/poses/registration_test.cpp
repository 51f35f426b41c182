#include "core/fusion/poses/registration.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "core/degree.h"
#include "core/fusion/views/surface_points.h"
#include "tests/support/fused_frames.h"
#include "tests/support/ray_cast_scene.h"

namespace instep {
namespace {

using Eigen::Vector3d;

Surfaces two_feet() {
  return {ellipsoid_surface({0, 60, 28}, {125, 45, 40}, 8),
          ellipsoid_surface({5, -62, 26}, {120, 44, 38}, -5),
          ellipsoid_surface({-70, 60, 60}, {38, 32, 70}),
          ellipsoid_surface({-65, -62, 60}, {38, 32, 70}), disc_surface({0, 0, 0}, {0, 0, 1}, 300)};
}

/// What each camera of a ring sees, in the station frame.
std::vector<PosedCloud> seen_by(const std::vector<CameraGeometry>& cameras, double axial_per_mm) {
  std::vector<PosedCloud> clouds;
  for (std::size_t i = 0; i < cameras.size(); ++i) {
    auto depth = *fuse_frames({render(cameras[i], two_feet(), {axial_per_mm, 0, 0}, i + 1, 0.1)});
    drop_flying_pixels(cameras[i].intrinsics, depth);
    std::vector<std::uint32_t> pixels;
    for (std::uint32_t p = 0; p < depth.depth_mm.size(); p += 3) {
      if (depth.depth_mm[p] > 0.0F) pixels.push_back(p);
    }
    const RigidTransform& pose = cameras[i].station_from_camera;
    const auto rays = *Deprojector::create(cameras[i].intrinsics);
    clouds.push_back({transformed(pose, surface_points(rays, depth, pixels)), pose});
  }
  return clouds;
}

std::vector<CameraGeometry> small_ring(int count) {
  auto cameras = ring_of_cameras(count, 450, 330, {0, 0, 20});
  for (auto& camera : cameras) {
    camera = camera_looking_at(camera.id, camera.station_from_camera.translation(), {0, 0, 20}, 320,
                               240, 288);
  }
  return cameras;
}

/// As seen by a camera that is said to stand elsewhere.
PosedCloud moved_by(const RigidTransform& transform, const PosedCloud& view) {
  return {transformed(transform, view.cloud), transform * view.station_from_camera};
}

/// A turn of `degrees` about the middle of the scene and a shift of `shift_mm`, in some direction.
RigidTransform disturbance(std::mt19937_64& random, double shift_mm, double degrees) {
  std::normal_distribution<double> normal;
  const auto direction = [&] {
    return Vector3d(normal(random), normal(random), normal(random)).normalized();
  };
  RigidTransform transform = RigidTransform::Identity();
  transform.linear() = Eigen::AngleAxisd(degrees * kDegree, direction()).toRotationMatrix();
  transform.translation() = shift_mm * direction();
  return transform;
}

/// Largest distance between what two views make of the same place, over places on the feet.
double disagreement(const std::vector<RigidTransform>& station_from_truth) {
  double worst = 0;
  for (const auto& a : station_from_truth) {
    for (const auto& b : station_from_truth) {
      for (const Vector3d& place :
           {Vector3d(0, 60, 60), {0, -60, 60}, {120, 0, 10}, {-120, 0, 10}}) {
        worst = std::max(worst, (a * place - b * place).norm());
      }
    }
  }
  return worst;
}

TEST(RegisterViews, RecoversPosesThatAreOffByTenMillimetresAndFourDegrees) {
  const auto truth = seen_by(small_ring(4), 1.0e-6);
  for (std::uint64_t seed = 1; seed <= 3; ++seed) {
    std::mt19937_64 random(seed);
    std::vector<PosedCloud> moved;
    std::vector<RigidTransform> given;
    for (const auto& cloud : truth) {
      given.push_back(disturbance(random, 10, 4));
      moved.push_back(moved_by(given.back(), cloud));
    }
    const auto registration = register_views(moved).value();
    std::vector<RigidTransform> refined;
    for (std::size_t i = 0; i < moved.size(); ++i) {
      EXPECT_EQ(registration.views[i].fit, ViewFit::kFits);
      refined.push_back(registration.views[i].correction * given[i]);
    }
    EXPECT_GT(disagreement(given), 10.0);
    EXPECT_LT(disagreement(refined), 0.8) << seed;
    EXPECT_LT(registration.residual_after_mm, 0.4);
    EXPECT_GT(registration.residual_before_mm, 5 * registration.residual_after_mm);
  }
}

TEST(RegisterViews, LeavesGoodPosesAlone) {
  const auto registration = register_views(seen_by(small_ring(4), 1.0e-6)).value();
  for (const auto& view : registration.views) {
    EXPECT_EQ(view.fit, ViewFit::kFits);
    EXPECT_LT(view.correction.translation().norm(), 0.05);
    EXPECT_LT(view.taken_away_mm, 0.02);
    EXPECT_GT(view.overlap, 0.5);
    EXPECT_LE(view.overlap, 1.0);
  }
}

/// Most of what the views share is the platform, along which the view slid: it lies still at once.
TEST(RegisterViews, BringsBackAViewThatSlidAlongThePlatform) {
  auto clouds = seen_by(small_ring(4), 1.0e-6);
  for (const double slid_mm : {5.0, 20.0, 30.0}) {
    RigidTransform slide = RigidTransform::Identity();
    slide.translation() = Vector3d(0, slid_mm, 0);
    auto slid = clouds;
    slid[1] = moved_by(slide, clouds[1]);
    const auto registration = register_views(slid).value();
    std::vector<RigidTransform> refined;
    for (std::size_t i = 0; i < slid.size(); ++i) {
      EXPECT_EQ(registration.views[i].fit, ViewFit::kFits);
      refined.push_back(registration.views[i].correction);
      if (i == 1) refined.back() = refined.back() * slide;
    }
    EXPECT_LT(disagreement(refined), 0.8) << slid_mm;
    EXPECT_GT(registration.views[1].taken_away_mm, 0.1 * slid_mm);
  }
}

TEST(RegisterViews, TellsPosesFromNoise) {
  const auto clouds = seen_by(small_ring(4), 1.0e-6);
  const auto right = register_views(clouds).value();
  std::mt19937_64 random(1);
  std::vector<PosedCloud> moved;
  for (const auto& cloud : clouds) moved.push_back(moved_by(disturbance(random, 5, 1.0), cloud));
  const auto wrong = register_views(moved).value();
  EXPECT_LT(right.unexplained_before_mm, 0.2);
  EXPECT_GT(wrong.unexplained_before_mm, 0.5);
  EXPECT_NEAR(wrong.unexplained_after_mm, right.unexplained_after_mm, 0.05);
}

/// As by a lens and a unit of depth that are off: larger by this share than it is.
PosedCloud larger_by(double share, const PosedCloud& view) {
  PosedCloud stretched = view;
  const Vector3d camera = view.station_from_camera.translation();
  for (auto& point : stretched.cloud.positions) point += share * (point - camera);
  return stretched;
}

/// How a point of the scene comes out of a view that was spoilt and registered.
struct ComesOut {
  RigidTransform given;  ///< by which its pose is off
  double share = 0.0;    ///< by which it is too large
  RigidTransform true_pose;
  RegisteredView found;

  RigidTransform pose() const { return found.correction * given * true_pose; }
  Vector3d operator()(const Vector3d& place) const {
    const Vector3d seen = (1.0 + share) * (true_pose.inverse() * place);
    const double wide = 1.0 + found.wider;
    return pose() * Vector3d(wide * seen.x(), wide * seen.y(), (1.0 + found.deeper) * seen.z());
  }
  /// How far one of the errors that are told moves it.
  Vector3d displacement(const Vector3d& place, std::size_t error) const {
    const RigidTransform camera = pose();
    return camera.linear() * (found.errors[error] * (camera.inverse() * place).homogeneous());
  }
};

std::vector<ComesOut> spoilt_and_registered(const std::vector<PosedCloud>& truth,
                                            const std::vector<double>& shares, std::uint64_t seed,
                                            const RegistrationSettings& settings = {}) {
  std::mt19937_64 random(seed);
  std::vector<PosedCloud> seen;
  std::vector<ComesOut> views;
  for (std::size_t i = 0; i < truth.size(); ++i) {
    views.push_back({disturbance(random, 1, 0.2), shares[i], truth[i].station_from_camera, {}});
    seen.push_back(moved_by(views[i].given, larger_by(shares[i], truth[i])));
  }
  const auto registration = register_views(seen, settings).value();
  for (std::size_t i = 0; i < views.size(); ++i) views[i].found = registration.views[i];
  return views;
}

/// By how much the length between two places of the scene is off, each as another view has it.
struct LengthError {
  double off_mm = 0.0;
  double sigma_mm = 0.0;  ///< as told
};

std::vector<LengthError> length_errors(const std::vector<ComesOut>& views) {
  std::vector<LengthError> errors;
  for (const auto& [from, to] : {std::pair(Vector3d(0, 100, 25), Vector3d(0, -100, 25)),
                                 std::pair(Vector3d(120, 60, 25), Vector3d(-110, -60, 40))}) {
    const Vector3d along = (to - from).normalized();
    for (std::size_t i = 0; i < views.size(); ++i) {
      const auto& a = views[i];
      const auto& b = views[(i + 2) % views.size()];
      double variance = 0.0;
      for (std::size_t e = 0; e < a.found.errors.size(); ++e) {
        variance += std::pow(along.dot(b.displacement(to, e) - a.displacement(from, e)), 2);
      }
      errors.push_back({(b(to) - a(from)).norm() - (to - from).norm(), std::sqrt(variance)});
    }
  }
  return errors;
}

double root_mean_square(const std::vector<LengthError>& errors) {
  double squares = 0.0;
  for (const auto& error : errors) squares += error.off_mm * error.off_mm;
  return std::sqrt(squares / static_cast<double>(errors.size()));
}

TEST(RegisterViews, FindsLensesThatAreOffAndPosesWithThem) {
  const auto truth = seen_by(small_ring(4), 1.0e-6);
  const std::vector<double> shares = {0.006, -0.006, 0.005, -0.005};
  const auto found = spoilt_and_registered(truth, shares, 3);
  for (std::size_t i = 0; i < truth.size(); ++i) {
    // Less than it is, for it is three times as much as is expected.
    EXPECT_NEAR(found[i].found.deeper / -shares[i], 0.5, 0.2) << i;
    EXPECT_NEAR(found[i].found.wider / -shares[i], 0.8, 0.2) << i;
  }
  RegistrationSettings exact;
  exact.expected.lens = 0.0;
  const auto by_poses_alone = spoilt_and_registered(truth, shares, 3, exact);
  EXPECT_NEAR(by_poses_alone[0].found.wider, 0.0, 1e-9);
  EXPECT_LT(root_mean_square(length_errors(found)),
            0.5 * root_mean_square(length_errors(by_poses_alone)));
}

TEST(RegisterViews, TellsWhatIsLeftUnknown) {
  const auto truth = seen_by(small_ring(4), 1.0e-6);
  double squares = 0.0;
  double count = 0.0;
  for (std::uint64_t seed = 1; seed <= 8; ++seed) {
    std::mt19937_64 random(seed + 100);
    std::normal_distribution<double> normal(0.0, 2e-3);
    std::vector<double> shares;
    for (std::size_t i = 0; i < truth.size(); ++i) shares.push_back(normal(random));
    for (const auto& error : length_errors(spoilt_and_registered(truth, shares, seed))) {
      squares += std::pow(error.off_mm / error.sigma_mm, 2);
      count += 1.0;
    }
  }
  EXPECT_LT(std::sqrt(squares / count), 1.4);
  EXPECT_GT(std::sqrt(squares / count), 0.3);
}

TEST(RegisterViews, LeavesOutAViewThatDoesNotFit) {
  auto clouds = seen_by(small_ring(5), 1.0e-6);
  for (auto& point : clouds[2].cloud.positions) {  // bent, as by a wrong lens
    point.z() += 15.0 * std::sin(0.05 * point.x()) + 10.0 * std::sin(0.06 * point.y());
  }
  const auto registration = register_views(clouds).value();
  EXPECT_EQ(registration.views[2].fit, ViewFit::kDoesNotFit);
  EXPECT_TRUE(registration.views[2].correction.isApprox(RigidTransform::Identity()));
  for (const std::size_t i : {0U, 1U, 3U, 4U}) {
    EXPECT_EQ(registration.views[i].fit, ViewFit::kFits);
    EXPECT_LT(registration.views[i].correction.translation().norm(), 1.5);
  }
}

/// A bent view spoils what its neighbours seem to be: they are judged again without it.
TEST(RegisterViews, LeavesOutNoViewForAnothersSake) {
  auto clouds = seen_by(small_ring(4), 1.0e-6);
  for (auto& point : clouds[2].cloud.positions) {
    point.z() += 25.0 * std::sin(0.05 * point.x()) + 25.0 * std::sin(0.06 * point.y());
  }
  RegistrationSettings settings;
  settings.most_residual_mm = 0.22;  // less than the neighbours have before the bent one is out
  const auto registration = register_views(clouds, settings).value();
  EXPECT_EQ(registration.views[2].fit, ViewFit::kDoesNotFit);
  for (const std::size_t i : {0U, 1U, 3U}) {
    EXPECT_EQ(registration.views[i].fit, ViewFit::kFits);
    EXPECT_LT(registration.views[i].residual_mm, 0.2);
  }
}

TEST(RegisterViews, RefusesToMoveAViewBeyondTheLimit) {
  auto clouds = seen_by(small_ring(4), 1.0e-6);
  RigidTransform shift = RigidTransform::Identity();
  shift.translation() = Vector3d(0, 0, 18);
  clouds[1] = moved_by(shift, clouds[1]);
  RegistrationSettings settings;
  settings.most_shift_mm = 6.0;
  const auto registration = register_views(clouds, settings).value();
  EXPECT_EQ(registration.views[1].fit, ViewFit::kDoesNotFit);
}

TEST(RegisterViews, LeavesOutAViewThatWouldHaveToBeStretchedTooFar) {
  auto clouds = seen_by(small_ring(4), 1.0e-6);
  clouds[1] = larger_by(0.06, clouds[1]);
  const auto registration = register_views(clouds).value();
  EXPECT_EQ(registration.views[1].fit, ViewFit::kDoesNotFit);
  EXPECT_EQ(registration.views[1].deeper, 0.0);
  for (const std::size_t i : {0U, 2U, 3U}) {
    EXPECT_EQ(registration.views[i].fit, ViewFit::kFits);
    EXPECT_LT(std::abs(registration.views[i].deeper), 1e-3);
  }
}

/// A few matches with what only happens to lie near would move it, and its neighbours with it.
TEST(RegisterViews, DoesNotMoveAViewThatSharesHardlyAnything) {
  auto clouds = seen_by(small_ring(4), 1.0e-6);
  RigidTransform aside = RigidTransform::Identity();
  aside.translation() = Vector3d(0, 0, 80);
  clouds[3] = moved_by(aside, clouds[3]);
  RegistrationSettings settings;
  settings.least_overlap = 0.3;
  const auto registration = register_views(clouds, settings).value();
  EXPECT_EQ(registration.views[3].fit, ViewFit::kAlone);
  EXPECT_GT(registration.views[3].overlap, 0.0);
  EXPECT_TRUE(registration.views[3].correction.isApprox(RigidTransform::Identity()));
  EXPECT_FALSE(registration.views[3].errors.empty());
  for (const std::size_t i : {0U, 1U, 2U}) {
    EXPECT_LT(registration.views[i].correction.translation().norm(), 0.2) << i;
  }
}

TEST(RegisterViews, TellsNoErrorsOfAViewThatShowsNothing) {
  auto clouds = seen_by(small_ring(4), 1.0e-6);
  clouds[2].cloud = {};
  const auto registration = register_views(clouds).value();
  EXPECT_TRUE(registration.views[2].errors.empty());
  EXPECT_FALSE(registration.views[1].errors.empty());
}

TEST(RegisterViews, SaysWhichViewsShareNothing) {
  auto clouds = seen_by(small_ring(4), 1.0e-6);
  RigidTransform away = RigidTransform::Identity();
  away.translation() = Vector3d(3000, 0, 0);
  clouds[3] = moved_by(away, clouds[3]);
  clouds.push_back({});
  const auto registration = register_views(clouds).value();
  EXPECT_EQ(registration.views[3].fit, ViewFit::kAlone);
  EXPECT_EQ(registration.views[4].fit, ViewFit::kAlone);
  EXPECT_EQ(registration.views[0].fit, ViewFit::kFits);
  EXPECT_NEAR(registration.views[3].correction.translation().norm(), 0.0, 1e-9);
}

TEST(RegisterViews, IsTheSameEveryTime) {
  const auto clouds = seen_by(small_ring(3), 2.9e-6);
  const auto once = register_views(clouds).value();
  const auto again = register_views(clouds).value();
  for (std::size_t i = 0; i < clouds.size(); ++i) {
    EXPECT_EQ(once.views[i].correction.matrix(), again.views[i].correction.matrix());
  }
}

TEST(RegisterViews, BearsOneViewAndNone) {
  EXPECT_TRUE(register_views({})->views.empty());
  EXPECT_EQ(register_views(seen_by(small_ring(1), 0))->views[0].fit, ViewFit::kAlone);
}

}  // namespace
}  // namespace instep
