#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "core/girth/girth.h"
#include "tests/support/cylinder_tape.h"

namespace instep {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

TEST(GirthOptions, RefuseANoiseThatIsNone) {
  const PointCloud cloud = test::cylinder(3000);
  for (const double sigma : {std::nan(""), -1.0, 0.0, 1e9, kInfinity, -kInfinity}) {
    for (const auto measure : {girth_by_rbf, girth_by_hull, girth_by_mesh, girth_by_paper}) {
      const auto girth = measure(cloud, test::level_plane(), {sigma});
      ASSERT_FALSE(girth) << sigma;
      EXPECT_EQ(girth.error().code, ErrorCode::kInvalidInput) << girth.error().line();
      EXPECT_FALSE(girth.error().advice.empty());
    }
  }
}

TEST(GirthOptions, TakeAnyNoiseThatIsOne) {
  for (const double sigma : {1e-300, 1e-9, 0.1, 100.0}) {
    EXPECT_TRUE(check_options({sigma})) << sigma;
  }
  EXPECT_TRUE(check_options({}));
}

}  // namespace
}  // namespace instep
