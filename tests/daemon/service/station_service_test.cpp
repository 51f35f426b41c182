#include "daemon/service/station_service.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <poll.h>
#include <signal.h>
#include <stdlib.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <atomic>
#include <condition_variable>
#include <future>
#include <mutex>
#include <nlohmann/json.hpp>

#include "daemon/control/control_client.h"
#include "daemon/scan/scan_id.h"
#include "tests/support/notifications.h"
#include "tests/support/small_station.h"
#include "tests/support/temporary_folder.h"

namespace {

/// A disk on which nothing that is written is durable while it stalls.
class Disk {
 public:
  void stall() { set(true); }
  void release() { set(false); }
  /// Waits until so many threads wait for it; false if they do not come.
  bool has_waiting(int threads) {
    std::unique_lock lock(mutex_);
    return changed_.wait_for(lock, std::chrono::seconds(60), [&] { return waiting_ >= threads; });
  }
  void flush() {
    std::unique_lock lock(mutex_);
    ++waiting_;
    changed_.notify_all();
    changed_.wait(lock, [this] { return !stalls_; });
    --waiting_;
  }

 private:
  void set(bool stalls) {
    const std::lock_guard lock(mutex_);
    stalls_ = stalls;
    changed_.notify_all();
  }

  std::mutex mutex_;
  std::condition_variable changed_;
  bool stalls_ = false;
  int waiting_ = 0;
};

Disk disk;

}  // namespace

/// In place of the C library's.
extern "C" int fsync(int file) {
  disk.flush();
  return static_cast<int>(::syscall(SYS_fsync, file));
}

namespace instep {
namespace {

using namespace std::chrono_literals;
using std::chrono::steady_clock;

/// For what is to come: on a machine that is as busy as can be, the start alone took 18 s.
constexpr auto kLong = 120000ms;
constexpr auto kWatchdog = 400ms;
/// A service feeds it once a second: what is left of each turn is for a busy machine.
constexpr auto kPatientWatchdog = 6000ms;
/// A second is promised, and of that work that hangs alone takes 850 ms: what is more is for a busy
/// machine. That the limits of the service add up to less than a second is checked where they
/// stand; without one of them the work would be waited for without end, or for a second more.
constexpr auto kEnd = 1600ms;

Settings small_station(const std::filesystem::path& folder) {
  Settings settings = test::small_station();
  settings.store.root = std::filesystem::proximate(folder) / "scans";
  settings.control.socket = folder / "control.sock";
  settings.log.level = LogLevel::kError;
  // A busy machine is no camera that fails a scan.
  settings.capture.deadline = 60s;
  settings.capture.frame_limit = 5s;
  return settings;
}

Result<std::vector<ScanRecord>> one_foot() {
  std::vector<ScanRecord> records(1);
  records[0].time = std::chrono::system_clock::now();
  records[0].id = new_scan_ids(records[0].time, 1).at(0);
  return records;
}

/// A service in this process whose measuring is what a test makes of it.
class MeasuringService : public testing::Test {
 protected:
  MeasuringService() : notifications_(folder_.path() / "notify.sock") {
    ::setenv("NOTIFY_SOCKET", (folder_.path() / "notify.sock").c_str(), 1);
    set_watchdog(kWatchdog);
    ::unsetenv("WATCHDOG_PID");
    sigset_t signals;
    sigemptyset(&signals);
    for (const int signal : {SIGTERM, SIGINT, SIGHUP}) sigaddset(&signals, signal);
    pthread_sigmask(SIG_BLOCK, &signals, &signals_before_);
  }
  ~MeasuringService() override {
    // Of a test that was given up: what still runs would be waited for without end.
    disk.release();
    const bool runs = running_.valid() && running_.wait_for(0s) != std::future_status::ready;
    if (runs) ::pthread_kill(service_thread_, SIGTERM);
    if (running_.valid()) running_.wait();
    // Other tests of this program raise them.
    pthread_sigmask(SIG_SETMASK, &signals_before_, nullptr);
    ::unsetenv("NOTIFY_SOCKET");
    ::unsetenv("WATCHDOG_USEC");
  }

  /// For a service that is yet to begin.
  static void set_watchdog(std::chrono::microseconds limit) {
    ::setenv("WATCHDOG_USEC", std::to_string(limit.count()).c_str(), 1);
  }

  /// Runs the service.
  void start(MeasureCapture measure) {
    const auto settings = small_station(folder_.path());
    running_ = std::async(std::launch::async, [this, settings, measure] {
      self_.set_value(::pthread_self());
      auto service = StationService::create(
          settings, [settings] { return Result<Settings>(settings); },
          [this, measure](const Capture& capture, const PipelineSettings& pipeline,
                          const ScanProgress& progress) {
            if (!measures_.exchange(true)) measuring_.set_value();
            return measure(capture, pipeline, progress);
          });
      ended_.set_value(service ? (*service)->run() : tl::make_unexpected(service.error()));
    });
    service_thread_ = self_.get_future().get();
  }

