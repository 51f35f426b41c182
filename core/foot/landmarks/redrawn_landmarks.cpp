#include "core/foot/landmarks/redrawn_landmarks.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

#include "core/foot/alignment.h"
#include "core/foot/landmarks.h"
#include "core/fusion/sole/wall_foot.h"
#include "core/geometry/drawn_local_errors.h"
#include "core/geometry/place_hash.h"
#include "core/normal_spread.h"

namespace instep {
namespace {

using Eigen::Vector3d;

constexpr std::size_t kRedraws = 8;
constexpr std::size_t kMostParts = 8;
constexpr std::size_t kPointsOfPart = 6000;
constexpr Parting kPartLeftOut{4, true};
constexpr Parting kLinesLeftOut{4, true, true};
/// An end moves by as much for a line that is left out as it would for one beyond the last, and
/// what bends between lines by far more: a jackknife's share would be 2.25. Of two feet and two
/// lasts in lines 1.5 and 2.5 mm apart, in three directions, 97.8 % of 314 intervals hold so; of
/// others, 2 and 3.5 mm apart, 98.8 % of 240.
constexpr double kShareOfLines = 0.56;
constexpr long long kNoFewerLines = 1 << 20;  ///< before the first: no number is negative
constexpr std::size_t kBitsOfALot = 8;
constexpr std::size_t kFewestDegrees = 2;
// What all redraws share, holes and the rules' own roundings, does not show in their scatter. Over
// drawn feet (tests/bench/feet) intervals so much wider hold about as often as they should.
constexpr double kSharedDoubt = 1.6;

/// Student's 97.5 % points for 1 to 8 degrees of freedom.
constexpr std::array<double, 8> kStudent{12.71, 4.30, 3.18, 2.78, 2.57, 2.45, 2.36, 2.31};

/// Moves the points by local errors as they may be.
void err_anew(std::uint64_t draw, PointCloud& cloud) {
  const auto errors = drawn_local_errors(cloud, draw);
  for (std::size_t i = 0; i < errors.size(); ++i) {
    cloud.positions[i] += errors[i] * cloud.normals[i];
  }
}

/// Of one part.
std::optional<Quieting> quieting_of(const FootScan& foot, const Parting& parting) {
  if (!foot.quieted) return std::nullopt;
  Quieting quieting = foot.quieted->quieting;
  if (!parting.is_part_left_out) quieting.parts = parting.parts;
  return quieting;
}

/// What one redraw differs by from the foot as found.
struct Redraw {
  std::vector<std::size_t> points;    ///< on these
  std::optional<std::uint64_t> draw;  ///< moved by such a draw of local errors
  double deeper_floor_mm = 0.0;
};

/// None where the axis is not found again.
RedrawnLandmarks redrawn_on(const FootScan& foot, const Redraw& redraw,
                            const std::optional<Quieting>& quieting) {
  PointCloud points = foot.cloud.subset(redraw.points);
  if (quieting) points = quieted(points, *quieting).cloud;
  FootScan part = aligned_as(foot, std::move(points));
  if (redraw.draw) err_anew(*redraw.draw, part.cloud);
  // Along another axis its landmarks would be those of another foot.
  if (!realign(part, redraw.deeper_floor_mm)) return {};
  mark(part);
  return {std::move(part.landmarks), part.foot_from_input.inverse()};
}

/// Even; by what does not depend on the processor. Were the draws of all feet the same, all would
/// share their luck.
std::uint64_t first_draw_of(const PointCloud& cloud) {
  const auto reach = static_cast<std::uint64_t>(std::llround(10.0 * cloud.local_errors.reach_mm));
  return mixed_bits(mixed_bits(cloud.size()) + reach) & ~std::uint64_t{1};
}

/// Of the skin that was put where nobody saw it: an upright piece tells where a landmark may lie,
/// but as all redraws share it, not how surely.
bool is_guessed_wall(const PointCloud& cloud, std::size_t index) {
  constexpr double kLeastUpright = -0.3;  // z of its normal
  return !cloud.was_seen(index) && cloud.has_normals() &&
         cloud.normals[index].z() > kLeastUpright &&
         cloud.positions[index].z() > WallSettings{}.usual_edge_mm;
}

/// How the points are parted, and numbers by which each comes into a part: at random, but lines in
/// turn. Each parting reads bits of its own.
struct Lots {
  Parting parting;
  std::vector<std::uint64_t> numbers;
};

/// All points of a scanner's line come into the same part, for what lies between lines is not told
/// by how many points these have; a part alone would have hardly any. In turn, so that never two
/// beside each other are left out, and in the second parting with others.
Lots lots_by_line(const std::vector<Vector3d>& points, const ScannerLines& lines,
                  const RigidTransform& input_from_points) {
  constexpr std::uint64_t kParts = kLinesLeftOut.parts;
  Lots lots{kLinesLeftOut, {}};
  lots.numbers.reserve(points.size());
  for (const auto& point : points) {
    const auto line =
        static_cast<std::uint64_t>(kNoFewerLines + lines.line_of(input_from_points * point));
    lots.numbers.push_back(line % kParts + ((line + line / kParts) % kParts << kBitsOfALot));
  }
  return lots;
}

Lots lots_of(const FootScan& foot) {
  const auto& points = foot.cloud.positions;
  if (foot.lines) return lots_by_line(points, *foot.lines, foot.foot_from_input.inverse());
  Lots lots{kPartLeftOut, {}};
  if (points.size() >= 2 * kPointsOfPart) {
    lots.parting = {std::min(points.size() / kPointsOfPart, kMostParts), false};
  }
  lots.numbers.reserve(points.size());
  for (const auto& point : points) lots.numbers.push_back(hash_of_place(point));
  return lots;
}

/// Of the points, those that a redraw is made on.
std::vector<std::size_t> points_of(const PointCloud& cloud, const Lots& lots, std::size_t redraw) {
  const auto& [parting, numbers] = lots;
  const std::size_t bits = kBitsOfALot * (redraw / parting.parts);
  const std::size_t part = redraw % parting.parts;
  std::vector<std::size_t> taken;
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    const bool is_of_part = (numbers[i] >> bits) % parting.parts == part;
    if (is_of_part != parting.is_part_left_out && !is_guessed_wall(cloud, i)) taken.push_back(i);
  }
  return taken;
}

/// What all redraws of a landmark share, so that they cannot show it: over drawn feet
/// (tests/bench/feet) by so much. The skin that a heel is fitted by pulls its point aside; where
/// skin turns under the sole or a toe close below, a surface of second order stands out furthest
/// too high.
double own_doubt_mm(const std::string& landmark) {
  if (landmark == "heel_point") return 0.35;
  return landmark == "metatarsale_fibulare" || landmark == "toe1_tip" ? 0.6 : 0.0;
}

/// Variance of what all points give over that between the redraws of a parting.
double variance_share(const Parting& parting) {
  if (parting.is_by_line) return kShareOfLines;
  const auto parts = static_cast<double>(parting.parts);
  return parting.is_part_left_out ? (parts - 1.0) * (parts - 1.0) / parts : 1.0 / parts;
}

/// What fewer points shift a value by goes as one over their number: that of all points over what
/// those of a redraw are off them. Of parts left out it is the jackknife's estimate of bias (Efron,
/// Tibshirani 1993, equation 10.8); of lines, between which nothing was seen, no more than it is.
double bias_share(const Parting& parting) {
  const bool are_points_left_out = parting.is_part_left_out && !parting.is_by_line;
  return are_points_left_out ? static_cast<double>(parting.parts) - 1.0 : 1.0;
}

/// Where a redraw puts a landmark, in the frame of the foot.
std::optional<Vector3d> place_of(const std::string& name, const RedrawnLandmarks& redrawn) {
  const auto found = redrawn.landmarks.find(name);
  if (found == redrawn.landmarks.end()) return std::nullopt;
  return redrawn.foot_from_redrawn * found->second.position_mm;
}

/// Along one of its axes, where each does.
std::vector<std::optional<double>> redrawn_coordinates(const std::vector<RedrawnLandmarks>& redraws,
                                                       const std::string& name, int axis) {
  std::vector<std::optional<double>> values;
  for (const auto& redrawn : redraws) {
    const auto place = place_of(name, redrawn);
    values.push_back(place ? std::optional((*place)(axis)) : std::nullopt);
  }
  return values;
}

}  // namespace

