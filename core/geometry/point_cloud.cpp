#include "core/geometry/point_cloud.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>

#include "core/picked.h"

namespace instep {
namespace {

template <typename T>
bool empty_or_sized(const std::vector<T>& list, std::size_t size) {
  return list.empty() || list.size() == size;
}

/// Joins two optional lists; `was_empty` tells that the target held no points at all before.
template <typename T>
void append_list(std::vector<T>& target, const std::vector<T>& source, bool was_empty) {
  if (was_empty) {
    target = source;
  } else if (target.empty() || source.empty()) {
    target.clear();
  } else {
    target.insert(target.end(), source.begin(), source.end());
  }
}

/// Also false for what is no number.
bool is_near_origin(const Eigen::Vector3d& place) {
  return std::abs(place.x()) <= kLargestCoordinateMm &&
         std::abs(place.y()) <= kLargestCoordinateMm && std::abs(place.z()) <= kLargestCoordinateMm;
}

/// The first point that is not. That none is is plain of many at once: no coordinate is larger than
/// the root of the sum of all squares.
std::size_t first_far_from_origin(const std::vector<Eigen::Vector3d>& places) {
  constexpr std::size_t kAtOnce = 256;
  for (std::size_t begin = 0; begin < places.size(); begin += kAtOnce) {
    const std::size_t end = std::min(begin + kAtOnce, places.size());
    const Eigen::Map<const Eigen::VectorXd> coordinates(
        places[begin].data(), static_cast<Eigen::Index>(3 * (end - begin)));
    if (coordinates.squaredNorm() <= kLargestCoordinateMm * kLargestCoordinateMm) continue;
    for (std::size_t i = begin; i < end; ++i) {
      if (!is_near_origin(places[i])) return i;
    }
  }
  return places.size();
}

tl::unexpected<Error> bad_point(std::size_t index, const std::string& what) {
  return fail(ErrorCode::kInvalidInput, "point " + std::to_string(index) + " " + what,
              "repair or export the cloud again");
}

/// The first below `least`, beyond what an error may be, or no number.
std::optional<std::size_t> first_wild_error(const std::vector<double>& errors, double least) {
  const auto wild = std::find_if_not(errors.begin(), errors.end(), [least](double error_mm) {
    return error_mm >= least && error_mm <= kLargestSigmaMm;
  });
  if (wild == errors.end()) return std::nullopt;
  return static_cast<std::size_t>(wild - errors.begin());
}

Result<void> check_errors_along_normals(const PointCloud& cloud) {
  const auto& [sigma, reach] = cloud.local_errors;
  if (!cloud.has_normals() && !(cloud.shared_errors_mm.empty() && sigma.empty())) {
    return fail(ErrorCode::kInvalidInput, "the points share errors along normals that they lack",
                "give the normals too, or leave the errors out");
  }
  for (const auto& error : cloud.shared_errors_mm) {
    if (const auto wild = first_wild_error(error, -kLargestSigmaMm)) {
      return bad_point(*wild, "has a shared error that is no number, or beyond 100 mm");
    }
  }
  if (sigma.empty()) return {};
  if (!(reach >= kLeastReachMm && reach <= kLargestCoordinateMm)) {
    return fail(ErrorCode::kInvalidInput,
                "the local errors of the points reach less than 0.1 mm, or further than 100 m",
                "give their reach in millimetres, or leave the errors out");
  }
  if (const auto wild = first_wild_error(sigma, 0.0)) {
    return bad_point(*wild, "has a local error that is no number, below 0 or beyond 100 mm");
  }
  return {};
}

}  // namespace

bool PointCloud::stands_on_platform() const {
  return std::find(origins.begin(), origins.end(), PointOrigin::kPlatform) != origins.end();
}

bool PointCloud::is_consistent() const {
  const bool are_errors_sized =
      std::all_of(shared_errors_mm.begin(), shared_errors_mm.end(),
                  [this](const auto& error) { return error.size() == size(); });
  return are_errors_sized && empty_or_sized(normals, size()) && empty_or_sized(sigma_mm, size()) &&
         empty_or_sized(view_directions, size()) && empty_or_sized(origins, size()) &&
         empty_or_sized(local_errors.sigma_mm, size());
}

void PointCloud::append(const PointCloud& other) {
  if (other.empty()) return;
  const bool was_empty = empty();
  if (!origins.empty() || !other.origins.empty()) {
    origins.resize(size(), PointOrigin::kSeen);
    for (std::size_t i = 0; i < other.size(); ++i) {
      origins.push_back(other.was_seen(i) ? PointOrigin::kSeen : other.origins[i]);
    }
  }
  for (auto& error : shared_errors_mm) error.resize(size() + other.size(), 0.0);
  for (const auto& error : other.shared_errors_mm) {
    shared_errors_mm.emplace_back(size(), 0.0);
    shared_errors_mm.back().insert(shared_errors_mm.back().end(), error.begin(), error.end());
  }
  if (!local_errors.empty() || !other.local_errors.empty()) {
    auto& sigma = local_errors.sigma_mm;
    sigma.resize(size());
    sigma.insert(sigma.end(), other.local_errors.sigma_mm.begin(),
                 other.local_errors.sigma_mm.end());
    sigma.resize(size() + other.size());
    local_errors.reach_mm = std::max(local_errors.reach_mm, other.local_errors.reach_mm);
  }
  append_list(normals, other.normals, was_empty);
  append_list(sigma_mm, other.sigma_mm, was_empty);
  append_list(view_directions, other.view_directions, was_empty);
  positions.insert(positions.end(), other.positions.begin(), other.positions.end());
  if (normals.empty()) drop_errors_along_normals();
}

void PointCloud::drop_normals() {
  normals.clear();
  drop_errors_along_normals();
}

void PointCloud::drop_errors_along_normals() {
  shared_errors_mm.clear();
  local_errors = {};
}

PointCloud PointCloud::subset(const std::vector<std::size_t>& indices) const {
  PointCloud part;
  part.positions = picked(positions, indices);
  part.normals = picked(normals, indices);
  part.sigma_mm = picked(sigma_mm, indices);
  part.view_directions = picked(view_directions, indices);
  part.origins = picked(origins, indices);
  for (const auto& error : shared_errors_mm) {
    part.shared_errors_mm.push_back(picked(error, indices));
  }
  part.local_errors = {picked(local_errors.sigma_mm, indices), local_errors.reach_mm};
  return part;
}

PointCloud transformed(const RigidTransform& target_from_source, const PointCloud& cloud) {
  PointCloud moved = cloud;
  for (auto& position : moved.positions) position = target_from_source * position;
  for (auto& normal : moved.normals) normal = target_from_source.linear() * normal;
  for (auto& view : moved.view_directions) view = target_from_source.linear() * view;
  return moved;
}

Result<void> check_cloud(const PointCloud& cloud) {
  if (!cloud.is_consistent()) {
    return fail(ErrorCode::kInternal, "the lists of a cloud differ in length", "report this");
  }
  if (const std::size_t i = first_far_from_origin(cloud.positions); i < cloud.size()) {
    return bad_point(i, cloud.positions[i].allFinite() ? "lies more than 100 m from the origin"
                                                       : "has a coordinate that is no number");
  }
  if (auto sound = check_errors_along_normals(cloud); !sound) return sound;
  if (!cloud.has_normals() && cloud.view_directions.empty() && !cloud.has_sigma()) return {};
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    if (cloud.has_normals() && !(std::abs(cloud.normals[i].norm() - 1.0) < 1e-3)) {
      return bad_point(i, "has a normal that is not of unit length");
    }
    if (!cloud.view_directions.empty() && !cloud.view_directions[i].allFinite()) {
      return bad_point(i, "has a view direction that is no number");
    }
    if (cloud.has_sigma() && !(cloud.sigma_mm[i] > 0.0 && cloud.sigma_mm[i] <= kLargestSigmaMm)) {
      return bad_point(i, "has a sigma that is not above 0, or above 100 mm");
    }
  }
  return {};
}

}  // namespace instep
