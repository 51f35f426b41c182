#include "daemon/cloud_files/cloud_file.h"

#include <fmt/core.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cctype>
#include <iterator>
#include <utility>

#include "core/geometry/mesh_sampling.h"
#include "core/median.h"
#include "core/noticed.h"
#include "daemon/cloud_files/mesh_reader.h"
#include "daemon/cloud_files/pcd_reader.h"
#include "daemon/cloud_files/ply_reader.h"
#include "daemon/cloud_files/raw_cloud.h"
#include "daemon/cloud_files/text_cloud_reader.h"
#include "daemon/cloud_files/text_tokens.h"
#include "daemon/cloud_files/unseen_points.h"
#include "drivers/files/file_bytes.h"

namespace instep {
namespace {

constexpr std::size_t kMostFileBytes = std::size_t{4} << 30;

/// The widest stretch of a mesh's surface without a point.
constexpr double kPointSpacing_mm = 3.0;

std::string lower_extension(const std::filesystem::path& path) {
  return lower_case(path.extension().string());
}

/// By the comment that it begins with ("# .PCD v0.7 - ..."), or by its first word.
bool looks_like_pcd(std::string_view bytes) {
  TextLines lines(bytes);
  for (bool is_first = true; auto line = lines.next(); is_first = false) {
    const auto word = take_word(*line);
    if (!word.empty() && word[0] != '#') return word == "VERSION" || word == "FIELDS";
    if (is_first && (word == "#.PCD" || take_word(*line) == ".PCD")) return true;
  }
  return false;
}

/// Text whose letters take two bytes each: one of each pair is zero, and the other a letter, but
/// for a mark of two bytes before the first.
bool looks_like_utf16(std::string_view bytes) {
  constexpr std::size_t kLetters = 16;
  const bool is_marked = bytes.starts_with("\xFF\xFE") || bytes.starts_with("\xFE\xFF");
  if (is_marked) bytes.remove_prefix(2);
  if (bytes.size() < 2 * kLetters) return false;
  bool any_letter_first = false;
  bool any_zero_first = false;
  for (std::size_t i = 0; i < 2 * kLetters; i += 2) {
    const bool is_zero_first = bytes[i] == '\0';
    const auto letter = static_cast<unsigned char>(bytes[is_zero_first ? i + 1 : i]);
    const bool is_pair = bytes[is_zero_first ? i : i + 1] == '\0';
    if (!is_pair || (std::isprint(letter) == 0 && std::isspace(letter) == 0)) return false;
    (is_zero_first ? any_zero_first : any_letter_first) = true;
  }
  return any_letter_first != any_zero_first;
}

/// The content decides where it can be told; STL and OBJ have no sure mark, so their names do.
Result<RawCloud> read_by_content(std::string_view bytes, const std::filesystem::path& path) {
  const std::string file = path.string();
  const std::string extension = lower_extension(path);
  const std::string_view start = bytes.substr(0, 4096);
  if (looks_like_utf16(start)) {
    return fail(ErrorCode::kUnsupported, file + " is text in UTF-16",
                "save it as UTF-8 or plain text");
  }
  if (start.substr(0, 3) == "ply" && start.size() > 3 &&
      std::isspace(static_cast<unsigned char>(start[3])) != 0) {
    return read_ply(bytes, file);
  }
  if (extension == ".ply") {
    return damaged_file(file, "it does not begin with \"ply\"");
  }
  if (looks_like_pcd(start)) return read_pcd(bytes, file);
  if (extension == ".obj") return read_obj(bytes, file);
  if (extension == ".stl") return read_stl(bytes, file);
  if (looks_like_text_cloud(start)) return read_text_cloud(bytes, file);
  if (lower_case(start.substr(0, 5)) == "solid") return read_stl(bytes, file);
  return fail(ErrorCode::kUnsupported, file + " is no cloud or mesh that can be read",
              "give PLY, XYZ or CSV text, PCD, OBJ or STL");
}

/// The longest side of the box round the points.
double extent_of(const std::vector<Eigen::Vector3d>& positions) {
  Eigen::AlignedBox3d box;
  for (const auto& position : positions) box.extend(position);
  return box.sizes().maxCoeff();
}

/// The same without the outermost hundredth at each end of each axis; of fewer than a hundred
/// points none is.
double extent_of_most(const std::vector<Eigen::Vector3d>& positions) {
  const double outermost = positions.size() < 100 ? 0.0 : 0.01;
  double longest = 0.0;
  for (int axis = 0; axis < 3; ++axis) {
    std::vector<double> places;
    places.reserve(positions.size());
    for (const auto& position : positions) places.push_back(position(axis));
    const double from = quantile(places, outermost);
    longest = std::max(longest, quantile(std::move(places), 1.0 - outermost) - from);
  }
  return longest;
}

/// By most of the points, for a stray may be metres away: but not asked of all where the whole is
/// of a likely size. Where nearly all are at one place, as those that a scanner did not see, the
/// others tell.
double size_of_body(const std::vector<Eigen::Vector3d>& positions, double extent, LengthUnit unit) {
  if (unit != LengthUnit::kAuto && !doubt_of_unit(unit, extent)) return extent;
  const double most = extent_of_most(positions);
  return most > 0.0 ? most : extent;
}

/// What stands in the same columns: none of it is negative, and only by chance of length 1.
bool are_colours(const std::vector<Eigen::Vector3d>& guessed) {
  constexpr double kOffOne = 0.02;  // of normals of two decimals
  constexpr double kFew = 0.1;
  const auto of_another_length = std::count_if(
      guessed.begin(), guessed.end(),
      [](const Eigen::Vector3d& normal) { return std::abs(normal.norm() - 1.0) > kOffOne; });
  const bool any_negative =
      std::any_of(guessed.begin(), guessed.end(),
                  [](const Eigen::Vector3d& normal) { return normal.minCoeff() < 0.0; });
  return !any_negative &&
         static_cast<double>(of_another_length) > kFew * static_cast<double>(guessed.size());
}

void drop_colours(const RawCloud& raw, CloudFile& read) {
  if (!raw.are_normals_guessed || !are_colours(read.cloud.normals)) return;
  read.cloud.normals.clear();
  read.notes.emplace_back(
      "columns 4 to 6 look like colours and were not used: if they are normals, give the file a "
      "heading, x y z nx ny nz");
}

/// Brings normals to unit length; drops them all, with a note, if one is none.
void settle_normals(CloudFile& read) {
  for (auto& normal : read.cloud.normals) {
    const double length = normal.norm();
    if (!(length > 0.0 && std::isfinite(length))) {
      read.notes.emplace_back("some of the file's normals are no directions, so none was used");
      read.cloud.normals.clear();
      return;
    }
    normal /= length;
  }
}

void drop_errors_along_normals(CloudFile& read, const std::string& why) {
  if (read.cloud.shared_errors_mm.empty() && read.cloud.local_errors.empty()) return;
  read.cloud.drop_errors_along_normals();
  read.notes.push_back("the errors that the file's points share are not in the intervals: " + why);
}

/// Adds to the corners of a mesh the points on its large faces, and normals where it has none.
void cover_faces(CloudFile& read) {
  PointCloud& cloud = read.cloud;
  TriangleMesh used = welded(read.mesh);
  if (used.triangles.empty()) {
    read.mesh = {};
    read.notes.emplace_back("no face of the file has three corners apart, so its points are used");
    return;
  }
  const std::size_t corners = used.positions.size();
  if (corners < cloud.size()) {
    read.notes.push_back(fmt::format("{} of the file's {} points are repeated or belong to no face",
                                     cloud.size() - corners, cloud.size()));
  }
  const TriangleMesh fine = refined(used, kPointSpacing_mm);
  if (!is_refined(fine, kPointSpacing_mm)) {
    read.notes.push_back(
        fmt::format("the faces are so large that some points on them lie further "
                    "apart than {} mm",
                    kPointSpacing_mm));
  }
  if (cloud.has_normals() || cloud.has_sigma()) {
    // What the file says of its points outweighs the faces; only new points are added to it.
    PointCloud on_faces = corners_with_normals(fine);
    std::vector<std::size_t> added(on_faces.size() - corners);
    for (std::size_t i = 0; i < added.size(); ++i) added[i] = corners + i;
    PointCloud extra = on_faces.subset(added);
    if (cloud.has_sigma()) {
      extra.sigma_mm.assign(extra.size(), median(cloud.sigma_mm));
    }
    if (extra.empty() || cloud.has_normals() != extra.has_normals()) return;
    drop_errors_along_normals(read,
                              "points between them were added on its faces; leave the faces out");
    cloud.append(extra);
    return;
  }
  cloud = corners_with_normals(fine);
  if (!cloud.has_normals()) {
    read.notes.emplace_back("the faces are wound against each other, so they give no normals");
  }
}

}  // namespace

tl::unexpected<Error> damaged_file(const std::string& file, const std::string& what) {
  return fail(ErrorCode::kCorruptData, fmt::format("{} is damaged ({})", file, what),
              "export or copy it again");
}

Result<CloudFile> read_cloud_file(const std::filesystem::path& path, LengthUnit unit) {
  const auto bytes = read_file_bytes(path, kMostFileBytes);
  if (!bytes) return tl::make_unexpected(bytes.error());
  return read_cloud_bytes(*bytes, path, unit);
}

Result<CloudFile> read_cloud_bytes(std::string_view bytes, const std::filesystem::path& name,
                                   LengthUnit unit) {
  const std::string file = name.string();
  if (bytes.empty()) {
    return fail(ErrorCode::kCorruptData, file + " is empty", "export or copy it again");
  }
  auto raw = read_by_content(bytes, name);
  if (!raw) return tl::make_unexpected(raw.error());
  if (raw->cloud.empty()) {
    return fail(ErrorCode::kInsufficientData, file + " has no points", "scan or export it again");
  }
  const std::size_t points_in_file = raw->cloud.size();
  if (auto good = leave_out_unseen(*raw, file); !good) return tl::make_unexpected(good.error());
  const double extent = extent_of(raw->cloud.positions);
  const double size = size_of_body(raw->cloud.positions, extent, unit);
  const auto settled = settle_unit(unit, size, file);
  if (!settled) return tl::make_unexpected(with_what_was_noticed(settled.error(), raw->notes));

  CloudFile read;
  read.cloud = std::move(raw->cloud);
  read.format = raw->format;
  read.unit = *settled;
  const double scale = millimetres_in(*settled);
  if (scale != 1.0) {
    for (auto& position : read.cloud.positions) position *= scale;
  }
  if (unit == LengthUnit::kAuto) {
    read.notes.push_back(fmt::format("the unit was taken to be {} by the body's size of {:.0f} mm",
                                     to_string(*settled), size * scale));
  }
  std::move(raw->notes.begin(), raw->notes.end(), std::back_inserter(read.notes));
  if (raw->surplus_bytes > 0) {
    read.notes.push_back(fmt::format(
        "the file goes on for {} bytes after all that its header names, which were not read; if "
        "any are missing of its {} points, export it again",
        raw->surplus_bytes, points_in_file));
  }
  if (const auto doubt = doubt_of_size(*settled, extent, size)) read.notes.push_back(*doubt);
  drop_colours(*raw, read);
  settle_normals(read);
  if (!read.cloud.has_normals())
    drop_errors_along_normals(read, "they lie along normals, which it lacks; give these too");
  if (!raw->triangles.empty()) {
    read.mesh = {read.cloud.positions, std::move(raw->triangles)};
    cover_faces(read);
  }
  if (auto good = check_cloud(read.cloud); !good) {
    return fail(good.error().code, file + ": " + good.error().message, good.error().advice);
  }
  return read;
}

}  // namespace instep
