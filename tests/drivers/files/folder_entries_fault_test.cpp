#include "drivers/files/folder_entries.h"

#include <dirent.h>
#include <dlfcn.h>
#include <gtest/gtest.h>

#include <cerrno>
#include <fstream>
#include <optional>

#include "drivers/evdev/input_device.h"
#include "tests/support/temporary_folder.h"

namespace {

/// How many entries can still be read; none = all.
std::optional<int> readable;

}  // namespace

/// Stands before that of the C library: no folder here fails in the middle of itself.
extern "C" dirent* readdir(DIR* folder) {
  static const auto real = reinterpret_cast<dirent* (*)(DIR*)>(::dlsym(RTLD_NEXT, "readdir"));
  if (!readable || (*readable)-- > 0) return real(folder);
  errno = EIO;
  return nullptr;
}

namespace instep {
namespace {

class FolderEntriesTest : public testing::Test {
 protected:
  FolderEntriesTest() {
    for (const char* name : {"event1", "event0", "mouse0"}) std::ofstream(folder_.path() / name);
  }

  /// Of what can be read before each of the failures that there can be.
  template <typename Look>
  void for_each_failure(Look look) const {
    constexpr int kEntries = 5;  // with . and ..
    for (int k = 0; k <= kEntries; ++k) {
      SCOPED_TRACE(k);
      readable = k;
      look();
      readable.reset();
    }
  }

  test::TemporaryFolder folder_;
};

TEST_F(FolderEntriesTest, AreInTheOrderOfTheirNames) {
  const auto all = entries_of(folder_.path());
  EXPECT_FALSE(all.failure);
  ASSERT_EQ(all.paths.size(), 3U);
  EXPECT_EQ(all.paths[1], folder_.path() / "event1");
  EXPECT_EQ(entries_of(folder_.path(), "event").paths.size(), 2U);
}

TEST_F(FolderEntriesTest, OfNoFolderAreNone) {
  const auto away = entries_of(folder_.path() / "away");
  EXPECT_EQ(away.failure, std::errc::no_such_file_or_directory);
  const auto file = entries_of(folder_.path() / "event0");
  EXPECT_EQ(file.failure, std::errc::not_a_directory);
  EXPECT_TRUE(away.paths.empty() && file.paths.empty());
}

TEST_F(FolderEntriesTest, SayWhereTheyBreakOff) {
  for_each_failure([&] {
    const auto some = entries_of(folder_.path());
    EXPECT_EQ(some.failure, std::errc::io_error);
    EXPECT_LE(some.paths.size(), 3U);
  });
}

// In the loop of events an exception would end the daemon.
TEST_F(FolderEntriesTest, ThatBreakOffFailTheSearchForAPedal) {
  for_each_failure([&] {
    const auto found = InputDevice::find(folder_.path(), "0c45:7403", 1);
    EXPECT_EQ(found.error().code, ErrorCode::kIo);
  });
}

}  // namespace
}  // namespace instep
