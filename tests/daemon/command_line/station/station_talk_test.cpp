#include "daemon/command_line/station/station_talk.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <stdlib.h>

#include <fstream>

#include "daemon/control/control_server.h"
#include "tests/support/loop_thread.h"
#include "tests/support/temporary_folder.h"

namespace instep {
namespace {

using testing::HasSubstr;

/// A daemon of another make: gives every request the answer that the test chooses.
class OddDaemon : public testing::Test {
 protected:
  OddDaemon() {
    ::setenv("INSTEP_SOCKET", socket_.c_str(), 1);
    loop_.call([this] {
      const auto serve = [this](ControlServer::Client client, const Request& request) {
        server_->answer(client, request.verb == "show" && !shown_.empty() ? shown_ : answer_);
        if (request.verb == "show" && !afterwards_.empty()) answer_ = afterwards_;
        if (request.verb == "scan") server_->send_event(client, event_);
      };
      server_ = ControlServer::listen(loop_.loop(), socket_, serve).value();
    });
  }
  ~OddDaemon() override {
    loop_.call([this] { server_.reset(); });
    ::unsetenv("INSTEP_SOCKET");
  }
  void say(const std::string& answer, const std::string& event = "") {
    loop_.call([&] {
      answer_ = answer;
      event_ = event;
    });
  }

  test::TemporaryFolder folder_;
  const std::filesystem::path socket_ = folder_.path() / "control.sock";
  test::LoopThread loop_;
  std::unique_ptr<ControlServer> server_;
  std::string answer_;
  std::string shown_;       ///< to show alone; as the others are answered if empty
  std::string afterwards_;  ///< to all that comes after it; as before if empty
  std::string event_;
};

void expect_not_understood(const Result<void>& outcome, const std::string& answer) {
  ASSERT_FALSE(outcome) << answer;
  EXPECT_THAT(outcome.error().line(), HasSubstr("of the same version")) << answer;
}

using StationTalk = OddDaemon;

TEST_F(StationTalk, SaysThatItDoesNotUnderstandAResultOfAnotherShape) {
  for (const auto* answer : {R"({"ok": true})", R"({"ok": true, "result": 3})",
                             R"({"ok": true, "result": [1]})", R"({"ok": 1, "result": null})"}) {
    say(answer);
    for (const auto* format : {"text", "json", "csv"}) {
      EXPECT_FALSE(show_scan("latest", format)) << answer;
    }
  }
  say(R"({"ok": true, "result": 3})");
  expect_not_understood(show_scan("latest", "json"), answer_);
}

TEST_F(StationTalk, CopiesNoFileOfAnotherFolder) {
  const auto out = folder_.path() / "out";
  const std::string scan = R"({"ok": true, "id": "scan", "folder": "/etc", "files": )";
  for (const auto* files : {"[3]", R"(["../etc/hostname"])", R"(["/etc/hostname"])", "[[]]"}) {
    say(scan + files + "}");
    expect_not_understood(export_scan("latest", out), files);
    EXPECT_FALSE(std::filesystem::exists(out / "scan")) << files;
  }
  for (const auto* id : {"3", R"("../scan")", "null", R"("")"}) {
    say(std::string(R"({"ok": true, "folder": "/etc", "files": [], "id": )") + id + "}");
    expect_not_understood(export_scan("latest", out), id);
  }
}

TEST_F(StationTalk, OutlivesListsAndEventsOfAnotherShape) {
  for (const auto* scans : {"3", R"("scan")", "[3, []]", R"({"id": 3})"}) {
    say(std::string(R"({"ok": true, "scans": )") + scans + "}",
        std::string(R"({"event": "result", "scans": )") + scans + "}");
    EXPECT_NO_THROW(static_cast<void>(list_scans(false, false))) << scans;
    EXPECT_NO_THROW(static_cast<void>(list_scans(false, true))) << scans;
    EXPECT_NO_THROW(static_cast<void>(scan_on_station(true, false))) << scans;
  }
}

// One result that is damaged, or was just deleted, would hide all that come after it.
TEST_F(StationTalk, ListsInDetailPastAScanThatCannotBeRead) {
  say(R"({"ok": true, "scans": [{"id": "20261121T091502417Z-k3f9"}]})");
  const auto outcome_where_shown = [&](const Error& error) {
    loop_.call([&] { shown_ = error_answer(error); });
    return list_scans(false, true);
  };
  for (const auto code : {ErrorCode::kCorruptData, ErrorCode::kIo, ErrorCode::kPermissionDenied,
                          ErrorCode::kNotFound}) {
    EXPECT_TRUE(outcome_where_shown({code, Remedy::kOperator, "unreadable", ""}))
        << to_string(code);
  }
  const auto gone = outcome_where_shown({ErrorCode::kDeviceGone, Remedy::kOperator, "gone", ""});
  ASSERT_FALSE(gone) << "the disk, and with it the rest of the list";
  EXPECT_EQ(gone.error().message, "gone");
}

// What came after it was missing from a list that passed for whole.
TEST_F(StationTalk, SaysWhileItListsThatTheFolderOfTheResultsIsGone) {
  say(R"({"ok": true, "scans": [{"id": "20261121T091502417Z-k3f9"}]})");
  const auto gone =
      error_answer({ErrorCode::kNotFound, Remedy::kOperator, "the results' folder is gone", ""});
  loop_.call([&] { shown_ = afterwards_ = gone; });
  const auto listed = list_scans(false, true);
  ASSERT_FALSE(listed);
  EXPECT_EQ(listed.error().message, "the results' folder is gone");
}

// The daemon may run on the socket that those settings name.
TEST(StationTalkWithoutSettings, SaysThatTheyCannotBeReadRatherThanThatNoDaemonRuns) {
  const test::TemporaryFolder folder;
  const auto file = folder.path() / "instep.toml";
  std::ofstream(file) << "[control]\nsocket = \"control.sock\"\n[no such table\n";
  ::setenv("INSTEP_CONFIG", file.c_str(), 1);
  const auto shown = show_scan("latest", "json");
  ::unsetenv("INSTEP_CONFIG");
  ASSERT_FALSE(shown);
  EXPECT_THAT(shown.error().line(), HasSubstr("the settings that name the daemon's socket cannot"));
  EXPECT_THAT(shown.error().line(), HasSubstr(file.string()));
  EXPECT_EQ(shown.error().line().find('\n'), std::string::npos);
}

}  // namespace
}  // namespace instep
