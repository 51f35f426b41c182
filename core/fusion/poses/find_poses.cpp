#include "core/fusion/poses/find_poses.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "core/degree.h"
#include "core/fusion/poses/registration.h"
#include "core/fusion/poses/rough_placing.h"
#include "core/fusion/poses/seen_object.h"
#include "core/fusion/poses/seen_platform.h"
#include "core/fusion/views/seen_through.h"
#include "core/fusion/views/working_view.h"
#include "core/in_millimetres.h"
#include "core/in_percent.h"
#include "core/mean.h"
#include "core/normal_spread.h"
#include "core/stride.h"

namespace instep {
namespace {

using Eigen::Vector3d;

constexpr std::size_t kPlatformShare = 20;  // one in so many of its points is fitted
constexpr std::size_t kLeastSkin = 100;     // points of an object that is worth placing by
constexpr std::size_t kAskedPoints = 2000;  // of a view, whether others see through them
constexpr std::size_t kPlacedPoints = 200;  // of a view, how well it is known where they are
// When the poses that are found are believed. By eye; it holds for the stations of
// tests/bench/calibration.
constexpr double kSeenThroughMm = 6.0;      // of Witness::judge()
constexpr double kMostContradicted = 0.05;  // share of a view's points that others see through
/// How far the normals of the object's sides must pass by its middle (turning_lever_mm()), as the
/// camera sees it that sees most of that.
constexpr double kLeastLeverMm = 10.0;
constexpr double kMostUnknownMm = 3.0;  // FoundPose::known_to_mm of poses that are of use
/// From here on somebody should hear of it; by a tape cameras are placed to some 20 mm. By eye.
constexpr double kNotableHeightMm = 30.0;
constexpr const char* kObjectAdvice =
    "see that the settings say within 150 mm and 25 degrees where each camera stands, and take "
    "none for another; then stand one thing as large as a foot, such as a last or a shoe and no "
    "box and nothing round, alone in the middle of the platform, where every camera sees its sides";

/// What a view shows near the station, to be fitted to what the others show. Of the platform little
/// is left: the views are level on it already, and many points of it, whose normals are never quite
/// upright, would hold the views where they happen to be.
PosedCloud cloud_of(const WorkingView& view, double platform_height_mm) {
  std::vector<std::uint32_t> pixels;
  std::size_t on_platform = 0;
  visit_pixels(view, 2, [&](std::size_t pixel, const Vector3d& point) {
    const double height = std::abs(point.z() - platform_height_mm);
    if (height > kMostObjectHeightMm || !is_within(point, kObjectRegionMm)) return;
    if (height < kLeastObjectHeightMm && ++on_platform % kPlatformShare != 0) return;
    pixels.push_back(static_cast<std::uint32_t>(pixel));
  });
  return {station_cloud(view, pixels), view.station_from_camera};
}

tl::unexpected<Error> not_found(const std::string& camera, const std::string& why,
                                const std::string& advice = kObjectAdvice) {
  return fail(ErrorCode::kInsufficientData,
              "where camera " + camera + " stands cannot be told: " + why, advice);
}

/// A view of another size, or the wrong way round, fits nowhere either.
tl::unexpected<Error> does_not_fit(const std::string& camera) {
  return not_found(camera, "what it sees does not fit what the others see",
                   kObjectAdvice + ("; and see that the lens and the depth unit of camera " +
                                    camera + " are its own, and its image is not mirrored"));
}

tl::unexpected<Error> too_round() {
  return fail(ErrorCode::kInsufficientData,
              "what stands on the platform is too round: how the cameras stand about it cannot be "
              "told",
              "stand a last or a shoe there in its place");
}

/// The views on their way to their poses.
class PoseSearch {
 public:
  PoseSearch(const PoseFinding& settings, const GoOn& go_on) : settings_(settings), go_on_(go_on) {}

  Result<void> open(const std::vector<View>& views, const Workers& workers) {
    std::vector<std::optional<Result<WorkingView>>> opened(views.size());
    workers(views.size(), [&](std::size_t i) { opened[i] = open_view(views[i]); });
    for (auto& view : opened) {
      if (!*view) return tl::make_unexpected(view->error());
      views_.push_back(std::move(**view));
      given_.push_back(views_.back().station_from_camera);
      found_.cameras.emplace_back();
    }
    return go_on_() ? Result<void>{} : cancelled();
  }

  Result<void> level_each() {
    bool is_any_level = false;
    for (std::size_t i = 0; i < views_.size(); ++i) {
      const auto platform = seen_platform({&views_[i]}, height());
      found_.cameras[i].is_level = platform.has_value();
      if (platform) move(i, onto_platform(*platform, height()));
      is_any_level = is_any_level || platform.has_value();
      if (!go_on_()) return cancelled();
    }
    if (is_any_level) return {};
    return fail(ErrorCode::kInsufficientData, "no camera sees the platform",
                "see that the platform is in view round the object, and that the poses in the "
                "settings are right within 150 mm and 25 degrees");
  }

