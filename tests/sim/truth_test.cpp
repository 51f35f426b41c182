#include "sim/truth.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/foot/full_size.h"
#include "core/geometry/polygon.h"
#include "core/girth/tape_plane.h"

namespace instep {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

struct Case {
  std::uint64_t seed;
  Side side;
};

/// Points of the skin up to z = 25 mm at full size in the foot frame, by brute force: a grid of 1
/// to 2 mm over the whole foot, and the zero between neighbours of different sign by a straight
/// line.
std::vector<Vector3d> skin_near_floor(const FootSolid& foot, const FootTruth& truth) {
  const RigidTransform solid_from_foot = truth.foot_from_solid.inverse();
  std::vector<Vector3d> points;
  const double highest = 25.0 / full_size_factor(foot.parameters().length_mm);
  for (double z = 0.5; z <= highest; z += 1.0) {
    for (double y = -80.0; y <= 80.0; y += 1.0) {
      double last = 1.0;
      for (double x = -10.0; x <= 330.0; x += 2.0) {
        const double value = foot.value(solid_from_foot * Vector3d(x, y, z));
        if ((value < 0) != (last < 0)) {
          points.emplace_back(x - 2.0 * value / (value - last), y, z);
        }
        last = value;
      }
    }
    for (double x = -10.0; x <= 330.0; x += 2.0) {
      double last = 1.0;
      for (double y = -80.0; y <= 80.0; y += 1.0) {
        const double value = foot.value(solid_from_foot * Vector3d(x, y, z));
        if ((value < 0) != (last < 0)) points.emplace_back(x, y - value / (value - last), z);
        last = value;
      }
    }
  }
  return points;
}

/// The section's hull by brute force: where rays from its middle leave the body for the last time.
double girth_by_rays(const FootSolid& foot, const FootTruth& truth, const std::string& id) {
  const auto& points = truth.planes.at(id);
  const TapePlane plane = TapePlane::through(points[0], points[1], points[2]).value();
  const Vector3d middle = (points[0] + points[1] + points[2]) / 3.0;
  const RigidTransform solid_from_foot = truth.foot_from_solid.inverse();
  std::vector<Vector2d> section;
  for (int i = 0; i < 1440; ++i) {
    const double angle = i * M_PI / 720;
    const Vector2d direction(std::cos(angle), std::sin(angle));
    const auto value = [&](double distance) {
      return foot.value(solid_from_foot * plane.lift(plane.project(middle) + distance * direction));
    };
    double inside = 120.0;
    while (value(inside) > 0) inside -= 0.5;
    double outside = inside + 0.5;
    for (int k = 0; k < 30; ++k) {
      const double half = 0.5 * (inside + outside);
      (value(half) < 0 ? inside : outside) = half;
    }
    section.push_back(inside * direction);
  }
  return perimeter(convex_hull(section));
}

class FootTruthOf : public testing::TestWithParam<Case> {
 protected:
  FootSolid foot_{draw_foot(GetParam().seed, GetParam().side)};
  FootTruth truth_ = foot_truth(foot_).value();
};

TEST_P(FootTruthOf, AgreesWithBruteForce) {
  const auto points = skin_near_floor(foot_, truth_);
  const double length = truth_.measures.at("foot_length");
  const double medial = truth_.side == Side::kRight ? 1.0 : -1.0;
  double rear = 1e9, front = -1e9, mt = -1e9, mf = -1e9, inner = -1e9, outer = -1e9;
  for (const Vector3d& point : points) {
    const double share = point.x() / length;
    const double inwards = medial * point.y();
    rear = std::min(rear, point.x());
    front = std::max(front, point.x());
    if (share > 0.60 && share < 0.80) mt = std::max(mt, inwards);
    if (share > 0.50 && share < 0.75) mf = std::max(mf, -inwards);
    if (share > 0.50 && share < 0.85) inner = std::max(inner, inwards);
    if (share > 0.50 && share < 0.85) outer = std::max(outer, -inwards);
  }
  EXPECT_NEAR(rear, 0.0, 0.15);
  EXPECT_NEAR(front, length, 0.15);
  EXPECT_NEAR(mt, medial * truth_.landmarks.at("mt").y(), 0.15);
  EXPECT_NEAR(mf, -medial * truth_.landmarks.at("mf").y(), 0.15);
  EXPECT_NEAR(inner + outer, truth_.measures.at("foot_breadth_horizontal"), 0.2);
  for (const char* id : {"ball_girth", "waist_girth", "instep_girth"}) {
    EXPECT_NEAR(girth_by_rays(foot_, truth_, id), truth_.measures.at(id), 0.01) << id;
    EXPECT_GE(truth_.contact_mm.at(id), truth_.measures.at(id) - 1e-6) << id;
  }
}

TEST_P(FootTruthOf, HasTheTraitsThatLandmarkRulesRelyOn) {
  const auto& marks = truth_.landmarks;
  const FootParameters& asked = foot_.parameters();
  const double length = truth_.measures.at("foot_length");
  const double medial = truth_.side == Side::kRight ? 1.0 : -1.0;
  EXPECT_NEAR(length, asked.length_mm, 1.5);
  EXPECT_NEAR(marks.at("instep").z(), asked.instep_height_mm, 1.5);
  EXPECT_NEAR(truth_.measures.at("foot_breadth_horizontal"), asked.ball_breadth_mm, 2.0);
  EXPECT_LT(marks.at("pternion").head<2>().norm(), 1e-3);
  EXPECT_NEAR(marks.at("toe2").y(), 0.0, 1e-3);
  EXPECT_GT(marks.at("toe2").x(), 0.95 * length);
  EXPECT_NEAR(marks.at("mt").x() / length, 0.69, 0.02);
  EXPECT_NEAR(marks.at("mf").x() / length, 0.62, 0.02);
  EXPECT_GT(medial * marks.at("mt").y(), 0);
  EXPECT_LT(medial * marks.at("mf").y(), 0);
  EXPECT_GT(marks.at("medial_arch").x(), 0.36 * length) << "a minimum, not an end of the range";
  EXPECT_LT(marks.at("medial_arch").x(), 0.59 * length);
}

INSTANTIATE_TEST_SUITE_P(Seeds, FootTruthOf,
                         testing::Values(Case{1, Side::kRight}, Case{2, Side::kLeft},
                                         Case{33, Side::kRight}));

TEST(FootTruthMirror, LeftAndRightHaveTheSameMeasures) {
  const auto right = foot_truth(FootSolid(draw_foot(4, Side::kRight))).value();
  const auto left = foot_truth(FootSolid(draw_foot(4, Side::kLeft))).value();
  for (const auto& [id, value] : right.measures) EXPECT_NEAR(left.measures.at(id), value, 1e-3);
  for (const auto& [name, point] : right.landmarks) {
    const Vector3d mirrored(point.x(), -point.y(), point.z());
    EXPECT_LT((left.landmarks.at(name) - mirrored).norm(), 0.05) << name;
  }
}

}  // namespace
}  // namespace instep
