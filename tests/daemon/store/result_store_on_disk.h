#pragma once

#include <gtest/gtest.h>

#include <chrono>
#include <memory>
#include <string>

#include "daemon/store/posix_storage.h"
#include "daemon/store/result_store.h"
#include "tests/support/temporary_folder.h"

namespace instep::test {

/// A store in a folder of its own, ready.
class ResultStoreOnDisk : public testing::Test {
 protected:
  ResultStoreOnDisk() : store(std::make_shared<PosixStorage>(), folder.path() / "scans") {
    EXPECT_TRUE(store.prepare());
  }
  void put(const std::string& id) { ASSERT_TRUE(store.put(id, {"{}", "ply", "<svg/>", "<svg/>"})); }
  /// After a restart, by the ids alone.
  std::string newest(std::chrono::system_clock::time_point now) const {
    return ResultStore(std::make_shared<PosixStorage>(), store.root()).find("latest", now).value();
  }

  TemporaryFolder folder;
  ResultStore store;
};

}  // namespace instep::test
