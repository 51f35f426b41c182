#include "sim/section_contour.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "sim/solids/blend.h"
#include "sim/solids/cylinder_solid.h"

namespace instep {
namespace {

using Eigen::Vector3d;
using std::numbers::pi;

/// Two balls joined by a soft waist: a section with hollows.
class Dumbbell final : public Solid {
 public:
  Dumbbell() : blend_(2.0) {
    blend_.add({{-30, 0, 0}, 20, {-30, 0, 0}, 20});
    blend_.add({{30, 0, 0}, 20, {30, 0, 0}, 20});
    blend_.add({{-30, 0, 0}, 6, {30, 0, 0}, 6});
  }
  double value(const Vector3d& point) const override { return blend_.value(point); }
  Eigen::AlignedBox3d bounds() const override { return blend_.bounds(); }

 private:
  Blend blend_;
};

TEST(TraceSection, RoundsACylinderLevel) {
  const CylinderSolid cylinder(40.0, 150.0);
  const auto plane = TapePlane::through({0, 0, 70}, {1, 0, 70}, {0, 1, 70}).value();
  const auto section = trace_section(cylinder, plane, {5, -3, 70}).value();
  EXPECT_NEAR(section.contact_mm, 80 * pi, 1e-4);
  EXPECT_NEAR(section.stretched_mm, 80 * pi, 1e-4);
}

TEST(TraceSection, RoundsACylinderAslant) {
  const CylinderSolid cylinder(40.0, 400.0);
  const double slope = 0.6;
  const auto plane = TapePlane::through({0, 0, 200}, {1, 0, 200 + slope}, {0, 1, 200}).value();
  const auto section = trace_section(cylinder, plane, {0, 0, 200}).value();
  double ellipse = 0.0;  // arc length by fine chords of the known ellipse
  const double a = 40.0 * std::hypot(1.0, slope);
  for (int i = 0; i < 100000; ++i) {
    const double t = 2 * pi * i / 100000, u = 2 * pi * (i + 1) / 100000;
    ellipse += std::hypot(a * (std::cos(u) - std::cos(t)), 40.0 * (std::sin(u) - std::sin(t)));
  }
  EXPECT_NEAR(section.contact_mm, ellipse, 1e-3);
}

TEST(TraceSection, FollowsHollowsAndBridgesThem) {
  const Dumbbell body;
  const auto plane = TapePlane::through({0, 0, 0}, {1, 0, 0}, {0, 1, 0}).value();
  const auto section = trace_section(body, plane, {0, 0, 0}).value();
  // Tape round two equal discs: two straight runs and a circle, the soft union being a little
  // outside of both.
  const double tape = 2 * 60.0 + 2 * pi * 20.0;
  EXPECT_GT(section.stretched_mm, tape);
  EXPECT_LT(section.stretched_mm, tape + 2 * pi * 1.5);
  EXPECT_GT(section.contact_mm, section.stretched_mm + 10.0);
}

TEST(TraceSection, RefusesAPointOutside) {
  const CylinderSolid cylinder(40.0, 150.0);
  const auto plane = TapePlane::through({0, 0, 70}, {1, 0, 70}, {0, 1, 70}).value();
  const auto section = trace_section(cylinder, plane, {60, 0, 70});
  ASSERT_FALSE(section);
  EXPECT_EQ(section.error().code, ErrorCode::kInvalidInput);
}

}  // namespace
}  // namespace instep
