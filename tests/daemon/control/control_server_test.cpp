#include "daemon/control/control_server.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <deque>

#include "tests/support/line_client.h"
#include "tests/support/loop_thread.h"
#include "tests/support/temporary_folder.h"

namespace instep {
namespace {

using test::LineClient;
using testing::HasSubstr;

const std::string kStatus = "{\"verb\": \"status\"}\n";
const std::string kWatch = "{\"verb\": \"watch\"}\n";
const std::string kList = "{\"verb\": \"list\"}\n";

/// A server on a loop of its own. It answers each request with its verb: list when the test says
/// so, as the daemon answers from another thread, the others at once.
class ControlServerTest : public testing::Test {
 protected:
  ControlServerTest() {
    loop_.call([this] {
      server_ = ControlServer::listen(loop_.loop(), socket_,
                                      [this](ControlServer::Client client, const Request& request) {
                                        serve(client, request);
                                      })
                    .value();
    });
  }
  ~ControlServerTest() override {
    loop_.call([this] { server_.reset(); });
  }

  void serve(ControlServer::Client client, const Request& request) {
    if (request.verb == "list") return waiting_.push_back(client);
    server_->answer(client, request.verb);
    if (request.verb == "watch") server_->add_watcher(client);
  }

  /// Answers the list that waits longest, once there is one; false if none comes.
  bool answer_list() {
    if (!loop_.wait_until([this] { return !waiting_.empty(); })) return false;
    loop_.call([this] {
      server_->answer(waiting_.front(), "list");
      waiting_.pop_front();
    });
    return true;
  }

  test::TemporaryFolder folder_;
  const std::filesystem::path socket_ = folder_.path() / "control.sock";
  test::LoopThread loop_;
  std::unique_ptr<ControlServer> server_;
  std::deque<ControlServer::Client> waiting_;
};

TEST_F(ControlServerTest, AnswersAllOfWhoShutDownItsWritingSide) {
  LineClient client(socket_);
  ASSERT_TRUE(client.send(kList + kStatus + kList));
  client.shut_down_writing();
  ASSERT_TRUE(answer_list());
  ASSERT_TRUE(answer_list());
  EXPECT_EQ(client.line(), "list");
  EXPECT_EQ(client.line(), "status");
  EXPECT_EQ(client.line(), "list");
  EXPECT_EQ(client.line(), std::nullopt) << "the connection ends with the last answer";
}

TEST_F(ControlServerTest, AnswersInOrderThoughAnEarlierRequestTakesLonger) {
  LineClient client(socket_);
  ASSERT_TRUE(client.send(kList + kStatus));
  ASSERT_TRUE(answer_list());
  EXPECT_EQ(client.line(), "list");
  EXPECT_EQ(client.line(), "status");
}

TEST_F(ControlServerTest, AnswersEachOfManyRequestsSentAtOnce) {
  constexpr int kMany = 1000;
  LineClient client(socket_);
  std::string requests;
  for (int i = 0; i < kMany; ++i) requests += kStatus;
  ASSERT_TRUE(client.send(kList + requests));
  ASSERT_TRUE(answer_list());
  EXPECT_EQ(client.line(), "list");
  for (int i = 0; i < kMany; ++i) ASSERT_EQ(client.line(), "status") << "after " << i;
}

TEST_F(ControlServerTest, GoesOnTellingAWatcherThatShutDownItsWritingSide) {
  LineClient client(socket_);
  ASSERT_TRUE(client.send(kWatch));
  client.shut_down_writing();
  EXPECT_EQ(client.line(), "watch");
  loop_.call([this] { server_->broadcast("event"); });
  EXPECT_EQ(client.line(), "event");
}

TEST_F(ControlServerTest, ForgetsAWatcherThatHasGone) {
  {
    LineClient client(socket_);
    ASSERT_TRUE(client.send(kWatch));
    client.shut_down_writing();
    EXPECT_EQ(client.line(), "watch");
  }
  EXPECT_TRUE(loop_.wait_until([this] { return !server_->has_watchers(); }));
}

TEST_F(ControlServerTest, DropsWhoSendsALineThatIsTooLong) {
  LineClient client(socket_);
  ASSERT_TRUE(client.send(std::string(kLongestRequest + 1, 'x')));
  EXPECT_THAT(client.line().value_or(""), HasSubstr("the request is too long"));
  EXPECT_EQ(client.line(), std::nullopt);
}

}  // namespace
}  // namespace instep
