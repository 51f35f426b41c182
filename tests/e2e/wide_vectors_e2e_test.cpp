#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <fstream>
#include <nlohmann/json.hpp>
#include <random>
#include <string>

#include "tests/support/run_program.h"
#include "tests/support/temporary_folder.h"

namespace instep {
namespace {

using nlohmann::json;
using testing::HasSubstr;

/// While it lives, programs that start take the processor for one without wide vectors.
class PlainProcessor {
 public:
  PlainProcessor() { ::setenv("GLIBC_TUNABLES", "glibc.cpu.hwcaps=-AVX2", 1); }
  ~PlainProcessor() { ::unsetenv("GLIBC_TUNABLES"); }
  PlainProcessor(const PlainProcessor&) = delete;
  PlainProcessor& operator=(const PlainProcessor&) = delete;
};

/// As the loader sees it, for it asks for more than wide vectors.
bool has_wide_vectors() {
  const auto loader = test::run_program("/lib64/ld-linux-x86-64.so.2", {"--help"});
  return loader.output.find("x86-64-v3 (supported") != std::string::npos;
}

class WideVectors : public testing::Test {
 protected:
  void SetUp() override {
    if (!INSTEP_BUILT_WIDE) GTEST_SKIP() << "this build is for any processor alone";
    if (!has_wide_vectors()) GTEST_SKIP() << "this processor has no wide vectors";
  }

  /// A bumpy tube of random points with noise.
  std::string write_tube(double sigma_mm) const {
    std::mt19937_64 numbers(3);
    std::uniform_real_distribution<double> part(0.0, 1.0);
    std::normal_distribution<double> noise(0.0, 1.0);
    const std::string name = folder_.path() / "tube.xyz";
    std::ofstream file(name);
    for (int i = 0; i < 6000; ++i) {
      const double angle = 2 * M_PI * part(numbers);
      const double height = 100.0 * part(numbers);
      const double radius =
          40.0 + 3 * std::cos(3 * angle + 0.05 * height) + sigma_mm * noise(numbers);
      file << radius * std::cos(angle) << " " << radius * std::sin(angle) << " " << height << "\n";
    }
    return name;
  }

  static json girth_of(const std::string& cloud) {
    const auto run =
        test::run_program("instep", {"girth", cloud, "--plane", "0,0,50,10,0,52,0,10,49"});
    EXPECT_EQ(run.exit_code, 0) << run.errors;
    return json::parse(run.output, nullptr, false);
  }

  test::TemporaryFolder folder_;
};

TEST_F(WideVectors, AreChosenWhereTheProcessorHasThem) {
  EXPECT_THAT(test::run_program("instep", {"doctor"}).output, HasSubstr(" for x86-64-v3,"));
  const PlainProcessor plain;
  EXPECT_THAT(test::run_program("instep", {"doctor"}).output, HasSubstr(" for any processor,"));
}

TEST_F(WideVectors, MeasureTheSame) {
  for (const double sigma_mm : {0.0, 0.3}) {
    const std::string cloud = write_tube(sigma_mm);
    const json wide = girth_of(cloud);
    const PlainProcessor plain;
    const json narrow = girth_of(cloud);
    for (const char* key : {"stretched_mm", "contact_mm", "stretched_u95_mm", "contact_u95_mm"}) {
      ASSERT_TRUE(wide.contains(key) && wide[key].is_number()) << wide;
      EXPECT_NEAR(wide[key].get<double>(), narrow[key].get<double>(), 1e-7) << key;
    }
  }
}

}  // namespace
}  // namespace instep
