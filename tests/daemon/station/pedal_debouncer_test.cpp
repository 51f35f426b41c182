#include "daemon/station/pedal_debouncer.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <vector>

namespace instep {
namespace {

using namespace std::chrono_literals;
using Signal = PedalSignal;
using Signals = std::vector<PedalSignal>;
using Time = std::chrono::nanoseconds;

constexpr Time kDebounce = 30ms;
constexpr Time kHold = 2s;

PedalDebouncer resting() {
  return {kDebounce, kHold, false, 0ms};
}

/// Plays edges the way the daemon does: at each deadline it looks at the contact.
Signals play(PedalDebouncer debouncer, const std::vector<PedalEdge>& edges, Time end) {
  std::size_t next = 0;
  bool contact = false;
  while (true) {
    const auto deadline = debouncer.next_deadline();
    const bool edge_first = next < edges.size() && (!deadline || edges[next].time <= *deadline);
    if (edge_first) {
      contact = edges[next].pressed;
      debouncer.on_edge(edges[next++]);
    } else if (deadline && *deadline <= end) {
      debouncer.on_level(contact, *deadline);
    } else {
      return debouncer.take_signals();
    }
  }
}

TEST(PedalDebouncer, MakesOnePressOfACleanTap) {
  EXPECT_EQ(play(resting(), {{true, 100ms}, {false, 250ms}}, 1s),
            (Signals{Signal::kPressed, Signal::kReleased}));
}

TEST(PedalDebouncer, IgnoresASpikeShorterThanTheDebounceTime) {
  EXPECT_TRUE(play(resting(), {{true, 100ms}, {false, 129ms}}, 1s).empty());
}

TEST(PedalDebouncer, TakesAPressAfterExactlyTheDebounceTime) {
  auto debouncer = resting();
  debouncer.on_edge({true, 100ms});
  ASSERT_EQ(debouncer.next_deadline(), Time(130ms));
  debouncer.on_level(true, 129ms);
  EXPECT_TRUE(debouncer.take_signals().empty());
  debouncer.on_level(true, 130ms);
  EXPECT_EQ(debouncer.take_signals(), Signals{Signal::kPressed});
}

// Edges between them are lost in bursts.
TEST(PedalDebouncer, MakesOnePressOfTwoRisingEdges) {
  EXPECT_EQ(play(resting(), {{true, 100ms}, {true, 110ms}, {false, 300ms}}, 1s),
            (Signals{Signal::kPressed, Signal::kReleased}));
}

// A full queue drops the newest edge.
TEST(PedalDebouncer, ReadsTheLevelAfterABurstWhoseLastEdgeWasLost) {
  auto debouncer = resting();
  debouncer.on_edge({true, 100ms});
  debouncer.on_edge({false, 105ms});
  debouncer.on_edge({true, 110ms});  // and a falling edge that never arrived
  debouncer.on_level(false, 140ms);
  EXPECT_TRUE(debouncer.take_signals().empty());
  EXPECT_FALSE(debouncer.next_deadline());
}

TEST(PedalDebouncer, NoticesAPressWhoseRisingEdgeWasLost) {
  auto debouncer = resting();
  debouncer.on_edge({false, 100ms});
  debouncer.on_level(true, 101ms);
  debouncer.on_level(true, 131ms);
  EXPECT_EQ(debouncer.take_signals(), Signals{Signal::kPressed});
}

// The kernel keeps the oldest edges of a burst: here the last one, closing, is among those it
// dropped.
TEST(PedalDebouncer, AsksForTheLevelAfterABurstThatSeemsToEndWhereItBegan) {
  auto debouncer = resting();
  for (int i = 0; i < 8; ++i) {
    debouncer.on_edge({true, 100ms + i * 2ms});
    debouncer.on_edge({false, 101ms + i * 2ms});
  }
  ASSERT_EQ(debouncer.next_deadline(), Time(145ms));
  debouncer.on_level(true, 145ms);
  ASSERT_EQ(debouncer.next_deadline(), Time(175ms));
  debouncer.on_level(true, 175ms);
  EXPECT_EQ(debouncer.take_signals(), Signals{Signal::kPressed});
}

std::vector<PedalEdge> chatter(Time begin, Time end, Time every, bool last) {
  std::vector<PedalEdge> edges;
  bool pressed = false;
  for (Time time = begin; time < end; time += every) edges.push_back({pressed = !pressed, time});
  if (edges.back().pressed != last) edges.push_back({last, edges.back().time + every});
  return edges;
}

TEST(PedalDebouncer, MakesOnePressOfTwoThousandBounces) {
  EXPECT_EQ(play(resting(), chatter(100ms, 2100ms, 1ms, true), 3s), Signals{Signal::kPressed});
}

TEST(PedalDebouncer, ReportsAContactThatChattersOnceAndItsRest) {
  EXPECT_EQ(play(resting(), chatter(1s, 60s, 10ms, false), 70s),
            (Signals{Signal::kChattering, Signal::kReleased}));
}

TEST(PedalDebouncer, TakesAContactThatChatteredAndThenClosedForStuck) {
  EXPECT_EQ(play(resting(), chatter(1s, 5s, 10ms, true), 70s),
            (Signals{Signal::kChattering, Signal::kStuck}));
}

TEST(PedalDebouncer, TakesAPressAfterAChatterThatEnded) {
  auto edges = chatter(1s, 5s, 10ms, false);
  edges.push_back({true, 6s});
  edges.push_back({false, 6500ms});
  EXPECT_EQ(play(resting(), edges, 10s),
            (Signals{Signal::kChattering, Signal::kReleased, Signal::kPressed, Signal::kReleased}));
}

TEST(PedalDebouncer, TellsAHoldOnceAfterTwoSeconds) {
  EXPECT_EQ(play(resting(), {{true, 100ms}, {false, 5s}}, 6s),
            (Signals{Signal::kPressed, Signal::kHeld, Signal::kReleased}));
  EXPECT_EQ(play(resting(), {{true, 100ms}, {false, 2099ms}}, 6s),
            (Signals{Signal::kPressed, Signal::kReleased}));
}

// Something stands on it while the station starts.
TEST(PedalDebouncer, DoesNotTriggerOnAPedalHeldAtStartUp) {
  PedalDebouncer debouncer(kDebounce, kHold, true, 0ms);
  EXPECT_EQ(debouncer.take_signals(), Signals{Signal::kStuck});
  debouncer.on_edge({false, 1s});
  debouncer.on_level(false, 1030ms);
  EXPECT_EQ(debouncer.take_signals(), Signals{Signal::kReleased});
  debouncer.on_edge({true, 2s});
  debouncer.on_level(true, 2030ms);
  EXPECT_EQ(debouncer.take_signals(), Signals{Signal::kPressed});
}

// A pedal jams, or its line is torn.
TEST(PedalDebouncer, CallsAPedalThatStaysDownStuck) {
  EXPECT_EQ(play(resting(), {{true, 100ms}}, 60s),
            (Signals{Signal::kPressed, Signal::kHeld, Signal::kStuck}));
}

TEST(PedalDebouncer, SurvivesTimesThatRunBackwards) {
  auto debouncer = resting();
  debouncer.on_edge({true, 500ms});
  debouncer.on_edge({false, 100ms});
  debouncer.on_edge({true, 300ms});
  debouncer.on_level(true, 530ms);
  EXPECT_EQ(debouncer.take_signals(), Signals{Signal::kPressed});
}

// The clock on which they are read says nothing about them.
TEST(PedalDebouncer, JudgesABatchReadLateByItsOwnTimes) {
  auto debouncer = resting();
  debouncer.on_edge({true, 100ms});
  debouncer.on_edge({false, 200ms});
  debouncer.on_edge({true, 400ms});
  debouncer.on_edge({false, 500ms});
  debouncer.on_level(false, 3s);
  EXPECT_EQ(debouncer.take_signals(),
            (Signals{Signal::kPressed, Signal::kReleased, Signal::kPressed, Signal::kReleased}));
}

/// Presses of a foot, each edge chattering for less than the debounce time.
std::vector<PedalEdge> chattering(std::mt19937_64& random, int presses, Time& end) {
  const auto between = [&](std::int64_t least, std::int64_t most) {
    const auto span = static_cast<std::uint64_t>(most - least + 1);
    return Time(least + static_cast<std::int64_t>(random() % span));
  };
  std::vector<PedalEdge> edges;
  Time now = 1s;
  const auto change = [&](bool pressed) {
    const auto bounces = random() % 12;
    for (std::uint64_t i = 0; i < bounces; ++i) {
      edges.push_back({pressed, now});
      now += between(1000, 12'000'000);
      edges.push_back({!pressed, now});
      now += between(1000, 12'000'000);
    }
    edges.push_back({pressed, now});
  };
  for (int i = 0; i < presses; ++i) {
    change(true);
    now += between(60'000'000, 1'500'000'000);
    change(false);
    now += between(60'000'000, 3'000'000'000);
  }
  end = now + 1s;
  return edges;
}

// One press, many events.
TEST(PedalDebouncer, CountsEveryPressOnceHoweverTheContactBounces) {
  for (std::uint64_t seed = 0; seed < 2000; ++seed) {
    std::mt19937_64 random(seed);
    const int presses = 1 + static_cast<int>(random() % 5);
    Time end{0};
    const auto edges = chattering(random, presses, end);
    const auto signals = play(resting(), edges, end);
    ASSERT_EQ(std::count(signals.begin(), signals.end(), Signal::kPressed), presses)
        << "seed " << seed;
    ASSERT_EQ(std::count(signals.begin(), signals.end(), Signal::kReleased), presses)
        << "seed " << seed;
  }
}

// Bursts overflow the queue of edges.
TEST(PedalDebouncer, EndsInTheTrueLevelHoweverManyEdgesAreLost) {
  for (std::uint64_t seed = 0; seed < 2000; ++seed) {
    std::mt19937_64 random(seed);
    Time end{0};
    auto edges = chattering(random, 3, end);
    edges.push_back({true, end});
    end += 1s;
    // As a full queue drops them: some edges never arrive, the level is still read.
    auto debouncer = resting();
    for (const auto& edge : edges) {
      if (random() % 3 != 0) debouncer.on_edge(edge);
    }
    debouncer.on_level(true, end);
    debouncer.on_level(true, end + kDebounce);
    const auto signals = debouncer.take_signals();
    const auto last = std::find_if(signals.rbegin(), signals.rend(), [](Signal signal) {
      return signal == Signal::kPressed || signal == Signal::kReleased;
    });
    ASSERT_NE(last, signals.rend());
    ASSERT_EQ(*last, Signal::kPressed) << "seed " << seed;
  }
}

}  // namespace
}  // namespace instep
