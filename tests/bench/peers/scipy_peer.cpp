#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <memory>
#include <sstream>
#include <string>

#include "tests/bench/peers/peer.h"
#include "tests/support/places.h"
#include "tests/support/temporary_folder.h"

namespace instep::bench {
namespace {

/// Raw numbers, as numpy.fromfile() reads them.
void write(const std::filesystem::path& file, const std::vector<Eigen::Vector3d>& vectors) {
  std::ofstream out(file, std::ios::binary);
  for (const auto& vector : vectors) {
    for (const double number : vector) {
      out.write(reinterpret_cast<const char*>(&number), sizeof(number));
    }
  }
}

std::string output_of(const std::string& command) {
  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> pipe(popen(command.c_str(), "r"), pclose);
  if (!pipe) return {};
  std::string output;
  for (int letter = std::fgetc(pipe.get()); letter != EOF; letter = std::fgetc(pipe.get())) {
    output += static_cast<char>(letter);
  }
  return output;
}

std::optional<PeerGirths> by_scipy(const PeerSubject& subject) {
  const test::TemporaryFolder folder;
  write(folder.path() / "points", subject.cloud.positions);
  write(folder.path() / "normals", subject.cloud.normals);
  std::vector<Eigen::Vector3d> corners;
  for (const auto& plane : subject.planes) {
    for (const auto& point : plane.control_points()) corners.push_back(point);
  }
  write(folder.path() / "planes", corners);
  const auto script = test::source_tree() / "tests" / "bench" / "peers" / "scipy_rbf.py";
  // /usr/bin: the interpreter for which Debian's python3-scipy is.
  std::istringstream lines(
      output_of("/usr/bin/python3 '" + script.string() + "' '" + folder.path().string() + "'"));
  PeerGirths girths;
  if (!(lines >> girths.milliseconds)) return std::nullopt;
  for (std::string word; lines >> word;) {
    girths.stretched_mm.push_back(word == "none" ? std::nullopt : std::optional(std::stod(word)));
  }
  if (girths.stretched_mm.size() != subject.planes.size()) return std::nullopt;
  return girths;
}

}  // namespace

Peer scipy_peer() {
  return {"SciPy r^3, 80 nearest, true normals", by_scipy};
}

}  // namespace instep::bench
