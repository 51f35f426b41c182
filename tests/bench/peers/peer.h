#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "core/geometry/point_cloud.h"
#include "core/geometry/triangle_mesh.h"
#include "core/girth/tape_plane.h"

namespace instep::bench {

/// A cloud on a body with known girths, and everything that a method may want to know of it.
struct PeerSubject {
  PointCloud cloud;         ///< with its true normals
  TriangleMesh body_faces;  ///< the body's own faces; none where it has none
  std::vector<TapePlane> planes;
  std::vector<double> stretched_mm;
};

/// The stretched girth of each plane, nothing where there is none, and the time of one girth from
/// the points on.
struct PeerGirths {
  std::vector<std::optional<double>> stretched_mm;
  double milliseconds = 0.0;
};

/// A way to a girth that is not this project's, or is, to be compared. Nothing if it cannot run
/// here.
struct Peer {
  std::string name;
  std::function<std::optional<PeerGirths>(const PeerSubject& subject)> girths;
};

/// The stretched girths of a mesh where planes cut it.
std::vector<std::optional<double>> sliced(const TriangleMesh& mesh,
                                          const std::vector<TapePlane>& planes);

/// The methods of this project. They are told no normals; the last cuts the body's own faces.
std::vector<Peer> own_methods();

/// Of CGAL: advancing front reconstruction of the whole cloud and of a slab round the plane, and
/// Poisson reconstruction with its default settings and the true normals; each mesh is sliced.
std::vector<Peer> cgal_peers();

/// SciPy's RBFInterpolator (r^3, exact, 80 nearest) of off-surface points along the true normals,
/// its contour on the plane; by peers/scipy_rbf.py.
Peer scipy_peer();

}  // namespace instep::bench
