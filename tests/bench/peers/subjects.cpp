#include "tests/bench/peers/subjects.h"

#include <filesystem>
#include <map>

#include "tests/support/cases/point_patterns.h"
#include "tests/support/cases/simulated_feet.h"
#include "tests/support/places.h"

namespace instep::bench {
namespace {

constexpr std::size_t kCrowd = 10;

std::vector<PeerSubject> simulated_feet(std::size_t points) {
  constexpr std::size_t kFeet = 3;
  constexpr std::size_t kPlanes = 3;
  std::vector<PeerSubject> subjects;
  for (const auto& foot : test::simulated_feet(kFeet)) {
    test::RandomNumbers random(subjects.size() + 1);
    PeerSubject subject;
    subject.cloud = test::chosen(foot.crowd(kCrowd * points, 1), points, test::Pattern::kEven, 1);
    foot.settle(subject.cloud);
    while (subject.planes.size() < kPlanes) {
      const TapePlane plane = foot.plane(random);
      const auto lengths = foot.lengths(plane);
      if (!lengths) continue;
      subject.planes.push_back(plane);
      subject.stretched_mm.push_back(lengths->stretched_mm);
    }
    subjects.push_back(std::move(subject));
  }
  return subjects;
}

/// By the files of a folder of the trial data.
std::vector<PeerSubject> trial_bodies(const std::string& folder, double unit_mm,
                                      const std::string& ending, std::size_t points) {
  std::vector<PeerSubject> subjects;
  if (!std::filesystem::exists(test::trial_data())) return subjects;
  std::map<std::string, PeerSubject> by_file;
  for (const auto& section : test::known_sections(folder)) {
    if (!section.file.ends_with(ending)) continue;
    auto& subject = by_file[section.file];
    subject.planes.push_back(section.plane);
    subject.stretched_mm.push_back(section.stretched_mm);
  }
  for (auto& [file, subject] : by_file) {
    auto shape = test::read_shape(test::trial_data() / folder / file, unit_mm);
    subject.cloud =
        shape.cloud.has_normals()
            ? test::chosen(shape.cloud, points, test::Pattern::kRandom, 1)
            : test::chosen(test::oriented_points_on(shape.mesh, kCrowd * points, 0.0, 1), points,
                           test::Pattern::kEven, 1);
    subject.body_faces = std::move(shape.mesh);
    subjects.push_back(std::move(subject));
  }
  return subjects;
}

std::vector<PeerSubject> exact_subjects(PeerBodies bodies, std::size_t points) {
  switch (bodies) {
    case PeerBodies::kScannedFeet:
      return trial_bodies("feet", 1000.0, ".stl", points);
    case PeerBodies::kLasts:
      return trial_bodies("lasts", 1.0, ".ply", points);
    case PeerBodies::kSimulatedFeet:
      break;
  }
  return simulated_feet(points);
}

}  // namespace

std::vector<PeerSubject> peer_subjects(PeerBodies bodies, std::size_t points, double sigma_mm) {
  auto subjects = exact_subjects(bodies, points);
  for (auto& subject : subjects) {
    if (sigma_mm > 0.0) subject.cloud = test::with_noise(std::move(subject.cloud), sigma_mm, 7);
  }
  return subjects;
}

}  // namespace instep::bench
