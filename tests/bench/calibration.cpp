// How well cameras are found from rough poses: what simulated stations show of one object.
#include <fmt/core.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <chrono>
#include <cmath>
#include <numbers>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/fusion/poses/find_poses.h"
#include "daemon/scan/camera_images.h"
#include "sim/simulated_station.h"
#include "tests/support/random_numbers.h"
#include "tests/support/simulated_capture.h"

namespace {

using namespace instep;
using Eigen::Vector3d;

/// Wrong by more is no pose that scans could refine.
constexpr double kWrongMm = 4.0;

struct Wishes {
  int objects = 8;
  int width_px = 320;
  bool verbose = false;
};

struct Case {
  Subject subject = Subject::kFoot;
  std::string name;
  int cameras = 4;
  double shift_mm = 0.0;  ///< of each camera, from where it is said to stand
  double turn_deg = 0.0;
  double lens = 0.0;  ///< one sigma, share of the focal length and, by another draw, of the depth
  NoiseLaw noise = NoiseLaw::kTypical;
};

struct Station {
  std::vector<View> views;  ///< by poses that are off
  std::vector<RigidTransform> truth;
  std::vector<Vector3d> seen;  ///< by what each multiplies the coordinates of what it sees
};

std::optional<Station> station_of(const Case& wanted, int seed, int width_px) {
  SimulationSettings settings;
  settings.seed = static_cast<std::uint64_t>(seed);
  settings.subject = wanted.subject;
  settings.cameras = wanted.cameras;
  settings.width_px = width_px;
  settings.height_px = width_px * 3 / 4;
  settings.noise = wanted.noise;
  settings.pacing = Pacing::kAsFastAsPossible;
  auto simulated = build_station(settings);
  if (!simulated) return std::nullopt;
  auto capture = test::capture_of(*simulated);
  if (!capture) return std::nullopt;
  test::RandomNumbers random(settings.seed + 1000);
  const auto direction = [&random] {
    return Vector3d(random.normal(), random.normal(), random.normal()).normalized();
  };
  Station station;
  for (auto& camera : capture->cameras) {
    auto& [id, lens, pose] = camera.geometry;
    station.truth.push_back(pose);
    pose.linear() =
        Eigen::AngleAxisd(wanted.turn_deg * std::numbers::pi / 180.0, direction()) * pose.linear();
    pose.translation() += wanted.shift_mm * direction();
    const double focal = 1.0 + wanted.lens * random.normal();
    const double depth = 1.0 + wanted.lens * random.normal();
    station.seen.emplace_back(depth / focal, depth / focal, depth);
    lens.fx *= focal;
    lens.fy *= focal;
    for (auto& frame : capture->frames) {
      if (frame.camera == id) frame.depth_unit_mm *= depth;
    }
  }
  auto images = camera_images(*capture, always);
  if (!images) return std::nullopt;
  station.views = views_of(*capture, std::move(*images));
  return station;
}

/// How far each camera puts a foot from where all together put it, root mean square.
std::vector<double> off_of_each(const FoundPoses& found, const Station& station) {
  const auto& truth = station.truth;
  std::vector<double> squares(truth.size(), 0.0);
  constexpr double kPlaces = 8.0;
  for (const double x : {-110.0, 110.0}) {
    for (const double y : {-40.0, 40.0}) {
      for (const double z : {0.0, 70.0}) {
        std::vector<Vector3d> put;
        Vector3d mean = Vector3d::Zero();
        for (std::size_t i = 0; i < truth.size(); ++i) {
          const Vector3d own = truth[i].inverse() * Vector3d(x, y, z);
          put.push_back(found.cameras[i].station_from_camera * own.cwiseProduct(station.seen[i]));
          mean += put.back() / static_cast<double>(truth.size());
        }
        for (std::size_t i = 0; i < put.size(); ++i) squares[i] += (put[i] - mean).squaredNorm();
      }
    }
  }
  for (double& square : squares) square = std::sqrt(square / kPlaces);
  return squares;
}

void report(const Case& wanted, const Wishes& wishes) {
  int refused = 0;
  int wrong = 0;
  std::size_t held = 0;
  std::vector<double> offs;
  std::vector<double> times_ms;
  for (int seed = 1; seed <= wishes.objects; ++seed) {
    const auto station = station_of(wanted, seed, wishes.width_px);
    if (!station) continue;
    const auto begin = std::chrono::steady_clock::now();
    const auto found = find_poses(station->views);
    times_ms.push_back(
        std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - begin)
            .count());
    if (!found) {
      ++refused;
      if (wishes.verbose) fmt::print("  {}: {}\n", seed, found.error().message);
      continue;
    }
    const auto own = off_of_each(*found, *station);
    if (*std::max_element(own.begin(), own.end()) > kWrongMm) ++wrong;
    for (std::size_t i = 0; i < own.size(); ++i) {
      if (own[i] <= *found->cameras[i].known_to_mm) ++held;
      offs.push_back(own[i]);
    }
  }
  std::sort(offs.begin(), offs.end());
  std::sort(times_ms.begin(), times_ms.end());
  fmt::print("{:<34}{:>8}{:>7}", wanted.name, refused, wrong);
  if (offs.empty()) {
    fmt::print("{:>10}{:>10}{:>8}", "-", "-", "-");
  } else {
    fmt::print("{:>10.2f}{:>10.2f}{:>6.0f} %", offs[offs.size() / 2], offs.back(),
               100.0 * static_cast<double>(held) / static_cast<double>(offs.size()));
  }
  fmt::print("{:>9.0f}\n", times_ms.empty() ? 0.0 : times_ms[times_ms.size() / 2]);
  std::fflush(stdout);
}

}  // namespace

