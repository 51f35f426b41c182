#include "core/fusion/find_poses.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <optional>
#include <utility>

#include "core/fusion/registration.h"
#include "core/fusion/seen_object.h"
#include "core/fusion/seen_through.h"
#include "core/fusion/working_view.h"
#include "core/in_millimetres.h"
#include "core/stride.h"

namespace instep {
namespace {

using Eigen::Vector3d;

constexpr double kDegree = std::numbers::pi / 180.0;
constexpr int kStride = 3;                  // every so many pixels, both ways
constexpr double kBelowMm = 10.0;           // beyond any noise of a platform
constexpr std::size_t kLeastSkin = 100;     // points of an object that is worth placing by
constexpr std::size_t kAskedPoints = 2000;  // of a view, whether others see through them
constexpr double kTwoSided = 1.96;          // 95 %
/// Of exact lenses the fit makes less, see warn_of_wrong_lenses() of pose_check.cpp.
constexpr double kWorthMendingShare = 3e-3;
constexpr const char* kObjectAdvice =
    "stand one thing as large as a foot and not round, such as a last or a shoe, alone in the "
    "middle of the platform, where every camera sees it from its side";

/// No flat top of an object: what a camera sees beside it lies lower.
bool is_lowest(const FoundPlatform& platform, const std::vector<Vector3d>& points) {
  const double reach = 3.0 * platform.scatter_mm + 1.0;
  std::size_t on_it = 0;
  std::size_t below = 0;
  for (const auto& point : points) {
    const double distance = platform.distance(point);
    if (distance < -kBelowMm) ++below;
    if (std::abs(distance) <= reach) ++on_it;
  }
  return below < on_it;
}

std::optional<FoundPlatform> platform_of(const std::vector<const WorkingView*>& views,
                                         const PoseFinding& settings) {
  std::vector<Vector3d> points;
  for (const auto* view : views) {
    visit_pixels(*view, kStride, [&](std::size_t, const Vector3d& point) {
      if (is_within(point, settings.platform_radius_mm)) points.push_back(point);
    });
  }
  PlatformSettings search;
  search.most_tilt_deg = settings.most_tilt_deg;
  const auto platform = find_platform(points, search);
  return platform && is_lowest(*platform, points) ? platform : std::nullopt;
}

/// Level, and at the height that the platform is to have.
RigidTransform onto_platform(const FoundPlatform& platform, const PoseFinding& settings) {
  RigidTransform level = platform.level_from_station();
  level.translation().z() += settings.platform_height_mm - platform.height_mm();
  return level;
}

/// All that a view shows near the station, to be fitted to what the others show.
PosedCloud cloud_of(const WorkingView& view, const PoseFinding& settings) {
  std::vector<std::uint32_t> pixels;
  visit_pixels(view, 2, [&](std::size_t pixel, const Vector3d& point) {
    const double height = std::abs(point.z() - settings.platform_height_mm);
    if (height <= settings.object.most_height_mm &&
        is_within(point, settings.object.region_radius_mm)) {
      pixels.push_back(static_cast<std::uint32_t>(pixel));
    }
  });
  return {station_cloud(view, pixels, settings.surface), view.station_from_camera};
}

tl::unexpected<Error> not_found(const std::string& camera, const std::string& why) {
  return fail(ErrorCode::kInsufficientData,
              "where camera " + camera + " stands cannot be told: " + why, kObjectAdvice);
}

/// The views on their way to their poses.
class PoseSearch {
 public:
  PoseSearch(const PoseFinding& settings, const GoOn& go_on) : settings_(settings), go_on_(go_on) {}

  Result<void> open(const std::vector<View>& views, const Workers& workers) {
    std::vector<std::optional<Result<WorkingView>>> opened(views.size());
    workers(views.size(),
            [&](std::size_t i) { opened[i] = open_view(views[i], settings_.surface); });
    for (auto& view : opened) {
      if (!*view) return tl::make_unexpected(view->error());
      views_.push_back(std::move(**view));
      given_.push_back(views_.back().station_from_camera);
      found_.cameras.emplace_back();
    }
    return go_on_() ? Result<void>{} : cancelled();
  }

  void level_each() {
    for (std::size_t i = 0; i < views_.size(); ++i) {
      const auto platform = platform_of({&views_[i]}, settings_);
      found_.cameras[i].is_level = platform.has_value();
      if (platform) move(i, onto_platform(*platform, settings_));
    }
  }

