#include "sim/simulated_pedal.h"

#include <gtest/gtest.h>
#include <poll.h>
#include <sys/stat.h>

#include <fstream>
#include <thread>

#include "tests/support/temporary_folder.h"

namespace instep {
namespace {

using namespace std::chrono_literals;
using test::TemporaryFolder;

std::unique_ptr<SimulatedPedal> pedal_with(const char* script) {
  return SimulatedPedal::open({parse_fault_script(script).value().pedal, {}}).value();
}

void write_to(const std::filesystem::path& fifo, const char* text) {
  std::ofstream(fifo) << text << std::flush;
}

TEST(SimulatedPedal, TapLastsATenthOfASecond) {
  const auto pedal = pedal_with("");
  pedal->tap();
  const auto edges = pedal->read_edges().value();
  ASSERT_EQ(edges.size(), 2U);
  EXPECT_TRUE(edges[0].pressed);
  EXPECT_FALSE(edges[1].pressed);
  EXPECT_NEAR(std::chrono::duration<double>(edges[1].time - edges[0].time).count(), 0.1, 0.01);
}

TEST(SimulatedPedal, RepeatedPressIsOneEdge) {
  const auto pedal = pedal_with("");
  pedal->press();
  pedal->press();
  EXPECT_EQ(pedal->read_edges().value().size(), 1U);
}

TEST(SimulatedPedal, BouncesAsTheScriptSays) {
  const auto pedal = pedal_with("pedal: bounce 12 edges in 20 ms");
  pedal->press();
  const auto edges = pedal->read_edges().value();
  ASSERT_EQ(edges.size(), 13U);
  for (std::size_t i = 0; i < edges.size(); ++i) {
    EXPECT_EQ(edges[i].pressed, i % 2 == 0);
    if (i > 0) {
      EXPECT_GT(edges[i].time, edges[i - 1].time);
    }
  }
  EXPECT_EQ(edges.back().time - edges.front().time, 20ms);
  EXPECT_TRUE(pedal->is_pressed().value());
  pedal->release();
  EXPECT_EQ(pedal->read_edges().value().size(), 13U);
  EXPECT_FALSE(pedal->is_pressed().value());
}

TEST(SimulatedPedal, StuckPedalIsPressedFromTheStart) {
  const auto pedal = pedal_with("pedal: stuck");
  EXPECT_TRUE(pedal->is_pressed().value());
  pedal->release();
  pedal->tap();
  EXPECT_TRUE(pedal->read_edges().value().empty());
  EXPECT_TRUE(pedal->is_pressed().value());
}

TEST(SimulatedPedal, VanishesAfterItsEdges) {
  const auto pedal = pedal_with("pedal: vanish after 2 edges, return after 0 ms");
  pedal->press();
  pedal->release();
  const auto gone = pedal->read_edges();
  ASSERT_FALSE(gone);
  EXPECT_EQ(gone.error().code, ErrorCode::kDeviceGone);
  EXPECT_FALSE(pedal->is_pressed());
  ASSERT_TRUE(pedal->reopen());
  pedal->press();
  EXPECT_EQ(pedal->read_edges().value().size(), 1U);
}

TEST(SimulatedPedal, StaysAwayWithoutReturn) {
  const auto pedal = pedal_with("pedal: vanish after 1 edges");
  pedal->press();
  ASSERT_FALSE(pedal->read_edges());
  EXPECT_FALSE(pedal->reopen());
}

TEST(SimulatedPedal, ShellPressesThroughTheFifo) {
  const TemporaryFolder folder;
  const auto fifo = folder.path() / "pedal";
  const auto pedal = SimulatedPedal::open({{}, fifo}).value();
  write_to(fifo, "tap\nnonsense\npre");
  write_to(fifo, "ss\n");
  std::vector<PedalEdge> edges = pedal->read_edges().value();
  ASSERT_EQ(edges.size(), 3U);
  EXPECT_TRUE(edges[0].pressed && !edges[1].pressed && edges[2].pressed);
  write_to(fifo, "release\nbounce\n");
  EXPECT_GT(pedal->read_edges().value().size(), 3U);
  EXPECT_FALSE(pedal->is_pressed().value());
}

TEST(SimulatedPedal, EndlessLineDoesNoHarm) {
  const TemporaryFolder folder;
  const auto fifo = folder.path() / "pedal";
  const auto pedal = SimulatedPedal::open({{}, fifo}).value();
  write_to(fifo, std::string(20000, 'x').c_str());
  EXPECT_TRUE(pedal->read_edges().value().empty());
  write_to(fifo, "\npress\n");
  std::size_t edges = 0;
  pollfd waiting{pedal->descriptor(), POLLIN, 0};
  while (poll(&waiting, 1, 0) == 1) edges += pedal->read_edges().value().size();
  EXPECT_EQ(edges, 1U);
}

/// A FIFO that never runs dry kept the daemon from all else.
TEST(SimulatedPedal, TakesAFloodInPartsAndAllOfIt) {
  const TemporaryFolder folder;
  const auto fifo = folder.path() / "pedal";
  const auto pedal = SimulatedPedal::open({{}, fifo}).value();
  constexpr int kTaps = 10000;  // less than the FIFO holds
  std::ofstream flood(fifo);
  for (int i = 0; i < kTaps; ++i) flood << "tap\n";
  flood.flush();
  std::size_t edges = 0;
  pollfd waiting{pedal->descriptor(), POLLIN, 0};
  while (poll(&waiting, 1, 0) == 1) {
    const auto some = pedal->read_edges();
    ASSERT_TRUE(some) << some.error().line();
    ASSERT_FALSE(some->empty());
    EXPECT_LE(some->size(), 1000U);
    edges += some->size();
  }
  EXPECT_EQ(edges, 2U * kTaps);
}

TEST(SimulatedPedal, MakesAndRemovesItsFifo) {
  const TemporaryFolder folder;
  const auto fifo = folder.path() / "pedal";
  {
    const auto pedal = SimulatedPedal::open({{}, fifo}).value();
    EXPECT_TRUE(std::filesystem::is_fifo(fifo));
  }
  EXPECT_FALSE(std::filesystem::exists(fifo));
  ASSERT_EQ(mkfifo(fifo.c_str(), 0600), 0);
  { const auto pedal = SimulatedPedal::open({{}, fifo}).value(); }
  EXPECT_TRUE(std::filesystem::is_fifo(fifo)) << "it was somebody else's";
}

// The daemon's umask left the group without the right to press.
TEST(SimulatedPedal, LetsItsGroupPressWhateverTheUmask) {
  const test::TemporaryFolder folder;
  const auto fifo = folder.path() / "pedal";
  const auto before = ::umask(0027);
  const auto pedal = SimulatedPedal::open({{}, fifo});
  ::umask(before);
  ASSERT_TRUE(pedal);
  struct stat there {};
  ASSERT_EQ(::stat(fifo.c_str(), &there), 0);
  EXPECT_EQ(there.st_mode & 07777U, 0660U);
}

TEST(SimulatedPedal, RefusesAFileThatIsNoFifo) {
  const TemporaryFolder folder;
  const auto file = folder.path() / "precious";
  write_to(file, "data");
  const auto pedal = SimulatedPedal::open({{}, file});
  ASSERT_FALSE(pedal);
  EXPECT_EQ(pedal.error().code, ErrorCode::kInvalidInput);
  EXPECT_EQ(std::filesystem::file_size(file), 4U);
  EXPECT_FALSE(SimulatedPedal::open({{}, folder.path() / "no" / "folder"}));
}

TEST(SimulatedPedal, MayBePressedFromAnotherThread) {
  const auto pedal = pedal_with("");
  std::thread foot([&] {
    for (int i = 0; i < 500; ++i) {
      pedal->press();
      pedal->release();
    }
  });
  std::vector<PedalEdge> all;
  while (all.size() < 1000) {
    pollfd waiting{pedal->descriptor(), POLLIN, 0};
    ASSERT_EQ(poll(&waiting, 1, 10000), 1);
    const auto edges = pedal->read_edges().value();
    all.insert(all.end(), edges.begin(), edges.end());
  }
  foot.join();
  ASSERT_EQ(all.size(), 1000U);
  for (std::size_t i = 1; i < all.size(); ++i) {
    EXPECT_NE(all[i].pressed, all[i - 1].pressed);
    EXPECT_GT(all[i].time, all[i - 1].time);
  }
}

TEST(SimulatedPedal, RemovesItsFifoAndNoOtherThatTookItsPlace) {
  const TemporaryFolder folder;
  const auto fifo = folder.path() / "pedal";
  {
    const auto pedal = SimulatedPedal::open({{}, fifo}).value();
    ASSERT_TRUE(std::filesystem::is_fifo(fifo));
  }
  EXPECT_FALSE(std::filesystem::exists(fifo));
  {
    const auto pedal = SimulatedPedal::open({{}, fifo}).value();
    std::filesystem::remove(fifo);
    ASSERT_EQ(::mkfifo(fifo.c_str(), 0660), 0);
  }
  EXPECT_TRUE(std::filesystem::is_fifo(fifo));
}

}  // namespace
}  // namespace instep