  Result<void> place_each(const Workers& workers) {
    std::vector<LevelView> level;
    double lever_mm = 0.0;
    for (const auto& view : views_) {
      level.push_back({view.posed(), skin_of(view)});
      if (level.back().skin.size() < kLeastSkin) {
        return not_found(view.id, "it sees nothing that stands on the platform");
      }
      lever_mm = std::max(lever_mm, turning_lever_mm(level.back().skin));
    }
    if (lever_mm < kLeastLeverMm) return too_round();
    const auto moves = place_roughly(level, workers, go_on_);
    if (!moves) return tl::make_unexpected(moves.error());
    for (std::size_t i = 0; i < views_.size(); ++i) move(i, (*moves)[i]);
    return {};
  }

  Result<void> fit_to_each_other() {
    RegistrationSettings registering;
    registering.are_poses_rough = true;
    registering.expected.pose_mm = 200.0;  // as if nothing were known
    registering.expected.pose_deg = 30.0;
    std::vector<PosedCloud> clouds;
    for (const auto& view : views_) clouds.push_back(cloud_of(view, height()));
    registering.normal_variance = variance_of_level_normals(clouds, height(), kLeastObjectHeightMm);
    const auto registration = register_views(clouds, registering, go_on_);
    if (!registration) return tl::make_unexpected(registration.error());
    for (std::size_t i = 0; i < views_.size(); ++i) {
      const auto& view = registration->views[i];
      if (view.fit == ViewFit::kDoesNotFit || view.fit == ViewFit::kAlone) {
        return does_not_fit(views_[i].id);
      }
      move(i, view.unstretched_correction);
      views_[i].errors = view.errors;
      found_.cameras[i].overlap = view.overlap;
      found_.cameras[i].apart_mm = view.residual_mm;
      found_.cameras[i].stretch = std::max(std::abs(view.deeper), std::abs(view.wider));
    }
    found_.unexplained_mm = registration->unexplained_after_mm;
    return {};
  }

  /// Where all together show no plane, each lies as level as it was laid.
  void level_together() {
    std::vector<const WorkingView*> level;
    for (std::size_t i = 0; i < views_.size(); ++i) {
      if (found_.cameras[i].is_level) level.push_back(&views_[i]);
    }
    const auto platform = seen_platform(level, height());
    if (!platform) return;
    for (std::size_t i = 0; i < views_.size(); ++i) move(i, onto_platform(*platform, height()));
  }

  /// Turn about z and place along the platform are free: no camera tells them.
  void stay_where_they_were() {
    Eigen::Vector2d turn = Eigen::Vector2d::Zero();
    Vector3d from = Vector3d::Zero();
    Vector3d to = Vector3d::Zero();
    for (std::size_t i = 0; i < views_.size(); ++i) {
      const Eigen::Matrix3d back =
          given_[i].linear() * views_[i].station_from_camera.linear().transpose();
      turn += Eigen::Vector2d(back(0, 0) + back(1, 1), back(1, 0) - back(0, 1));
      from += views_[i].station_from_camera.translation();
      to += given_[i].translation();
    }
    RigidTransform common = RigidTransform::Identity();
    common.linear() =
        Eigen::AngleAxisd(std::atan2(turn.y(), turn.x()), Vector3d::UnitZ()).toRotationMatrix();
    common.translation() = (to - common.linear() * from) / static_cast<double>(views_.size());
    common.translation().z() = 0.0;
    for (std::size_t i = 0; i < views_.size(); ++i) move(i, common);
  }

  Result<void> check() {
    for (std::size_t i = 0; i < views_.size(); ++i) {
      auto& camera = found_.cameras[i];
      warn_of(i);
      if (views_.size() == 1) continue;
      camera.known_to_mm = unknown_of(i);
      if (contradicted_share(i) > kMostContradicted) {
        return not_found(views_[i].id, "other cameras see through what it shows");
      }
      if (!(*camera.known_to_mm <= kMostUnknownMm)) {
        return not_found(views_[i].id,
                         "it shares too little of the object with the others, and could stand "
                         "elsewhere by " +
                             in_millimetres(*camera.known_to_mm));
      }
    }
    warn_of_height();
    return {};
  }

  FoundPoses found() {
    for (std::size_t i = 0; i < views_.size(); ++i) {
      auto& camera = found_.cameras[i];
      camera.station_from_camera = views_[i].station_from_camera;
      const RigidTransform way = camera.station_from_camera * given_[i].inverse();
      camera.moved_mm = (camera.station_from_camera.translation() - given_[i].translation()).norm();
      camera.turned_deg = Eigen::AngleAxisd(way.linear()).angle() / kDegree;
    }
    return std::move(found_);
  }

 private:
  double height() const { return settings_.platform_height_mm; }

  /// What a view shows of the object, with normals.
  PointCloud skin_of(const WorkingView& view) const {
    return station_cloud(view, object_pixels(view, height()));
  }

  void move(std::size_t view, const RigidTransform& new_from_old) {
    views_[view].station_from_camera = new_from_old * views_[view].station_from_camera;
  }

