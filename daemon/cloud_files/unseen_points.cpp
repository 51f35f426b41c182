#include "daemon/cloud_files/unseen_points.h"

#include <fmt/core.h>

#include <algorithm>
#include <cstdint>
#include <limits>

namespace instep {
namespace {

/// A coordinate beyond this is damage in any unit: a million kilometres of millimetres.
constexpr double kLargestInFile = 1e15;

/// Of the points that are numbers, so many may be absurd: of a damaged file many are.
constexpr double kFewAbsurd = 0.01;

constexpr const char* kNoNumber =
    "they have a coordinate that is no number, as of pixels that saw nothing";

constexpr std::uint32_t kLeftOut = std::numeric_limits<std::uint32_t>::max();

struct Sorted {
  std::vector<std::size_t> points;  ///< that stay
  std::size_t no_numbers = 0;
  std::size_t absurd = 0;
  std::size_t first_absurd = 0;

  bool are_all() const { return no_numbers + absurd == 0; }
};

/// The list of those that stay is not made where all do.
Sorted sorted_out(const std::vector<Eigen::Vector3d>& positions) {
  Sorted sorted;
  for (std::size_t i = 0; i < positions.size(); ++i) {
    const bool is_number = positions[i].allFinite();
    const bool is_absurd = is_number && positions[i].cwiseAbs().maxCoeff() > kLargestInFile;
    if (!is_number) ++sorted.no_numbers;
    if (is_absurd && sorted.absurd++ == 0) sorted.first_absurd = i;
  }
  if (sorted.are_all()) return sorted;
  for (std::size_t i = 0; i < positions.size(); ++i) {
    // Of what is no number the comparison is false.
    if (positions[i].allFinite() && positions[i].cwiseAbs().maxCoeff() <= kLargestInFile)
      sorted.points.push_back(i);
  }
  return sorted;
}

/// Gives the corners of faces their new numbers; how many faces went with a point.
std::size_t drop_faces(const Sorted& sorted, std::size_t points, RawCloud& raw) {
  std::vector<std::uint32_t> places(points, kLeftOut);
  for (std::size_t i = 0; i < sorted.points.size(); ++i)
    places[sorted.points[i]] = static_cast<std::uint32_t>(i);
  for (auto& triangle : raw.triangles) {
    for (auto& corner : triangle) corner = places[corner];
  }
  return std::erase_if(raw.triangles, [](const auto& triangle) {
    return std::find(triangle.begin(), triangle.end(), kLeftOut) != triangle.end();
  });
}

std::string note_of(std::size_t left_out, std::size_t points, const char* why, std::size_t faces) {
  const std::string note =
      fmt::format("{} of the file's {} points were left out: {}", left_out, points, why);
  return faces == 0 ? note : note + fmt::format("; faces that went with them: {}", faces);
}

}  // namespace

Result<void> leave_out_unseen(RawCloud& raw, const std::string& file) {
  const std::size_t points = raw.cloud.size();
  const Sorted sorted = sorted_out(raw.cloud.positions);
  if (sorted.are_all()) return {};
  const std::size_t numbers = points - sorted.no_numbers;
  if (static_cast<double>(sorted.absurd) > kFewAbsurd * static_cast<double>(numbers)) {
    return fail(ErrorCode::kInvalidInput,
                fmt::format("{} of the {} points of {}, first point {}, have a coordinate that is "
                            "absurdly large",
                            sorted.absurd, points, file, sorted.first_absurd),
                "repair or export it again");
  }
  if (sorted.points.empty()) {
    return fail(
        ErrorCode::kInsufficientData,
        fmt::format("of the {} points of {} each has a coordinate that is no number", points, file),
        "scan or export it again");
  }
  raw.cloud = raw.cloud.subset(sorted.points);
  const std::size_t faces = drop_faces(sorted, points, raw);
  if (sorted.no_numbers > 0) {
    raw.notes.push_back(note_of(sorted.no_numbers, points, kNoNumber, faces));
  }
  if (sorted.absurd > 0) {
    raw.notes.push_back(note_of(sorted.absurd, points,
                                "they have a coordinate that is absurdly large",
                                sorted.no_numbers > 0 ? 0 : faces));
  }
  return {};
}

}  // namespace instep
