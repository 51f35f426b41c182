#include <gtest/gtest.h>
#include <sys/resource.h>

#include <cmath>
#include <numbers>

#include "core/girth/girth.h"
#include "tests/support/cylinder_tape.h"
#include "tests/support/random_numbers.h"

namespace instep {
namespace {

constexpr std::size_t kPoints = 10000000;

/// Ten million random points on 200 mm of the cylinder.
PointCloud large_cloud() {
  PointCloud cloud;
  cloud.positions.reserve(kPoints);
  test::RandomNumbers random(41);
  for (std::size_t i = 0; i < kPoints; ++i) {
    const double angle = random.uniform(0.0, 2.0 * std::numbers::pi);
    cloud.positions.emplace_back(test::kCylinderRadius * std::cos(angle),
                                 test::kCylinderRadius * std::sin(angle),
                                 random.uniform(-100.0, 100.0));
  }
  return cloud;
}

/// The most memory that this process has had so far.
std::size_t peak_bytes() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<std::size_t>(usage.ru_maxrss) * 1024;
}

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
constexpr bool kMemoryIsOurs = false;  // sanitizers take several times as much for themselves
#else
constexpr bool kMemoryIsOurs = true;
#endif

struct Method {
  const char* name;
  Result<Girth> (*measure)(const PointCloud&, const TapePlane&, const GirthOptions&);
};

constexpr Method kMethods[] = {{"rbf", girth_by_rbf},
                               {"mesh", girth_by_mesh},
                               {"hull", girth_by_hull},
                               {"rbf-paper", girth_by_paper}};

TEST(TenMillionPoints, AreMeasuredInLessThanThreeTimesTheirMemory) {
  const PointCloud cloud = large_cloud();
  for (const auto& [name, measure] : kMethods) {
    SCOPED_TRACE(name);
    const auto girth = measure(cloud, test::level_plane(), {});
    ASSERT_TRUE(girth) << girth.error().line();
    EXPECT_NEAR(girth->stretched_mm, test::kCylinderGirth, 0.01);
    EXPECT_NEAR(girth->contact_mm, test::kCylinderGirth, 0.01);
    EXPECT_EQ(girth->points, kPoints);
    if (kMemoryIsOurs) {
      EXPECT_LT(peak_bytes(), 3 * kPoints * sizeof(Eigen::Vector3d));
    }
  }
}

}  // namespace
}  // namespace instep
