// The paper's Tables 1 to 4 as this project measures them, beside the paper's own numbers.
//
// What could not be known: the distance between the rings of its cylinders and where on them its
// tape plane lay, its last and that tape plane, its foot, and its computer. So the rows below are
// of several distances, of other lasts and of another foot; nothing is set so as to meet its
// numbers.
#include <fmt/core.h>

#include <Eigen/LU>
#include <algorithm>
#include <chrono>
#include <cmath>
#include <filesystem>
#include <functional>
#include <numbers>
#include <numeric>
#include <string>
#include <vector>

#include "core/girth/girth.h"
#include "core/surface/paper/triharmonic_rbf.h"
#include "daemon/cloud_files/cloud_file.h"
#include "daemon/cloud_files/cloud_ply_writer.h"
#include "drivers/files/file_bytes.h"
#include "tests/support/analytic_shapes.h"
#include "tests/support/places.h"
#include "tests/support/random_numbers.h"
#include "tests/support/shape_files.h"
#include "tests/support/temporary_folder.h"

namespace instep {
namespace {

using Clock = std::chrono::steady_clock;

/// A method, and the paper's numbers for the one that it stands for; none for our own.
struct Method {
  std::string name;
  std::function<Result<Girth>(const PointCloud&, const TapePlane&)> girth;
  std::vector<double> table_2;  ///< deviation of models 1, 2 and 3
  std::vector<double> table_3;  ///< girth of models 1, 2 and 3
};

/// All columns of all tables: a further method is a further entry here.
std::vector<Method> methods() {
  return {
      {"Method 1, hull",
       [](const auto& cloud, const auto& plane) { return girth_by_hull(cloud, plane); },
       {0.028709, 0.114822, 0.459100},
       {248.640348, 243.796843, 239.850287}},
      {"Method 2, mesh",
       [](const auto& cloud, const auto& plane) { return girth_by_mesh(cloud, plane); },
       {0.018406, 0.074521, 0.228097},
       {248.749485, 247.414452, 244.912462}},
      {"Method 3, rbf-paper",
       [](const auto& cloud, const auto& plane) { return girth_by_paper(cloud, plane); },
       {0.014857, 0.028504, 0.033265},
       {248.904068, 248.476340, 247.630655}},
      {"ours, rbf",
       [](const auto& cloud, const auto& plane) { return girth_by_rbf(cloud, plane); },
       {},
       {}},
  };
}

/// The stretched girth, or no number where the method refuses.
double stretched(const Method& method, const PointCloud& cloud, const TapePlane& plane) {
  const auto girth = method.girth(cloud, plane);
  return girth ? girth->stretched_mm : std::nan("");
}

std::string row(const std::vector<double>& values, int digits) {
  std::string text;
  for (const double value : values) {
    text += std::isnan(value) ? fmt::format("{:>13}", "refused")
                              : fmt::format("{:13.{}f}", value, digits);
  }
  return text;
}

/// The matrix of eq. 7 with the right side of eq. 8 as its last column.
Eigen::MatrixXd augmented_matrix(const std::vector<Eigen::Vector3d>& points,
                                 test::RandomNumbers& random) {
  const auto count = static_cast<Eigen::Index>(points.size());
  Eigen::MatrixXd matrix = Eigen::MatrixXd::Zero(count + 4, count + 5);
  for (Eigen::Index i = 0; i < count; ++i) {
    const Eigen::Vector3d& point = points[static_cast<std::size_t>(i)];
    for (Eigen::Index j = 0; j < count; ++j) {
      matrix(i, j) = std::pow((point - points[static_cast<std::size_t>(j)]).norm(), 3);
    }
    matrix.row(i).segment(count, 4) << 1.0, point.transpose();
    matrix.col(i).segment(count, 4) << 1.0, point;
    matrix(i, count + 4) = random.normal();
  }
  return matrix;
}

void table_1() {
  fmt::print("Table 1. Rank of the system of eq. 7 (paper: 2 2, 4 4, 6 6, 8 8, n+4 n+4)\n");
  fmt::print("{:>12}{:>8}{:>8}{:>8}{:>12}{:>10}\n", "points", "r(A)", "r(A,b)", "full", "r(A) here",
             "eq. 9");
  const auto print = [](const std::string& name, const std::vector<Eigen::Vector3d>& points,
                        test::RandomNumbers& random) {
    const Eigen::MatrixXd augmented = augmented_matrix(points, random);
    Eigen::FullPivLU<Eigen::MatrixXd> left(augmented.leftCols(augmented.cols() - 1));
    Eigen::FullPivLU<Eigen::MatrixXd> both(augmented);
    left.setThreshold(1e-12);
    both.setThreshold(1e-12);
    fmt::print("{:>12}{:>8}{:>8}{:>8}{:>12}{:>10}\n", name, left.rank(), both.rank(),
               points.size() + 4, rank_of_system(points), has_unique_solution(points));
  };
  test::RandomNumbers random(1);
  for (const std::size_t count : {1U, 2U, 3U, 4U, 5U, 10U, 50U}) {
    std::vector<Eigen::Vector3d> points(count);
    for (auto& point : points) point = {random.normal(), random.normal(), random.normal()};
    print(std::to_string(count), points, random);
    if (count < 10) continue;
    for (auto& point : points) point.z() = 0.0;
    print(std::to_string(count) + " flat", points, random);
  }
  fmt::print("r(A) by LU of the whole matrix; \"here\" and eq. 9 as the octree decides them\n\n");
}

/// Of the three models.
std::vector<double> cylinder_deviations(const Method& method, double pitch, double twist,
                                        double z) {
  const auto plane = TapePlane::through({0, 0, z}, {1, 0, z}, {0, 1, z}).value();
  std::vector<double> deviations;
  for (const auto& [per_ring, count] : {std::pair{120, 10}, {60, 15}, {30, 15}}) {
    deviations.push_back(
        80.0 * std::numbers::pi -
        stretched(method, test::cylinder_rings(per_ring, count, pitch, twist), plane));
  }
  return deviations;
}

void table_2() {
  fmt::print("Table 2. Cylinder of radius 40 mm: accurate girth - measured girth, mm\n");
  fmt::print("{:<21}{:>30}{:>13}{:>13}{:>13}\n", "", "rings, plane", "Model 1", "Model 2",
             "Model 3");
  for (const auto& method : methods()) {
    if (!method.table_2.empty()) {
      fmt::print("{:<21}{:>30}{}\n", method.name, "the paper's", row(method.table_2, 6));
    }
    for (const double twist : {0.0, 0.5}) {
      for (const double pitch : {2.0, 4.0, 6.0}) {
        for (const double z : {0.0, 0.25 * pitch, 0.5 * pitch}) {
          fmt::print(
              "{:<21}{:>30}{}\n", method.name,
              fmt::format("{:.0f} mm{}, z {:.1f} mm", pitch, twist > 0.0 ? " twisted" : "", z),
              row(cylinder_deviations(method, pitch, twist, z), 6));
        }
      }
    }
  }
  fmt::print(
      "z from the middle of the rings, whose distance is not known; twisted: each ring by half a\n"
      "step. Eq. 10 gives each point one intersection, straight under it: on rings that are not\n"
      "twisted, no more corners than a ring has points, so, if they were exact, Method 1's "
      "deviation\n\n");
}

PointCloud some_of(const PointCloud& cloud, std::size_t count, std::uint64_t seed) {
  test::RandomNumbers random(seed);
  std::vector<std::size_t> order(cloud.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  for (std::size_t i = order.size() - 1; i > 0; --i)
    std::swap(order[i], order[random.below(i + 1)]);
  order.resize(std::min(count, order.size()));
  PointCloud part = cloud.subset(order);
  part.normals.clear();  // the paper has none
  return part;
}

/// Sums up how far a method is off, and how far it moves when points are taken away.
struct Tally {
  double off = 0.0;
  double moved = 0.0;
  double worst_move = 0.0;
  int moves = 0;
  int measured = 0;
  int refused = 0;
};

void table_3() {
  fmt::print("Table 3. Girths of lasts, mm, by the number of points\n");
  fmt::print("{:<21}{:<30}{:>10}{:>13}{:>13}{:>13}{:>10}\n", "", "", "truth", "Model 1", "Model 2",
             "Model 3", "3 to 1");
  const std::vector<std::size_t> counts = {14240, 3560, 902};
  std::vector<std::string> summary;
  for (const auto& method : methods()) {
    if (!method.table_3.empty()) {
      fmt::print("{:<21}{:<30}{:>10}{}{:9.2f}%\n", method.name, "the paper's (its last)", "",
                 row(method.table_3, 4), 100.0 * (method.table_3[2] / method.table_3[0] - 1.0));
    }
    Tally tally;
    for (const auto& section : test::known_sections("lasts")) {
      const auto shape = test::read_shape(test::trial_data() / "lasts" / section.file);
      std::vector<double> girths;
      for (const std::size_t count : counts) {
        girths.push_back(stretched(method, some_of(shape.cloud, count, 1), section.plane));
        if (std::isnan(girths.back())) {
          ++tally.refused;
          continue;
        }
        ++tally.measured;
        tally.off += std::abs(girths.back() - section.stretched_mm);
      }
      const double move = 100.0 * (girths[2] / girths[0] - 1.0);
      if (!std::isnan(move)) {
        ++tally.moves;
        tally.moved += std::abs(move);
        tally.worst_move = std::max(tally.worst_move, std::abs(move));
      }
      fmt::print("{:<21}{:<30}{:10.3f}{}{:>10}\n", method.name, section.file + " " + section.name,
                 section.stretched_mm, row(girths, 4),
                 std::isnan(move) ? "-" : fmt::format("{:.2f}%", move));
    }
    summary.push_back(fmt::format(
        "{:<21}mean error {:.3f} mm; from Model 1 to 3 it moves by {:.2f} % in the mean, {:.2f} % "
        "at worst; refused {}\n",
        method.name, tally.off / std::max(tally.measured, 1),
        tally.moved / std::max(tally.moves, 1), tally.worst_move, tally.refused));
  }
  for (const auto& line : summary) fmt::print("{}", line);
  fmt::print(
      "models: {} points, and {} and {} of them at random (the paper: 17040, 4260, 1080)\n\n",
      counts[0], counts[1], counts[2]);
}

void table_4() {
  fmt::print("Table 4. Time from reading the file to the girth, ms; the middle one of five runs\n");
  fmt::print("the paper: short heel, instep, ball: 9090, 7112, 7044 points of the part; ");
  fmt::print("943, 720, 693 ms on its computer\n");
  const test::TemporaryFolder folder;
  const auto file = folder.path() / "foot.ply";
  const auto mesh = test::read_shape(test::trial_data() / "feet" / "retail_left.stl", 1000.0).mesh;
  if (!write_file_bytes(file, *cloud_to_ply(test::points_on(mesh, 200000, 0.0, 1)))) return;
  for (const auto& method : methods()) {
    for (const auto& section : test::known_sections("feet")) {
      if (section.file != "retail_left.stl") continue;
      std::vector<double> times;
      Result<Girth> girth = Girth{};
      for (int run = 0; run < 5; ++run) {
        const auto start = Clock::now();
        const auto cloud = read_cloud_file(file, LengthUnit::kMillimetre);
        if (!cloud) return;
        girth = method.girth(cloud->cloud, section.plane);
        times.push_back(std::chrono::duration<double, std::milli>(Clock::now() - start).count());
      }
      std::sort(times.begin(), times.end());
      fmt::print("{:<21}{:<10}", method.name, section.name);
      if (girth) {
        fmt::print("{:6} points of the part {:9.1f} ms, off by {:+.4f} mm\n", girth->band_points,
                   times[2], girth->stretched_mm - section.stretched_mm);
      } else {
        fmt::print("refused: {}\n", girth.error().line());
      }
    }
  }
  fmt::print(
      "a foot of 200,000 points as binary PLY; it has no short heel girth to compare with\n");
}

}  // namespace
}  // namespace instep

int main() {
  instep::table_1();
  instep::table_2();
  if (!std::filesystem::exists(instep::test::trial_data())) {
    fmt::print("Tables 3 and 4 need the trial data, which is not here\n");
    return 0;
  }
  instep::table_3();
  instep::table_4();
  return 0;
}
