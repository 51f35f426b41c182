#include "tests/support/cases/drawn_feet.h"

#include <fmt/core.h>

#include <Eigen/Geometry>
#include <numbers>
#include <vector>

#include "tests/support/cases/foot_skin.h"
#include "tests/support/cases/point_patterns.h"
#include "tests/support/random_numbers.h"
#include "tests/support/shape_files.h"

namespace instep::test {
namespace {

using Eigen::Vector3d;

/// An even distribution over all turns (Shoemake's quaternions).
Eigen::Quaterniond any_turn(RandomNumbers& random) {
  const double u = random.uniform();
  const double a = 2.0 * std::numbers::pi * random.uniform();
  const double b = 2.0 * std::numbers::pi * random.uniform();
  const double near = std::sqrt(1.0 - u);
  const double far = std::sqrt(u);
  return {far * std::cos(b), near * std::sin(a), near * std::cos(a), far * std::sin(b)};
}

RigidTransform drawn_pose(bool any, RandomNumbers& random) {
  RigidTransform pose = RigidTransform::Identity();
  pose.linear() =
      any ? any_turn(random).toRotationMatrix()
          : Eigen::AngleAxisd(random.uniform(-3.14, 3.14), Vector3d::UnitZ()).toRotationMatrix();
  for (int axis = 0; axis < 3; ++axis) pose.translation()(axis) = random.uniform(-500.0, 500.0);
  return pose;
}

struct Hole {
  Vector3d middle;
  double radius;
};

std::vector<Hole> drawn_holes(const PointCloud& cloud, RandomNumbers& random) {
  std::vector<Hole> holes(random.below(4));
  for (auto& hole : holes) {
    hole = {cloud.positions[random.below(cloud.size())], random.uniform(3.0, 10.0)};
  }
  return holes;
}

/// What a scanner sees of it: not the sole where it stands, nothing in the holes.
PointCloud seen_part(const PointCloud& cloud, const std::vector<Hole>& holes, bool with_sole) {
  std::vector<std::size_t> kept;
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    const Vector3d& place = cloud.positions[i];
    bool is_seen = with_sole || cloud.normals[i].z() > -0.5;
    for (const auto& hole : holes) {
      is_seen = is_seen && (place - hole.middle).norm() > hole.radius;
    }
    if (is_seen) kept.push_back(i);
  }
  return cloud.subset(kept);
}

void add_strays(PointCloud& cloud, std::size_t count, RandomNumbers& random) {
  Eigen::AlignedBox3d box;
  for (const auto& point : cloud.positions) box.extend(point);
  for (std::size_t i = 0; i < count; ++i) {
    Vector3d place;
    for (int axis = 0; axis < 3; ++axis) {
      place(axis) = random.uniform(box.min()(axis) - 10.0, box.max()(axis) + 10.0);
    }
    // Nothing is seen under the floor.
    place.z() = std::max(place.z(), 0.5);
    cloud.positions.push_back(place);
    cloud.normals.push_back(Vector3d::UnitZ());
  }
}

}  // namespace

DrawnFoot draw_scanned_foot_without_truth(std::uint64_t seed, SolesSeen soles) {
  RandomNumbers random(seed + 1000);
  const FootSolid solid(draw_foot(seed, random.uniform() < 0.5 ? Side::kLeft : Side::kRight));
  DrawnFoot foot;
  foot.truth.side = solid.parameters().side;
  foot.sole_is_seen = random.uniform() < 0.7 && soles == SolesSeen::kMostly;
  foot.top_mm = random.uniform(80.0, 200.0);
  const double sigma = random.uniform(0.05, 0.5);
  const auto points =
      static_cast<std::size_t>(std::exp(random.uniform(std::log(8e3), std::log(5e4))));
  PointCloud cloud = oriented_points_on(rough_skin(solid, foot.top_mm), points, 0.0, seed);
  settle_on_skin(solid, cloud);
  const auto holes = drawn_holes(cloud, random);
  cloud = with_noise(seen_part(cloud, holes, foot.sole_is_seen), sigma, seed);
  const std::size_t strays = random.uniform() < 0.3 ? 1 + random.below(10) : 0;
  add_strays(cloud, strays, random);
  foot.input_from_solid = drawn_pose(foot.sole_is_seen, random);
  foot.cloud = transformed(foot.input_from_solid, cloud);
  foot.cloud.normals.clear();
  foot.making =
      fmt::format("{} {:.0f} mm, {} points, noise {:.2f}, {} holes, {} strays, top {:.0f}{}",
                  to_string(foot.truth.side), solid.parameters().length_mm, foot.cloud.size(),
                  sigma, holes.size(), strays, foot.top_mm, foot.sole_is_seen ? "" : ", open sole");
  return foot;
}

DrawnFoot draw_scanned_foot(std::uint64_t seed, SolesSeen soles) {
  DrawnFoot foot = draw_scanned_foot_without_truth(seed, soles);
  foot.truth = foot_truth(FootSolid(draw_foot(seed, foot.truth.side))).value();
  return foot;
}

}  // namespace instep::test
