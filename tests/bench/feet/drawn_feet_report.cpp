#include "tests/bench/feet/drawn_feet_report.h"

#include <fmt/core.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <map>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "core/foot/alignment.h"
#include "core/foot/landmarks.h"
#include "core/foot/measures.h"
#include "tests/bench/feet/girth_parts.h"
#include "tests/bench/feet/thread_time.h"
#include "tests/support/cases/drawn_feet.h"

namespace instep::bench {
namespace {

struct FootOutcome {
  test::DrawnFoot drawn;
  std::string refusal;
  std::optional<FootScan> foot;
  MeasureSet set;
  std::map<std::string, GirthParts> parts;
  double milliseconds = 0.0;
};

FootOutcome measured(std::uint64_t seed, test::SolesSeen soles) {
  FootOutcome outcome{test::draw_scanned_foot(seed, soles), {}, {}, {}, {}, 0.0};
  const double start = thread_milliseconds();
  AlignmentOptions options;
  // An open sole is what a station gives, and a station knows its platform.
  if (!outcome.drawn.sole_is_seen) {
    options.standing_plane =
        StandingPlane{Eigen::Vector3d::UnitZ(), outcome.drawn.input_from_solid.translation().z()};
  }
  const auto foot = align_foot(outcome.drawn.cloud, options).and_then(find_landmarks);
  const auto set = foot ? measure_foot(*foot) : tl::make_unexpected(foot.error());
  outcome.milliseconds = thread_milliseconds() - start;
  if (set) {
    outcome.foot = *foot;
    outcome.set = *set;
    outcome.parts = girth_parts(outcome.drawn, seed, *foot, *set);
  } else {
    outcome.refusal = set.error().line();
  }
  return outcome;
}

std::vector<FootOutcome> measured_feet(const DrawnFeetWishes& wishes) {
  std::vector<FootOutcome> outcomes(wishes.feet);
  const auto soles = wishes.all_open ? test::SolesSeen::kNever : test::SolesSeen::kMostly;
  std::atomic<std::size_t> next = 0;
  std::vector<std::thread> threads;
  for (std::size_t i = 0; i < std::max<std::size_t>(1, wishes.threads); ++i) {
    threads.emplace_back([&] {
      for (std::size_t at = next++; at < outcomes.size(); at = next++) {
        outcomes[at] = measured(wishes.first_seed + at, soles);
      }
    });
  }
  for (auto& thread : threads) thread.join();
  return outcomes;
}

struct Tally {
  std::vector<double> errors;
  std::vector<double> intervals;
  std::size_t held = 0;
  std::size_t withheld = 0;
};

/// What issue and reference ask for; nothing where they ask for no figure.
std::optional<double> bar_of(const std::string& id) {
  if (id == "foot_length") return 0.7;
  const bool is_girth = id.size() > 6 && id.compare(id.size() - 6, 6, "_girth") == 0;
  if (is_girth && id != "ankle_girth") return 1.0;
  return std::nullopt;
}

double quantile(std::vector<double> values, double share) {
  if (values.empty()) return NAN;
  std::sort(values.begin(), values.end());
  return values[static_cast<std::size_t>(share * static_cast<double>(values.size() - 1) + 0.5)];
}

void print_row(const std::string& id, const Tally& tally) {
  const auto count = static_cast<double>(tally.errors.size());
  double mean = 0.0, square = 0.0;
  std::vector<double> sizes;
  for (const double error : tally.errors) {
    mean += error / count;
    sizes.push_back(std::abs(error));
  }
  for (const double error : tally.errors) square += std::pow(error - mean, 2) / count;
  const auto bar = bar_of(id);
  const auto within =
      std::count_if(sizes.begin(), sizes.end(), [&](double size) { return bar && size <= *bar; });
  const auto share = [](auto part, auto whole) {
    return whole > 0 ? fmt::format("{:.1f}",
                                   100.0 * static_cast<double>(part) / static_cast<double>(whole))
                     : std::string("-");
  };
  fmt::print("{:<26}{:>5}{:>5}{:>8.2f}{:>8.2f}{:>8.2f}{:>8.2f}{:>9}{:>8}{:>8}\n", id,
             tally.errors.size(), tally.withheld, mean, std::sqrt(square), quantile(sizes, 0.95),
             quantile(sizes, 1.0), bar ? share(within, sizes.size()) : "",
             share(tally.held, tally.intervals.size()),
             tally.intervals.empty() ? "-" : fmt::format("{:.2f}", quantile(tally.intervals, 0.5)));
}

/// Our names of the landmarks beside the truth's.
const std::map<std::string, std::string>& true_names() {
  static const std::map<std::string, std::string> names{
      {"pternion", "pternion"},       {"acropodion", "acropodion"},
      {"toe2_tip", "toe2"},           {"metatarsale_tibiale", "mt"},
      {"metatarsale_fibulare", "mf"}, {"instep_point", "instep"},
      {"medial_arch", "medial_arch"}, {"lateral_midfoot", "lateral_midfoot"},
      {"heel_point", "heel_point"},   {"junction", "junction"},
      {"arch_point", "arch_point"},   {"medial_malleolus", "medial_malleolus"},
      {"heel_medial", "heel_medial"}, {"heel_lateral", "heel_lateral"},
      {"toe1_tip", "toe1_tip"}};
  return names;
}

struct LandmarkTally {
  std::vector<Eigen::Vector3d> errors;  ///< in the true foot frame
  std::vector<double> radii;
  std::size_t held = 0;
};

void add_to(std::map<std::string, LandmarkTally>& tallies, const FootOutcome& outcome) {
  const FootTruth& truth = outcome.drawn.truth;
  const RigidTransform true_from_found = truth.foot_from_solid *
                                         outcome.drawn.input_from_solid.inverse() *
                                         outcome.foot->foot_from_input.inverse();
  for (const auto& [name, landmark] : outcome.foot->landmarks) {
    const auto known = true_names().find(name);
    if (known == true_names().end()) continue;
    const Eigen::Vector3d error =
        true_from_found * landmark.position_mm - truth.landmarks.at(known->second);
    auto& tally = tallies[name];
    tally.errors.push_back(error);
    if (!landmark.radius_mm) continue;
    tally.radii.push_back(*landmark.radius_mm);
    if (error.norm() <= *landmark.radius_mm) ++tally.held;
  }
}

void print_row(const std::string& name, const LandmarkTally& tally) {
  const auto count = static_cast<double>(tally.errors.size());
  Eigen::Array3d mean = Eigen::Array3d::Zero();
  Eigen::Array3d square = Eigen::Array3d::Zero();
  std::vector<double> distances;
  for (const auto& error : tally.errors) {
    mean += error.array() / count;
    square += error.array().square() / count;
    distances.push_back(error.norm());
  }
  const Eigen::Array3d spread = (square - mean.square()).max(0.0).sqrt();
  fmt::print(
      "{:<26}{:>5}   {:>+6.2f} ({:.2f}) {:>+6.2f} ({:.2f}) {:>+6.2f} "
      "({:.2f}){:>8.2f}{:>8.2f}{:>8.1f}{:>8.2f}\n",
      name, tally.errors.size(), mean.x(), spread.x(), mean.y(), spread.y(), mean.z(), spread.z(),
      quantile(distances, 0.5), quantile(distances, 0.95),
      100.0 * static_cast<double>(tally.held) / static_cast<double>(tally.radii.size()),
      quantile(tally.radii, 0.5));
}

void print_foot(const FootOutcome& outcome, std::uint64_t seed) {
  fmt::print(
      "{} {}: {}\n", seed, outcome.drawn.making,
      outcome.refusal.empty() ? fmt::format("{:.0f} ms", outcome.milliseconds) : outcome.refusal);
  for (const auto& measure : outcome.set.measures) {
    fmt::print("    {:<26}{:>9.2f}{:>+8.2f}  +-{:.2f}\n", measure.id, measure.value(),
               measure.value() - outcome.drawn.truth.measures.at(measure.id),
               measure.u95().value_or(NAN));
  }
  if (outcome.foot) {
    std::map<std::string, LandmarkTally> own;
    add_to(own, outcome);
    for (const auto& [name, tally] : own) {
      const auto& error = tally.errors.front();
      fmt::print("    {:<26}{:>+8.2f}{:>+8.2f}{:>+8.2f}  {:.2f}\n", name, error.x(), error.y(),
                 error.z(), outcome.foot->landmarks.at(name).confidence);
    }
  }
  for (const auto& [id, parts] : outcome.parts) {
    fmt::print("    {:<26} plane{:>+7.2f}  surface{:>+7.2f}\n", id, parts.plane, parts.surface);
  }
  for (const auto& one : outcome.set.withheld) fmt::print("    {}: {}\n", one.id, one.reason);
}

/// Each part as if it were the whole error, of feet whose soles were seen and of those open below.
struct PartTallies {
  Tally plane;
  Tally surface;
};

void add_to(std::map<std::string, PartTallies>& tallies, const FootOutcome& outcome) {
  for (const auto& [id, parts] : outcome.parts) {
    auto& own = tallies[id + (outcome.drawn.sole_is_seen ? ", sole seen" : ", open sole")];
    own.plane.errors.push_back(parts.plane);
    own.surface.errors.push_back(parts.surface);
  }
}

void print_row(const std::string& name, const PartTallies& tallies) {
  const auto part = [](const Tally& tally) {
    double mean = 0.0;
    std::vector<double> sizes;
    double within = 0.0;
    const auto count = static_cast<double>(tally.errors.size());
    for (const double error : tally.errors) {
      mean += error / count;
      sizes.push_back(std::abs(error));
      if (std::abs(error) <= 1.0) within += 100.0 / count;
    }
    return fmt::format("{:>+8.2f}{:>8.2f}{:>8.2f}{:>8.1f}", mean, quantile(sizes, 0.5),
                       quantile(sizes, 0.95), within);
  };
  fmt::print("{:<30}{:>4}{}   {}\n", name, tallies.plane.errors.size(), part(tallies.plane),
             part(tallies.surface));
}

void add_to(std::map<std::string, Tally>& tallies, const FootOutcome& outcome) {
  for (const auto& [id, truth] : outcome.drawn.truth.measures) {
    Tally& tally = tallies[id];
    const Measure* measure = outcome.set.find(id);
    if (measure == nullptr) {
      ++tally.withheld;
      continue;
    }
    const double error = measure->value() - truth;
    tally.errors.push_back(error);
    if (!measure->u95()) continue;
    tally.intervals.push_back(*measure->u95());
    if (std::abs(error) <= *measure->u95()) ++tally.held;
  }
}

}  // namespace

void report_drawn_feet(const DrawnFeetWishes& wishes) {
  const auto outcomes = measured_feet(wishes);
  std::map<std::string, Tally> tallies;
  std::map<std::string, LandmarkTally> landmarks;
  std::map<std::string, PartTallies> parts;
  std::size_t refused = 0, right_side = 0;
  std::vector<double> times;
  for (std::size_t i = 0; i < outcomes.size(); ++i) {
    const FootOutcome& outcome = outcomes[i];
    if (wishes.verbose || !outcome.refusal.empty()) print_foot(outcome, wishes.first_seed + i);
    if (!outcome.foot) {
      ++refused;
      continue;
    }
    const bool is_right = outcome.foot->side == outcome.drawn.truth.side;
    right_side += is_right ? 1 : 0;
    if (!is_right) fmt::print("{} {}: wrong side\n", wishes.first_seed + i, outcome.drawn.making);
    times.push_back(outcome.milliseconds);
    add_to(tallies, outcome);
    add_to(landmarks, outcome);
    add_to(parts, outcome);
  }
  fmt::print("\n{} simulated feet: {} refused, side right in {} of {}, median {:.0f} ms\n\n",
             outcomes.size(), refused, right_side, outcomes.size() - refused, quantile(times, 0.5));
  fmt::print("{:<26}{:>5}{:>5}{:>8}{:>8}{:>8}{:>8}{:>9}{:>8}{:>8}\n", "mm, degrees", "n", "none",
             "bias", "SD", "95 %", "worst", "in bar %", "held %", "u95");
  for (const auto& [id, tally] : tallies) print_row(id, tally);
  fmt::print("\n{:<26}{:>5}   {:>6} (SD) {:>8} (SD) {:>8} (SD){:>10}{:>8}\n", "landmarks: bias, mm",
             "n", "x", "y", "z", "median", "95 %", "held %", "radius");
  for (const auto& [name, tally] : landmarks) print_row(name, tally);
  fmt::print("\n{:<34}{:>8}{:>8}{:>8}{:>8}{:>11}{:>8}{:>8}{:>8}\n", "parts of a girth's error, mm",
             "plane", "median", "95 %", "in 1 %", "surface", "median", "95 %", "in 1 %");
  for (const auto& [name, tally] : parts) print_row(name, tally);
}

}  // namespace instep::bench