  /// And begins a scan; returns once it measures.
  void begin(MeasureCapture measure) {
    start(std::move(measure));
    ASSERT_TRUE(notifications_.wait_for("STATUS=ready", kLong));
    ASSERT_FALSE(ask("list").is_null()) << "the store is prepared";
    ASSERT_FALSE(ask("scan").is_null());
    ASSERT_EQ(measuring_.get_future().wait_for(kLong), std::future_status::ready);
  }

  /// The same with one foot, which is stored when this returns.
  void begin_and_store() {
    ASSERT_NO_FATAL_FAILURE(begin(
        [](const Capture&, const PipelineSettings&, const ScanProgress&) { return one_foot(); }));
    ASSERT_TRUE(notifications_.wait_for("STATUS=storing", kLong));
    ASSERT_TRUE(notifications_.wait_for("STATUS=ready", kLong));
  }

  nlohmann::json ask(const std::string& verb, const std::string& id = {}) const {
    auto client = ControlClient::connect(folder_.path() / "control.sock");
    return client->ask(verb, id, kLong).value_or(nlohmann::json());
  }

  void reload() { ::pthread_kill(service_thread_, SIGHUP); }

  /// Looks at the watchdog may still see the step by which a task began and the last one.
  bool leaves_the_watchdog_hungry() {
    constexpr int kMayStillBeFed = 2;
    notifications_.forget();
    int fed = 0;
    while (fed <= kMayStillBeFed && notifications_.wait_for("WATCHDOG=1", 2 * kWatchdog)) ++fed;
    return fed <= kMayStillBeFed;
  }

  /// What run() gave after SIGTERM; nothing if it was not over within `limit`.
  std::optional<bool> end(std::chrono::milliseconds limit = kLong) {
    // Its own thread, for one that another test has left behind may not have blocked the signal.
    ::pthread_kill(service_thread_, SIGTERM);
    auto future = ended_.get_future();
    if (future.wait_for(limit) != std::future_status::ready) return std::nullopt;
    const auto ended = future.get();
    return ended && *ended;
  }

  bool stored_anything() const {
    for (const auto& entry :
         std::filesystem::recursive_directory_iterator(folder_.path() / "scans")) {
      if (entry.path().filename() == "result.json") return true;
    }
    return false;
  }

  test::TemporaryFolder folder_;
  test::Notifications notifications_;

