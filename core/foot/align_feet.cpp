#include "core/foot/align_feet.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <utility>

#include "core/mean.h"

namespace instep {
namespace {

/// Cosine of the angle between two feet up to which "left of" has a meaning for both.
constexpr double kSameWay = 0.5;
/// So far aside of each other, in lengths of the shorter one, feet stand beside one another.
constexpr double kAsideShare = 0.15;
/// Of people who stand on a station so few cross their feet: assumed, not measured.
constexpr double kCrossed = 0.02;

/// Where the middle of a foot's points lies in the input.
Eigen::Vector3d place_of(const FootScan& foot) {
  return foot.foot_from_input.inverse() * mean_of(foot.cloud.positions);
}

/// One axis of a foot as it lies in the input.
Eigen::Vector3d in_input(const FootScan& foot, const Eigen::Vector3d& axis) {
  return foot.foot_from_input.linear().transpose() * axis;
}

/// How far left of the first foot the second one stands, looking the way that both point on
/// average; nothing where they point different ways, or stand rather one behind the other.
std::optional<double> second_left_of_first_mm(const FootScan& first, const FootScan& second) {
  const Eigen::Vector3d one_way = in_input(first, Eigen::Vector3d::UnitX());
  const Eigen::Vector3d other_way = in_input(second, Eigen::Vector3d::UnitX());
  if (one_way.dot(other_way) < kSameWay) return std::nullopt;
  const Eigen::Vector3d up =
      in_input(first, Eigen::Vector3d::UnitZ()) + in_input(second, Eigen::Vector3d::UnitZ());
  const Eigen::Vector3d left = up.cross(one_way + other_way).normalized();
  const double left_mm = left.dot(place_of(second) - place_of(first));
  const double shorter_mm = std::min(first.length_mm(), second.length_mm());
  return std::abs(left_mm) > kAsideShare * shorter_mm ? std::optional(left_mm) : std::nullopt;
}

/// How sure a foot's shape is of a side, 0 to 1.
double by_shape(const FootScan& foot, Side side) {
  return foot.side == side ? foot.side_confidence : 1.0 - foot.side_confidence;
}

/// How sure it is that the left one of two feet is that which stands on the left. `left`, `right`:
/// how sure their shapes are of it.
double by_place_too(double left, double right) {
  const double uncrossed = (1.0 - kCrossed) * left * right;
  const double crossed = kCrossed * (1.0 - left) * (1.0 - right);
  return std::max(0.5, uncrossed / (uncrossed + crossed));
}

/// Aligns again if the place of the foot overrules its shape.
Result<FootScan> with_side(FootScan foot, const PointCloud& cloud, Side side,
                           AlignmentOptions options) {
  if (foot.side == side) return foot;
  options.side = side;
  options.is_side_by_place = true;
  return align_foot(cloud, options);
}

/// Of two feet that look like the same side one is the other: which, their shapes tell against each
/// other.
void doubt_one_side(std::vector<FootScan>& feet) {
  const auto right_alone = [](const FootScan& right, const FootScan& wrong) {
    return right.side_confidence * (1.0 - wrong.side_confidence);
  };
  const double first = right_alone(feet[0], feet[1]);
  const double second = right_alone(feet[1], feet[0]);
  feet[0].side_confidence = std::max(0.5, first / (first + second));
  feet[1].side_confidence = std::max(0.5, second / (first + second));
}

/// Of two that stand there whoever has to put it right must know which one is meant.
Error of_one(Error error, Side side) {
  error.message = std::string("the ") + to_string(side) + " one of two feet: " + error.message;
  return error;
}

/// Gives two feet that stand beside one another the sides of their places.
Result<void> settle_by_place(std::vector<FootScan>& feet, const std::vector<PointCloud>& clouds,
                             bool is_second_left, const AlignmentOptions& options) {
  const double sure = by_place_too(by_shape(feet[is_second_left ? 1 : 0], Side::kLeft),
                                   by_shape(feet[is_second_left ? 0 : 1], Side::kRight));
  for (std::size_t i = 0; i < 2; ++i) {
    const Side side = (i == 1) == is_second_left ? Side::kLeft : Side::kRight;
    auto settled = with_side(std::move(feet[i]), clouds[i], side, options);
    if (!settled) return tl::make_unexpected(of_one(settled.error(), side));
    settled->cloud_number = i;
    settled->side_confidence = sure;
    feet[i] = *std::move(settled);
  }
  return {};
}

/// Where it stands beside the other shows which one failed, as long as the other is a foot.
Error of_two(const std::vector<Result<FootScan>>& found, const std::vector<PointCloud>& clouds) {
  const std::size_t failed = found[0] ? 1 : 0;
  Error error = found[failed].error();
  const auto& other = found[1 - failed];
  if (!other) {
    error.message = other.error().message == error.message
                        ? "both feet: " + error.message
                        : "one foot: " + error.message + "; the other: " + other.error().message;
    return error;
  }
  const double aside = (other->foot_from_input * mean_of(clouds[failed].positions)).y() -
                       mean_of(other->cloud.positions).y();
  if (!std::isfinite(aside)) return error;
  return of_one(std::move(error), aside > 0.0 ? Side::kLeft : Side::kRight);
}

}  // namespace

Result<std::vector<FootScan>> align_feet(const std::vector<PointCloud>& clouds,
                                         const AlignmentOptions& options, const GoOn& go_on) {
  AlignmentOptions each = options;
  each.is_one_foot = true;
  if (clouds.size() > 1) each.side.reset();
  std::vector<Result<FootScan>> found;
  for (const auto& cloud : clouds) {
    found.push_back(align_foot(cloud, each));
    if (!go_on()) return cancelled();
  }
  const auto failed =
      std::find_if(found.begin(), found.end(), [](const auto& foot) { return !foot; });
  if (failed != found.end()) {
    return tl::make_unexpected(found.size() == 2 ? of_two(found, clouds) : failed->error());
  }
  std::vector<FootScan> feet;
  for (auto& foot : found) {
    foot->cloud_number = feet.size();
    feet.push_back(std::move(*foot));
  }
  if (feet.size() != 2) return feet;

  if (const auto left_mm = second_left_of_first_mm(feet[0], feet[1])) {
    auto settled = settle_by_place(feet, clouds, *left_mm > 0.0, each);
    if (!settled) return tl::make_unexpected(settled.error());
  } else if (feet[0].side == feet[1].side) {
    doubt_one_side(feet);
    for (auto& foot : feet) {
      foot.warnings.emplace_back("both feet look like the same side: check the sides");
    }
  }
  std::stable_sort(feet.begin(), feet.end(), [](const FootScan& a, const FootScan& b) {
    return a.side == Side::kLeft && b.side == Side::kRight;
  });
  return feet;
}

}  // namespace instep
