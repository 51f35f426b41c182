#include "daemon/station/output_keeper.h"

#include <gtest/gtest.h>

#include <string>
#include <thread>
#include <vector>

#include "tests/support/loop_thread.h"
#include "tests/support/model_board.h"

namespace instep {
namespace {

using namespace std::chrono_literals;

constexpr auto kOften = 5ms;

class OutputKeeperTest : public testing::Test {
 protected:
  OutputKeeperTest() {
    thread_.call([this] {
      keeper_.emplace(
          thread_.loop(), [this] { return board_.open("lamp"); },
          [this] { said_.push_back(trouble()); }, kOften);
    });
  }
  ~OutputKeeperTest() override {
    board_.let_go();
    thread_.stop();
  }

  void set(bool on) {
    thread_.call([&] { keeper_->set(on); });
  }
  bool becomes(bool on) {
    return thread_.wait_until([&] { return board_.is_on("lamp") == on; });
  }
  std::string trouble() const { return keeper_->trouble() ? keeper_->trouble()->message : ""; }

  test::ModelBoard board_;
  test::LoopThread thread_;
  std::vector<std::string> said_;  ///< of each change of its trouble; the loop's, as the keeper
  std::optional<OutputKeeper> keeper_;
};

TEST_F(OutputKeeperTest, DoesTheLastWishAndPutsTheLineOffAtItsEnd) {
  for (const bool on : {true, false, true}) set(on);
  ASSERT_TRUE(becomes(true));
  thread_.stop();
  keeper_.reset();
  EXPECT_FALSE(board_.is_on("lamp"));
  EXPECT_TRUE(said_.empty());
}

TEST_F(OutputKeeperTest, SaysOnceThatTheBoardLeftAndLightsTheLampWhenItIsBack) {
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
  board_.hang();
  for (int i = 0; i < 101; ++i) set(i % 2 == 0);
  board_.let_go();
  ASSERT_TRUE(becomes(true));
  EXPECT_EQ(board_.changes(), std::vector<std::string>{"lamp on"});
}

TEST_F(OutputKeeperTest, GivesALineThatHangsUpAtItsEnd) {
  set(true);
  ASSERT_TRUE(becomes(true));
  board_.hang();
  set(false);
  set(true);
  thread_.stop();
  const auto begin = std::chrono::steady_clock::now();
  keeper_.reset();
  EXPECT_LT(std::chrono::steady_clock::now() - begin, 1s);
  board_.let_go();
  // Its thread, which is left behind, puts it off.
  EXPECT_TRUE(board_.wait_for_changes(2));
  EXPECT_FALSE(board_.is_on("lamp"));
}

}  // namespace
}  // namespace instep
