#include "daemon/station/station_signals.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <optional>
#include <set>

#include "tests/support/loop_thread.h"
#include "tests/support/model_board.h"

namespace instep {
namespace {

const std::vector<std::string> kNames = {"lamp.ready", "lamp.busy", "lamp.fault", "projector"};

GpioOutputSettings line(const std::string& name) {
  GpioOutputSettings settings;
  settings.place.line = name;
  return settings;
}

class StationSignalsTest : public testing::Test {
 protected:
  ~StationSignalsTest() override { thread_->stop(); }

  void open(const OutputSettings& outputs) {
    thread_->call([&] {
      signals_.emplace(
          thread_->loop(), outputs,
          [this](const GpioOutputSettings& chosen) { return board_.open(chosen.place.line); },
          [] {});
    });
  }
  std::set<std::string> lit() const {
    std::set<std::string> names;
    for (const auto& name : kNames) {
      if (board_.is_on(name)) names.insert(name);
    }
    return names;
  }
  /// Whether just these are lit, once all is done that the state asks for.
  bool shows(StationState state, const std::set<std::string>& wanted) {
    thread_->call([&] { signals_->show(state); });
    return thread_->wait_until([&] { return lit() == wanted; });
  }

  test::ModelBoard board_;
  std::optional<test::LoopThread> thread_{std::in_place};
  std::optional<StationSignals> signals_;
};

TEST_F(StationSignalsTest, ShowTheStateAndLightTheCaptureAlone) {
  open({line("lamp.ready"), line("lamp.busy"), line("lamp.fault"), line("projector")});
  using Lit = std::set<std::string>;
  const std::vector<std::pair<StationState, Lit>> scan = {
      {StationState::kStarting, {"lamp.busy"}},
      {StationState::kReady, {"lamp.ready"}},
      {StationState::kCapturing, {"lamp.busy", "projector"}},
      {StationState::kMeasuring, {"lamp.busy"}},
      {StationState::kStoring, {"lamp.busy"}},
      {StationState::kDegraded, {"lamp.fault"}},
      {StationState::kFault, {"lamp.fault"}},
      {StationState::kReady, {"lamp.ready"}}};
  for (const auto& [state, wanted] : scan) {
    EXPECT_TRUE(shows(state, wanted)) << to_string(state);
  }
  thread_->stop();
  signals_.reset();
  EXPECT_EQ(lit(), Lit());
}

TEST_F(StationSignalsTest, GiveABoardThatHangsUpAllAtOnce) {
  // One after the other they take a moment each, whatever the machine does. A busy one only adds to
  // what they take: the quickest of some tries tells which it is.
  constexpr auto kLessThanOneByOne = 3 * OutputKeeper::kLastMoment;
  auto quickest = std::chrono::steady_clock::duration::max();
  for (int tries = 0; tries < 5 && quickest >= kLessThanOneByOne; ++tries) {
    board_ = {};
    thread_.emplace();
    open({line("lamp.ready"), line("lamp.busy"), line("lamp.fault"), line("projector")});
    ASSERT_TRUE(shows(StationState::kCapturing, {"lamp.busy", "projector"}));
    board_.hang();
    thread_->stop();
    const auto begin = std::chrono::steady_clock::now();
    signals_.reset();
    quickest = std::min(quickest, std::chrono::steady_clock::now() - begin);
    board_.let_go();
    EXPECT_TRUE(board_.wait_for_changes(4));
    EXPECT_EQ(lit(), std::set<std::string>());
  }
  EXPECT_LT(quickest, kLessThanOneByOne);
}

TEST_F(StationSignalsTest, AreOnlyThoseThatTheSettingsName) {
  OutputSettings outputs;
  outputs.projector = line("projector");
  open(outputs);
  EXPECT_TRUE(shows(StationState::kCapturing, {"projector"}));
  thread_->stop();
  ASSERT_EQ(signals_->status().size(), 1U);
  EXPECT_EQ(signals_->status()[0].name, "projector");
  EXPECT_TRUE(signals_->status()[0].on);
}

}  // namespace
}  // namespace instep
