#include "core/surface/paper/marching_cubes.h"

#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <unordered_map>
#include <vector>

#include "core/surface/paper/cube_polygons.h"

namespace instep {
namespace {

constexpr std::uint8_t kCorners = 8;
constexpr std::uint8_t kAllInside = 0xff;

Eigen::Vector3i corner_offset(unsigned corner) {
  return {static_cast<int>(corner & 1U), static_cast<int>((corner >> 1U) & 1U),
          static_cast<int>((corner >> 2U) & 1U)};
}

/// Walks a grid layer by layer and collects triangles.
class March {
 public:
  March(const CubeGrid& grid, const MarchedField& field) : grid_(grid), field_(field) {}

  TriangleMesh run() {
    std::vector<double> lower = read_layer(0);
    for (int z = 0; z < grid_.counts.z(); ++z) {
      std::vector<double> upper = read_layer(z + 1);
      for (int y = 0; y < grid_.counts.y(); ++y) {
        for (int x = 0; x < grid_.counts.x(); ++x) add_cube({x, y, z}, lower, upper);
      }
      lower = std::move(upper);
      if (field_.progress) field_.progress((z + 1.0) / grid_.counts.z());
    }
    return std::move(mesh_);
  }

 private:
  std::size_t place_in_layer(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(grid_.counts.x() + 1) +
           static_cast<std::size_t>(x);
  }

  /// The values at the corners of one height; no number where the field is unknown.
  std::vector<double> read_layer(int z) const {
    std::vector<double> values;
    values.reserve(place_in_layer(0, grid_.counts.y() + 1));
    for (int y = 0; y <= grid_.counts.y(); ++y) {
      for (int x = 0; x <= grid_.counts.x(); ++x) {
        values.push_back(field_.value(grid_.corner({x, y, z}))
                             .value_or(std::numeric_limits<double>::quiet_NaN()));
      }
    }
    return values;
  }

  void add_cube(const Eigen::Vector3i& cube, const std::vector<double>& lower,
                const std::vector<double>& upper) {
    std::array<double, kCorners> values;
    std::uint8_t inside = 0;
    for (unsigned corner = 0; corner < kCorners; ++corner) {
      const Eigen::Vector3i place = cube + corner_offset(corner);
      const auto& layer = place.z() == cube.z() ? lower : upper;
      values[corner] = layer[place_in_layer(place.x(), place.y())];
      if (!std::isfinite(values[corner])) return;
      if (values[corner] >= 0.0) inside = static_cast<std::uint8_t>(inside | (1U << corner));
    }
    if (inside == 0 || inside == kAllInside || !field_.admits(cube)) return;
    for (const auto& polygon : cube_polygons(inside)) {
      const std::uint32_t first = mesh_corner(cube, polygon[0], values);
      std::uint32_t previous = mesh_corner(cube, polygon[1], values);
      for (std::size_t i = 2; i < polygon.size(); ++i) {
        const std::uint32_t next = mesh_corner(cube, polygon[i], values);
        mesh_.triangles.push_back({first, previous, next});
        previous = next;
      }
    }
  }

  /// Where the surface crosses an edge, as a corner of the mesh; the same for all cubes round it.
  std::uint32_t mesh_corner(const Eigen::Vector3i& cube, const CubeEdge& edge,
                            const std::array<double, kCorners>& values) {
    const Eigen::Vector3i from = cube + corner_offset(edge.corner);
    const auto [known, is_new] =
        crossings_.try_emplace(key_of(from, edge.axis), std::uint32_t(mesh_.positions.size()));
    if (is_new) {
      const double at_from = values[edge.corner];
      const double at_to = values[edge.corner | (1U << edge.axis)];
      Eigen::Vector3d place = grid_.corner(from);
      place[edge.axis] += grid_.cube * (at_from / (at_from - at_to));
      mesh_.positions.push_back(place);
    }
    return known->second;
  }

  std::uint64_t key_of(const Eigen::Vector3i& corner, std::uint8_t axis) const {
    const auto columns = place_in_layer(0, grid_.counts.y() + 1);
    return 3 * (static_cast<std::uint64_t>(corner.z()) * columns +
                place_in_layer(corner.x(), corner.y())) +
           axis;
  }

  const CubeGrid& grid_;
  const MarchedField& field_;
  TriangleMesh mesh_;
  std::unordered_map<std::uint64_t, std::uint32_t> crossings_;
};

}  // namespace

Result<CubeGrid> CubeGrid::covering(const Eigen::AlignedBox3d& box, double cube) {
  CubeGrid grid;
  const Eigen::Array3d counts = (box.sizes().array() / cube + 1.0).ceil();
  if (!(cube > 0.0) || !((counts + 1.0).prod() <= static_cast<double>(kMostGridCorners))) {
    return fail(ErrorCode::kInvalidInput, "the cubes are too small for the size of the body",
                "give larger cubes");
  }
  grid.cube = cube;
  grid.counts = counts.matrix().cast<int>();
  grid.origin = box.center() - 0.5 * cube * counts.matrix();
  return grid;
}

TriangleMesh march_cubes(const CubeGrid& grid, const MarchedField& field) {
  return March(grid, field).run();
}

}  // namespace instep
