#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <fstream>
#include <string>
#include <vector>

#include "daemon/cloud_files/cloud_file.h"
#include "tests/support/temporary_folder.h"

namespace instep::test {

/// The bytes of a number, as files have it; `big`: the largest first.
template <typename T>
std::string raw(T value, bool big = false) {
  std::array<char, sizeof(T)> bytes;
  std::memcpy(bytes.data(), &value, sizeof(T));
  if (big) std::reverse(bytes.begin(), bytes.end());
  return {bytes.data(), bytes.size()};
}

/// Files that are written with a content and read again.
class CloudFiles : public testing::Test {
 protected:
  Result<CloudFile> read(const std::string& name, const std::string& bytes,
                         LengthUnit unit = LengthUnit::kMillimetre) {
    std::ofstream(folder_.path() / name, std::ios::binary) << bytes;
    return read_cloud_file(folder_.path() / name, unit);
  }

  /// Expects an error of that code whose line holds `said` and the file's name.
  void expect_fault(const std::string& name, const std::string& bytes, ErrorCode code,
                    const std::string& said, LengthUnit unit = LengthUnit::kMillimetre) {
    const auto file = read(name, bytes, unit);
    ASSERT_FALSE(file) << said;
    EXPECT_EQ(file.error().code, code) << file.error().line();
    EXPECT_NE(file.error().line().find(said), std::string::npos) << file.error().line();
    EXPECT_NE(file.error().message.find(name), std::string::npos) << file.error().line();
    EXPECT_FALSE(file.error().advice.empty());
  }

  TemporaryFolder folder_;
};

inline const std::vector<Eigen::Vector3d> kPoints = {
    {0, 0, 0}, {10, 0.5, 0}, {0, 20.25, 3}, {-1, 2, 30}};

}  // namespace instep::test