 private:
  std::promise<void> measuring_;
  std::atomic<bool> measures_ = false;  ///< or has
  std::promise<Result<bool>> ended_;
  sigset_t signals_before_{};
  std::promise<pthread_t> self_;
  pthread_t service_thread_{};
  std::future<void> running_;
};

tl::unexpected<Error> given_up() {
  return fail(ErrorCode::kCancelled, "given up", "");
}

Result<std::vector<ScanRecord>> measure_for_long(const Capture&, const PipelineSettings&,
                                                 const ScanProgress& progress) {
  while (progress("girths", 0.5)) ::poll(nullptr, 0, 20);  // a piece of work
  return given_up();
}

TEST_F(MeasuringService, EndsCleanlyWithinASecondWhenItMeasuresForLong) {
  ASSERT_NO_FATAL_FAILURE(begin(measure_for_long));
  EXPECT_EQ(end(kEnd), true);
  EXPECT_FALSE(stored_anything());
}

TEST_F(MeasuringService, FeedsTheWatchdogThroughLongWorkThatMovesOn) {
  set_watchdog(kPatientWatchdog);
  ASSERT_NO_FATAL_FAILURE(begin(measure_for_long));
  for (int i = 0; i < 4; ++i) EXPECT_TRUE(notifications_.wait_for("WATCHDOG=1", kPatientWatchdog));
  EXPECT_EQ(end(), true);
}

TEST_F(MeasuringService, LeavesTheWatchdogHungryWhenTheWorkHangsAndEndsWithinASecond) {
  // Shared, since the thread that hangs outlives the service.
  const auto release = std::make_shared<std::promise<void>>();
  const auto over = std::make_shared<std::promise<void>>();
  ASSERT_NO_FATAL_FAILURE(
      begin([until = release->get_future().share(), over](
                const Capture&, const PipelineSettings&,
                const ScanProgress& progress) -> Result<std::vector<ScanRecord>> {
        progress("girths", 0.5);
        until.wait();
        over->set_value();
        return given_up();
      }));
  EXPECT_TRUE(leaves_the_watchdog_hungry());
  EXPECT_EQ(end(kEnd), false);
  EXPECT_FALSE(stored_anything());
  release->set_value();
  over->get_future().wait();
}

// To be killed for it would cost a customer's scan, and mend no disk.
TEST_F(MeasuringService, FeedsTheWatchdogWhileTheDiskStallsWithAMeasuredScanInHand) {
  set_watchdog(kPatientWatchdog);
  ASSERT_NO_FATAL_FAILURE(begin_and_store());
  const std::string last = ask("status")["last_result"];
  disk.stall();
  ASSERT_FALSE(ask("scan").is_null());
  ASSERT_TRUE(disk.has_waiting(1)) << "with the scan";
  const auto deleted = std::async(std::launch::async, [&] { return ask("delete", last); });
  ASSERT_TRUE(disk.has_waiting(2)) << "with the archive too";
  notifications_.forget();
  const auto deadline = steady_clock::now() + kLong;
  nlohmann::json status;
  do {
    EXPECT_TRUE(notifications_.wait_for("WATCHDOG=1", kPatientWatchdog));
    status = ask("status");
  } while (status["warnings"].empty() && steady_clock::now() < deadline);
  EXPECT_THAT(status["warnings"].dump(), testing::HasSubstr("the scan is not stored yet"));
  EXPECT_EQ(status["state"], "storing") << "and is not given up";
  disk.release();
  EXPECT_TRUE(notifications_.wait_for("STATUS=ready", kLong));
  EXPECT_TRUE(ask("status")["warnings"].empty());
  deleted.wait();
  EXPECT_EQ(end(), true);
  EXPECT_TRUE(stored_anything());
}

/// It was killed again and again before it could say what is wrong.
TEST_F(MeasuringService, IsReadyAndFedThoughTheDiskOfItsResultsHangsFromTheStart) {
  set_watchdog(kPatientWatchdog);
  disk.stall();
  start([](const Capture&, const PipelineSettings&, const ScanProgress&) { return one_foot(); });
  EXPECT_TRUE(notifications_.wait_for("READY=1", kLong));
  ASSERT_TRUE(disk.has_waiting(1));
  EXPECT_TRUE(notifications_.wait_for("STATUS=fault", kLong)) << "a look later";
  const auto status = ask("status");
  EXPECT_THAT(status["troubles"].dump(), testing::HasSubstr("disk of the results does not answer"));
  EXPECT_EQ(status["store"]["trouble"], status["trouble"]);
  for (int i = 0; i < 4; ++i)
    EXPECT_TRUE(notifications_.wait_for("WATCHDOG=1", kPatientWatchdog)) << i;
  disk.release();
  EXPECT_TRUE(notifications_.wait_for("STATUS=ready", kLong)) << "tried out as soon as it answers";
  EXPECT_EQ(ask("list")["scans"].size(), 0U);
  EXPECT_EQ(end(), true);
}

/// It was said to be gone for up to a minute after it was there again, and no scan could begin.
TEST_F(MeasuringService, IsReadySoonAfterTheDiskOfItsResultsIsBack) {
  start([](const Capture&, const PipelineSettings&, const ScanProgress&) { return one_foot(); });
  ASSERT_TRUE(notifications_.wait_for("STATUS=ready", kLong));
  const auto root = folder_.path() / "scans";
  const auto aside = folder_.path() / "aside";
  ASSERT_EQ(ask("list")["scans"].size(), 0U) << "it is prepared";
  std::filesystem::rename(root, aside);
  ASSERT_TRUE(notifications_.wait_for("STATUS=fault", kLong));
  std::filesystem::rename(aside, root);
  EXPECT_TRUE(notifications_.wait_for("STATUS=ready", kLong));
  EXPECT_EQ(end(), true);
}

/// A look at the store that waited behind it passed for the one that takes so long.
TEST_F(MeasuringService, LeavesTheWatchdogHungryWhenADeletionHangsThoughALookWaits) {
  ASSERT_NO_FATAL_FAILURE(begin_and_store());
  const std::string last = ask("status")["last_result"];
  disk.stall();
  const auto deleted = std::async(std::launch::async, [&] { return ask("delete", last); });
  EXPECT_TRUE(disk.has_waiting(1));
  reload();  // which looks at once
  EXPECT_TRUE(notifications_.wait_for("READY=1", kLong));
  EXPECT_TRUE(leaves_the_watchdog_hungry());
  disk.release();
  deleted.wait();
  EXPECT_EQ(end(), true);
}

/// It was forgotten for good when somebody asked to delete it while the disk was away.
TEST_F(MeasuringService, ForgetsTheLastResultWhenItIsDeletedAndNotWhenItsDiskIsAway) {
  ASSERT_NO_FATAL_FAILURE(begin_and_store());
  const auto root = folder_.path() / "scans";
  const std::filesystem::path told = ask("status")["store"]["root"].get<std::string>();
  EXPECT_EQ(told.lexically_normal(), root) << "whole, though the settings name it from here";
  const std::string last = ask("status")["last_result"];
  EXPECT_NE(last, "");
  std::filesystem::rename(root, folder_.path() / "aside");
  EXPECT_TRUE(ask("delete", last).is_null());
  EXPECT_EQ(ask("status")["last_result"], last);
  std::filesystem::rename(folder_.path() / "aside", root);
  EXPECT_EQ(ask("delete", last)["id"], last);
  EXPECT_EQ(ask("status")["last_result"], "");
  EXPECT_EQ(end(), true);
}

}  // namespace
}  // namespace instep
