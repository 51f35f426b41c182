#include "core/girth/band/plane_heights.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <span>

namespace instep {
namespace {

/// So many points at a time cost hardly more than one.
constexpr std::size_t kAtOnce = 4;
using Some = Eigen::Array<double, kAtOnce, 1>;

/// More than a height loses by being kept to fewer digits, against itself.
constexpr double kRounding = 1e-6;

/// From the least to the most of some measures.
class Reach {
 public:
  void add(const Some& measures) {
    least_ = measures.min(least_);
    most_ = measures.max(most_);
  }
  double length() const { return most_.maxCoeff() - least_.minCoeff(); }

 private:
  Some least_ = Some::Constant(std::numeric_limits<double>::infinity());
  Some most_ = Some::Constant(-std::numeric_limits<double>::infinity());
};

/// From a place to some points that follow each other.
struct Arms {
  Some x;
  Some y;
  Some z;

  Arms(const Eigen::Vector3d* to, const Eigen::Vector3d& from)
      : x(to[0].x(), to[1].x(), to[2].x(), to[3].x()),
        y(to[0].y(), to[1].y(), to[2].y(), to[3].y()),
        z(to[0].z(), to[1].z(), to[2].z(), to[3].z()) {
    x -= from.x();
    y -= from.y();
    z -= from.z();
  }

  Some along(const Eigen::Vector3d& direction) const {
    return direction.x() * x + direction.y() * y + direction.z() * z;
  }
};

/// The last of the points, which fill no group, and the very last again until they do.
std::array<Eigen::Vector3d, kAtOnce> filled_up(std::span<const Eigen::Vector3d> rest) {
  std::array<Eigen::Vector3d, kAtOnce> group;
  group.fill(rest.back());
  std::copy(rest.begin(), rest.end(), group.begin());
  return group;
}

}  // namespace

PlaneHeights::PlaneHeights(const PointCloud& cloud, const TapePlane& plane) {
  const std::span<const Eigen::Vector3d> points(cloud.positions);
  if (points.empty()) return;
  const std::size_t groups = (points.size() + kAtOnce - 1) / kAtOnce;
  heights_.resize(static_cast<Eigen::Index>(kAtOnce * groups));
  Reach along;
  Reach across;
  Reach above;
  const Eigen::Vector3d origin = plane.origin();
  const Eigen::Vector3d u = plane.u();
  const Eigen::Vector3d v = plane.v();
  const Eigen::Vector3d normal = plane.normal();
  const auto look_at = [&](const Eigen::Vector3d* group, std::size_t first) {
    const Arms arms(group, origin);
    along.add(arms.along(u));
    across.add(arms.along(v));
    const Some heights = arms.along(normal);
    above.add(heights);
    heights_.segment<kAtOnce>(static_cast<Eigen::Index>(first)) = heights.cast<float>();
  };
  const std::size_t whole = points.size() / kAtOnce * kAtOnce;
  for (std::size_t i = 0; i < whole; i += kAtOnce) look_at(&points[i], i);
  if (whole < points.size()) look_at(filled_up(points.subspan(whole)).data(), whole);
  heights_.conservativeResize(static_cast<Eigen::Index>(points.size()));
  size_ = std::hypot(along.length(), across.length(), above.length());
}

std::vector<std::size_t> PlaneHeights::about(double half_width) const {
  const auto widest = std::nextafter(static_cast<float>((1.0 + kRounding) * half_width),
                                     std::numeric_limits<float>::infinity());
  // Whether one is taken is as good as chance: all are put down, and what is not taken is
  // overwritten by the next.
  constexpr std::size_t kAtATime = 512;
  std::array<std::size_t, kAtATime> taken;
  std::vector<std::size_t> found;
  const auto count = static_cast<std::size_t>(heights_.size());
  for (std::size_t begin = 0; begin < count; begin += kAtATime) {
    const std::size_t end = std::min(begin + kAtATime, count);
    std::size_t some = 0;
    for (std::size_t i = begin; i < end; ++i) {
      taken[some] = i;
      some += std::abs(heights_[static_cast<Eigen::Index>(i)]) <= widest ? 1U : 0U;
    }
    found.insert(found.end(), taken.begin(), taken.begin() + static_cast<std::ptrdiff_t>(some));
  }
  return found;
}

}  // namespace instep
