#include "tests/support/cases/drawn_cases.h"

#include <fmt/core.h>

#include <cmath>
#include <filesystem>
#include <map>
#include <utility>

#include "tests/support/cases/case_bodies.h"
#include "tests/support/cases/point_patterns.h"
#include "tests/support/cases/simulated_feet.h"
#include "tests/support/places.h"
#include "tests/support/random_numbers.h"
#include "tests/support/shape_files.h"

namespace instep::test {
namespace {

constexpr double kShareOfSmooth = 0.40;
constexpr double kShareOfCreased = 0.10;
constexpr double kShareOfSimulatedFeet = 0.10;
constexpr double kShareOfLasts = 0.15;  // the rest are scanned feet
constexpr double kShareOfExact = 0.30;
constexpr double kShareOfHoles = 0.25;
constexpr double kShareOfNormalsTold = 0.25;
constexpr double kShareOfSigmaTold = 0.25;
/// How many points to choose each from, where there is a choice.
constexpr std::size_t kCrowd = 8;

double log_uniform(double low, double high, RandomNumbers& random) {
  return low * std::pow(high / low, random.uniform());
}

Pattern drawn_pattern(RandomNumbers& random) {
  const double draw = random.uniform();
  if (draw < 0.40) return Pattern::kRandom;
  if (draw < 0.60) return Pattern::kEven;
  return draw < 0.85 ? Pattern::kGraded : Pattern::kLines;
}

}  // namespace

struct DrawnCases::Bodies {
  std::vector<CaseBody> simulated_feet;
  std::vector<CaseBody> feet;
  std::vector<KnownSection> last_sections;
  std::map<std::string, PointCloud> lasts;

  bool with_trial_data() const { return !feet.empty(); }
  GirthCase whole_case(RandomNumbers& random) const;
  GirthCase on_body(const CaseBody& body, double most_points, RandomNumbers& random) const;
  GirthCase on_last(RandomNumbers& random) const;
};

/// A known section of a last, and some of its vertices.
GirthCase DrawnCases::Bodies::on_last(RandomNumbers& random) const {
  const KnownSection& section = last_sections[random.below(last_sections.size())];
  const PointCloud& vertices = lasts.at(section.file);
  const double count = log_uniform(900, 18000, random);
  // Patterns need a crowd to choose from.
  const Pattern pattern = count < 4000 ? drawn_pattern(random) : Pattern::kRandom;
  return {
      .name = section.file + " " + section.name,
      .making = {.body = "last", .sampling = name_of(pattern)},
      .cloud = chosen(vertices, static_cast<std::size_t>(count), pattern, random.below(1U << 30)),
      .plane = section.plane,
      .stretched_mm = section.stretched_mm,
      .contact_mm = section.contact_mm,
      .floor_mm = {}};
}

/// On a plane drawn for it.
GirthCase DrawnCases::Bodies::on_body(const CaseBody& body, double most_points,
                                      RandomNumbers& random) const {
  TapePlane plane = body.plane(random);
  auto lengths = body.lengths(plane);
  while (!lengths) {
    plane = body.plane(random);
    lengths = body.lengths(plane);
  }
  const auto count = static_cast<std::size_t>(log_uniform(most_points / 18.0, most_points, random));
  const Pattern pattern = drawn_pattern(random);
  const auto crowd =
      body.crowd(pattern == Pattern::kRandom ? count : kCrowd * count, random.below(1U << 30));
  PointCloud cloud = chosen(crowd, count, pattern, random.below(1U << 30));
  body.settle(cloud);
  return {.name = body.name,
          .making = {.body = body.name, .sampling = name_of(pattern)},
          .cloud = std::move(cloud),
          .plane = plane,
          .stretched_mm = lengths->stretched_mm,
          .contact_mm = lengths->contact_mm,
          .floor_mm = {}};
}

/// Still without holes and noise, and with its true normals.
GirthCase DrawnCases::Bodies::whole_case(RandomNumbers& random) const {
  constexpr double kMostPoints = 8000;
  constexpr double kMostPointsOfFeet = 18000;
  const double analytic = kShareOfSmooth + kShareOfCreased;
  const double without_trial_data = analytic + kShareOfSimulatedFeet;
  const double draw = random.uniform() * (with_trial_data() ? 1.0 : without_trial_data);
  if (draw < kShareOfSmooth) {
    const auto shapes = smooth_bodies(1 + random.below(1U << 30));
    return on_body(shapes[random.below(shapes.size())], kMostPoints, random);
  }
  if (draw < analytic) {
    return on_body(creased_body(random.below(1U << 30)), kMostPoints, random);
  }
  if (draw < without_trial_data) {
    return on_body(simulated_feet[random.below(simulated_feet.size())], kMostPointsOfFeet, random);
  }
  if (draw < without_trial_data + kShareOfLasts) return on_last(random);
  return on_body(feet[random.below(feet.size())], kMostPointsOfFeet, random);
}

DrawnCases::DrawnCases() {
  constexpr std::size_t kSimulatedFeet = 12;
  Bodies bodies;
  bodies.simulated_feet = simulated_feet(kSimulatedFeet);
  if (std::filesystem::exists(trial_data())) {
    bodies.feet = scanned_feet();
    bodies.last_sections = known_sections("lasts");
    for (const auto& section : bodies.last_sections) {
      if (bodies.lasts.contains(section.file)) continue;
      bodies.lasts[section.file] = read_shape(trial_data() / "lasts" / section.file).cloud;
    }
  }
  bodies_ = std::make_unique<const Bodies>(std::move(bodies));
}

DrawnCases::~DrawnCases() = default;

GirthCase DrawnCases::operator()(std::uint64_t number) const {
  constexpr std::uint64_t kFirstSeed = 20000;
  RandomNumbers random(kFirstSeed + number);
  GirthCase drawn = bodies_->whole_case(random);
  drawn.name += fmt::format(" {}", number);
  CaseMaking& making = drawn.making;
  if (random.uniform() < kShareOfHoles) {
    making.hole_mm = random.uniform(5.0, 25.0);
    drawn.cloud = with_hole(drawn.cloud, drawn.plane, making.hole_mm, random.below(1U << 30));
  }
  if (random.uniform() >= kShareOfExact) {
    making.sigma_mm = log_uniform(0.05, 1.0, random);
    drawn.cloud = with_noise(std::move(drawn.cloud), making.sigma_mm, random.below(1U << 30));
    making.sigma_told = random.uniform() < kShareOfSigmaTold;
  }
  if (making.sigma_told) drawn.cloud.sigma_mm.assign(drawn.cloud.size(), making.sigma_mm);
  making.normals_told = random.uniform() < kShareOfNormalsTold;
  if (!making.normals_told) drawn.cloud.normals.clear();
  return drawn;
}

}  // namespace instep::test
