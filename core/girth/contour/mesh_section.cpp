#include "core/girth/contour/mesh_section.h"

#include <algorithm>
#include <array>
#include <map>
#include <optional>
#include <utility>

#include "core/geometry/distinct_points.h"
#include "core/picked.h"

namespace instep {
namespace {

using Edge = std::pair<std::size_t, std::size_t>;

/// The pieces of the cut: crossings of edges, and the faces that link them in pairs.
struct CutFaces {
  std::vector<Eigen::Vector2d> crossings;
  std::vector<std::array<std::size_t, 2>> links;
};

std::vector<std::size_t> crossed_faces(const TriangleMesh& mesh,
                                       const std::vector<double>& heights) {
  std::vector<std::size_t> crossed;
  for (std::size_t face = 0; face < mesh.triangles.size(); ++face) {
    const auto& corners = mesh.triangles[face];
    const auto above = std::count_if(corners.begin(), corners.end(),
                                     [&](std::uint32_t corner) { return heights[corner] >= 0.0; });
    if (above == 1 || above == 2) crossed.push_back(face);
  }
  return crossed;
}

/// One number for all corners at the same place.
std::map<std::size_t, std::size_t> merge_corners(const TriangleMesh& mesh,
                                                 const std::vector<std::size_t>& faces) {
  std::vector<std::size_t> corners;
  for (const std::size_t face : faces) {
    corners.insert(corners.end(), mesh.triangles[face].begin(), mesh.triangles[face].end());
  }
  const auto firsts = first_at_same_place(picked(mesh.positions, corners));
  std::map<std::size_t, std::size_t> merged;
  for (std::size_t i = 0; i < corners.size(); ++i) merged[corners[i]] = corners[firsts[i]];
  return merged;
}

CutFaces cut_faces(const TriangleMesh& mesh, const TapePlane& plane) {
  std::vector<double> heights;
  heights.reserve(mesh.positions.size());
  for (const auto& position : mesh.positions) heights.push_back(plane.distance(position));
  const auto faces = crossed_faces(mesh, heights);
  const auto merged = merge_corners(mesh, faces);

  CutFaces result;
  std::map<Edge, std::size_t> numbers;
  const auto crossing = [&](std::size_t a, std::size_t b) {
    const auto [entry, is_new] = numbers.try_emplace(std::minmax(a, b), result.crossings.size());
    if (is_new) {
      const auto [low, high] = entry->first;
      const double part = heights[low] / (heights[low] - heights[high]);
      result.crossings.push_back(
          plane.project(mesh.positions[low] + part * (mesh.positions[high] - mesh.positions[low])));
    }
    return entry->second;
  };
  for (const std::size_t face : faces) {
    std::vector<std::size_t> ends;
    for (std::size_t k = 0; k < 3; ++k) {
      const std::size_t a = merged.at(mesh.triangles[face][k]);
      const std::size_t b = merged.at(mesh.triangles[face][(k + 1) % 3]);
      if ((heights[a] >= 0.0) != (heights[b] >= 0.0)) ends.push_back(crossing(a, b));
    }
    if (ends.size() == 2 && ends[0] != ends[1]) result.links.push_back({ends[0], ends[1]});
  }
  return result;
}

/// Follows links until none is left, open lines from their ends first.
class Chainer {
 public:
  explicit Chainer(const CutFaces& faces) : faces_(faces), used_(faces.links.size(), false) {
    at_.resize(faces.crossings.size());
    for (std::size_t link = 0; link < faces.links.size(); ++link) {
      for (const std::size_t end : faces.links[link]) at_[end].push_back(link);
    }
  }

  std::vector<SectionLine> chain() {
    std::vector<SectionLine> lines;
    for (const bool only_ends : {true, false}) {
      for (std::size_t start = 0; start < at_.size(); ++start) {
        if (only_ends && at_[start].size() % 2 == 0) continue;
        while (next_link(start)) lines.push_back(follow(start));
      }
    }
    return lines;
  }

 private:
  std::optional<std::size_t> next_link(std::size_t crossing) const {
    for (const std::size_t link : at_[crossing]) {
      if (!used_[link]) return link;
    }
    return std::nullopt;
  }

  SectionLine follow(std::size_t start) {
    SectionLine line;
    line.points.push_back(faces_.crossings[start]);
    std::size_t here = start;
    while (const auto link = next_link(here)) {
      used_[*link] = true;
      const auto& ends = faces_.links[*link];
      here = ends[0] == here ? ends[1] : ends[0];
      if (here == start) {
        line.closed = true;
        break;
      }
      line.points.push_back(faces_.crossings[here]);
    }
    return line;
  }

  const CutFaces& faces_;
  std::vector<bool> used_;
  std::vector<std::vector<std::size_t>> at_;
};

}  // namespace

std::vector<SectionLine> cut(const TriangleMesh& mesh, const TapePlane& plane, const Seams& seams) {
  const CutFaces faces = cut_faces(mesh, plane);
  auto lines = stitched(Chainer(faces).chain(), seams);
  std::stable_sort(lines.begin(), lines.end(),
                   [](const auto& a, const auto& b) { return a.length() > b.length(); });
  return lines;
}

}  // namespace instep
