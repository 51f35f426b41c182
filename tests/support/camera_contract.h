#pragma once

#include <gtest/gtest.h>

#include <chrono>
#include <memory>
#include <thread>

#include "drivers/depth_camera.h"

namespace instep::test {

/// What drivers/depth_camera.h promises, for any backend. A backend is a default-constructible type
/// with
///
///     std::unique_ptr<DepthCamera> camera();         streams, at any pace
///     std::unique_ptr<DepthCamera> silent_camera();  starts, but sends nothing
///
/// and runs the suite by INSTANTIATE_TYPED_TEST_SUITE_P(Name, CameraContract, Backend). Cameras
/// must not outlive their backend.
template <typename Backend>
class CameraContract : public testing::Test {
 protected:
  static constexpr std::chrono::seconds kLongLimit{20};

  static std::chrono::steady_clock::duration time_of(auto&& work) {
    const auto begin = std::chrono::steady_clock::now();
    work();
    return std::chrono::steady_clock::now() - begin;
  }

  Backend backend_;
};

TYPED_TEST_SUITE_P(CameraContract);

TYPED_TEST_P(CameraContract, DescribesItself) {
  const auto camera = this->backend_.camera();
  const CameraDescription& description = camera->description();
  EXPECT_FALSE(description.geometry.id.empty());
  EXPECT_FALSE(description.model.empty());
  EXPECT_GT(description.depth_unit_mm, 0.0);
  EXPECT_GE(description.geometry.intrinsics.width, 16);
  EXPECT_GE(description.geometry.intrinsics.height, 16);
  EXPECT_GT(description.geometry.intrinsics.fx, 0.0);
  EXPECT_TRUE(is_rigid(description.geometry.station_from_camera.matrix()));
}

TYPED_TEST_P(CameraContract, RefusesFramesBeforeStart) {
  const auto camera = this->backend_.camera();
  const auto frame = camera->next_frame(this->kLongLimit);
  ASSERT_FALSE(frame);
  EXPECT_EQ(frame.error().code, ErrorCode::kInvalidInput);
}

TYPED_TEST_P(CameraContract, SendsFramesAsDescribed) {
  const auto camera = this->backend_.camera();
  ASSERT_TRUE(camera->start());
  const auto frame = camera->next_frame(this->kLongLimit);
  ASSERT_TRUE(frame) << frame.error().line();
  const CameraDescription& description = camera->description();
  EXPECT_EQ(frame->camera, description.geometry.id);
  EXPECT_EQ(frame->width, description.geometry.intrinsics.width);
  EXPECT_EQ(frame->height, description.geometry.intrinsics.height);
  EXPECT_DOUBLE_EQ(frame->depth_unit_mm, description.depth_unit_mm);
  EXPECT_EQ(frame->status, FrameStatus::kGood);
  EXPECT_EQ(frame->raw.size(),
            static_cast<std::size_t>(frame->width) * static_cast<std::size_t>(frame->height));
}

TYPED_TEST_P(CameraContract, KeepsFramesInOrder) {
  const auto camera = this->backend_.camera();
  ASSERT_TRUE(camera->start());
  auto last = camera->next_frame(this->kLongLimit);
  ASSERT_TRUE(last) << last.error().line();
  for (int i = 0; i < 4; ++i) {
    auto next = camera->next_frame(this->kLongLimit);
    ASSERT_TRUE(next) << next.error().line();
    EXPECT_GT(next->sequence, last->sequence);
    EXPECT_GT(next->device_time, last->device_time);
    EXPECT_GE(next->host_time, last->host_time);
    last = std::move(next);
  }
}

TYPED_TEST_P(CameraContract, StartsAndStopsAsOftenAsAsked) {
  const auto camera = this->backend_.camera();
  camera->stop();
  for (int round = 0; round < 3; ++round) {
    ASSERT_TRUE(camera->start());
    ASSERT_TRUE(camera->start());
    ASSERT_TRUE(camera->next_frame(this->kLongLimit));
    camera->stop();
    camera->stop();
    const auto frame = camera->next_frame(this->kLongLimit);
    ASSERT_FALSE(frame);
    EXPECT_EQ(frame.error().code, ErrorCode::kInvalidInput);
  }
}

TYPED_TEST_P(CameraContract, GivesUpAtItsLimit) {
  const auto camera = this->backend_.silent_camera();
  ASSERT_TRUE(camera->start());
  for (const int limit_ms : {0, 1, 30}) {
    const auto spent = this->time_of([&] {
      const auto frame = camera->next_frame(std::chrono::milliseconds(limit_ms));
      ASSERT_FALSE(frame);
      EXPECT_EQ(frame.error().code, ErrorCode::kTimeout);
      EXPECT_EQ(frame.error().remedy, Remedy::kRetry);
    });
    EXPECT_LT(spent, this->kLongLimit) << "it waits for something else";
  }
}

TYPED_TEST_P(CameraContract, WakesAWaiterOnInterrupt) {
  const auto camera = this->backend_.silent_camera();
  ASSERT_TRUE(camera->start());
  const auto spent = this->time_of([&] {
    std::thread other([&] { camera->interrupt(); });
    const auto frame = camera->next_frame(this->kLongLimit);
    other.join();
    ASSERT_FALSE(frame);
    EXPECT_EQ(frame.error().code, ErrorCode::kCancelled);
  });
  EXPECT_LT(spent, this->kLongLimit);
}

TYPED_TEST_P(CameraContract, RemembersAnInterruptUntilStart) {
  const auto camera = this->backend_.camera();
  ASSERT_TRUE(camera->start());
  camera->interrupt();
  const auto refused = camera->next_frame(this->kLongLimit);
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().code, ErrorCode::kCancelled);
  camera->stop();
  ASSERT_TRUE(camera->start());
  EXPECT_TRUE(camera->next_frame(this->kLongLimit));
}

REGISTER_TYPED_TEST_SUITE_P(CameraContract, DescribesItself, RefusesFramesBeforeStart,
                            SendsFramesAsDescribed, KeepsFramesInOrder,
                            StartsAndStopsAsOftenAsAsked, GivesUpAtItsLimit,
                            WakesAWaiterOnInterrupt, RemembersAnInterruptUntilStart);

}  // namespace instep::test
