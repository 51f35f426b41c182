// The methods of this project beside others that lead from points to a girth, over the same clouds.
#include <fmt/core.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "tests/bench/peers/peer.h"
#include "tests/bench/peers/subjects.h"

namespace instep::bench {
namespace {

struct Sort {
  std::size_t points;
  double sigma_mm;
};

constexpr Sort kSorts[] = {{17040, 0.0}, {17040, 0.5}, {4260, 0.0},
                           {4260, 0.5},  {1080, 0.0},  {1080, 0.5}};

std::vector<Peer> all_peers() {
  auto peers = own_methods();
  for (auto& peer : cgal_peers()) peers.push_back(std::move(peer));
  peers.push_back(scipy_peer());
  return peers;
}

/// One cell of the table.
struct Cell {
  double sum = 0.0;
  double worst = 0.0;
  double milliseconds = 0.0;
  int girths = 0;
  int refused = 0;

  void add(const PeerSubject& subject, const PeerGirths& found) {
    for (std::size_t i = 0; i < found.stretched_mm.size(); ++i) {
      if (!found.stretched_mm[i]) {
        ++refused;
        continue;
      }
      const double size = std::abs(*found.stretched_mm[i] - subject.stretched_mm[i]);
      sum += size;
      worst = std::max(worst, size);
      ++girths;
    }
    milliseconds = std::max(milliseconds, found.milliseconds);
  }

  std::string text() const {
    if (girths == 0) return refused > 0 ? "refused" : "-";
    return fmt::format("{:.2f}/{:.2f}{}", sum / girths, worst, refused > 0 ? "*" : "");
  }
};

Cell measured(const Peer& peer, const std::vector<PeerSubject>& subjects) {
  Cell cell;
  for (const auto& subject : subjects) {
    const auto girths = peer.girths(subject);
    if (girths) cell.add(subject, *girths);
  }
  return cell;
}

void table(const std::string& title, PeerBodies bodies, const std::string& wanted) {
  std::vector<std::vector<PeerSubject>> subjects;
  for (const auto& sort : kSorts) {
    subjects.push_back(peer_subjects(bodies, sort.points, sort.sigma_mm));
  }
  if (subjects.front().empty()) return;
  fmt::print("\n{:<37}", title);
  for (const auto& sort : kSorts) {
    fmt::print("{:>15}", fmt::format("{}, {:g} mm", sort.points, sort.sigma_mm));
  }
  fmt::print("{:>11}\n", "ms, 17040");
  for (const auto& peer : all_peers()) {
    if (peer.name.find(wanted) == std::string::npos) continue;
    fmt::print("{:<37}", peer.name);
    double milliseconds = 0.0;
    for (const auto& cloud : subjects) {
      const Cell cell = measured(peer, cloud);
      if (&cloud == &subjects.front()) milliseconds = cell.milliseconds;
      fmt::print("{:>15}", cell.text());
      std::fflush(stdout);
    }
    fmt::print("{:>11.0f}\n", milliseconds);
  }
}

}  // namespace
}  // namespace instep::bench

int main(int count, char** words) {
  CLI::App app(
      "Errors and times of this project's methods beside those of CGAL and SciPy.\n"
      "Wants Debian's libcgal-dev to be built and python3-scipy for SciPy's row:\n"
      "  apt-get install libcgal-dev python3-scipy\n"
      "  cmake --preset release && cmake --build --preset release --target bench_peers");
  std::string wanted;
  app.add_option("--only", wanted, "Only those with this in their names, such as CGAL");
  CLI11_PARSE(app, count, words);
  using namespace instep::bench;
  fmt::print(
      "mean / worst error of the stretched girth, mm; * some were refused; the time is that\n"
      "of one girth from the points on, processor, the slowest cloud's; noise is along the\n"
      "normals\n");
  table("simulated feet, even points", PeerBodies::kSimulatedFeet, wanted);
  table("scanned feet, even points", PeerBodies::kScannedFeet, wanted);
  table("lasts, their own vertices at random", PeerBodies::kLasts, wanted);
  return 0;
}
