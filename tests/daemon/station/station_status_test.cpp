#include "daemon/station/station_status.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <string>
#include <vector>

#include "tests/support/small_station.h"
#include "tests/support/station_on_loop.h"

namespace instep {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

using StationTold = test::StationOnLoop;

// A camera that never started hid a pedal that was stuck, and a disk that was full.
TEST_F(StationTold, NamesEveryTroubleAndNotTheFirstAlone) {
  auto settings = test::small_station();
  settings.cameras[0].kind = CameraKind::kRecording;
  settings.cameras[0].path = folder_.path() / "no recording";
  settings.pedal.kind = PedalKind::kSimulated;
  settings.pedal.fifo = folder_.path() / "pedal";
  std::ofstream(settings.pedal.fifo) << "tap";
  begin(settings);
  loop_.call([&] {
    station_->store_failed({ErrorCode::kNoSpace, Remedy::kOperator, "the disk is full", ""});
  });
  ASSERT_TRUE(loop_.wait_until([&] { return station_->status().troubles.size() == 3; }));
  StationStatus status;
  loop_.call([&] { status = station_->status(); });
  std::vector<std::string> lines;
  for (const auto& trouble : status.troubles) lines.push_back(trouble.error.line());
  EXPECT_THAT(lines, ElementsAre(HasSubstr("no recording"), "the disk is full",
                                 HasSubstr("delete it, and it is made anew")));
  EXPECT_EQ(status.trouble(), lines.front());
  ASSERT_TRUE(status.pedal && status.pedal->trouble);
  EXPECT_EQ(status.pedal->trouble->line(), lines.back());
  EXPECT_EQ(status.store.root, root_);
  EXPECT_TRUE(status.store.trouble);
}

TEST_F(StationTold, HasNoLastResultOnceThatIsRemoved) {
  begin(test::small_station());
  ASSERT_TRUE(comes_to(StationState::kReady));
  loop_.call([&] { EXPECT_TRUE(station_->request_scan()); });
  std::string id;
  ASSERT_TRUE(loop_.wait_until([&] {
    id = station_->status().last_result;
    return !id.empty();
  }));
  loop_.call([&] {
    station_->forget_result("20261121T091502417Z-aaaa");
    EXPECT_EQ(station_->status().last_result, id);
    station_->forget_result(id);
    EXPECT_EQ(station_->status().last_result, "");
  });
}

}  // namespace
}  // namespace instep
