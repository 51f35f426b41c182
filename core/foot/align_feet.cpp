#include "core/foot/align_feet.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

namespace instep {
namespace {

/// Cosine of the angle between two feet up to which "left of" has a meaning for both.
constexpr double kSameWay = 0.5;
/// So far aside of each other, in lengths of the shorter one, feet stand beside one another.
constexpr double kAsideShare = 0.15;
/// Of people who stand on a station so few cross their feet: assumed, not measured.
constexpr double kCrossed = 0.02;

Eigen::Vector3d centre(const PointCloud& cloud) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (const auto& position : cloud.positions) sum += position;
  return sum / static_cast<double>(cloud.size());
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
  // Shapes that each are sure of the other contradict both.
  return uncrossed + crossed > 0.0 ? std::max(0.5, uncrossed / (uncrossed + crossed)) : 0.5;
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
  const double aside =
      (other->foot_from_input * centre(clouds[failed])).y() - centre(other->cloud).y();
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

  const RigidTransform first_from_second =
      feet[0].foot_from_input * feet[1].foot_from_input.inverse();
  const double aside_mm =
      (first_from_second * centre(feet[1].cloud)).y() - centre(feet[0].cloud).y();
  const double shorter_mm = std::min(feet[0].length_mm(), feet[1].length_mm());
  if (first_from_second.linear()(0, 0) >= kSameWay &&
      std::abs(aside_mm) > kAsideShare * shorter_mm) {
    const bool second_is_left = aside_mm > 0.0;
    const double sure = by_place_too(by_shape(feet[second_is_left ? 1 : 0], Side::kLeft),
                                     by_shape(feet[second_is_left ? 0 : 1], Side::kRight));
    for (std::size_t i = 0; i < 2; ++i) {
      const Side side = (i == 1) == second_is_left ? Side::kLeft : Side::kRight;
      auto settled = with_side(std::move(feet[i]), clouds[i], side, each);
      if (!settled) return tl::make_unexpected(of_one(settled.error(), side));
      settled->cloud_number = i;
      settled->side_confidence = sure;
      feet[i] = std::move(*settled);
    }
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