  Result<void> place_each() {
    std::vector<LevelView> level;
    for (const auto& view : views_) {
      level.push_back({view.posed(), object_points(view, settings_.object, height())});
      if (level.back().skin.size() < kLeastSkin) {
        return not_found(view.id, "it sees nothing that stands on the platform");
      }
    }
    const auto moves = place_roughly(level, settings_.placing, go_on_);
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
    for (const auto& view : views_) clouds.push_back(cloud_of(view, settings_));
    const auto registration = register_views(clouds, registering, go_on_);
    if (!registration) return tl::make_unexpected(registration.error());
    for (std::size_t i = 0; i < views_.size(); ++i) {
      const auto& view = registration->views[i];
      if (view.fit == ViewFit::kDoesNotFit || view.fit == ViewFit::kAlone) {
        return not_found(views_[i].id, "what it sees does not fit what the others see");
      }
      move(i, view.correction);
      views_[i].errors = view.errors;
      found_.cameras[i].overlap = view.overlap;
      found_.cameras[i].apart_mm = view.residual_mm;
      found_.cameras[i].stretch = std::max(std::abs(view.deeper), std::abs(view.wider));
    }
    found_.unexplained_mm = registration->unexplained_after_mm;
    return {};
  }

  void level_together() {
    std::vector<const WorkingView*> all;
    for (const auto& view : views_) all.push_back(&view);
    const auto platform = platform_of(all, settings_);
    if (!platform) {
      found_.warnings.push_back(
          "no camera sees the platform: its tilt and its height are as the "
          "given poses say");
      return;
    }
    for (std::size_t i = 0; i < views_.size(); ++i) move(i, onto_platform(*platform, settings_));
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

  Result<void> check_object() const {
    PointCloud object;
    for (const auto& view : views_) {
      object.append(
          station_cloud(view, object_pixels(view, settings_.object, height()), settings_.surface));
    }
    const double lever_mm = turning_lever_mm(object);
    if (lever_mm >= settings_.least_lever_mm) return {};
    return fail(
        ErrorCode::kInsufficientData,
        "what stands on the platform is too round: how the cameras stand about it cannot be "
        "told",
        kObjectAdvice);
  }

  Result<void> check() {
    const auto unknown_mm = unknown_of_each();
    for (std::size_t i = 0; i < views_.size(); ++i) {
      auto& camera = found_.cameras[i];
      camera.known_to_mm = unknown_mm[i];
      if (contradicted(i) > settings_.most_contradicted) {
        return not_found(views_[i].id, "other cameras see through what it shows");
      }
      if (!(camera.known_to_mm <= settings_.most_unknown_mm)) {
        return not_found(views_[i].id,
                         "it shares too little of the object with the others, and "
                         "could stand elsewhere by " +
                             in_millimetres(camera.known_to_mm));
      }
      warn_of(i);
    }
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

  void move(std::size_t view, const RigidTransform& new_from_old) {
    views_[view].station_from_camera = new_from_old * views_[view].station_from_camera;
  }

  /// Of its points of the object, the share that another view sees through.
  double contradicted(std::size_t view) const {
    ViewedCloud asked;
    const auto skin = object_points(views_[view], settings_.object, height());
    const std::size_t stride = stride_to_at_most(kAskedPoints, skin.size());
    for (std::size_t i = 0; i < skin.size(); i += stride) asked.cloud.positions.push_back(skin[i]);
    asked.views.assign(asked.cloud.size(), static_cast<std::uint16_t>(view));
    std::vector<PosedDepth> posed;
    for (const auto& other : views_) posed.push_back(other.posed());
    const auto kept = points_not_seen_through(asked, posed, settings_.seen_through_mm);
    return asked.cloud.empty()
               ? 0.0
               : 1.0 - static_cast<double>(kept.size()) / static_cast<double>(asked.cloud.size());
  }

  /// How far each view may put the object from where all together put it, 95 %.
  std::vector<double> unknown_of_each() const {
    std::vector<double> unknown(views_.size(), 0.0);
    for (std::size_t i = 0; i < views_.size(); ++i) {
      const auto skin = object_points(views_[i], settings_.object, height());
      const std::size_t stride = stride_to_at_most(settings_.placing.points, skin.size());
      double squares = 0.0;
      double asked = 0.0;
      for (std::size_t at = 0; at < skin.size(); at += stride) {
        squares += variance_at(skin[at], i);
        asked += 1.0;
      }
      unknown[i] = kTwoSided * std::sqrt(squares / std::max(1.0, asked));
    }
    return unknown;
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
    if (camera.stretch > kWorthMendingShare) {
      char share[32];
      std::snprintf(share, sizeof share, "%.1f %%", 100.0 * camera.stretch);
      found_.warnings.push_back("what " + name + " sees comes out wrong by " + share +
                                " of its size: calibrate its lens and its depth");
    }
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
  search.level_each();
  if (views.size() > 1) {
    if (auto good = search.place_each(); !good) return tl::make_unexpected(good.error());
    if (auto good = search.fit_to_each_other(); !good) return tl::make_unexpected(good.error());
    if (auto good = search.check_object(); !good) return tl::make_unexpected(good.error());
  }
  search.level_together();
  search.stay_where_they_were();
  if (auto good = search.check(); !good) return tl::make_unexpected(good.error());
  return search.found();
}

}  // namespace instep
