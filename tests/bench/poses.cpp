// How well measures hold where cameras do not stand where they are said to, or do not see right:
// simulated feet, four cameras, the given poses trusted or refined.
#include <fmt/core.h>

#include <CLI/CLI.hpp>
#include <cmath>
#include <map>
#include <numbers>
#include <string>
#include <vector>

#include "daemon/scan/scan_pipeline.h"
#include "sim/simulated_station.h"
#include "tests/support/bent_capture.h"
#include "tests/support/random_numbers.h"
#include "tests/support/simulated_scan.h"

namespace {

using namespace instep;

constexpr double kDegreesAMillimetre = 0.1;

struct Wishes {
  int feet = 16;
  int cameras = 4;
  bool two_feet = false;
  bool bad_sensor = false;
};

/// What is wrong with each camera, one sigma.
struct Fault {
  std::string name;
  double shift_mm = 0.0;  ///< each axis; with it a turn of kDegreesAMillimetre
  double lens = 0.0;      ///< share of the focal length and, by another draw, of the depth
  test::BentCamera bent{};
};

Result<test::SimulatedScan> scan_of(int seed, const Wishes& wishes) {
  SimulationSettings settings;
  settings.seed = static_cast<std::uint64_t>(seed);
  settings.side = seed % 2 == 0 ? Side::kLeft : Side::kRight;
  if (wishes.two_feet) settings.subject = Subject::kFeet;
  settings.cameras = wishes.cameras;
  settings.width_px = 320;
  settings.height_px = 240;
  if (wishes.bad_sensor) settings.noise = NoiseLaw::kPessimistic;
  return test::scan_of(settings);
}

void spoil(const Fault& fault, int seed, Capture& capture) {
  if (fault.bent.sigma_mm > 0.0) {
    test::bend_depths(fault.bent, static_cast<std::uint64_t>(seed) + 2000, capture);
  }
  test::RandomNumbers random(static_cast<std::uint64_t>(seed) + 1000);
  const auto draw = [&random](double sigma) {
    Eigen::Vector3d vector;
    for (double& part : vector) part = sigma * random.normal();
    return vector;
  };
  for (auto& camera : capture.cameras) {
    const Eigen::Vector3d turn =
        draw(fault.shift_mm * kDegreesAMillimetre * std::numbers::pi / 180.0);
    RigidTransform off = RigidTransform::Identity();
    if (turn.norm() > 0.0) {
      off.linear() = Eigen::AngleAxisd(turn.norm(), turn.normalized()).toRotationMatrix();
    }
    off.translation() = draw(fault.shift_mm);
    camera.geometry.station_from_camera = off * camera.geometry.station_from_camera;
    const double focal = 1.0 + fault.lens * random.normal();
    const double depth = 1.0 + fault.lens * random.normal();
    camera.geometry.intrinsics.fx *= focal;
    camera.geometry.intrinsics.fy *= focal;
    for (auto& frame : capture.frames) {
      if (frame.camera == camera.geometry.id) frame.depth_unit_mm *= depth;
    }
  }
}

/// What became of many scans.
struct Tally {
  int refused = 0;
  int measures = 0;
  int held = 0;
  int girths = 0;
  double squares = 0.0;  ///< of the errors of the ball girth

  void add(const Result<std::vector<ScanRecord>>& records, const test::SimulatedScan& scan) {
    if (!records || records->size() != scan.truth.size()) {
      ++refused;
      return;
    }
    for (std::size_t foot = 0; foot < records->size(); ++foot) {
      add((*records)[foot].measures, scan.truth[foot].measures);
    }
  }

  void add(const MeasureSet& set, const std::map<std::string, double>& truth) {
    measures += test::number_known(set, truth);
    held += test::number_held(set, truth);
    const Measure* girth = set.find("ball_girth");
    if (girth == nullptr || !girth->u95()) return;
    ++girths;
    squares += std::pow(girth->value() - truth.at("ball_girth"), 2);
  }

  std::string line() const {
    if (measures == 0) return fmt::format("{:>9}{:>10}{:>12}", refused, "-", "-");
    return fmt::format("{:>9}{:>8.1f} %{:>9.2f} mm", refused, 100.0 * held / measures,
                       girths > 0 ? std::sqrt(squares / girths) : 0.0);
  }
};

void report(const Fault& fault, const std::vector<test::SimulatedScan>& scans) {
  Tally tallies[2];
  for (std::size_t i = 0; i < scans.size(); ++i) {
    test::SimulatedScan scan = scans[i];
    spoil(fault, static_cast<int>(i), scan.capture);
    for (const bool refine : {false, true}) {
      PipelineSettings settings;
      settings.refine_views = refine;
      tallies[refine ? 1 : 0].add(measure_capture(scan.capture, settings, {}), scan);
    }
  }
  fmt::print("{:<22}{}  |{}\n", fault.name, tallies[0].line(), tallies[1].line());
  std::fflush(stdout);
}

}  // namespace

int main(int count, char** words) {
  CLI::App app(
      "Measures of simulated feet by cameras that do not stand where they are said to, or whose\n"
      "lenses are off, or whose depths are bent (a standard deviation at half a metre, alike in\n"
      "pixels so near to each other)");
  Wishes wishes;
  app.add_option("--feet", wishes.feet, "How many feet, or people")->capture_default_str();
  app.add_option("--cameras", wishes.cameras, "How many cameras round them")->capture_default_str();
  app.add_flag("--two-feet", wishes.two_feet, "Both feet of each person at once");
  app.add_flag("--bad-sensor", wishes.bad_sensor, "With 1.2 mm of noise in place of 0.4");
  CLI11_PARSE(app, count, words);
  std::vector<test::SimulatedScan> scans;
  for (int seed = 1; seed <= wishes.feet; ++seed) {
    if (auto scan = scan_of(seed, wishes)) scans.push_back(std::move(*scan));
  }
  fmt::print("refused scans, measures within their interval, ball girth's error (RMS)\n");
  fmt::print("{:<22}{:^32} | {:^32}\n", "off by", "poses trusted", "poses refined");
  for (const auto& fault :
       {Fault{"nothing"}, Fault{"0.1 mm, 0.01 deg", 0.1}, Fault{"0.25 mm, 0.025 deg", 0.25},
        Fault{"0.5 mm, 0.05 deg", 0.5}, Fault{"1 mm, 0.1 deg", 1.0}, Fault{"4 mm, 0.4 deg", 4.0},
        Fault{"lens, depth 0.1 %", 0.0, 1e-3}, Fault{"lens, depth 0.3 %", 0.0, 3e-3},
        Fault{"bent 0.1 mm, 4 px", 0.0, 0.0, {0.1, 4.0}},
        Fault{"bent 0.2 mm, 2 px", 0.0, 0.0, {0.2, 2.0}},
        Fault{"bent 0.2 mm, 4 px", 0.0, 0.0, {0.2, 4.0}},
        Fault{"bent 0.2 mm, 12 px", 0.0, 0.0, {0.2, 12.0}},
        Fault{"bent 0.4 mm, 4 px", 0.0, 0.0, {0.4, 4.0}}}) {
    report(fault, scans);
  }
  return 0;
}
