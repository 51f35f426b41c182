#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <poll.h>
#include <signal.h>

#include <fstream>
#include <nlohmann/json.hpp>
#include <random>
#include <string>

#include "daemon/scan/scan_id.h"
#include "tests/support/station_process.h"

namespace instep {
namespace {

using namespace std::chrono_literals;
using test::StationProcess;

std::string bytes_of(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

/// The results there are; each is checked to be whole.
std::size_t whole_results(const std::filesystem::path& store) {
  std::size_t count = 0;
  if (!std::filesystem::exists(store)) return 0;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(store)) {
    const auto name = entry.path().filename().string();
    if (!entry.is_directory() || !is_scan_id(name)) continue;
    ++count;
    const auto result =
        nlohmann::json::parse(bytes_of(entry.path() / "result.json"), nullptr, false);
    EXPECT_TRUE(result.is_object() && result.value("id", "") == name) << entry.path();
    EXPECT_THAT(bytes_of(entry.path() / "sections.svg"), testing::HasSubstr("</svg>"));
    EXPECT_THAT(bytes_of(entry.path() / "report.svg"), testing::HasSubstr("</svg>"));
    EXPECT_EQ(bytes_of(entry.path() / "cloud.ply").substr(0, 3), "ply") << entry.path();
  }
  return count;
}

/// Reads what the station tells of its scan, at most `most` lines of it. The lines that came; none
/// comes after the result.
std::size_t follow(ControlClient& client, std::size_t most) {
  for (std::size_t line = 0; line < most; ++line) {
    const auto told = client.next(60s);
    if (!told) return line;
    if (told->value("event", "") == "result") return line + 1;
  }
  return most;
}

/// Two hundred deaths in all, in parts that can run side by side.
class SuddenDeath : public testing::TestWithParam<std::uint64_t> {};

TEST_P(SuddenDeath, LeavesNoTornResultAtFiftyRandomMomentsOfAScan) {
  const std::uint64_t seed = GetParam();
  constexpr int kDeaths = 50;
  constexpr std::size_t kAll = 1000;
  StationProcess station;
  station.write_settings(StationProcess::tiny_settings());
  std::mt19937_64 random(seed);
  // The first scan ends: it tells how many steps one takes. Moments are counted in steps and a few
  // milliseconds, so that a slow machine meets the same ones.
  std::size_t steps = kAll;
  std::size_t seen = 0;
  for (int death = 0; death < kDeaths; ++death) {
    station.start();
    ASSERT_TRUE(station.wait_for("STATUS=ready", 60s)) << station.log();
    auto client = station.connect();
    ASSERT_TRUE(client);
    ASSERT_TRUE(client->ask("watch"));
    ASSERT_TRUE(client->ask("scan"));
    if (death == 0) {
      steps = follow(*client, kAll);
    } else {
      follow(*client, random() % (steps + steps / 4 + 1));
      ::poll(nullptr, 0, static_cast<int>(random() % 40));
    }
    station.signal(SIGKILL);
    ASSERT_EQ(station.wait_for_exit(10s), -SIGKILL);
    const std::size_t now = whole_results(station.store());
    ASSERT_GE(now, seen) << "a result was lost at death " << death << ", seed " << seed;
    seen = now;
  }
  EXPECT_GT(seen, 1U);
  EXPECT_LT(seen, static_cast<std::size_t>(kDeaths));

  station.start();
  ASSERT_TRUE(station.wait_for("STATUS=ready", 60s));
  for (const auto& entry : std::filesystem::recursive_directory_iterator(station.store())) {
    EXPECT_FALSE(entry.path().filename().string().starts_with('.')) << entry.path();
  }
  const auto scan = station.run_instep("scan");
  EXPECT_EQ(scan.exit_code, 0) << scan.text;
}

INSTANTIATE_TEST_SUITE_P(Seeds, SuddenDeath, testing::Values(41, 42, 43, 44));

}  // namespace
}  // namespace instep
