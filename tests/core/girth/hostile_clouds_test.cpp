#include "tests/support/hostile_clouds.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <ostream>
#include <string>
#include <tuple>
#include <vector>

#include "core/girth/girth.h"

// Whatever the points are: never a crash or a hang (every test has a time limit), and never a wrong
// number that does not say so. An answer is near the truth, or carries a warning, or is a refusal
// that says why and what to do.

namespace instep {

namespace test {
void PrintTo(const HostileCase& hostile, std::ostream* stream) {
  *stream << hostile.name;
}
}  // namespace test

namespace {

using test::HostileCase;

struct Method {
  std::string name;
  Result<Girth> (*measure)(const PointCloud&, const TapePlane&, const GirthOptions&);
  /// What every girth by this method says, so that it tells nothing of this one.
  std::string standing_warning;
};

void PrintTo(const Method& method, std::ostream* stream) {
  *stream << method.name;
}

const std::vector<Method>& methods() {
  static const std::vector<Method> all = {
      {"Rbf", girth_by_rbf, ""},
      {"Mesh", girth_by_mesh, ""},
      {"Hull", girth_by_hull, "a hull of points knows no skin"},
      {"Paper", girth_by_paper, "the paper's method takes noise for shape"}};
  return all;
}

/// What an answer without a warning may be off, against the girth.
constexpr double kHonest = 0.01;

bool warns_of_this(const Girth& girth, const Method& method) {
  return std::any_of(girth.warnings.begin(), girth.warnings.end(), [&](const auto& warning) {
    return method.standing_warning.empty() ||
           warning.find(method.standing_warning) == std::string::npos;
  });
}

/// Within what is honest for any method, or within twice the half-width that it gave.
bool is_near(double length, std::optional<double> u95, double truth) {
  return std::abs(length - truth) <= std::max(kHonest * truth, 2.0 * u95.value_or(0.0));
}

void expect_reason(const Error& error) {
  EXPECT_FALSE(error.message.empty());
  EXPECT_FALSE(error.advice.empty());
  EXPECT_NE(error.code, ErrorCode::kInternal) << error.line();
}

void expect_finite(const Girth& girth) {
  EXPECT_TRUE(std::isfinite(girth.stretched_mm) && girth.stretched_mm > 0.0);
  EXPECT_TRUE(std::isfinite(girth.contact_mm) && girth.contact_mm > 0.0);
  EXPECT_TRUE(std::isfinite(girth.largest_gap_mm) && girth.largest_gap_mm >= 0.0);
}

class HostileClouds : public testing::TestWithParam<std::tuple<Method, HostileCase>> {
 protected:
  static const Method& method() { return std::get<0>(GetParam()); }
  static test::HostileCloud hostile() { return std::get<1>(GetParam()).make(); }
  static Result<Girth> measure(const test::HostileCloud& hostile) {
    return method().measure(hostile.cloud, hostile.plane, {});
  }
};

class UnmeasurableClouds : public HostileClouds {};
class RinglessClouds : public HostileClouds {};
class SpoiltClouds : public HostileClouds {};

TEST_P(UnmeasurableClouds, AreRefused) {
  const auto girth = measure(hostile());
  ASSERT_FALSE(girth) << girth->stretched_mm << " mm";
  expect_reason(girth.error());
}

TEST_P(RinglessClouds, AreRefusedOrWarnedOf) {
  const auto girth = measure(hostile());
  if (!girth) return expect_reason(girth.error());
  expect_finite(*girth);
  EXPECT_TRUE(warns_of_this(*girth, method())) << girth->stretched_mm << " mm";
}

TEST_P(SpoiltClouds, AreMeasuredRefusedOrWarnedOf) {
  const auto cloud = hostile();
  const auto girth = measure(cloud);
  if (!girth) return expect_reason(girth.error());
  expect_finite(*girth);
  if (warns_of_this(*girth, method())) return;
  EXPECT_TRUE(is_near(girth->stretched_mm, girth->stretched_u95_mm, *cloud.truth_mm))
      << "stretched " << girth->stretched_mm << " mm, truth " << *cloud.truth_mm << " mm";
  EXPECT_TRUE(is_near(girth->contact_mm, girth->contact_u95_mm, *cloud.truth_mm))
      << "contact " << girth->contact_mm << " mm, truth " << *cloud.truth_mm << " mm";
}

std::string name_of(const testing::TestParamInfo<std::tuple<Method, HostileCase>>& info) {
  return std::get<0>(info.param).name + std::get<1>(info.param).name;
}

INSTANTIATE_TEST_SUITE_P(All, UnmeasurableClouds,
                         testing::Combine(testing::ValuesIn(methods()),
                                          testing::ValuesIn(test::unmeasurable_clouds())),
                         name_of);
INSTANTIATE_TEST_SUITE_P(All, RinglessClouds,
                         testing::Combine(testing::ValuesIn(methods()),
                                          testing::ValuesIn(test::ringless_clouds())),
                         name_of);
INSTANTIATE_TEST_SUITE_P(All, SpoiltClouds,
                         testing::Combine(testing::ValuesIn(methods()),
                                          testing::ValuesIn(test::spoilt_clouds())),
                         name_of);

}  // namespace
}  // namespace instep
