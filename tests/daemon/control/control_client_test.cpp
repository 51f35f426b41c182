#include "daemon/control/control_client.h"

#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <unistd.h>

#include <nlohmann/json.hpp>

#include "daemon/control/unix_socket.h"
#include "tests/support/temporary_folder.h"

namespace instep {
namespace {

/// The daemon's end is closed, so that a client that reads all the same does not wait for ever.
TEST(ControlClient, SaysThatTheSystemDoesNotLetItWait) {
  const test::TemporaryFolder folder;
  const auto socket = folder.path() / "control.sock";
  auto listening = ListeningSocket::open(socket).value();
  auto client = ControlClient::connect(socket).value();
  const int accepted = ::accept(listening.descriptor(), nullptr, nullptr);
  ASSERT_GE(accepted, 0);
  ::close(accepted);
  rlimit limit{};
  ASSERT_EQ(::getrlimit(RLIMIT_NOFILE, &limit), 0);
  const rlimit none{0, limit.rlim_max};
  ::setrlimit(RLIMIT_NOFILE, &none);  // poll() then takes no descriptor
  const auto line = client.next(std::chrono::seconds(30));
  ::setrlimit(RLIMIT_NOFILE, &limit);
  ASSERT_FALSE(line);
  EXPECT_EQ(line.error().code, ErrorCode::kIo) << line.error().line();
}

TEST(ControlClient, SaysThatTheDaemonEndedTheConnection) {
  const test::TemporaryFolder folder;
  const auto socket = folder.path() / "control.sock";
  auto listening = ListeningSocket::open(socket).value();
  auto client = ControlClient::connect(socket).value();
  ::close(::accept(listening.descriptor(), nullptr, nullptr));
  const auto line = client.next(std::chrono::seconds(30));
  ASSERT_FALSE(line);
  EXPECT_EQ(line.error().code, ErrorCode::kDeviceGone) << line.error().line();
}

// It waited for longer than asked, and then said that the daemon had ended.
TEST(ControlClient, SaysThatAHungDaemonReadsNothing) {
  const test::TemporaryFolder folder;
  const auto socket = folder.path() / "control.sock";
  const auto listening = ListeningSocket::open(socket).value();
  auto client = ControlClient::connect(socket).value();
  const std::string more_than_is_buffered(std::size_t{4} << 20, 'x');
  const auto answer = client.ask("show", more_than_is_buffered, std::chrono::milliseconds(50));
  ASSERT_FALSE(answer);
  EXPECT_EQ(answer.error().code, ErrorCode::kTimeout) << answer.error().line();
}

}  // namespace
}  // namespace instep
