#include "daemon/station/scan_session.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <deque>
#include <fstream>
#include <nlohmann/json.hpp>

#include "core/go_on.h"
#include "daemon/scan/scan_id.h"
#include "daemon/store/posix_storage.h"
#include "sim/simulated_station.h"
#include "tests/support/scripted_camera.h"
#include "tests/support/temporary_folder.h"

namespace instep {
namespace {

constexpr const char* kStages[] = {"fuse frames", "fuse views", "align", "landmarks", "girths"};

std::shared_ptr<CameraSet> small_cameras() {
  SimulationSettings settings;
  settings.cameras = 3;
  settings.width_px = 160;
  settings.height_px = 120;
  settings.pacing = Pacing::kAsFastAsPossible;
  auto station = build_station(settings);
  return std::make_shared<CameraSet>(std::move(station->cameras));
}

ScanTools small_tools(const std::filesystem::path& results) {
  ScanTools tools;
  tools.cameras = small_cameras();
  tools.capture.frames_per_camera = 2;
  tools.platform_height_mm = 0.0;
  tools.store = std::make_shared<ResultStore>(std::make_shared<PosixStorage>(), results);
  EXPECT_TRUE(tools.store->prepare());
  return tools;
}

ScanOutcome scan_with(const ScanTools& tools) {
  TaskProgress progress;
  const std::atomic<bool> cancelled = false;
  const ScanListener listener{[](ScanStep) {}, [](std::string_view, double) {}};
  return run_scan(tools, cancelled, progress, listener);
}

/// But for the store's mark, which is of no scan.
std::size_t files_in(const std::filesystem::path& folder) {
  std::size_t count = 0;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder)) {
    if (!entry.is_directory() && entry.path().filename() != "store-id") ++count;
  }
  return count;
}

/// A scan whose measuring is cancelled at its k-th step.
class CancelledScan : public testing::Test {
 protected:
  CancelledScan() : cameras_(small_cameras()) {}

  struct Run {
    ScanOutcome outcome;
    std::size_t steps = 0;  ///< of the measuring
    std::map<std::string, std::size_t> steps_of_stage;
    std::uint64_t progress = 0;  ///< that the watchdog saw during the measuring
    std::size_t told_stages = 0;
    std::size_t files = 0;
  };

  Run run(std::optional<std::size_t> cancel_at) {
    const test::TemporaryFolder folder;
    Run run;
    TaskProgress progress;
    std::atomic<bool> cancelled = false;
    ScanTools tools;
    tools.cameras = cameras_;
    tools.capture.frames_per_camera = 2;
    tools.capture.warmup_frames = 0;
    tools.platform_height_mm = 0.0;
    tools.store =
        std::make_shared<ResultStore>(std::make_shared<PosixStorage>(), folder.path() / "scans");
    EXPECT_TRUE(tools.store->prepare());
    tools.measure = [&](const Capture& capture, const PipelineSettings& settings,
                        const ScanProgress& told) {
      const auto before = progress.steps();
      if (!first_) first_ = capture;
      auto records = measure_capture(*first_, settings, [&](std::string_view stage, double done) {
        ++run.steps_of_stage[std::string(stage)];
        if (++run.steps == cancel_at) cancelled = true;
        return told(stage, done);
      });
      run.progress = progress.steps() - before;
      return records;
    };
    ScanListener listener;
    listener.on_step = [](ScanStep) {};
    listener.on_progress = [&](std::string_view, double) { ++run.told_stages; };
    run.outcome = run_scan(tools, cancelled, progress, listener);
    run.files = files_in(folder.path());
    return run;
  }

 private:
  std::shared_ptr<CameraSet> cameras_;
  /// All runs measure the same frames: how often the fit of the views steps depends on their noise.
  std::optional<Capture> first_;
};

TEST_F(CancelledScan, TellsEachPieceOfEachStageAndEachStageOnce) {
  const auto whole = run(std::nullopt);
  ASSERT_FALSE(whole.outcome.error) << whole.outcome.error->line();
  EXPECT_EQ(whole.files, 4U);  // result.json, cloud.ply, sections.svg, report.svg
  EXPECT_EQ(whole.progress, whole.steps);
  EXPECT_EQ(whole.steps_of_stage.at("fuse frames"), 1U + 3 * 2);
  // Three cameras twice, four rounds of fitting them at least, the stages between, one foot.
  EXPECT_GE(whole.steps_of_stage.at("fuse views"), 1U + 2 * 3 + 4 + 3 + 1);
  EXPECT_EQ(whole.steps_of_stage.at("girths"), 1U + 18);     // one for each measure
  EXPECT_EQ(whole.told_stages, 1 + std::size(kStages) + 2);  // capture, ..., store, done
}