double below_last_line_mm(const FootScan& foot) {
  constexpr double kSoleMm = 40.0;  // of a flat part of it
  if (!foot.lines || foot.is_floor_known) return 0.0;
  const Vector3d across = foot.foot_from_input.linear() * foot.lines->across;
  const double pitch_mm = foot.lines->pitch_mm;
  return pitch_mm > kSoleMm * across.head<2>().norm() ? pitch_mm : 0.0;
}

Redraws redraw_landmarks(const FootScan& foot, const Workers& workers) {
  Redraws redraws;
  const Lots lots = lots_of(foot);
  redraws.parting = lots.parting;
  const std::size_t parts = redraws.parting.parts;
  const std::size_t partings = (kRedraws + parts / 2) / parts;
  const std::size_t count = partings * parts;
  redraws.landmarks.resize(count);
  redraws.erring.resize(foot.cloud.local_errors.empty() ? 0 : count);
  const std::uint64_t first_draw = first_draw_of(foot.cloud);
  const auto quieting = quieting_of(foot, redraws.parting);
  const double below_mm = below_last_line_mm(foot);
  workers(count + redraws.erring.size(), [&](std::size_t job) {
    const std::size_t number = job % count;
    Redraw redraw{points_of(foot.cloud, lots, number), std::nullopt,
                  below_mm * static_cast<double>(number % parts) / static_cast<double>(parts - 1)};
    if (job < count) {
      redraws.landmarks[number] = redrawn_on(foot, redraw, quieting);
    } else {
      redraw.draw = first_draw + number;
      redraws.erring[number] = redrawn_on(foot, redraw, quieting);
    }
  });
  return redraws;
}