  /// Of its points of the object, the share that another view sees through.
  double contradicted_share(std::size_t view) const {
    ViewedCloud asked;
    const auto skin = object_points(views_[view], height());
    asked.cloud.positions = one_in(stride_to_at_most(kAskedPoints, skin.size()), skin);
    asked.views.assign(asked.cloud.size(), static_cast<std::uint16_t>(view));
    std::vector<PosedDepth> posed;
    for (const auto& other : views_) posed.push_back(other.posed());
    const auto kept = points_not_seen_through(asked, posed, kSeenThroughMm);
    return asked.cloud.empty()
               ? 0.0
               : 1.0 - static_cast<double>(kept.size()) / static_cast<double>(asked.cloud.size());
  }

  /// How far a view may put the object from where all together put it, 95 %. What the fit tells of
  /// its lens is not mended here, and stands aside.
  double unknown_of(std::size_t view) const {
    const auto points = object_points(views_[view], height());
    if (points.empty() || views_[view].errors.empty()) {
      return std::numeric_limits<double>::infinity();
    }
    const Vector3d middle = mean_of(points);
    const std::size_t stride = stride_to_at_most(kPlacedPoints, points.size());
    double known = 0.0;
    double stretched = 0.0;
    double asked = 0.0;
    for (std::size_t at = 0; at < points.size(); at += stride) {
      known += variance_at(points[at], view);
      stretched += std::pow(found_.cameras[view].stretch, 2) * (points[at] - middle).squaredNorm();
      asked += 1.0;
    }
    return kDeviations * std::sqrt((known + stretched) / asked);
  }

  /// Of where a view puts a place against the mean of all views, which moves with the station.
  double variance_at(const Vector3d& place, std::size_t view) const {
    double sum = 0.0;
    for (std::size_t error = 0; error < views_[view].errors.size(); ++error) {
      Vector3d mean = Vector3d::Zero();
      for (const auto& other : views_) mean += moved_by(other, error, place);
      mean /= static_cast<double>(views_.size());
      sum += (moved_by(views_[view], error, place) - mean).squaredNorm();
    }
    return sum;
  }

  static Vector3d moved_by(const WorkingView& view, std::size_t error, const Vector3d& place) {
    const Vector3d own = view.station_from_camera.inverse() * place;
    return view.station_from_camera.linear() * (view.errors[error] * own.homogeneous());
  }

  void warn_of(std::size_t view) {
    const auto& camera = found_.cameras[view];
    const std::string name = "camera " + views_[view].id;
    if (!camera.is_level) {
      found_.warnings.push_back(name +
                                " does not see the platform: its tilt and height are by "
                                "what it shares with the others");
    }
    if (views_[view].depth.moved) {
      found_.warnings.push_back("what " + name + " sees moved by " +
                                in_millimetres(views_[view].depth.movement_mm) +
                                " while it was read: calibrate again, and let nobody touch the "
                                "object or the station");
    }
    if (camera.stretch > kNotableStretch) {
      found_.warnings.push_back("what " + name + " sees comes out wrong by " +
                                in_percent(camera.stretch) +
                                " of its size: calibrate its lens and its depth");
    }
  }

  /// A plane that lies elsewhere than the platform was said to, from where all cameras are.
  void warn_of_height() {
    double mean_mm = 0.0;
    for (std::size_t i = 0; i < views_.size(); ++i) {
      mean_mm += (views_[i].station_from_camera.translation().z() - given_[i].translation().z()) /
                 static_cast<double>(views_.size());
    }
    if (std::abs(mean_mm) < kNotableHeightMm) return;
    found_.warnings.push_back(
        "the cameras stand " + in_millimetres(std::abs(mean_mm)) +
        (mean_mm > 0.0 ? " higher" : " lower") +
        " above the platform than they were said to: if they do not, something else that is level "
        "was taken for it, such as the floor; let nothing but the platform be in view");
  }

  const PoseFinding& settings_;
  const GoOn& go_on_;
  std::vector<WorkingView> views_;
  std::vector<RigidTransform> given_;
  FoundPoses found_;
};

}  // namespace

Result<FoundPoses> find_poses(const std::vector<View>& views, const PoseFinding& settings,
                              const Workers& workers, const GoOn& go_on) {
  if (views.empty()) {
    return fail(ErrorCode::kInvalidInput, "there is no camera to calibrate",
                "see that the settings or the recording have one");
  }
  PoseSearch search(settings, go_on);
  if (auto good = search.open(views, workers); !good) return tl::make_unexpected(good.error());
  if (auto good = search.level_each(); !good) return tl::make_unexpected(good.error());
  if (views.size() > 1) {
    if (auto good = search.place_each(workers); !good) return tl::make_unexpected(good.error());
    if (auto good = search.fit_to_each_other(); !good) return tl::make_unexpected(good.error());
  }
  search.level_together();
  search.stay_where_they_were();
  if (auto good = search.check(); !good) return tl::make_unexpected(good.error());
  return search.found();
}

}  // namespace instep
