#include "daemon/cloud_files/pcd_compression.h"

#include <cstdint>
#include <utility>

#include "tests/support/cloud_files.h"

namespace instep {
namespace {

using test::CloudFiles;
using test::kPoints;
using test::raw;

constexpr std::size_t kFurthest = 8192;  // bytes back
constexpr std::size_t kLongest = 264;

/// The longest repetition of what stands at most `kFurthest` before `at`.
struct Repetition {
  std::size_t distance = 0;
  std::size_t length = 0;
};

Repetition repetition_at(const std::string& bytes, std::size_t at) {
  Repetition best;
  for (std::size_t distance = 1; distance <= std::min(at, kFurthest); ++distance) {
    std::size_t length = 0;
    while (length < kLongest && at + length < bytes.size() &&
           bytes[at + length] == bytes[at + length - distance]) {
      ++length;
    }
    if (length > best.length) best = {distance, length};
  }
  return best;
}

/// LZF as its format is described: runs of at most 32 bytes as they are, and repetitions of 3 and
/// more bytes. Written apart from the library that unpacks it.
std::string packed(const std::string& bytes) {
  std::string out;
  std::string run;
  const auto end_run = [&] {
    if (run.empty()) return;
    out += static_cast<char>(run.size() - 1);
    out += std::exchange(run, "");
  };
  for (std::size_t at = 0; at < bytes.size();) {
    const auto [distance, length] = repetition_at(bytes, at);
    if (length < 3) {
      run += bytes[at++];
      if (run.size() == 32) end_run();
      continue;
    }
    end_run();
    const std::size_t told = length - 2;
    const std::size_t back = distance - 1;
    out += static_cast<char>((std::min<std::size_t>(told, 7) << 5U) | (back >> 8U));
    if (told >= 7) out += static_cast<char>(told - 7);
    out += static_cast<char>(back & 0xFFU);
    at += length;
  }
  end_run();
  return out;
}

std::string header(std::size_t points) {
  return "# .PCD v0.7\nVERSION 0.7\nFIELDS rgb x y z\nSIZE 4 4 8 4\nTYPE U F F I\nCOUNT 2 1 1 1\n"
         "WIDTH " +
         std::to_string(points) + "\nHEIGHT 1\nVIEWPOINT 0 0 0 1 0 0 0\nDATA binary_compressed\n";
}

/// All of one field behind each other, as compressed files have them.
std::string by_fields(const std::vector<Eigen::Vector3d>& points) {
  std::string bytes(8 * points.size(), 'c');
  for (const auto& point : points) bytes += raw(static_cast<float>(point.x()));
  for (const auto& point : points) bytes += raw(point.y());
  for (const auto& point : points) bytes += raw(static_cast<std::int32_t>(point.z()));
  return bytes;
}

std::string body(const std::string& unpacked) {
  const std::string data = packed(unpacked);
  return raw(static_cast<std::uint32_t>(data.size())) +
         raw(static_cast<std::uint32_t>(unpacked.size())) + data;
}

class CompressedPcd : public CloudFiles {};

TEST_F(CompressedPcd, IsRead) {
  const auto file = read("a.pcd", header(4) + body(by_fields(kPoints)));
  ASSERT_TRUE(file) << file.error().line();
  EXPECT_EQ(file->cloud.positions, kPoints);
  EXPECT_EQ(file->format, "PCD, compressed");
}

TEST_F(CompressedPcd, OfManyPointsIsRead) {
  std::vector<Eigen::Vector3d> points;
  for (int i = 0; i < 3000; ++i) points.emplace_back(i % 250, 0.25 * (i % 90), (i * 7) % 60);
  const auto file = read("a.pcd", header(points.size()) + body(by_fields(points)));
  ASSERT_TRUE(file) << file.error().line();
  EXPECT_EQ(file->cloud.positions, points);
}

TEST_F(CompressedPcd, TellsWhatFollows) {
  const auto file = read("a.pcd", header(4) + body(by_fields(kPoints)) + "more");
  ASSERT_TRUE(file) << file.error().line();
  ASSERT_FALSE(file->notes.empty());
  EXPECT_NE(file->notes[0].find("goes on for 4 bytes"), std::string::npos) << file->notes[0];
}

TEST_F(CompressedPcd, ThatContradictsItselfIsRefused) {
  const auto corrupt = ErrorCode::kCorruptData;
  const std::string good = body(by_fields(kPoints));
  expect_fault("none.pcd", header(4), corrupt, "cut short");
  expect_fault("sizes.pcd", header(4) + good.substr(0, 7), corrupt, "cut short");
  expect_fault("short.pcd", header(4) + good.substr(0, good.size() - 1), corrupt, "cut short");
  expect_fault("fewer.pcd", header(5) + good, corrupt, "96 bytes, by its header 120");
  expect_fault("more.pcd", header(3) + good, corrupt, "96 bytes, by its header 72");
  std::string wrong = good;
  wrong[8] = '\xFF';  // a repetition of what stands before the first byte
  expect_fault("wrong.pcd", header(4) + wrong, corrupt, "cannot be unpacked");
}

/// Four GiB out of a few bytes.
TEST_F(CompressedPcd, IsNotBelievedASizeThatItsDataCannotFill) {
  constexpr std::uint32_t kMany = 40000000;
  const std::string body = raw(std::uint32_t{5}) + raw(kMany * 24) + "abcde";
  expect_fault("vast.pcd", header(kMany) + body, ErrorCode::kCorruptData, "cannot hold");
}

/// Whatever byte is damaged, the file is read or refused, and nothing else happens.
TEST_F(CompressedPcd, WithADamagedByteIsReadOrRefused) {
  const std::string good = header(4) + body(by_fields(kPoints));
  for (std::size_t i = header(4).size(); i < good.size(); ++i) {
    for (const char value : {'\0', '\x1F', '\x20', '\xE0', '\xFF'}) {
      std::string damaged = good;
      damaged[i] = value;
      const auto file = read("d.pcd", damaged);
      EXPECT_TRUE(file || !file.error().advice.empty());
    }
  }
}

}  // namespace
}  // namespace instep