std::optional<double> u95_of_redraws(const std::vector<std::optional<double>>& values,
                                     const Parting& parting) {
  const std::size_t parts = parting.parts;
  if (parts == 0) return std::nullopt;
  double squares = 0.0;
  std::size_t degrees = 0;
  for (std::size_t first = 0; first + parts <= values.size(); first += parts) {
    double sum = 0.0;
    double sum_of_squares = 0.0;
    double count = 0.0;
    for (std::size_t i = first; i < first + parts; ++i) {
      if (!values[i]) continue;
      sum += *values[i];
      sum_of_squares += *values[i] * *values[i];
      count += 1.0;
    }
    if (count < 2.0) continue;
    squares += std::max(0.0, sum_of_squares - sum * sum / count);
    degrees += static_cast<std::size_t>(count) - 1;
  }
  if (degrees < kFewestDegrees) return std::nullopt;
  const double variance = variance_share(parting) * squares / static_cast<double>(degrees);
  return kStudent[std::min(degrees, kStudent.size()) - 1] * std::sqrt(variance);
}

std::optional<double> u95_of_erring(const std::vector<std::optional<double>>& values,
                                    const std::vector<std::optional<double>>& erring) {
  if (erring.empty()) return 0.0;
  double squares = 0.0;
  std::size_t degrees = 0;
  for (std::size_t i = 0; i < erring.size(); ++i) {
    if (!values[i] || !erring[i]) continue;
    squares += std::pow(*erring[i] - *values[i], 2);
    ++degrees;
  }
  if (degrees < kFewestDegrees) return std::nullopt;
  return kStudent[std::min(degrees, kStudent.size()) - 1] *
         std::sqrt(squares / static_cast<double>(degrees));
}

std::optional<double> u95_by_redraws(double told, const std::vector<std::optional<double>>& values,
                                     const Parting& parting) {
  const auto u95 = u95_of_redraws(values, parting);
  if (!u95) return std::nullopt;
  double sum = 0.0;
  double count = 0.0;
  for (const auto& value : values) {
    if (!value) continue;
    sum += *value;
    count += 1.0;
  }
  return std::max(kSharedDoubt * *u95, bias_share(parting) * std::abs(sum / count - told));
}

void set_radii(FootScan& foot) {
  const auto& redraws = foot.redraws;
  for (auto& [name, landmark] : foot.landmarks) {
    double squared = 0.0;
    bool is_known = true;
    for (int axis = 0; axis < 3; ++axis) {
      const auto values = redrawn_coordinates(redraws.landmarks, name, axis);
      const auto own = u95_by_redraws(landmark.position_mm(axis), values, redraws.parting);
      const auto erring = u95_of_erring(values, redrawn_coordinates(redraws.erring, name, axis));
      is_known = is_known && own && erring;
      squared += std::pow(own.value_or(0.0), 2) + std::pow(erring.value_or(0.0), 2);
    }
    const auto other = redraws.of_other_side ? place_of(name, *redraws.of_other_side)
                                             : std::optional(landmark.position_mm);
    if (is_known && other) {
      double shared = 0.0;
      for (const auto& off : landmark.deviations_off_mm) shared += off.squaredNorm();
      landmark.radius_mm =
          std::hypot(std::sqrt(squared), own_doubt_mm(name), kDeviations * std::sqrt(shared)) +
          (*other - landmark.position_mm).norm();
    }
  }
}

}  // namespace instep
