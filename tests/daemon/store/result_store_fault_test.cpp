#include <gtest/gtest.h>

#include <random>
#include <string>

#include "daemon/scan/scan_id.h"
#include "daemon/store/result_store.h"
#include "tests/daemon/store/simulated_disk.h"

namespace instep {
namespace {

using test::FaultyStorage;
using test::SimulatedDisk;
using Fault = FaultyStorage::Fault;

constexpr const char* kOld = "20261120T080000000Z-aaaa";
constexpr const char* kNew = "20261121T091502417Z-k3f9";
constexpr const char* kNext = "20261121T091502418Z-bbbb";

ResultContent content(const std::string& id) {
  return {"json of " + id, "cloud of " + id + std::string(1000, '.'), "sections of " + id,
          "report of " + id};
}

bool is_whole(SimulatedDisk& disk, const ResultStore& store, const std::string& id) {
  const auto folder = store.folder_of(id);
  const auto same = [&](const char* file, const std::string& wanted) {
    const auto bytes = disk.read(folder / file, 1 << 20);
    return bytes && *bytes == wanted;
  };
  const auto wanted = content(id);
  return same("result.json", wanted.result_json) && same("cloud.ply", wanted.cloud_ply) &&
         same("sections.svg", wanted.sections_svg) && same("report.svg", wanted.report_svg);
}

/// After whatever happened: starts again, and checks that each result is whole, that those reported
/// are there, that nothing else is, and that the next one can be stored.
void check_after_restart(const std::shared_ptr<SimulatedDisk>& disk,
                         const std::vector<std::string>& reported, const std::string& where) {
  ResultStore store(disk, "/scans");
  ASSERT_TRUE(store.prepare()) << where;
  const auto ids = store.list();
  ASSERT_TRUE(ids) << where;
  for (const auto& id : *ids) ASSERT_TRUE(is_whole(*disk, store, id)) << where << ", torn " << id;
  for (const auto& id : reported) ASSERT_TRUE(store.find(id)) << where << ", lost " << id;
  const auto cleared_again = store.prepare();
  ASSERT_TRUE(cleared_again) << where;
  ASSERT_EQ(cleared_again->cleared, 0U) << where;
  ASSERT_TRUE(store.put(kNext, content(kNext))) << where;
  ASSERT_TRUE(is_whole(*disk, store, kNext)) << where;
}

std::shared_ptr<SimulatedDisk> disk_with_an_old_result() {
  auto disk = std::make_shared<SimulatedDisk>();
  ResultStore store(disk, "/scans");
  EXPECT_TRUE(disk->sync_folder("/"));
  EXPECT_TRUE(store.prepare());
  EXPECT_TRUE(disk->sync_folder("/"));
  EXPECT_TRUE(store.put(kOld, content(kOld)));
  return disk;
}

class ResultStoreFault : public testing::TestWithParam<Fault> {};

TEST_P(ResultStoreFault, LeavesNoTornResultWhicheverCallFails) {
  std::size_t call = 1;
  for (bool struck = true; struck; ++call) {
    const auto disk = disk_with_an_old_result();
    const auto faulty = std::make_shared<FaultyStorage>(disk, GetParam(), call);
    const bool stored = ResultStore(faulty, "/scans").put(kNew, content(kNew)).has_value();
    struck = faulty->struck();
    std::vector<std::string> reported = {kOld};
    if (stored) reported.push_back(kNew);
    EXPECT_EQ(stored, !struck || GetParam() == Fault::kShortWrite) << "call " << call;
    check_after_restart(disk, reported, "call " + std::to_string(call));
  }
  EXPECT_GT(call, 20U);
}

TEST_P(ResultStoreFault, DeletesWholeResultsOrNoneWhicheverCallFails) {
  std::size_t call = 1;
  for (bool struck = true; struck; ++call) {
    const auto disk = disk_with_an_old_result();
    const auto faulty = std::make_shared<FaultyStorage>(disk, GetParam(), call);
    (void)ResultStore(faulty, "/scans").remove(kOld);
    struck = faulty->struck();
    check_after_restart(disk, {}, "call " + std::to_string(call));
  }
  EXPECT_GT(call, 8U);
}

// What is on trial is the disk: the results, and one that is being written, are left as they are.
TEST_P(ResultStoreFault, SaysOfADiskThatFailsThatItDoesAndLeavesNoTrialBehind) {
  const auto today = *time_of_scan_id(kOld);
  const std::filesystem::path day = "/scans/2026/11/20";
  const auto half_made = day / ".writing-x";
  std::size_t call = 1;
  for (bool struck = true; struck; ++call) {
    const auto disk = disk_with_an_old_result();
    ASSERT_TRUE(disk->make_folder(half_made));
    const auto faulty = std::make_shared<FaultyStorage>(disk, GetParam(), call);
    const bool works = ResultStore(faulty, "/scans").try_out(today).has_value();
    struck = faulty->struck();
    // A look for the newest, one at the root's mark, and the clearing of an earlier trial.
    const bool may_fail = (call >= 4 && call <= 7) || call == 9 || call == 16;
    const bool harmless =
        GetParam() == Fault::kShortWrite ||
        (may_fail && GetParam() != Fault::kDiesBefore && GetParam() != Fault::kDiesAfter);
    EXPECT_EQ(works, !struck || harmless) << "call " << call;
    ASSERT_TRUE(ResultStore(disk, "/scans").try_out(today)) << "call " << call;
    EXPECT_EQ(disk->list("/scans")->size(), 2U) << "the mark and the year, call " << call;
    EXPECT_EQ(disk->list(day)->size(), 2U) << "the old and the half-made one, call " << call;
    check_after_restart(disk, {kOld}, "call " + std::to_string(call));
  }
  EXPECT_GT(call, 20U);
}

INSTANTIATE_TEST_SUITE_P(All, ResultStoreFault,
                         testing::Values(Fault::kIo, Fault::kNoSpace, Fault::kShortWrite,
                                         Fault::kDiesBefore, Fault::kDiesAfter));

TEST(ResultStore, NeitherTearsNorLosesAResultInTenThousandPowerCuts) {
  for (std::uint64_t seed = 0; seed < 10000; ++seed) {
    std::mt19937_64 random(seed);
    const auto disk = disk_with_an_old_result();
    const auto dying = std::make_shared<FaultyStorage>(
        disk, random() % 2 == 0 ? Fault::kDiesBefore : Fault::kDiesAfter, 1 + random() % 26);
    ResultStore store(dying, "/scans");
    std::vector<std::string> reported = {kOld};
    if (store.put(kNew, content(kNew))) reported.push_back(kNew);
    if (random() % 4 == 0) {
      reported.erase(reported.begin());
      (void)store.remove(kOld);
    }
    disk->cut_power(random);
    check_after_restart(disk, reported, "seed " + std::to_string(seed));
    if (HasFatalFailure()) return;
  }
}

}  // namespace
}  // namespace instep
