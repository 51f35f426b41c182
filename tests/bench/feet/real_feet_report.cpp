#include "tests/bench/feet/real_feet_report.h"

#include <fmt/core.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/foot/alignment.h"
#include "core/foot/landmarks.h"
#include "core/foot/measures.h"
#include "core/foot/measures/foot_tapes.h"
#include "core/geometry/mesh_sampling.h"
#include "core/median.h"
#include "tests/bench/feet/thread_time.h"
#include "tests/support/cases/point_patterns.h"
#include "tests/support/foot_body.h"
#include "tests/support/places.h"
#include "tests/support/shape_files.h"

namespace instep::bench {
namespace {

using Eigen::Vector3d;

struct Measured {
  FootScan foot;
  MeasureSet set;
};

Result<Measured> measured(const PointCloud& cloud) {
  auto foot = align_foot(cloud).and_then(find_landmarks);
  if (!foot) return tl::make_unexpected(foot.error());
  auto set = measure_foot(*foot);
  if (!set) return tl::make_unexpected(set.error());
  return Measured{*std::move(foot), *std::move(set)};
}

PointCloud turned(const PointCloud& cloud, double angle, const Vector3d& axis,
                  const Vector3d& shift) {
  RigidTransform move(Eigen::AngleAxisd(angle, axis.normalized()));
  move.pretranslate(shift);
  return transformed(move, cloud);
}

PointCloud noisy(PointCloud cloud, double sigma_mm, std::uint64_t seed) {
  cloud.normals.clear();
  return test::with_isotropic_noise(std::move(cloud), sigma_mm, seed);
}

struct Variant {
  std::string name;
  PointCloud cloud;
};

std::vector<Variant> variants_of(const PointCloud& cloud) {
  const Vector3d up = Vector3d::UnitZ();
  return {{"turned on the floor", turned(cloud, 2.1, up, {300, -200, 0})},
          {"tipped over", turned(cloud, 1.9, {1, 2, 0.5}, {10, 20, 30})},
          {"upside down", turned(cloud, 3.1, {1, 0.2, 0}, {0, 0, 0})},
          {"mirrored", test::mirrored(cloud)},
          {"first half", test::half_of(cloud, 0)},
          {"second half", test::half_of(cloud, 1)},
          {"noise 0.5 mm", noisy(cloud, 0.5, 1)},
          {"noise 0.5 mm again", noisy(cloud, 0.5, 2)}};
}

void report_moves(const std::string& name, const PointCloud& cloud) {
  const auto plain = measured(cloud);
  if (!plain) {
    fmt::print("{}: {}\n", name, plain.error().line());
    return;
  }
  fmt::print("\n{}: {} {:.2f}, {} points\n", name, to_string(plain->foot.side),
             plain->foot.side_confidence, cloud.size());
  for (const auto& one : plain->set.withheld) fmt::print("  {}: {}\n", one.id, one.reason);
  std::map<std::string, std::pair<double, std::string>> largest;
  for (const auto& variant : variants_of(cloud)) {
    const auto moved = measured(variant.cloud);
    if (!moved) {
      fmt::print("  {}: {}\n", variant.name, moved.error().line());
      continue;
    }
    const bool other = variant.name == "mirrored";
    if ((moved->foot.side == plain->foot.side) == other) {
      fmt::print("  {}: wrong side\n", variant.name);
    }
    for (const auto& one : moved->set.withheld) {
      if (plain->set.find(one.id)) fmt::print("  {}: {}: {}\n", variant.name, one.id, one.reason);
    }
    for (const auto& measure : plain->set.measures) {
      const Measure* same = moved->set.find(measure.id);
      const double move = same ? std::abs(same->value() - measure.value()) : INFINITY;
      auto& worst = largest[measure.id];
      if (move >= worst.first) worst = {move, variant.name};
    }
  }
  for (const auto& measure : plain->set.measures) {
    const auto& [move, where] = largest[measure.id];
    fmt::print("  {:<26}{:>9.2f} +-{:<6.2f} moves {:>6.2f}  {}\n", measure.id, measure.value(),
               measure.u95().value_or(NAN), move, where);
  }
}

std::optional<std::filesystem::path> trial_folder(const char* name) {
  const auto folder = test::trial_data() / name;
  if (std::filesystem::exists(folder)) return folder;
  fmt::print("no trial data: {}\n", name);
  return std::nullopt;
}

/// By how much the medial end of a plane lies in front of the lateral one, seen from above. `plane`
/// is in the foot's frame.
double slant_deg(const TapePlane& plane, const FootScan& foot) {
  const Vector3d normal = plane.normal();
  return -foot.medial_sign() * std::atan(normal.y() / normal.x()) * 180.0 / M_PI;
}

/// How far a plane is from another: the largest distance of its landmarks, on the floor.
double distance_of_planes(const TapePlane& plane, const TapePlane& known) {
  double most = 0.0;
  for (int i = 0; i < 2; ++i) {
    most = std::max(most,
                    std::abs(known.distance(plane.control_points()[static_cast<std::size_t>(i)])));
  }
  return most;
}

}  // namespace

void report_real_feet() {
  const auto folder = trial_folder("feet");
  if (!folder) return;
  report_moves("lab_left.ply", test::read_shape(*folder / "lab_left.ply").cloud);
  for (const char* name : {"retail_left.stl", "retail_right.stl"}) {
    report_moves(name, test::read_shape(*folder / name, 1000.0).cloud);
  }
}

void report_lasts() {
  const auto folder = trial_folder("lasts");
  if (!folder) return;
  const auto known = test::known_sections("lasts");
  for (const char* name : {"Donna_STD_38_T30.ply", "Uomo_STD_T10_42.ply", "Uomo_STD_T25_43.ply"}) {
    const auto last = measured(test::read_shape(*folder / name).cloud);
    if (!last) {
      fmt::print("{}: {}\n", name, last.error().line());
      continue;
    }
    fmt::print("\n{}: {} {:.2f}\n", name, to_string(last->foot.side), last->foot.side_confidence);
    for (const auto& warning : last->foot.warnings) fmt::print("  {}\n", warning);
    for (const auto& measure : last->set.measures) {
      fmt::print("  {:<26}{:>9.2f} +-{:.2f}", measure.id, measure.value(),
                 measure.u95().value_or(NAN));
      for (const auto& section : known) {
        if (section.file != name || section.name + "_girth" != measure.id) continue;
        const auto plane = measure.plane->transformed(last->foot.foot_from_input.inverse());
        const Vector3d middle = 0.5 * (plane.control_points()[0] + plane.control_points()[1]);
        fmt::print(
            "  {:.2f} mm from the public plane, of {:.2f}; in the middle {:.2f}; slants {:.0f}, "
            "{:.0f}",
            distance_of_planes(plane, section.plane), section.stretched_mm,
            std::abs(section.plane.distance(middle)), slant_deg(*measure.plane, last->foot),
            slant_deg(section.plane.transformed(last->foot.foot_from_input), last->foot));
      }
      fmt::print("\n");
    }
    for (const auto& one : last->set.withheld) fmt::print("  {}: {}\n", one.id, one.reason);
  }
}

void report_time() {
  const auto folder = trial_folder("feet");
  if (!folder) return;
  const auto mesh = test::read_shape(*folder / "retail_left.stl", 1000.0).mesh;
  const PointCloud cloud = test::points_on(mesh, 50000, 0.3, 1);
  std::vector<double> align, whole;
  for (int run = 0; run < 7; ++run) {
    const double start = thread_milliseconds();
    const auto foot = align_foot(cloud).and_then(find_landmarks);
    const double found = thread_milliseconds();
    if (!foot || !measure_foot(*foot)) {
      fmt::print("the cloud cannot be measured\n");
      return;
    }
    align.push_back(found - start);
    whole.push_back(thread_milliseconds() - start);
  }
  fmt::print("\n50000 points, processor time: landmarks {:.0f} ms, the whole {:.0f} ms (bar 300)\n",
             median(align), median(whole));
}

}  // namespace instep::bench
