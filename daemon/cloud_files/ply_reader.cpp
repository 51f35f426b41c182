#include "daemon/cloud_files/ply_reader.h"

#include <fmt/core.h>

#include <algorithm>

#include "core/fusion/views/shared_errors.h"
#include "daemon/cloud_files/error_properties.h"
#include "daemon/cloud_files/ply_body.h"
#include "daemon/cloud_files/ply_header.h"

namespace instep {
namespace {

/// Columns that go to the three coordinates of each vector, if the element has all three.
bool want_vectors(const PlyElement& element, const std::array<const char*, 3>& names,
                  std::vector<Eigen::Vector3d>& vectors, std::vector<PlyColumn>& columns) {
  std::array<std::size_t, 3> places{};
  for (std::size_t i = 0; i < 3; ++i) {
    const auto place = element.find(names[i]);
    if (!place || element.properties[*place].count_type) return false;
    places[i] = *place;
  }
  vectors.resize(element.count);
  if (vectors.empty()) return true;
  for (std::size_t i = 0; i < 3; ++i) {
    columns.push_back({places[i], {vectors.front().data() + i, 3}});
  }
  return true;
}

/// A column that goes to `numbers`, if the element has it.
bool want_numbers(const PlyElement& element, const std::string& name, std::vector<double>& numbers,
                  std::vector<PlyColumn>& columns) {
  const auto place = element.find(name);
  if (!place || element.properties[*place].count_type || element.count == 0) return false;
  numbers.resize(element.count);
  columns.push_back({*place, {numbers.data(), 1}});
  return true;
}

bool is_shared_error(const PlyProperty& property) {
  return property.name.starts_with("shared_error_") && property.name.ends_with("_mm");
}

/// The columns of the errors that many points share. None is passed over, for intervals would be
/// too narrow then.
Result<void> want_shared_errors(const PlyElement& element, const std::string& file,
                                std::vector<std::vector<double>>& errors,
                                std::vector<PlyColumn>& columns) {
  const auto& properties = element.properties;
  const auto told = static_cast<std::size_t>(
      std::count_if(properties.begin(), properties.end(), is_shared_error));
  if (told > kMostSharedErrors) {
    return fail(ErrorCode::kUnsupported,
                fmt::format("{} has {} properties of shared errors", file, told),
                fmt::format("leave the smallest of them out, down to {}", kMostSharedErrors));
  }
  errors.resize(element.count > 0 ? told : 0);
  for (std::size_t e = 0; e < errors.size(); ++e) {
    if (!want_numbers(element, shared_error_property(e), errors[e], columns)) {
      return damaged_file(file,
                          "its shared errors are not numbered from 1 on, each of a number a point");
    }
  }
  return {};
}

/// The columns of the errors that neighbours share, and of how far these reach: of no use without
/// each other.
Result<void> want_local_errors(const PlyElement& element, const std::string& file,
                               std::vector<double>& errors, std::vector<double>& reaches,
                               std::vector<PlyColumn>& columns) {
  const bool has_errors = want_numbers(element, kLocalErrorProperty, errors, columns);
  if (want_numbers(element, kLocalErrorReachProperty, reaches, columns) == has_errors) return {};
  return damaged_file(file, fmt::format("of {} and {} one is missing, or no number a point",
                                        kLocalErrorProperty, kLocalErrorReachProperty));
}

Result<void> read_vertices(PlyBody& body, const PlyElement& element, const std::string& file,
                           RawCloud& raw) {
  PointCloud& cloud = raw.cloud;
  std::vector<PlyColumn> columns;
  std::vector<double> origins;
  if (!want_vectors(element, {"x", "y", "z"}, cloud.positions, columns)) {
    return damaged_file(file, "its vertices lack x, y or z");
  }
  want_vectors(element, {"nx", "ny", "nz"}, cloud.normals, columns);
  if (!want_numbers(element, "sigma_mm", cloud.sigma_mm, columns) &&
      element.find(kNoiseWithoutUnit)) {
    raw.notes.emplace_back(kNoteOfNoiseWithoutUnit);
  }
  want_numbers(element, "origin", origins, columns);
  const auto wanted = want_shared_errors(element, file, cloud.shared_errors_mm, columns);
  if (!wanted) return wanted;
  std::vector<double> reaches;
  auto& local = cloud.local_errors;
  if (auto told = want_local_errors(element, file, local.sigma_mm, reaches, columns); !told)
    return told;
  if (auto good = body.read(element, columns, nullptr); !good) return good;
  for (const double origin : origins) {
    cloud.origins.push_back(origin == 1.0 ? PointOrigin::kPlatform : PointOrigin::kSeen);
  }
  // Of files put together from several, the longest: what reaches further leaves more of a girth
  // open.
  for (const double reach : reaches) {
    if (!(reach > 0.0)) return damaged_file(file, "its local errors reach no distance");
    local.reach_mm = std::max(local.reach_mm, reach);
  }
  return {};
}

/// Passes over records that other programs draw faces from.
Result<void> pass_over_faces(PlyBody& body, const PlyElement& element, const std::string& why,
                             RawCloud& raw) {
  if (element.count > 0) {
    raw.notes.push_back(fmt::format("the file's {} records \"{}\" were not read: {}", element.count,
                                    element.name, why));
  }
  return body.read(element, {}, nullptr);
}

/// Polygons, of so many points, as fans of triangles round their first corner.
Result<void> read_faces(PlyBody& body, const PlyElement& element, std::size_t point_count,
                        const std::string& file, RawCloud& raw) {
  const auto place = element.find("vertex_indices") ? element.find("vertex_indices")
                                                    : element.find("vertex_index");
  if (!place || !element.properties[*place].count_type) {
    return pass_over_faces(body, element, "they have no list vertex_indices", raw);
  }
  PlyLists polygons;
  polygons.property = *place;
  if (auto good = body.read(element, {}, &polygons); !good) return good;

  const auto points = static_cast<double>(point_count);
  std::size_t first = 0;
  for (const std::uint32_t length : polygons.lengths) {
    const double* corner = polygons.items.data() + first;
    for (std::uint32_t i = 0; i < length; ++i) {
      if (!(corner[i] >= 0 && corner[i] < points)) {
        return damaged_file(file, fmt::format("a face names point {} of {}", corner[i], points));
      }
    }
    for (std::uint32_t i = 2; i < length; ++i) {
      raw.triangles.push_back({static_cast<std::uint32_t>(corner[0]),
                               static_cast<std::uint32_t>(corner[i - 1]),
                               static_cast<std::uint32_t>(corner[i])});
    }
    first += length;
  }
  return {};
}

/// Of the first element of vertices, which may stand behind the faces; 0 without any.
std::size_t count_points(const PlyHeader& header) {
  for (const auto& element : header.elements) {
    if (element.name == "vertex") return std::min(element.count, kMostFilePoints);
  }
  return 0;
}

const char* format_name(PlyFormat format) {
  switch (format) {
    case PlyFormat::kAscii:
      return "PLY, ASCII";
    case PlyFormat::kLittleEndian:
      return "PLY, binary little endian";
    case PlyFormat::kBigEndian:
      return "PLY, binary big endian";
  }
  return "PLY";
}

}  // namespace

Result<RawCloud> read_ply(std::string_view bytes, const std::string& file) {
  const auto header = read_ply_header(bytes, file);
  if (!header) return tl::make_unexpected(header.error());
  const auto body = open_ply_body(*header, bytes, file);
  RawCloud raw;
  raw.format = format_name(header->format);
  const std::size_t points = count_points(*header);
  bool has_vertices = false;
  for (const auto& element : header->elements) {
    if (!body->can_hold(element)) {
      return damaged_file(file,
                          fmt::format("it is too short for the {} records \"{}\" of its header",
                                      element.count, element.name));
    }
    const bool wanted = element.name == "vertex" || element.name == "face";
    if (wanted && element.count > kMostFilePoints) {
      return fail(ErrorCode::kUnsupported,
                  fmt::format("{} has {} records \"{}\"", file, element.count, element.name),
                  fmt::format("thin it out to at most {}", kMostFilePoints));
    }
    Result<void> good;
    if (element.name == "vertex" && !has_vertices) {
      has_vertices = true;
      good = read_vertices(*body, element, file, raw);
    } else if (element.name == "face" && points > 0) {
      good = read_faces(*body, element, points, file, raw);
    } else if (element.name == "tristrips") {
      good = pass_over_faces(*body, element, "export the mesh as triangles", raw);
    } else {
      good = body->read(element, {}, nullptr);
    }
    if (!good) return tl::make_unexpected(good.error());
  }
  if (!has_vertices) return damaged_file(file, "it has no vertices");
  raw.surplus_bytes = body->unread_bytes();
  return raw;
}

}  // namespace instep
