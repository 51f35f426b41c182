#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <functional>
#include <ostream>

#include "tests/support/openni_bus.h"

/// Why a sensor cannot be had, each cause told from the others.
namespace instep::test {
namespace {

using testing::HasSubstr;

struct Cause {
  const char* name;
  std::function<void(OpenniBus&, OpenniCamera::Settings&)> make;
  ErrorCode code;
  const char* said;
};

void PrintTo(const Cause& cause, std::ostream* out) {
  *out << cause.name;
}

class OpenniCause : public testing::TestWithParam<Cause> {};

// "No device found" is said of missing drivers, rights and rules alike.
TEST_P(OpenniCause, IsNamed) {
  OpenniBus bus;
  auto settings = bus.settings();
  GetParam().make(bus, settings);
  const auto camera = OpenniCamera::open(settings);
  ASSERT_FALSE(camera);
  EXPECT_EQ(camera.error().code, GetParam().code) << camera.error().line();
  EXPECT_THAT(camera.error().line(), HasSubstr(GetParam().said));
  EXPECT_FALSE(camera.error().advice.empty());
  EXPECT_TRUE(child_processes().empty());
}

INSTANTIATE_TEST_SUITE_P(
    All, OpenniCause,
    testing::Values(
        Cause{"NoSensor", [](auto&, auto&) {}, ErrorCode::kNotFound,
              "A1 is not plugged in (there is no other)"},
        Cause{"OtherSensor", [](auto& bus, auto&) { bus.plug_in({.serial = "B2"}); },
              ErrorCode::kNotFound, "A1 is not plugged in (there is B2)"},
        Cause{"OneOfThoseInUse",
              [](auto& bus, auto&) {
                bus.plug_in({.serial = "B2"});
                bus.plug_in({.serial = "C3", .faults = {"busy"}});
              },
              ErrorCode::kNotFound,
              "A1 is not plugged in, unless it is one that cannot be opened (there is B2, and the "
              "sensor at sim://1/2"},
        // Which may be the station's own, at another camera of its: to close other programs was the
        // advice for a cable that was out.
        Cause{"OnlyOneInUse", [](auto& bus, auto&) { bus.plug_in({.faults = {"busy"}}); },
              ErrorCode::kNotFound, "if both are right, close other programs that use it"},
        Cause{"Busy",
              [](auto& bus, auto& settings) {
                bus.plug_in({.faults = {"busy"}});
                settings.serial.clear();
              },
              ErrorCode::kBusy, "held by somebody else"},
        Cause{"NoDriver",
              [](auto& bus, auto&) {
                std::filesystem::remove(bus.folder() / "OpenNI2/Drivers/libinstepsim.so.0");
              },
              ErrorCode::kUnsupported, "finds no driver"},
        Cause{"NoLibrary",
              [](auto& bus, auto&) { std::filesystem::remove(bus.folder() / "libOpenNI2.so.0"); },
              ErrorCode::kNotFound, "there is no libOpenNI2.so.0 in"},
        Cause{"NoLoadableLibrary",
              [](auto& bus, auto&) {
                std::filesystem::remove(bus.folder() / "libOpenNI2.so.0");
                std::ofstream(bus.folder() / "libOpenNI2.so.0") << "no library";
              },
              ErrorCode::kIo, "a library of it is missing"},
        Cause{"NoProgram", [](auto&, auto& settings) { settings.program.file = "/none/at/all"; },
              ErrorCode::kNotFound, "cannot be started"},
        Cause{"OtherProgram", [](auto&, auto& settings) { settings.program.file = "/bin/true"; },
              ErrorCode::kIo, "ended with code 0"},
        Cause{"NoFieldOfView", [](auto& bus, auto&) { bus.plug_in({.hfov_rad = 0.0}); },
              ErrorCode::kUnsupported, "give its intrinsics"},
        Cause{"NoSuchSize",
              [](auto& bus, auto& settings) {
                bus.plug_in({});
                settings.intrinsics = CameraIntrinsics{80, 60, 70, 70, 40, 30, {}};
              },
              ErrorCode::kUnsupported, "but 32x24 at 30/s in 1 mm"},
        Cause{"TwoOfOneSerial",  // which of them is which cannot be told
              [](auto& bus, auto&) {
                bus.plug_in({.serial = "A1"});
                const auto images = bus.folder() / "twin.raw";
                std::filesystem::copy_file(bus.folder() / "A1.raw", images);
                const auto file = bus.folder() / "bus/twin.device";
                std::filesystem::copy_file(bus.folder() / "bus/A1.device", file);
                std::ofstream(file, std::ios::app)
                    << "uri sim://2/1\nframes " << images.string() << '\n';
              },
              ErrorCode::kInvalidInput, "two OpenNI2 sensors have the serial number A1"}),
    [](const auto& cause) { return std::string(cause.param.name); });

}  // namespace
}  // namespace instep::test
