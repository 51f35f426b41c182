#include "daemon/station/station_machine.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <string>
#include <utility>
#include <vector>

namespace instep {
namespace {

using S = StationState;
using E = StationEvent;
using A = StationAction;

/// A machine that knows of its pedal, brought into a state by the events that lead there.
StationMachine machine_in(S state) {
  StationMachine machine;
  machine.handle(E::kPedalReady);
  const auto play = [&](std::vector<E> events) {
    for (const auto event : events) machine.handle(event);
  };
  switch (state) {
    case S::kStarting:
      break;
    case S::kReady:
      play({E::kCamerasReady});
      break;
    case S::kCapturing:
      play({E::kCamerasReady, E::kScanRequested});
      break;
    case S::kMeasuring:
      play({E::kCamerasReady, E::kScanRequested, E::kCaptured});
      break;
    case S::kStoring:
      play({E::kCamerasReady, E::kScanRequested, E::kCaptured, E::kMeasured});
      break;
    case S::kDegraded:
      play({E::kCamerasLost});
      break;
    case S::kFault:
      play({E::kCamerasReady, E::kPedalFault});
      break;
  }
  return machine;
}

struct Row {
  S from;
  E event;
  S to;
  std::vector<A> actions;
};

// Written from the rules of the station, not from the code: every state with every event.
const std::vector<Row> kTable = {
    {S::kStarting, E::kCamerasReady, S::kReady, {}},
    {S::kStarting, E::kCamerasLost, S::kDegraded, {}},
    {S::kStarting, E::kPedalReady, S::kStarting, {}},
    {S::kStarting, E::kPedalFault, S::kStarting, {}},
    {S::kStarting, E::kScanRequested, S::kStarting, {A::kRefuseScan}},
    {S::kStarting, E::kCancelRequested, S::kStarting, {}},
    {S::kStarting, E::kCaptured, S::kStarting, {}},
    {S::kStarting, E::kMeasured, S::kStarting, {}},
    {S::kStarting, E::kStored, S::kStarting, {}},
    {S::kStarting, E::kScanFailed, S::kStarting, {}},
    {S::kStarting, E::kStoreFailed, S::kStarting, {}},
    {S::kStarting, E::kStoreReady, S::kStarting, {}},
    {S::kStarting, E::kScanCancelled, S::kStarting, {}},
    {S::kStarting, E::kShutdown, S::kStarting, {A::kLeave}},

    {S::kReady, E::kCamerasReady, S::kReady, {}},
    {S::kReady, E::kCamerasLost, S::kDegraded, {}},
    {S::kReady, E::kPedalReady, S::kReady, {}},
    {S::kReady, E::kPedalFault, S::kFault, {}},
    {S::kReady, E::kScanRequested, S::kCapturing, {A::kStartScan}},
    {S::kReady, E::kCancelRequested, S::kReady, {}},
    {S::kReady, E::kCaptured, S::kReady, {}},
    {S::kReady, E::kMeasured, S::kReady, {}},
    {S::kReady, E::kStored, S::kReady, {}},
    {S::kReady, E::kScanFailed, S::kReady, {}},
    {S::kReady, E::kStoreFailed, S::kFault, {}},
    {S::kReady, E::kStoreReady, S::kReady, {}},
    {S::kReady, E::kScanCancelled, S::kReady, {}},
    {S::kReady, E::kShutdown, S::kReady, {A::kLeave}},

    {S::kCapturing, E::kCamerasReady, S::kCapturing, {}},
    {S::kCapturing, E::kCamerasLost, S::kCapturing, {}},
    {S::kCapturing, E::kPedalReady, S::kCapturing, {}},
    {S::kCapturing, E::kPedalFault, S::kCapturing, {}},
    {S::kCapturing, E::kScanRequested, S::kCapturing, {A::kIgnorePress}},
    {S::kCapturing, E::kCancelRequested, S::kCapturing, {A::kCancelScan}},
    {S::kCapturing, E::kCaptured, S::kMeasuring, {}},
    {S::kCapturing, E::kMeasured, S::kCapturing, {}},
    {S::kCapturing, E::kStored, S::kCapturing, {}},
    {S::kCapturing, E::kScanFailed, S::kReady, {A::kAnnounceFailure}},
    {S::kCapturing, E::kStoreFailed, S::kCapturing, {}},
    {S::kCapturing, E::kStoreReady, S::kCapturing, {}},
    {S::kCapturing, E::kScanCancelled, S::kReady, {A::kAnnounceCancelled}},
    {S::kCapturing, E::kShutdown, S::kCapturing, {A::kCancelScan}},

    {S::kMeasuring, E::kCamerasReady, S::kMeasuring, {}},
    {S::kMeasuring, E::kCamerasLost, S::kMeasuring, {}},
    {S::kMeasuring, E::kPedalReady, S::kMeasuring, {}},
    {S::kMeasuring, E::kPedalFault, S::kMeasuring, {}},
    {S::kMeasuring, E::kScanRequested, S::kMeasuring, {A::kIgnorePress}},
    {S::kMeasuring, E::kCancelRequested, S::kMeasuring, {A::kCancelScan}},
    {S::kMeasuring, E::kCaptured, S::kMeasuring, {}},
    {S::kMeasuring, E::kMeasured, S::kStoring, {}},
    {S::kMeasuring, E::kStored, S::kMeasuring, {}},
    {S::kMeasuring, E::kScanFailed, S::kReady, {A::kAnnounceFailure}},
    {S::kMeasuring, E::kStoreFailed, S::kMeasuring, {}},
    {S::kMeasuring, E::kStoreReady, S::kMeasuring, {}},
    {S::kMeasuring, E::kScanCancelled, S::kReady, {A::kAnnounceCancelled}},
    {S::kMeasuring, E::kShutdown, S::kMeasuring, {A::kCancelScan}},

    {S::kStoring, E::kCamerasReady, S::kStoring, {}},
    {S::kStoring, E::kCamerasLost, S::kStoring, {}},
    {S::kStoring, E::kPedalReady, S::kStoring, {}},
    {S::kStoring, E::kPedalFault, S::kStoring, {}},
    {S::kStoring, E::kScanRequested, S::kStoring, {A::kIgnorePress}},
    {S::kStoring, E::kCancelRequested, S::kStoring, {}},
    {S::kStoring, E::kCaptured, S::kStoring, {}},
    {S::kStoring, E::kMeasured, S::kStoring, {}},
    {S::kStoring, E::kStored, S::kReady, {A::kAnnounceResult}},
    {S::kStoring, E::kScanFailed, S::kReady, {A::kAnnounceFailure}},
    {S::kStoring, E::kStoreFailed, S::kFault, {A::kAnnounceFailure}},
    {S::kStoring, E::kStoreReady, S::kStoring, {}},
    {S::kStoring, E::kScanCancelled, S::kReady, {A::kAnnounceCancelled}},
    {S::kStoring, E::kShutdown, S::kStoring, {}},

    {S::kDegraded, E::kCamerasReady, S::kReady, {}},
    {S::kDegraded, E::kCamerasLost, S::kDegraded, {}},
    {S::kDegraded, E::kPedalReady, S::kDegraded, {}},
    {S::kDegraded, E::kPedalFault, S::kFault, {}},
    {S::kDegraded, E::kScanRequested, S::kDegraded, {A::kRefuseScan}},
    {S::kDegraded, E::kCancelRequested, S::kDegraded, {}},
    {S::kDegraded, E::kCaptured, S::kDegraded, {}},
    {S::kDegraded, E::kMeasured, S::kDegraded, {}},
    {S::kDegraded, E::kStored, S::kDegraded, {}},
    {S::kDegraded, E::kScanFailed, S::kDegraded, {}},
    {S::kDegraded, E::kStoreFailed, S::kFault, {}},
    {S::kDegraded, E::kStoreReady, S::kDegraded, {}},
    {S::kDegraded, E::kScanCancelled, S::kDegraded, {}},
    {S::kDegraded, E::kShutdown, S::kDegraded, {A::kLeave}},

    {S::kFault, E::kCamerasReady, S::kFault, {}},
    {S::kFault, E::kCamerasLost, S::kFault, {}},
    {S::kFault, E::kPedalReady, S::kReady, {}},
    {S::kFault, E::kPedalFault, S::kFault, {}},
    {S::kFault, E::kScanRequested, S::kCapturing, {A::kStartScan}},
    {S::kFault, E::kCancelRequested, S::kFault, {}},
    {S::kFault, E::kCaptured, S::kFault, {}},
    {S::kFault, E::kMeasured, S::kFault, {}},
    {S::kFault, E::kStored, S::kFault, {}},
    {S::kFault, E::kScanFailed, S::kFault, {}},
    {S::kFault, E::kStoreFailed, S::kFault, {}},
    {S::kFault, E::kStoreReady, S::kFault, {}},
    {S::kFault, E::kScanCancelled, S::kFault, {}},
    {S::kFault, E::kShutdown, S::kFault, {A::kLeave}},
};

TEST(StationMachine, FollowsItsTableInEveryStateOnEveryEvent) {
  ASSERT_EQ(kTable.size(), 7U * 14U);
  for (const auto& row : kTable) {
    StationMachine machine = machine_in(row.from);
    ASSERT_EQ(machine.state(), row.from);
    const auto actions = machine.handle(row.event);
    const auto where =
        std::string(to_string(row.from)) + ", event " + std::to_string(static_cast<int>(row.event));
    EXPECT_EQ(machine.state(), row.to) << where;
    EXPECT_EQ(actions, row.actions) << where;
  }
}

// It was ready before its pedal was open, and a press was lost.
TEST(StationMachine, IsStartingUntilItKnowsOfItsPedal) {
  for (const auto& [told, state] :
       {std::pair(E::kPedalReady, S::kReady), {E::kPedalFault, S::kFault}}) {
    StationMachine machine;
    for (const auto event :
         {E::kCamerasReady, E::kStoreFailed, E::kStoreReady, E::kCamerasLost, E::kCamerasReady}) {
      machine.handle(event);
      EXPECT_EQ(machine.state(), S::kStarting);
    }
    machine.handle(told);
    EXPECT_EQ(machine.state(), state);
  }
}

TEST(StationMachine, LeavesOnceTheCancelledScanHasEnded) {
  StationMachine machine = machine_in(S::kMeasuring);
  EXPECT_EQ(machine.handle(E::kShutdown), std::vector<A>{A::kCancelScan});
  EXPECT_TRUE(machine.handle(E::kShutdown).empty());
  EXPECT_EQ(machine.handle(E::kScanCancelled), (std::vector<A>{A::kAnnounceCancelled, A::kLeave}));
}

TEST(StationMachine, CancelsAScanOnce) {
  StationMachine machine = machine_in(S::kCapturing);
  EXPECT_EQ(machine.handle(E::kCancelRequested), std::vector<A>{A::kCancelScan});
  EXPECT_TRUE(machine.handle(E::kCancelRequested).empty());
}

// A press during a scan is no wish for another one.
TEST(StationMachine, CountsPressesDuringAScan) {
  StationMachine machine = machine_in(S::kCapturing);
  for (int i = 0; i < 3; ++i) machine.handle(E::kScanRequested);
  EXPECT_EQ(machine.ignored_presses(), 3U);
}

TEST(StationMachine, RecoversFromAFullDiskWithTheNextScan) {
  StationMachine machine = machine_in(S::kStoring);
  machine.handle(E::kStoreFailed);
  EXPECT_EQ(machine.state(), S::kFault);
  for (const auto event : {E::kScanRequested, E::kCaptured, E::kMeasured}) machine.handle(event);
  EXPECT_EQ(machine.handle(E::kStored), std::vector<A>{A::kAnnounceResult});
  EXPECT_EQ(machine.state(), S::kReady);
}

// It was in fault until somebody scanned, long after there was room again.
TEST(StationMachine, RecoversFromAFullDiskWithoutAScan) {
  StationMachine machine = machine_in(S::kReady);
  machine.handle(E::kStoreFailed);
  EXPECT_EQ(machine.state(), S::kFault);
  EXPECT_TRUE(machine.handle(E::kStoreReady).empty());
  EXPECT_EQ(machine.state(), S::kReady);
}

TEST(StationMachine, RemembersACameraThatWasLostDuringTheScan) {
  StationMachine machine = machine_in(S::kCapturing);
  machine.handle(E::kCamerasLost);
  machine.handle(E::kScanFailed);
  EXPECT_EQ(machine.state(), S::kDegraded);
}

TEST(StationMachine, NeverStartsASecondScanNorForgetsOneInRandomWalks) {
  std::mt19937_64 random(20);
  for (int walk = 0; walk < 500; ++walk) {
    StationMachine machine;
    int running = 0;
    for (int step = 0; step < 200; ++step) {
      const auto event = static_cast<E>(random() % 13);  // all but the shutdown
      const bool was_busy = machine.is_busy();
      const auto actions = machine.handle(event);
      running += static_cast<int>(std::count(actions.begin(), actions.end(), A::kStartScan));
      if (was_busy && !machine.is_busy()) --running;
      ASSERT_EQ(running, machine.is_busy() ? 1 : 0);
    }
  }
}

}  // namespace
}  // namespace instep
