#include "tests/support/shape_files.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <sstream>
#include <stdexcept>

#include "tests/support/random_numbers.h"

#include "tests/support/places.h"

namespace instep::test {
namespace {

static_assert(std::endian::native == std::endian::little);

using nlohmann::json;

template <typename T>
T take(std::istream& in) {
  std::array<char, sizeof(T)> bytes;
  in.read(bytes.data(), sizeof(T));
  if (!in) throw std::runtime_error("a trial file ends too soon");
  return std::bit_cast<T>(bytes);
}

Eigen::Vector3d take_vector(std::istream& in) {
  const double x = take<float>(in);
  const double y = take<float>(in);
  const double z = take<float>(in);
  return {x, y, z};
}

ShapeFile read_ply(std::istream& in, double unit_mm) {
  std::size_t vertices = 0;
  std::size_t faces = 0;
  bool normals = false;
  for (std::string line; std::getline(in, line) && line != "end_header";) {
    std::istringstream words(line);
    std::string first, second;
    words >> first >> second;
    if (first == "element" && second == "vertex") words >> vertices;
    if (first == "element" && second == "face") words >> faces;
    normals = normals || line == "property float nx";
  }
  ShapeFile shape;
  for (std::size_t i = 0; i < vertices; ++i) {
    shape.cloud.positions.push_back(unit_mm * take_vector(in));
    if (normals) shape.cloud.normals.push_back(take_vector(in).normalized());
  }
  for (std::size_t i = 0; i < faces; ++i) {
    if (take<std::uint8_t>(in) != 3) throw std::runtime_error("a trial mesh has no triangles");
    std::array<std::uint32_t, 3> corners;
    for (auto& corner : corners) corner = take<std::uint32_t>(in);
    shape.mesh.triangles.push_back(corners);
  }
  shape.mesh.positions = shape.cloud.positions;
  return shape;
}

ShapeFile read_stl(std::istream& in, double unit_mm) {
  in.seekg(80);
  const auto faces = take<std::uint32_t>(in);
  ShapeFile shape;
  for (std::uint32_t i = 0; i < faces; ++i) {
    take_vector(in);
    for (int k = 0; k < 3; ++k) shape.mesh.positions.push_back(unit_mm * take_vector(in));
    shape.mesh.triangles.push_back({3 * i, 3 * i + 1, 3 * i + 2});
    take<std::uint16_t>(in);
  }
  shape.cloud.positions = shape.mesh.positions;
  return shape;
}

Eigen::Vector3d as_point(const json& list) {
  return {list.at(0).get<double>(), list.at(1).get<double>(), list.at(2).get<double>()};
}

KnownSection as_section(const std::string& file, const json& entry) {
  const auto& points = entry.at("plane");
  const auto plane =
      TapePlane::through(as_point(points.at(0)), as_point(points.at(1)), as_point(points.at(2)));
  if (!plane) throw std::runtime_error(plane.error().line());
  return {file,
          entry.at("name"),
          *plane,
          entry.value("sigma_mm", 0.0),
          entry.at("stretched_mm"),
          entry.at("contact_mm")};
}

}  // namespace

ShapeFile read_shape(const std::filesystem::path& path, double unit_mm) {
  std::ifstream in(path, std::ios::binary);
  if (!in) throw std::runtime_error("cannot open " + path.string());
  return path.extension() == ".stl" ? read_stl(in, unit_mm) : read_ply(in, unit_mm);
}

std::vector<KnownSection> known_sections(const std::string& folder) {
  std::ifstream in(trial_data() / folder / "truth.json");
  const json truth = json::parse(in);
  std::vector<KnownSection> sections;
  if (truth.contains("cases")) {
    for (const auto& entry : truth.at("cases")) {
      sections.push_back(as_section(entry.at("name").get<std::string>() + ".ply", entry));
    }
    return sections;
  }
  for (const auto& [file, entries] : truth.items()) {
    for (const auto& entry : entries) {
      sections.push_back(as_section(file.substr(0, file.find(' ')), entry));
    }
  }
  return sections;
}

PointCloud oriented_points_on(const TriangleMesh& mesh, std::size_t count, double sigma_mm,
                              std::uint64_t seed) {
  const auto corner = [&](const auto& face, std::size_t k) { return mesh.positions[face[k]]; };
  std::vector<double> areas;
  double total = 0.0;
  for (const auto& face : mesh.triangles) {
    const Eigen::Vector3d a = corner(face, 0);
    total += 0.5 * (corner(face, 1) - a).cross(corner(face, 2) - a).norm();
    areas.push_back(total);
  }
  RandomNumbers random(seed);
  PointCloud cloud;
  for (std::size_t i = 0; i < count; ++i) {
    const auto place = std::upper_bound(areas.begin(), areas.end(), random.uniform() * total);
    const auto& face = mesh.triangles[static_cast<std::size_t>(place - areas.begin())];
    const Eigen::Vector3d a = corner(face, 0);
    const Eigen::Vector3d ab = corner(face, 1) - a;
    const Eigen::Vector3d ac = corner(face, 2) - a;
    const double root = std::sqrt(random.uniform());
    const double part = random.uniform();
    const Eigen::Vector3d normal = ab.cross(ac).normalized();
    cloud.positions.push_back(a + root * ((1.0 - part) * ab + part * ac) +
                              sigma_mm * random.normal() * normal);
    cloud.normals.push_back(normal);
  }
  return cloud;
}

PointCloud points_on(const TriangleMesh& mesh, std::size_t count, double sigma_mm,
                     std::uint64_t seed) {
  PointCloud cloud = oriented_points_on(mesh, count, sigma_mm, seed);
  cloud.normals.clear();
  return cloud;
}

}  // namespace instep::test
