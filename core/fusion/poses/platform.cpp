#include "core/fusion/poses/platform.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <random>
#include <utility>

#include "core/degree.h"
#include "core/median.h"
#include "core/normal_spread.h"
#include "core/stride.h"

namespace instep {
namespace {

constexpr double kLeastShare = 0.02;  // of all points that must lie on it
constexpr std::size_t kLeastPoints = 300;
constexpr double kLeastExtentMm = 25.0;  // standard deviation of its points, both ways
constexpr std::size_t kLargestSample = 40000;
constexpr std::size_t kScoredSample = 2500;
constexpr int kTriples = 600;
constexpr double kShortestSideMm = 40.0;
constexpr double kReachMm = 4.0;  // of a plane, while candidates are compared
constexpr int kRefinements = 12;

struct Candidate {
  Eigen::Vector3d centre;
  Eigen::Vector3d normal;
};

std::vector<Eigen::Vector3d> even_sample(const std::vector<Eigen::Vector3d>& points,
                                         std::size_t most) {
  return one_in(stride_to_at_most(most, points.size()), points);
}

std::vector<Eigen::Vector3d> within_search(const std::vector<Eigen::Vector3d>& points,
                                           const PlatformSettings& settings) {
  if (!settings.expected_height_mm) return points;
  std::vector<Eigen::Vector3d> layer;
  for (const auto& point : points) {
    if (std::abs(point.z() - *settings.expected_height_mm) <= settings.search_mm) {
      layer.push_back(point);
    }
  }
  return layer;
}

std::optional<Candidate> through(const Eigen::Vector3d& a, const Eigen::Vector3d& b,
                                 const Eigen::Vector3d& c, double least_cosine) {
  const double shortest = std::min({(b - a).norm(), (c - b).norm(), (a - c).norm()});
  if (shortest < kShortestSideMm) return std::nullopt;
  Eigen::Vector3d normal = (b - a).cross(c - a);
  if (normal.norm() < 0.25 * shortest * shortest) return std::nullopt;
  normal.normalize();
  if (normal.z() < 0.0) normal = -normal;
  if (normal.z() < least_cosine) return std::nullopt;
  return Candidate{(a + b + c) / 3.0, normal};
}

double score(const Candidate& plane, const std::vector<Eigen::Vector3d>& points) {
  double sum = 0.0;
  for (const auto& point : points) {
    const double ratio = plane.normal.dot(point - plane.centre) / kReachMm;
    sum += std::max(0.0, 1.0 - ratio * ratio);
  }
  return sum;
}

std::optional<Candidate> best_candidate(const std::vector<Eigen::Vector3d>& points,
                                        double least_cosine) {
  const auto scored = even_sample(points, kScoredSample);
  std::mt19937_64 random(1);
  const auto any = [&]() -> const Eigen::Vector3d& { return points[random() % points.size()]; };
  std::optional<Candidate> best;
  double best_score = 0.0;
  for (int i = 0; i < kTriples; ++i) {
    const auto& a = any();
    const auto& b = any();
    const auto& c = any();
    const auto candidate = through(a, b, c, least_cosine);
    if (!candidate) continue;
    const double candidate_score = score(*candidate, scored);
    if (candidate_score > best_score) {
      best_score = candidate_score;
      best = candidate;
    }
  }
  return best;
}

/// Mean and covariance of the points within `reach` of a plane.
struct Layer {
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
  std::size_t count = 0;
};

Layer layer_of(const Candidate& plane, const std::vector<Eigen::Vector3d>& points, double reach) {
  Layer layer;
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  Eigen::Matrix3d squares = Eigen::Matrix3d::Zero();
  for (const auto& point : points) {
    const Eigen::Vector3d offset = point - plane.centre;
    if (std::abs(plane.normal.dot(offset)) > reach) continue;
    sum += offset;
    squares += offset * offset.transpose();
    ++layer.count;
  }
  if (layer.count == 0) return layer;
  const auto count = static_cast<double>(layer.count);
  layer.mean = plane.centre + sum / count;
  layer.covariance = squares / count - (sum / count) * (sum / count).transpose();
  return layer;
}

/// Half the points of a layer that belong to the plane lie within this of it.
double median_distance(const Candidate& plane, const std::vector<Eigen::Vector3d>& points,
                       double reach) {
  std::vector<double> distances;
  for (const auto& point : points) {
    const double distance = std::abs(plane.normal.dot(point - plane.centre));
    if (distance <= reach) distances.push_back(distance);
  }
  return median(std::move(distances));
}

/// More points within its reach than in the layers of the same thickness on both sides together, of
/// all points: where a search ends within a wall, there are none beyond.
bool stands_out(const Candidate& plane, const std::vector<Eigen::Vector3d>& points, double reach) {
  const auto inside = layer_of(plane, points, reach).count;
  const auto twice = layer_of(plane, points, 2.0 * reach).count;
  return inside > 2 * (twice - inside);
}

}  // namespace

RigidTransform FoundPlatform::level_from_station() const {
  const auto turn = Eigen::Quaterniond::FromTwoVectors(normal, Eigen::Vector3d::UnitZ());
  RigidTransform level = RigidTransform::Identity();
  level.linear() = turn.toRotationMatrix();
  level.translation() = centre - level.linear() * centre;
  return level;
}

std::optional<FoundPlatform> find_platform(const std::vector<Eigen::Vector3d>& points,
                                           const PlatformSettings& settings) {
  const auto sample = even_sample(points, kLargestSample);
  const auto layer_points = within_search(sample, settings);
  if (layer_points.size() < kLeastPoints) return std::nullopt;
  const double least_cosine = std::cos(settings.most_tilt_deg * kDegree);
  auto plane = best_candidate(layer_points, least_cosine);
  if (!plane) return std::nullopt;

  double reach = kReachMm;
  Layer layer;
  for (int i = 0; i < kRefinements; ++i) {
    layer = layer_of(*plane, layer_points, reach);
    if (layer.count < kLeastPoints) return std::nullopt;
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> axes(layer.covariance);
    plane->normal = axes.eigenvectors().col(0);
    if (plane->normal.z() < 0.0) plane->normal = -plane->normal;
    plane->centre = layer.mean;
    if (!(axes.eigenvalues()(1) > kLeastExtentMm * kLeastExtentMm)) {
      return std::nullopt;
    }
    reach = std::clamp(3.0 * kSigmaInMedians * median_distance(*plane, layer_points, reach), 0.3,
                       kReachMm);
  }
  const bool supported =
      static_cast<double>(layer.count) >= kLeastShare * static_cast<double>(sample.size());
  if (!supported || plane->normal.z() < least_cosine || !stands_out(*plane, sample, reach)) {
    return std::nullopt;
  }
  const double variance = plane->normal.dot(layer.covariance * plane->normal);
  return FoundPlatform{plane->centre, plane->normal, std::sqrt(std::max(0.0, variance)),
                       layer.count};
}

}  // namespace instep
