#include <algorithm>
#include <array>
#include <string_view>

#include "daemon/cloud_files/cloud_file.h"
#include "daemon/cloud_files/cloud_ply_writer.h"
#include "tests/fuzz/fuzz_target.h"

namespace instep {
namespace {

void check_refusal(const Error& error) {
  test::require(!error.message.empty() && !error.advice.empty(),
                "a refusal says why and what next");
  test::require(error.code != ErrorCode::kInternal, "no file is a bug of ours: " + error.line());
}

void check_read(const CloudFile& read) {
  test::require(!read.cloud.empty(), "a cloud that was read has points");
  test::require(check_cloud(read.cloud).has_value(), "a cloud that was read is sound");
  test::require(read.unit != LengthUnit::kAuto, "the unit is settled");
  const std::size_t corners = read.mesh.positions.size();
  for (const auto& triangle : read.mesh.triangles) {
    test::require(*std::max_element(triangle.begin(), triangle.end()) < corners,
                  "a face names points that are there");
  }
}

/// What was read can be written, and comes back as it was.
void check_round_trip(const PointCloud& cloud) {
  const auto bytes = cloud_to_ply(cloud);
  test::require(bytes.has_value(), "a sound cloud can be written");
  const auto again = read_cloud_bytes(*bytes, "again.ply", LengthUnit::kMillimetre);
  test::require(again.has_value(), "what was written can be read");
  test::require(again->cloud.positions == cloud.positions, "coordinates come back bit by bit");
}

}  // namespace
}  // namespace instep

/// The library that reads STL files leaks some of what it refuses, for its own keepers to mend.
extern "C" const char* __lsan_default_suppressions() {
  return "leak:libassimp";
}

/// The bytes as a file under each name that decides how bytes without a mark of their own are read.
int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace instep;
  const std::string_view bytes(reinterpret_cast<const char*>(data), size);
  for (const char* name : {"body.xyz", "body.obj", "body.stl"}) {
    for (const LengthUnit unit : {LengthUnit::kMillimetre, LengthUnit::kAuto}) {
      const auto read = read_cloud_bytes(bytes, name, unit);
      if (!read) {
        check_refusal(read.error());
        continue;
      }
      check_read(*read);
      check_round_trip(read->cloud);
    }
  }
  return 0;
}
