#include "daemon/station/output_keeper.h"

#include <gtest/gtest.h>

#include <atomic>
#include <string>
#include <thread>
#include <vector>

#include "tests/support/loop_thread.h"
#include "tests/support/model_board.h"

namespace instep {
namespace {

using namespace std::chrono_literals;

constexpr auto kOften = 5ms;
constexpr OutputKeeper::Pace kPatient{kOften, 1h};

class OutputKeeperTest : public testing::Test {
 protected:
  ~OutputKeeperTest() override {
    board_.let_go();
    thread_.stop();
  }

  void keep(const OutputKeeper::Pace& pace) {
    keep(pace, [this] { return board_.open("lamp"); });
  }
  void keep(const OutputKeeper::Pace& pace, const OutputKeeper::Open& open) {
    thread_.call([&] {
      keeper_.emplace(
          thread_.loop(), "lamp", open, [this] { said_.push_back(trouble()); }, pace);
    });
  }
  void set(bool on) {
    thread_.call([&] { keeper_->set(on); });
  }
  bool becomes(bool on) {
    return thread_.wait_until([&] { return board_.is_on("lamp") == on; });
  }
  /// Of a board that hangs until the keeper has ended; its thread, which is left behind, puts the
  /// line off later.
  void expect_end_without_waiting() {
    thread_.stop();
    keeper_.reset();
    EXPECT_TRUE(board_.is_on("lamp"));
    board_.let_go();
    EXPECT_TRUE(board_.wait_for_changes(2));
    EXPECT_FALSE(board_.is_on("lamp"));
  }
  std::string trouble() const { return keeper_->trouble() ? keeper_->trouble()->message : ""; }

  test::ModelBoard board_;
  test::LoopThread thread_;
  std::vector<std::string> said_;  ///< of each change of its trouble; the loop's, as the keeper
  std::optional<OutputKeeper> keeper_;
};

TEST_F(OutputKeeperTest, DoesTheLastWishAndPutsTheLineOffAtItsEnd) {
  keep(kPatient);
  for (const bool on : {true, false, true}) set(on);
  ASSERT_TRUE(becomes(true));
  thread_.stop();
  keeper_.reset();
  EXPECT_FALSE(board_.is_on("lamp"));
  EXPECT_TRUE(said_.empty());
}

TEST_F(OutputKeeperTest, SaysOnceThatTheBoardLeftAndLightsTheLampWhenItIsBack) {
  keep(kPatient);
  set(true);
  ASSERT_TRUE(becomes(true));
  for (int round = 0; round < 3; ++round) {
    thread_.call([&] { said_.clear(); });
    board_.unplug();
    ASSERT_TRUE(thread_.wait_until([&] { return !said_.empty(); })) << "though nothing changes";
    std::this_thread::sleep_for(10 * kOften);  // in which it is looked for again and again
    board_.plug_in();
    ASSERT_TRUE(becomes(true));
    ASSERT_TRUE(thread_.wait_until([&] { return said_.size() > 1; }));
    thread_.call([&] { EXPECT_EQ(said_, (std::vector<std::string>{"there is no board", ""})); });
  }
}

// The loop goes on, and of what was wanted meanwhile only the last is done.
TEST_F(OutputKeeperTest, HoldsNothingUpWhileTheBoardHangs) {
  keep(kPatient);
  board_.hang();
  for (int i = 0; i < 101; ++i) set(i % 2 == 0);
  board_.let_go();
  ASSERT_TRUE(becomes(true));
  EXPECT_EQ(board_.changes(), std::vector<std::string>{"lamp on"});
}

TEST_F(OutputKeeperTest, GivesALineThatHangsUpAtItsEnd) {
  keep(kPatient);
  set(true);
  ASSERT_TRUE(becomes(true));
  board_.hang();
  set(false);
  set(true);
  expect_end_without_waiting();
}

// Nothing is under way when the board begins to hang: putting the line off is what hangs.
TEST_F(OutputKeeperTest, GivesUpAtItsEndALineThatRestedWhenItsBoardBeganToHang) {
  keep({1h, 1h});
  set(true);
  ASSERT_TRUE(becomes(true));
  board_.hang();
  expect_end_without_waiting();
}

TEST_F(OutputKeeperTest, SaysThatTheBoardHangsAndThatItGoesOn) {
  keep({kOften, 50ms});
  set(true);
  ASSERT_TRUE(becomes(true));
  thread_.call([&] { said_.clear(); });
  board_.hang();
  // A busy machine may make it take a line for one that hangs before and after this as well.
  const auto ends_with = [&](const std::string& message, const std::string& line) {
    return thread_.wait_until([&] {
      const auto& trouble = keeper_->trouble();
      return !said_.empty() && said_.back() == message && (trouble ? trouble->line() : "") == line;
    });
  };
  ASSERT_TRUE(
      ends_with("it does not answer", "it does not answer: unplug its board and plug it in again"));
  board_.let_go();
  EXPECT_TRUE(ends_with("", ""));
}

TEST_F(OutputKeeperTest, TellsTheLatestTroubleAndItsFirstAlone) {
  std::atomic<int> chips = 1;
  keep(kPatient, [&chips]() -> Result<std::unique_ptr<OutputLine>> {
    return fail(ErrorCode::kNotFound, "none of " + std::to_string(chips), "plug it in");
  });
  ASSERT_TRUE(thread_.wait_until([&] { return trouble() == "none of 1"; }));
  chips = 2;
  EXPECT_TRUE(thread_.wait_until([&] { return trouble() == "none of 2"; }));
  thread_.stop();
  EXPECT_EQ(said_, std::vector<std::string>{"none of 1"});
  keeper_.reset();  // before what it opens with
}

}  // namespace
}  // namespace instep
