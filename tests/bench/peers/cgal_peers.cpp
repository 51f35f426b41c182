#include <CGAL/Advancing_front_surface_reconstruction.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/compute_average_spacing.h>
#include <CGAL/poisson_surface_reconstruction.h>
#include <CGAL/property_map.h>

#include <cmath>
#include <ctime>
#include <iterator>
#include <utility>

#include "core/geometry/point_index.h"
#include "core/geometry/point_spacing.h"
#include "tests/bench/peers/peer.h"

namespace instep::bench {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Point = Kernel::Point_3;
using Vector = Kernel::Vector_3;
using OrientedPoint = std::pair<Point, Vector>;
using PolygonMesh = CGAL::Surface_mesh<Point>;

double milliseconds_since(std::clock_t begin) {
  return 1e3 * static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC;
}

TriangleMesh advancing_front(const std::vector<Eigen::Vector3d>& places) {
  std::vector<Point> points;
  for (const auto& place : places) points.emplace_back(place.x(), place.y(), place.z());
  std::vector<std::array<std::size_t, 3>> facets;
  CGAL::advancing_front_surface_reconstruction(points.begin(), points.end(),
                                               std::back_inserter(facets));
  TriangleMesh mesh;
  mesh.positions = places;
  for (const auto& facet : facets) {
    mesh.triangles.push_back({static_cast<std::uint32_t>(facet[0]),
                              static_cast<std::uint32_t>(facet[1]),
                              static_cast<std::uint32_t>(facet[2])});
  }
  return mesh;
}

std::optional<PeerGirths> by_advancing_front(const PeerSubject& subject) {
  const std::clock_t begin = std::clock();
  const auto mesh = advancing_front(subject.cloud.positions);
  PeerGirths girths;
  girths.milliseconds = milliseconds_since(begin);
  girths.stretched_mm = sliced(mesh, subject.planes);
  return girths;
}

std::optional<PeerGirths> by_advancing_front_on_slab(const PeerSubject& subject) {
  constexpr double kHalfWidthInSpacings = 6.0;
  const auto& positions = subject.cloud.positions;
  const double half_width = kHalfWidthInSpacings * median_nearest_distance(PointIndex(positions));
  PeerGirths girths;
  const std::clock_t begin = std::clock();
  for (const auto& plane : subject.planes) {
    std::vector<Eigen::Vector3d> slab;
    for (const auto& position : positions) {
      if (std::abs(plane.distance(position)) < half_width) slab.push_back(position);
    }
    girths.stretched_mm.push_back(sliced(advancing_front(slab), {plane}).front());
  }
  girths.milliseconds = milliseconds_since(begin) / static_cast<double>(subject.planes.size());
  return girths;
}

TriangleMesh mesh_of(const PolygonMesh& faces) {
  TriangleMesh mesh;
  for (const auto vertex : faces.vertices()) {
    const Point& place = faces.point(vertex);
    mesh.positions.emplace_back(place.x(), place.y(), place.z());
  }
  for (const auto face : faces.faces()) {
    std::array<std::uint32_t, 3> corners{};
    std::size_t corner = 0;
    for (const auto vertex : faces.vertices_around_face(faces.halfedge(face))) {
      corners.at(corner++) = static_cast<std::uint32_t>(vertex);
    }
    mesh.triangles.push_back(corners);
  }
  return mesh;
}

std::optional<PeerGirths> by_poisson(const PeerSubject& subject) {
  constexpr unsigned int kNeighbours = 6;  // as in CGAL's own example
  constexpr double kLeastAngle = 20.0;
  constexpr double kLargestFacet = 30.0;
  constexpr double kLargestDistance = 0.05;  // in spacings; CGAL's own 0.375 cuts too much off
  std::vector<OrientedPoint> points;
  for (std::size_t i = 0; i < subject.cloud.size(); ++i) {
    const auto& place = subject.cloud.positions[i];
    const auto& normal = subject.cloud.normals[i];
    points.emplace_back(Point(place.x(), place.y(), place.z()),
                        Vector(normal.x(), normal.y(), normal.z()));
  }
  const CGAL::First_of_pair_property_map<OrientedPoint> places;
  const CGAL::Second_of_pair_property_map<OrientedPoint> normals;
  const std::clock_t begin = std::clock();
  const double spacing = CGAL::compute_average_spacing<CGAL::Sequential_tag>(
      points, kNeighbours, CGAL::parameters::point_map(places));
  PolygonMesh faces;
  PeerGirths girths;
  if (CGAL::poisson_surface_reconstruction_delaunay(points.begin(), points.end(), places, normals,
                                                    faces, spacing, kLeastAngle, kLargestFacet,
                                                    kLargestDistance)) {
    girths.stretched_mm = sliced(mesh_of(faces), subject.planes);
  } else {
    girths.stretched_mm.assign(subject.planes.size(), std::nullopt);
  }
  girths.milliseconds = milliseconds_since(begin);
  return girths;
}

}  // namespace

std::vector<Peer> cgal_peers() {
  return {{"CGAL advancing front", by_advancing_front},
          {"CGAL advancing front, slab", by_advancing_front_on_slab},
          {"CGAL Poisson, true normals", by_poisson}};
}

}  // namespace instep::bench
