#include "daemon/cloud_files/cloud_ply_writer.h"

#include <cstdint>

#include "daemon/cloud_files/error_properties.h"
#include "daemon/cloud_files/little_endian.h"

namespace instep {
namespace {

std::string header_of(const PointCloud& cloud) {
  std::string header = "ply\nformat binary_little_endian 1.0\ncomment unit mm\nelement vertex " +
                       std::to_string(cloud.size()) +
                       "\nproperty double x\nproperty double y\nproperty double z\n";
  if (cloud.has_normals()) {
    header += "property float nx\nproperty float ny\nproperty float nz\n";
  }
  if (cloud.has_sigma()) header += "property float sigma_mm\n";
  if (!cloud.origins.empty()) header += "property uchar origin\n";
  for (std::size_t e = 0; e < cloud.shared_errors_mm.size(); ++e) {
    header += "property float " + shared_error_property(e) + "\n";
  }
  if (!cloud.local_errors.empty()) {
    header += std::string("property float ") + kLocalErrorProperty + "\n";
    header += std::string("property float ") + kLocalErrorReachProperty + "\n";
  }
  return header + "end_header\n";
}

}  // namespace

Result<std::string> cloud_to_ply(const PointCloud& cloud) {
  if (!cloud.is_consistent()) {
    return fail(ErrorCode::kInvalidInput, "the lists of a cloud differ in length", "report this");
  }
  std::string bytes = header_of(cloud);
  bytes.reserve(bytes.size() + cloud.size() * (49 + 4 * cloud.shared_errors_mm.size()));
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    for (int axis = 0; axis < 3; ++axis) append_little_endian(bytes, cloud.positions[i][axis]);
    for (int axis = 0; axis < 3 && cloud.has_normals(); ++axis) {
      append_little_endian(bytes, static_cast<float>(cloud.normals[i][axis]));
    }
    if (cloud.has_sigma()) append_little_endian(bytes, static_cast<float>(cloud.sigma_mm[i]));
    if (!cloud.origins.empty())
      append_little_endian(bytes, static_cast<std::uint8_t>(cloud.was_seen(i) ? 0 : 1));
    for (const auto& error : cloud.shared_errors_mm) {
      append_little_endian(bytes, static_cast<float>(error[i]));
    }
    if (!cloud.local_errors.empty()) {
      append_little_endian(bytes, static_cast<float>(cloud.local_errors.sigma_mm[i]));
      append_little_endian(bytes, static_cast<float>(cloud.local_errors.reach_mm));
    }
  }
  return bytes;
}

}  // namespace instep
