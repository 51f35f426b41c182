#include "daemon/control/control_server.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <sys/syscall.h>
#include <sys/un.h>
#include <unistd.h>

#include <atomic>
#include <cstring>
#include <deque>

#include "tests/support/line_client.h"
#include "tests/support/loop_thread.h"
#include "tests/support/temporary_folder.h"

namespace {
std::atomic<int> failed_accepts = 0;
}

/// In place of the C library's: counts the calls that fail.
extern "C" int accept4(int socket, sockaddr* address, socklen_t* length, int flags) {
  const auto accepted = static_cast<int>(::syscall(SYS_accept4, socket, address, length, flags));
  if (accepted < 0) ++failed_accepts;
  return accepted;
}

namespace instep {
namespace {

using test::LineClient;
using testing::HasSubstr;

const std::string kStatus = "{\"verb\": \"status\"}\n";
const std::string kWatch = "{\"verb\": \"watch\"}\n";
const std::string kList = "{\"verb\": \"list\"}\n";
const std::string kShow = "{\"verb\": \"show\", \"id\": \"latest\"}\n";
/// More than a socket holds.
constexpr std::size_t kLongAnswer = 2 * 1024 * 1024;

void connect_to(const std::filesystem::path& path, int socket) {
  sockaddr_un address{};
  address.sun_family = AF_UNIX;
  std::memcpy(address.sun_path, path.c_str(), path.string().size());
  ASSERT_EQ(::connect(socket, reinterpret_cast<const sockaddr*>(&address), sizeof address), 0);
}

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
    ++served_;
    if (request.verb == "list") return waiting_.push_back(client);
    if (request.verb == "show") return server_->answer(client, std::string(kLongAnswer, 'x'));
    const bool refused = request.verb == "watch" && !server_->add_watcher(client);
    server_->answer(client, refused ? "refused" : request.verb);
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
  int served_ = 0;
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

// The answers piled up to the 20 MiB that one client may leave unread, of each of 32 clients.
TEST_F(ControlServerTest, AnswersNoMoreUntilAnAnswerIsRead) {
  constexpr int kMany = 8;
  LineClient client(socket_);
  for (int i = 0; i < kMany; ++i) ASSERT_TRUE(client.send(kShow));
  ASSERT_TRUE(loop_.wait_until([this] { return served_ > 0; }));
  // The loop comes to all that it has to do before it answers another client.
  LineClient other(socket_);
  ASSERT_TRUE(other.send(kStatus));
  EXPECT_EQ(other.line(), "status");
  loop_.call([this] { EXPECT_EQ(served_, 2) << "one long answer, and the other client's"; });
  for (int i = 0; i < kMany; ++i) EXPECT_EQ(client.line()->size(), kLongAnswer) << i;
}

TEST_F(ControlServerTest, DoesWhatWasAskedByWhoDidNotWaitForTheAnswer) {
  loop_.call([this] {
    const LineClient client(socket_);
    ASSERT_TRUE(client.send(kList));
  });
  EXPECT_TRUE(loop_.wait_until([this] { return !waiting_.empty(); }));
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

TEST_F(ControlServerTest, GivesThePlaceOfTheQuietestToWhoComes) {
  std::deque<LineClient> clients;
  const auto add = [&](const std::string& request, const std::string& answer) {
    ASSERT_TRUE(clients.emplace_back(socket_).send(request));
    ASSERT_EQ(clients.back().line(), answer);
  };
  add(kWatch, "watch");
  while (clients.size() < ControlServer::kMostClients) add(kStatus, "status");
  LineClient& speaks = clients[1];
  LineClient& is_quiet = clients[2];
  ASSERT_TRUE(speaks.send(kStatus));
  ASSERT_EQ(speaks.line(), "status");

  add(kStatus, "status");
  EXPECT_THAT(is_quiet.line().value_or(""), HasSubstr("too many programs talk to the daemon"));
  EXPECT_EQ(is_quiet.line(), std::nullopt);
  ASSERT_TRUE(speaks.send(kStatus));
  EXPECT_EQ(speaks.line(), "status");
  loop_.call([this] { server_->broadcast("event"); });
  EXPECT_EQ(clients.front().line(), "event") << "a watcher is quiet by its nature";
}

TEST_F(ControlServerTest, TurnsAwayWhoComesWhenEachPlaceIsNeeded) {
  std::deque<LineClient> clients;
  while (clients.size() < ControlServer::kMostClients) {
    ASSERT_TRUE(clients.emplace_back(socket_).send(kList));
  }
  ASSERT_TRUE(loop_.wait_until([this] { return waiting_.size() == ControlServer::kMostClients; }));
  LineClient late(socket_);
  EXPECT_THAT(late.line().value_or(""), HasSubstr("too many programs talk to the daemon"));
  EXPECT_EQ(late.line(), std::nullopt);
  for (LineClient& client : clients) {
    ASSERT_TRUE(answer_list());
    EXPECT_EQ(client.line(), "list");
  }
}

TEST_F(ControlServerTest, GivesThePlaceOfWhoDoesNotReadItsAnswers) {
  const std::string answer(ControlServer::kMostUnreadBytes / 2, 'a');
  std::deque<LineClient> clients;
  while (clients.size() < ControlServer::kMostClients) {
    ASSERT_TRUE(clients.emplace_back(socket_).send(kList));
    ASSERT_TRUE(loop_.wait_until([this] { return !waiting_.empty(); }));
    loop_.call([&] {
      server_->answer(waiting_.front(), answer);
      waiting_.pop_front();
    });
  }
  LineClient late(socket_);
  ASSERT_TRUE(late.send(kStatus));
  EXPECT_EQ(late.line(), "status");
  EXPECT_EQ(clients.back().line(), answer) << "it was quiet for a shorter time than others";
}

TEST_F(ControlServerTest, KeepsPlacesForWhoDoesNotWatch) {
  std::deque<LineClient> watchers;
  while (watchers.size() < ControlServer::kMostWatchers) {
    ASSERT_TRUE(watchers.emplace_back(socket_).send(kWatch));
    ASSERT_EQ(watchers.back().line(), "watch");
  }
  LineClient another(socket_);
  ASSERT_TRUE(another.send(kWatch + kStatus));
  EXPECT_EQ(another.line(), "refused");
  EXPECT_EQ(another.line(), "status");
  ASSERT_TRUE(watchers.front().send(kWatch));
  EXPECT_EQ(watchers.front().line(), "watch") << "it watches already";
}

TEST_F(ControlServerTest, DropsAWatcherThatDoesNotRead) {
  LineClient client(socket_);
  ASSERT_TRUE(client.send(kWatch));
  ASSERT_EQ(client.line(), "watch");
  const std::string event(ControlServer::kMostUnreadBytes / 8, 'e');
  loop_.call([&] {
    for (int i = 0; i < 7; ++i) server_->broadcast(event);
    EXPECT_TRUE(server_->has_watchers()) << "so much may wait for it";
    for (int i = 0; i < 2; ++i) server_->broadcast(event);
    EXPECT_FALSE(server_->has_watchers());
  });
}

// What waits on the socket wakes the loop at once and again, which is all it would do.
TEST_F(ControlServerTest, RestsWhileThereIsNoDescriptorForAClient) {
  constexpr int kRounds = 2000;
  rlimit limit{};
  ASSERT_EQ(::getrlimit(RLIMIT_NOFILE, &limit), 0);
  const int socket = ::socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0);
  const rlimit none{0, limit.rlim_max};
  failed_accepts = 0;
  loop_.call([&] {
    ::setrlimit(RLIMIT_NOFILE, &none);
    connect_to(socket_, socket);
  });
  for (int i = 0; i < kRounds; ++i) loop_.call([] {});
  ::setrlimit(RLIMIT_NOFILE, &limit);
  EXPECT_GE(failed_accepts, 1);
  EXPECT_LT(failed_accepts, kRounds / 4);
  LineClient client(socket_);
  ASSERT_TRUE(client.send(kStatus));
  EXPECT_EQ(client.line(), "status") << "it listens again";
  ::close(socket);
}

}  // namespace
}  // namespace instep
