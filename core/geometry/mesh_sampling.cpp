#include "core/geometry/mesh_sampling.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <unordered_map>

#include "core/geometry/disjoint_sets.h"
#include "core/geometry/distinct_points.h"

namespace instep {
namespace {

using Eigen::Vector3d;
using Triangle = std::array<std::uint32_t, 3>;

constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();
/// Of a mesh whose faces are halved.
constexpr std::size_t kMostCorners = 2000000;

/// An edge without direction as one number.
std::uint64_t edge_key(std::uint32_t a, std::uint32_t b) {
  return (std::uint64_t{std::min(a, b)} << 32) | std::max(a, b);
}

/// Which side of a triangle is longest (0: from corner 0 to 1, and so on) and how long; the first
/// of equal ones. Neighbours need not choose alike: in whatever order, each of them halves every
/// edge that is too long, and in its middle.
std::pair<std::size_t, double> longest_side(const std::vector<Vector3d>& positions,
                                            const Triangle& triangle) {
  std::size_t longest = 0;
  double length = -1.0;
  for (std::size_t side = 0; side < 3; ++side) {
    const double here = (positions[triangle[side]] - positions[triangle[(side + 1) % 3]]).norm();
    if (here > length) {
      longest = side;
      length = here;
    }
  }
  return {longest, length};
}

/// Twice the area, along the face's normal.
Vector3d face_vector(const TriangleMesh& mesh, const Triangle& triangle) {
  const Vector3d& corner = mesh.positions[triangle[0]];
  return (mesh.positions[triangle[1]] - corner).cross(mesh.positions[triangle[2]] - corner);
}

/// Joins the triangles that share an edge; false if two of them run along it the same way.
bool join_along_edges(const TriangleMesh& mesh, DisjointSets& pieces) {
  struct Side {
    std::uint64_t edge;
    std::size_t triangle;
    bool upwards;
  };
  std::vector<Side> sides;
  sides.reserve(mesh.triangles.size() * 3);
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    for (std::size_t i = 0; i < 3; ++i) {
      const auto a = mesh.triangles[t][i];
      const auto b = mesh.triangles[t][(i + 1) % 3];
      if (a != b) sides.push_back({edge_key(a, b), t, a < b});
    }
  }
  std::sort(sides.begin(), sides.end(), [](const Side& a, const Side& b) {
    return a.edge != b.edge ? a.edge < b.edge : a.triangle < b.triangle;
  });
  for (std::size_t i = 1; i < sides.size(); ++i) {
    if (sides[i].edge != sides[i - 1].edge) continue;
    if (sides[i].upwards == sides[i - 1].upwards) return false;
    pieces.join(sides[i - 1].triangle, sides[i].triangle);
  }
  return true;
}

Vector3d centre_of_area(const TriangleMesh& mesh) {
  Vector3d sum = Vector3d::Zero();
  double area = 0.0;
  for (const auto& triangle : mesh.triangles) {
    const double weight = face_vector(mesh, triangle).norm();
    sum += weight * (mesh.positions[triangle[0]] + mesh.positions[triangle[1]] +
                     mesh.positions[triangle[2]]);
    area += weight;
  }
  return area > 0.0 ? Vector3d(sum / (3.0 * area)) : Vector3d::Zero();
}

/// +1 or -1 for each triangle: whether its own winding points out of the body.
std::vector<double> outward_signs(const TriangleMesh& mesh, DisjointSets& pieces) {
  const Vector3d centre = centre_of_area(mesh);
  std::vector<double> volume(mesh.triangles.size(), 0.0);
  std::vector<double> magnitude(mesh.triangles.size(), 0.0);
  double whole = 0.0;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const auto& triangle = mesh.triangles[t];
    const double part = face_vector(mesh, triangle).dot(mesh.positions[triangle[0]] - centre);
    volume[pieces.of(t)] += part;
    magnitude[pieces.of(t)] += std::abs(part);
    whole += part;
  }
  // Below this share of a piece's faces the sign of its volume is chance.
  constexpr double kTelling = 0.1;
  std::vector<double> signs(mesh.triangles.size());
  for (std::size_t t = 0; t < signs.size(); ++t) {
    const std::size_t piece = pieces.of(t);
    const bool telling = std::abs(volume[piece]) > kTelling * magnitude[piece];
    signs[t] = (telling ? volume[piece] : whole) < 0.0 ? -1.0 : 1.0;
  }
  return signs;
}

}  // namespace

TriangleMesh welded(const TriangleMesh& mesh) {
  const auto first = first_at_same_place(mesh.positions);
  std::vector<std::uint32_t> new_index(mesh.positions.size(), kNone);
  TriangleMesh joined;
  joined.triangles.reserve(mesh.triangles.size());
  for (const auto& triangle : mesh.triangles) {
    const std::array corners = {first[triangle[0]], first[triangle[1]], first[triangle[2]]};
    if (corners[0] == corners[1] || corners[1] == corners[2] || corners[2] == corners[0]) continue;
    Triangle renamed{};
    for (std::size_t i = 0; i < 3; ++i) {
      auto& index = new_index[corners[i]];
      if (index == kNone) {
        index = static_cast<std::uint32_t>(joined.positions.size());
        joined.positions.push_back(mesh.positions[corners[i]]);
      }
      renamed[i] = index;
    }
    joined.triangles.push_back(renamed);
  }
  return joined;
}

TriangleMesh refined(const TriangleMesh& mesh, double longest_edge_mm) {
  TriangleMesh fine;
  fine.positions = mesh.positions;
  std::unordered_map<std::uint64_t, std::uint32_t> middles;
  std::vector<Triangle> waiting(mesh.triangles.rbegin(), mesh.triangles.rend());
  while (!waiting.empty()) {
    const Triangle triangle = waiting.back();
    waiting.pop_back();
    const auto [side, length] = longest_side(fine.positions, triangle);
    const auto a = triangle[side];
    const auto b = triangle[(side + 1) % 3];
    const auto c = triangle[(side + 2) % 3];
    if (!(length > longest_edge_mm) || fine.positions.size() >= kMostCorners) {
      fine.triangles.push_back(triangle);
      continue;
    }
    const auto next = static_cast<std::uint32_t>(fine.positions.size());
    const auto [middle, is_new] = middles.try_emplace(edge_key(a, b), next);
    if (is_new) fine.positions.push_back(0.5 * (fine.positions[a] + fine.positions[b]));
    waiting.push_back({middle->second, b, c});
    waiting.push_back({a, middle->second, c});
  }
  return fine;
}

bool is_refined(const TriangleMesh& mesh, double longest_edge_mm) {
  return std::all_of(mesh.triangles.begin(), mesh.triangles.end(), [&](const Triangle& triangle) {
    return longest_side(mesh.positions, triangle).second <= longest_edge_mm;
  });
}

PointCloud corners_with_normals(const TriangleMesh& mesh) {
  PointCloud cloud;
  cloud.positions = mesh.positions;
  DisjointSets pieces(mesh.triangles.size());
  if (!join_along_edges(mesh, pieces)) return cloud;

  const auto signs = outward_signs(mesh, pieces);
  std::vector<Vector3d> normals(mesh.positions.size(), Vector3d::Zero());
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const Vector3d weighted = signs[t] * face_vector(mesh, mesh.triangles[t]);
    for (const auto corner : mesh.triangles[t]) normals[corner] += weighted;
  }
  for (auto& normal : normals) {
    const double length = normal.norm();
    if (!(length > 0.0)) return cloud;
    normal /= length;
  }
  cloud.normals = std::move(normals);
  return cloud;
}

}  // namespace instep
