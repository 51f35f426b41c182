#include <ctime>

#include "tests/bench/peers/peer.h"
#include "tests/bench/shared/girth_methods.h"

namespace instep::bench {
namespace {

PeerGirths girths_by(const GirthMethod& method, const PeerSubject& subject) {
  PointCloud bare = subject.cloud;
  bare.normals.clear();
  PeerGirths girths;
  const std::clock_t begin = std::clock();
  for (const auto& plane : subject.planes) {
    const auto girth = method(bare, plane);
    girths.stretched_mm.push_back(girth ? std::optional(girth->stretched_mm) : std::nullopt);
  }
  girths.milliseconds = 1e3 * static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC /
                        static_cast<double>(subject.planes.size());
  return girths;
}

std::optional<PeerGirths> girths_of_faces(const PeerSubject& subject) {
  if (subject.body_faces.empty()) return std::nullopt;
  return girths_by(
      [&](const PointCloud&, const TapePlane& plane) {
        return girth_by_section(subject.body_faces, plane);
      },
      subject);
}

}  // namespace

std::vector<std::optional<double>> sliced(const TriangleMesh& mesh,
                                          const std::vector<TapePlane>& planes) {
  std::vector<std::optional<double>> girths;
  for (const auto& plane : planes) {
    const auto girth = girth_by_section(mesh, plane);
    girths.push_back(girth ? std::optional(girth->stretched_mm) : std::nullopt);
  }
  return girths;
}

std::vector<Peer> own_methods() {
  std::vector<Peer> peers;
  for (const auto& method : girth_methods()) {
    peers.push_back({"instep " + method.name, [method](const PeerSubject& subject) {
                       return std::optional(girths_by(method.girth, subject));
                     }});
  }
  peers.push_back({"instep section, body's faces", girths_of_faces});
  return peers;
}

}  // namespace instep::bench
