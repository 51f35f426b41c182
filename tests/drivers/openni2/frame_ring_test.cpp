#include "drivers/openni2/frame_ring.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <numeric>
#include <thread>

namespace instep {
namespace {

constexpr int kWidth = 32;
constexpr int kHeight = 24;
constexpr auto kPixels = static_cast<std::uint32_t>(kWidth * kHeight);

RingRecord record_of(std::uint64_t sequence) {
  RingRecord record;
  record.sequence = sequence;
  record.width = kWidth;
  record.height = kHeight;
  record.pixels = kPixels;
  return record;
}

/// Every pixel of a frame tells its number.
std::vector<std::uint16_t> pixels_of(std::uint64_t sequence) {
  return std::vector<std::uint16_t>(kPixels, static_cast<std::uint16_t>(sequence & 0xFFFFU));
}

void put(FrameRing& ring, std::uint64_t sequence) {
  ASSERT_TRUE(ring.put(record_of(sequence), pixels_of(sequence).data(), kWidth));
}

TEST(FrameRing, GivesWhatWasPutInInOrder) {
  auto ring = FrameRing::create().value();
  EXPECT_FALSE(ring.take());
  for (std::uint64_t i = 1; i <= 5; ++i) put(ring, i);
  for (std::uint64_t i = 1; i <= 5; ++i) {
    const auto frame = ring.take();
    ASSERT_TRUE(frame);
    EXPECT_EQ(frame->record.sequence, i);
    EXPECT_EQ(frame->raw, pixels_of(i));
  }
  EXPECT_FALSE(ring.take());
}

TEST(FrameRing, DropsTheOldestWhenItIsFull) {
  auto ring = FrameRing::create().value();
  for (std::uint64_t i = 1; i <= 20; ++i) put(ring, i);
  for (std::uint64_t i = 21 - FrameRing::kPlaces; i <= 20; ++i) {
    const auto frame = ring.take();
    ASSERT_TRUE(frame);
    EXPECT_EQ(frame->record.sequence, i);
  }
  EXPECT_FALSE(ring.take());
}

TEST(FrameRing, ForgetsWhatIsCleared) {
  auto ring = FrameRing::create().value();
  for (std::uint64_t i = 1; i <= 3; ++i) put(ring, i);
  ring.clear();
  EXPECT_FALSE(ring.take());
  put(ring, 4);
  EXPECT_EQ(ring.take()->record.sequence, 4U);
}

TEST(FrameRing, TakesTheRowsOutOfAWiderImage) {
  auto ring = FrameRing::create().value();
  constexpr std::size_t kStride = kWidth + 5;
  std::vector<std::uint16_t> wide(kStride * kHeight);
  std::iota(wide.begin(), wide.end(), std::uint16_t{0});
  auto record = record_of(1);
  record.pixels = kPixels - 7;  // and the last row is cut short
  ASSERT_TRUE(ring.put(record, wide.data(), kStride));
  const auto frame = ring.take();
  ASSERT_TRUE(frame);
  ASSERT_EQ(frame->raw.size(), kPixels - 7);
  for (std::size_t i = 0; i < frame->raw.size(); ++i) {
    ASSERT_EQ(frame->raw[i], wide[i / kWidth * kStride + i % kWidth]) << i;
  }
}

TEST(FrameRing, RefusesMoreThanItHolds) {
  auto ring = FrameRing::create().value();
  auto record = record_of(1);
  record.pixels = static_cast<std::uint32_t>(FrameRing::kMostPixels + 1);
  EXPECT_FALSE(ring.put(record, pixels_of(1).data(), kWidth));
  EXPECT_FALSE(ring.take());
}

TEST(FrameRing, IsTheSameFromTheOtherSide) {
  auto reader = FrameRing::create().value();
  auto writer = FrameRing::attach(reader.descriptor()).value();
  put(writer, 7);
  writer.beat();
  EXPECT_EQ(reader.take()->record.sequence, 7U);
  EXPECT_LE(reader.last_beat(), std::chrono::steady_clock::now());
  EXPECT_GT(reader.last_beat(), std::chrono::steady_clock::now() - std::chrono::seconds(10));
}

TEST(FrameRing, CannotBeCutShort) {
  // A reader of memory that was cut short is killed.
  const auto ring = FrameRing::create().value();
  EXPECT_NE(::ftruncate(ring.descriptor(), 0), 0);
  EXPECT_NE(::ftruncate(ring.descriptor(), 1 << 30), 0);
}

TEST(FrameRing, IsNotTakenForSomethingElse) {
  const int other = ::memfd_create("other", MFD_CLOEXEC);
  EXPECT_FALSE(FrameRing::attach(other));
  EXPECT_FALSE(FrameRing::attach(-1));
  const auto ring = FrameRing::create().value();
  struct stat status {};
  ASSERT_EQ(::fstat(ring.descriptor(), &status), 0);
  ASSERT_EQ(::ftruncate(other, status.st_size), 0);
  EXPECT_FALSE(FrameRing::attach(other));
  ::close(other);
}

TEST(FrameRing, SurvivesAWriterThatRunsWild) {
  auto ring = FrameRing::create().value();
  struct stat status {};
  ASSERT_EQ(::fstat(ring.descriptor(), &status), 0);
  constexpr std::size_t kHead = 4096;
  auto* bytes = static_cast<std::uint8_t*>(
      ::mmap(nullptr, kHead, PROT_READ | PROT_WRITE, MAP_SHARED, ring.descriptor(), 0));
  ASSERT_NE(static_cast<void*>(bytes), MAP_FAILED);
  std::uint32_t random = 1;
  for (int round = 0; round < 2000; ++round) {
    for (int i = 0; i < 64; ++i) {
      random = random * 1664525U + 1013904223U;
      // Small values are the states that a place can have.
      bytes[(random >> 12) % kHead] = static_cast<std::uint8_t>((random >> 24) % 5);
    }
    for (int i = 0; i < 3; ++i) {
      const auto frame = ring.take();
      EXPECT_TRUE(!frame || frame->raw.size() <= FrameRing::kMostPixels);
    }
    ring.clear();
  }
  ::munmap(bytes, kHead);
}

TEST(FrameRing, NeverGivesHalfAFrame) {
  auto ring = FrameRing::create().value();
  constexpr std::uint64_t kFrames = 20000;
  std::thread writer([&] {
    for (std::uint64_t i = 1; i <= kFrames; ++i) put(ring, i);
  });
  std::uint64_t last = 0;
  while (last < kFrames) {
    const auto frame = ring.take();
    if (!frame) continue;
    ASSERT_GT(frame->record.sequence, last);
    last = frame->record.sequence;
    const auto expected = static_cast<std::uint16_t>(last & 0xFFFFU);
    ASSERT_TRUE(std::all_of(frame->raw.begin(), frame->raw.end(),
                            [&](std::uint16_t value) { return value == expected; }));
  }
  writer.join();
}

}  // namespace
}  // namespace instep
