#include "daemon/control/unix_socket.h"

#include <fcntl.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/file.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/un.h>
#include <unistd.h>

#include <cstring>
#include <deque>
#include <fstream>
#include <iterator>
#include <thread>
#include <vector>

#include "daemon/control/control_client.h"
#include "tests/support/temporary_folder.h"

namespace instep {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

class UnixSocket : public testing::Test {
 protected:
  std::size_t files_left() const {
    return static_cast<std::size_t>(
        std::distance(fs::directory_iterator(folder_.path()), fs::directory_iterator()));
  }
  test::TemporaryFolder folder_;
  const fs::path path_ = folder_.path() / "control.sock";
};

TEST_F(UnixSocket, IsReachedByItsGroupAndLeavesNothingBehind) {
  {
    const auto socket = ListeningSocket::open(path_);
    ASSERT_TRUE(socket) << socket.error().line();
    const auto client = connect_unix_socket(path_);
    ASSERT_TRUE(client) << client.error().line();
    struct stat status {};
    ASSERT_EQ(::stat(path_.c_str(), &status), 0);
    EXPECT_EQ(status.st_mode & 0777, 0660U);
  }
  EXPECT_EQ(files_left(), 0U);
}

TEST_F(UnixSocket, TakesTheNameOfOneThatNobodyListensOn) {
  {
    // As a daemon leaves it that was killed: with no lock, but its file.
    auto killed = std::make_unique<ListeningSocket>(ListeningSocket::open(path_).value());
    fs::rename(path_, folder_.path() / "kept");
    killed.reset();
    fs::rename(folder_.path() / "kept", path_);
    std::ofstream(path_.string() + ".lock");
  }
  const auto socket = ListeningSocket::open(path_);
  ASSERT_TRUE(socket) << socket.error().line();
}

TEST_F(UnixSocket, IsLeftToTheOneThatIsAboutToListen) {
  const std::string name = path_.string() + ".lock";
  const Descriptor lock(::open(name.c_str(), O_RDONLY | O_CREAT | O_CLOEXEC, 0600));
  ASSERT_EQ(::flock(lock.number(), LOCK_EX | LOCK_NB), 0);
  const auto socket = ListeningSocket::open(path_);
  ASSERT_FALSE(socket);
  EXPECT_EQ(socket.error().code, ErrorCode::kBusy);
  EXPECT_FALSE(fs::exists(path_));
  EXPECT_TRUE(fs::exists(name)) << "it is not its own";
}

// The place is taken from the moment it is locked, though nobody listens yet.
TEST_F(UnixSocket, OfManyThatOpenItAtOnceOneHasIt) {
  for (int round = 0; round < 50; ++round) {
    constexpr std::size_t kMany = 4;
    std::vector<std::optional<Result<ListeningSocket>>> sockets(kMany);
    std::vector<std::thread> threads;
    for (auto& socket : sockets) {
      threads.emplace_back([&socket, this] { socket.emplace(ListeningSocket::open(path_)); });
    }
    for (auto& thread : threads) thread.join();
    std::size_t open = 0;
    for (const auto& socket : sockets) {
      if (*socket) {
        ++open;
      } else {
        EXPECT_EQ((*socket).error().code, ErrorCode::kBusy);
        EXPECT_THAT((*socket).error().message, HasSubstr("another instepd answers on"));
      }
    }
    ASSERT_EQ(open, 1U);
    const auto client = connect_unix_socket(path_);
    ASSERT_TRUE(client) << "the one that is open is the one that has the name";
  }
}

TEST_F(UnixSocket, LeavesAloneWhatHasTakenItsPlace) {
  {
    const auto socket = ListeningSocket::open(path_);
    ASSERT_TRUE(socket);
    fs::remove(path_);
    std::ofstream(path_) << "another";
  }
  EXPECT_TRUE(fs::exists(path_));
}

TEST_F(UnixSocket, RefusesAPlaceThatHoldsSomethingElse) {
  std::ofstream(path_) << "precious";
  const auto socket = ListeningSocket::open(path_);
  ASSERT_FALSE(socket);
  EXPECT_THAT(socket.error().message, HasSubstr("is no socket"));
  EXPECT_EQ(fs::file_size(path_), 8U);
  EXPECT_EQ(files_left(), 1U) << "no lock is left";
}

/// Listens, as a daemon that hangs does, and takes no connection.
class HangingListener {
 public:
  explicit HangingListener(const fs::path& path)
      : descriptor_(::socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0)) {
    sockaddr_un address{};
    address.sun_family = AF_UNIX;
    std::strncpy(address.sun_path, path.c_str(), sizeof address.sun_path - 1);
    EXPECT_EQ(
        ::bind(descriptor_.number(), reinterpret_cast<const sockaddr*>(&address), sizeof address),
        0);
    EXPECT_EQ(::listen(descriptor_.number(), 0), 0);
  }

 private:
  Descriptor descriptor_;
};

TEST_F(UnixSocket, DoesNotWaitForEverForOneThatTakesNoConnection) {
  const HangingListener hanging(path_);
  std::deque<Descriptor> waiting;
  Result<Descriptor> reached;
  for (int client = 0; client < 10 && reached; ++client) {
    reached = connect_unix_socket(path_, std::chrono::milliseconds(20));
    if (reached) waiting.push_back(std::move(*reached));
  }
  ASSERT_FALSE(reached);
  EXPECT_EQ(reached.error().code, ErrorCode::kTimeout);
  EXPECT_THAT(reached.error().message, HasSubstr("takes no connection"));
  const auto socket = ListeningSocket::open(path_);
  ASSERT_FALSE(socket) << "the name of one that listens is not taken";
  EXPECT_EQ(socket.error().code, ErrorCode::kBusy);
  EXPECT_TRUE(fs::exists(path_));
}

// To start the daemon, as was advised, does nothing while it runs.
TEST_F(UnixSocket, IsKnownToBeLostWhereItsFileWasRemoved) {
  EXPECT_FALSE(has_lost_listener(path_));
  const auto socket = ListeningSocket::open(path_);
  ASSERT_TRUE(socket) << socket.error().line();
  EXPECT_FALSE(has_lost_listener(path_));
  fs::remove(path_);
  EXPECT_TRUE(has_lost_listener(path_));
  EXPECT_FALSE(has_lost_listener(path_.string() + "2"));
  const auto client = ControlClient::connect(path_);
  ASSERT_FALSE(client);
  EXPECT_THAT(client.error().line(), HasSubstr("sudo systemctl restart instepd"));
  const auto second = ListeningSocket::open(path_);
  ASSERT_FALSE(second);
  EXPECT_THAT(second.error().line(), HasSubstr("sudo systemctl restart instepd"));
}

TEST_F(UnixSocket, SaysThatWhatIsThereIsNoSocketToReach) {
  std::ofstream(path_) << "a file";
  for (const fs::path& place : {path_, folder_.path()}) {
    const auto reached = connect_unix_socket(place);
    ASSERT_FALSE(reached);
    EXPECT_EQ(reached.error().code, ErrorCode::kInvalidInput);
    EXPECT_THAT(reached.error().message, HasSubstr("is no socket"));
  }
  EXPECT_EQ(connect_unix_socket(folder_.path() / "none").error().code, ErrorCode::kNotFound);
}

}  // namespace
}  // namespace instep