int main(int count, char** words) {
  CLI::App app("Poses of simulated cameras that are found from rough ones, as by instep calibrate");
  Wishes wishes;
  app.add_option("--objects", wishes.objects, "How many of each kind")->capture_default_str();
  app.add_option("--width", wishes.width_px, "Of the depth images, pixels")->capture_default_str();
  app.add_flag("-v,--verbose", wishes.verbose, "Why each was refused");
  CLI11_PARSE(app, count, words);
  fmt::print(
      "off: how far a camera puts the object from where all put it, mm; held: by its 95 %\n");
  fmt::print("{:<34}{:>8}{:>7}{:>10}{:>10}{:>8}{:>9}\n", "cameras off by", "refused", "wrong",
             "median", "worst", "held", "ms");
  for (const auto& wanted :
       {Case{Subject::kLast, "last, 4 cameras: 0", 4, 0.0, 0.0},
        Case{Subject::kLast, "last, 4 cameras: 50 mm, 10 deg", 4, 50.0, 10.0},
        Case{Subject::kLast, "last, 4 cameras: 150 mm, 25 deg", 4, 150.0, 25.0},
        Case{Subject::kFoot, "foot, 4 cameras: 150 mm, 25 deg", 4, 150.0, 25.0},
        Case{Subject::kFoot, "foot, bad sensors: 50 mm, 10 deg", 4, 50.0, 10.0, 0.0,
             NoiseLaw::kPessimistic},
        Case{Subject::kFoot, "foot, lenses 0.2 %: 50 mm, 10 deg", 4, 50.0, 10.0, 2e-3},
        Case{Subject::kFoot, "foot, 6 cameras: 150 mm, 25 deg", 6, 150.0, 25.0},
        Case{Subject::kFoot, "foot, 3 cameras: 50 mm, 10 deg", 3, 50.0, 10.0},
        Case{Subject::kLast, "last, 3 cameras: 50 mm, 10 deg", 3, 50.0, 10.0},
        Case{Subject::kFoot, "foot, 2 cameras: 20 mm, 4 deg", 2, 20.0, 4.0},
        Case{Subject::kFeet, "two feet, 4 cameras: 50 mm, 10 deg", 4, 50.0, 10.0},
        Case{Subject::kCylinder, "cylinder, 4 cameras: 50 mm, 10 deg", 4, 50.0, 10.0}}) {
    report(wanted, wishes);
  }
  return 0;
}