/// A remark is made once, and stands in the result.
TEST(ScanSession, TellsInTheResultHowTheFramesWereTaken) {
  const test::TemporaryFolder folder;
  ScanTools tools = small_tools(folder.path() / "scans");
  tools.measure = measure_capture;
  tools.remarks->note("the projector was off");
  tools.remarks->note("the projector was off");
  const auto outcome = scan_with(tools);
  ASSERT_FALSE(outcome.error) << outcome.error->line();
  std::ifstream file(outcome.stored.at(0).folder / "result.json");
  const auto result = nlohmann::json::parse(file);
  const auto warnings = result.at("warnings").get<std::vector<std::string>>();
  EXPECT_EQ(std::count(warnings.begin(), warnings.end(), "the projector was off"), 1);
}

/// Its id sorted before that of the customer before, where the clock had been set back meanwhile.
TEST(ScanSession, GivesIdsThatSortBehindThoseThatAreThere) {
  const test::TemporaryFolder folder;
  const ScanTools tools = [&] {
    ScanTools small = small_tools(folder.path() / "scans");
    small.measure = measure_capture;
    return small;
  }();
  using namespace std::chrono;
  const auto before = new_scan_ids(system_clock::now() + minutes(3), 1).front();
  ASSERT_TRUE(tools.store->put(before, {"{}", "ply", "<svg/>", "<svg/>"}));
  const auto outcome = scan_with(tools);
  ASSERT_FALSE(outcome.error) << outcome.error->line();
  EXPECT_EQ(time_of_scan_id(outcome.stored.at(0).id), *time_of_scan_id(before) + milliseconds(1));
}

/// Those that the cameras' own threads leave out never come to the fusion, which counts others.
TEST(ScanSession, CountsTheFaultyFramesOfItsCapture) {
  using Step = test::ScriptedCamera::Step;
  const test::TemporaryFolder folder;
  ScanTools tools = small_tools(folder.path() / "scans");
  tools.capture.warmup_frames = 0;
  std::vector<std::unique_ptr<DepthCamera>> cameras;
  cameras.push_back(std::make_unique<test::ScriptedCamera>(
      "left", std::deque<Step>{Step::kGood, Step::kEmpty, Step::kGood, Step::kGood}));
  cameras.push_back(std::make_unique<test::ScriptedCamera>(
      "right", std::deque<Step>{Step::kCorrupt, Step::kZero, Step::kGood, Step::kGood}));
  tools.cameras = std::make_shared<CameraSet>(std::move(cameras));
  std::vector<std::uint64_t> counts;
  tools.measure = [&](const Capture& capture, const PipelineSettings&,
                      const ScanProgress&) -> Result<std::vector<ScanRecord>> {
    counts.push_back(capture.frames_rejected);
    return cancelled();
  };
  scan_with(tools);
  scan_with(tools);
  EXPECT_EQ(counts, (std::vector<std::uint64_t>{3, 0}));
}

TEST(ScanSession, TellsInTheResultHowManyFramesWereFaulty) {
  const test::TemporaryFolder folder;
  ScanTools tools = small_tools(folder.path() / "scans");
  tools.measure = [](Capture capture, const PipelineSettings& settings, const ScanProgress& told) {
    capture.frames_rejected = 3;
    return measure_capture(capture, settings, told);
  };
  const auto outcome = scan_with(tools);
  ASSERT_FALSE(outcome.error) << outcome.error->line();
  std::ifstream file(outcome.stored.at(0).folder / "result.json");
  EXPECT_EQ(nlohmann::json::parse(file).at("quality").at("frames_rejected"), 3.0);
}

/// Whoever scanned again had one foot twice.
TEST(ScanSession, StoresBothFeetOrNone) {
  const test::TemporaryFolder folder;
  ScanTools tools = small_tools(folder.path() / "scans");
  tools.measure = [](const Capture& capture, const PipelineSettings& settings,
                     const ScanProgress& told) {
    auto records = measure_capture(capture, settings, told);
    records->push_back(records->front());
    records->back().id = "20261121T091502417Z-k3f9";
    return records;
  };
  std::filesystem::create_directories(folder.path() / "scans/2026/11");
  std::ofstream(folder.path() / "scans/2026/11/21") << "in the way of the second foot";
  const auto outcome = scan_with(tools);
  EXPECT_TRUE(outcome.error);
  EXPECT_TRUE(outcome.store_failed);
  EXPECT_TRUE(outcome.stored.empty());
  EXPECT_TRUE(tools.store->list()->empty());
}

TEST_F(CancelledScan, EndsAtOnceAndLeavesNothingAtEveryStep) {
  const auto whole = run(std::nullopt);
  ASSERT_FALSE(whole.outcome.error);
  for (std::size_t k = 1; k <= whole.steps; ++k) {
    const auto cut = run(k);
    ASSERT_TRUE(cut.outcome.error) << k;
    EXPECT_EQ(cut.outcome.error->line(), cancelled().value().line()) << k;
    EXPECT_FALSE(cut.outcome.store_failed);
    EXPECT_TRUE(cut.outcome.stored.empty());
    EXPECT_EQ(cut.steps, k) << "it went on after the cancel";
    EXPECT_EQ(cut.files, 0U) << k;
  }
}

}  // namespace
}  // namespace instep
