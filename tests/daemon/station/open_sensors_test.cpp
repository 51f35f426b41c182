#include "daemon/station/open_sensors.h"

#include <gtest/gtest.h>

#include <deque>
#include <memory>
#include <string>
#include <vector>

#include "tests/support/scripted_camera.h"

namespace instep {
namespace {

CameraSettings sensor(const std::string& name) {
  CameraSettings camera;
  camera.kind = CameraKind::kOpenni;
  camera.openni.placement.name = name;
  return camera;
}

/// Tells how many of its kind are open.
class CountedCamera final : public test::ScriptedCamera {
 public:
  CountedCamera(const std::string& name, int& open) : ScriptedCamera(name, {}), open_(open) {
    ++open_;
  }
  ~CountedCamera() override { --open_; }

 private:
  int& open_;
};

std::unique_ptr<DepthCamera> camera(const std::string& name) {
  return std::make_unique<test::ScriptedCamera>(name, std::deque<test::ScriptedCamera::Step>{});
}

TEST(OpenSensors, KeepThoseThatTheSettingsNameAndGiveEachOnce) {
  Settings settings;
  settings.cameras = {sensor("left"), sensor("right"), CameraSettings()};
  Devices devices;
  devices.cameras.push_back(camera("right"));  // the left one is away
  devices.cameras.push_back(camera("simulated"));
  devices.usb["right"] = {.bus_path = {}, .serial = "B2"};
  OpenSensors kept;
  kept.keep(settings, std::move(devices));
  EXPECT_FALSE(kept.take("left"));
  EXPECT_FALSE(kept.take("simulated"));
  const auto right = kept.take("right");
  ASSERT_TRUE(right && right->camera);
  EXPECT_EQ(right->camera->description().geometry.id, "right");
  ASSERT_TRUE(right->usb);
  EXPECT_EQ(right->usb->serial, "B2");
  EXPECT_FALSE(kept.take("right")) << "a second source of its name has to open its own";
}

/// The second one was handed out as a camera that is none, and ended the daemon.
TEST(OpenSensors, KeepOneOfTwoSourcesOfOneName) {
  Settings settings;
  settings.cameras = {sensor("left"), sensor("left")};
  Devices devices;
  for (int i = 0; i < 2; ++i) devices.cameras.push_back(camera("left"));
  OpenSensors kept;
  kept.keep(settings, std::move(devices));
  const auto first = kept.take("left");
  ASSERT_TRUE(first);
  EXPECT_TRUE(first->camera);
  EXPECT_FALSE(kept.take("left"));
}

TEST(OpenSensors, AreClosedWhenTheyAreNotKeptAnyMore) {
  Settings settings;
  settings.cameras = {sensor("left")};
  int open = 0;
  OpenSensors kept;
  for (const bool keeps_others : {true, false}) {
    Devices devices;
    devices.cameras.push_back(std::make_unique<CountedCamera>("left", open));
    kept.keep(settings, std::move(devices));
    EXPECT_EQ(open, 1);
    if (keeps_others) {
      kept.keep(settings, Devices());
    } else {
      kept.clear();
    }
    EXPECT_EQ(open, 0);
    EXPECT_FALSE(kept.take("left"));
  }
}

}  // namespace
}  // namespace instep
