#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <poll.h>
#include <signal.h>

#include <fstream>
#include <nlohmann/json.hpp>
#include <random>
#include <string>

#include "daemon/store/scan_id.h"
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
    EXPECT_EQ(bytes_of(entry.path() / "cloud.ply").substr(0, 3), "ply") << entry.path();
  }
  return count;
}

/// Two hundred deaths in all, in parts that can run side by side.
class SuddenDeath : public testing::TestWithParam<std::uint64_t> {};

TEST_P(SuddenDeath, LeavesNoTornResultAtFiftyRandomMomentsOfAScan) {
  const std::uint64_t seed = GetParam();
  constexpr int kDeaths = 50;
  StationProcess station;
  station.write_settings(StationProcess::tiny_settings());
  std::mt19937_64 random(seed);
  std::chrono::milliseconds scan_time{600};
  std::size_t seen = 0;
  for (int death = 0; death < kDeaths; ++death) {
    station.start();
    ASSERT_TRUE(station.wait_for("STATUS=ready", 60s)) << station.log();
    auto client = station.connect();
    ASSERT_TRUE(client);
    ASSERT_TRUE(client->ask("watch"));
    const auto begun = std::chrono::steady_clock::now();
    ASSERT_TRUE(client->ask("scan"));
    if (death == 0) {
      // The first scan may end: it tells how long one takes, and so when to strike.
      while (client->next(60s).value_or(nlohmann::json{{"event", "result"}})["event"] != "result") {
      }
      scan_time =
          std::chrono::ceil<std::chrono::milliseconds>(std::chrono::steady_clock::now() - begun);
    } else {
      const auto strike = static_cast<int>(
          random() % static_cast<std::uint64_t>(scan_time.count() + scan_time.count() / 5 + 1));
      ::poll(nullptr, 0, strike);
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
