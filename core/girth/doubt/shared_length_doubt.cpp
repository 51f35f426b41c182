#include "core/girth/doubt/shared_length_doubt.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "core/geometry/polygon.h"
#include "core/geometry/seen_skin.h"
#include "core/normal_spread.h"

namespace instep {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

/// Skin that hardly meets the plane crosswise moves along it by its error over so much at most.
constexpr double kLeastCrosswise = 0.3;

/// Corners of a line closer together than this part of the reach of local errors, on skin that
/// faces alike, move as one.
constexpr double kMovesAsOne = 0.25;
constexpr double kFacesAlike = 0.9;
/// Their pairs are counted: as many of them at most, about, however short the reach.
constexpr double kMostStretches = 2000.0;

/// Shorter waves (mm) are smoothed away, as sigma_mm of fused clouds tells of them too: of
/// simulated feet whose depths are bent by 0.36 mm girths are 0.2 mm too long where the errors
/// reach 7 mm, and not at all where they are those of single pixels (tests/bench/poses).
constexpr double kShortestWaves = 6.0;

/// Where a line may be longer by what the skin errs.
struct Corner {
  std::size_t skin = 0;       ///< the point of the cloud whose errors it has
  double a_millimetre = 0.0;  ///< by which the line grows for each that the skin moves outwards
  double way = 0.0;           ///< of the line from the corner before
};

/// What was seen of a cloud's skin, with what is known of its errors.
class ErringSkin {
 public:
  ErringSkin(const TapePlane& plane, const PointCloud& cloud)
      : plane_(plane), cloud_(cloud), seen_(cloud) {}

  /// Half-width of the 95 % interval of the length of a closed line.
  double u95_of(const std::vector<Vector2d>& line) const {
    const auto corners = corners_of(line);
    const double deviations =
        kDeviations * std::sqrt(shared_variance(corners) + local_variance(corners));
    return deviations + waves_along(corners);  // which make it longer, never shorter
  }

 private:
  /// Neighbouring corners together.
  struct Stretch {
    Vector3d place = Vector3d::Zero();
    Vector3d normal = Vector3d::Zero();
    double growth = 0.0;  ///< one sigma
  };

  std::vector<Corner> corners_of(const std::vector<Vector2d>& line) const {
    std::vector<Corner> corners;
    const std::size_t count = line.size();
    for (std::size_t i = 0; i < count; ++i) {
      const Vector2d& corner = line[i];
      const Vector2d way = corner - line[(i + count - 1) % count];
      const Vector2d turn = way.normalized() - (line[(i + 1) % count] - corner).normalized();
      const auto skin = seen_.nearest(plane_.lift(corner));
      if (!skin) continue;
      corners.push_back(
          {skin->index, turn.dot(motion_on_plane(cloud_.normals[skin->index])), way.norm()});
    }
    return corners;
  }

  /// How the section moves where the skin moves by 1 along its normal.
  Vector2d motion_on_plane(const Vector3d& normal) const {
    const Vector2d in_plane(plane_.u().dot(normal), plane_.v().dot(normal));
    return in_plane / std::max(kLeastCrosswise * kLeastCrosswise, in_plane.squaredNorm());
  }

  double shared_variance(const std::vector<Corner>& corners) const {
    double variance = 0.0;
    for (const auto& error : cloud_.shared_errors_mm) {
      double growth = 0.0;
      for (const auto& corner : corners) growth += error[corner.skin] * corner.a_millimetre;
      variance += growth * growth;
    }
    return variance;
  }

  std::vector<Stretch> stretches_of(const std::vector<Corner>& corners) const {
    double all = 0.0;
    for (const auto& corner : corners) all += corner.way;
    const double shortest = all / kMostStretches;
    const double longest = std::max(shortest, kMovesAsOne * cloud_.local_errors.reach_mm);
    const auto goes_on = [&](const Stretch& stretch, const Vector3d& place,
                             const Vector3d& normal) {
      const double far = (stretch.place - place).norm();
      return far <= shortest || (far <= longest && stretch.normal.dot(normal) >= kFacesAlike);
    };
    std::vector<Stretch> stretches;
    for (const auto& [skin, a_millimetre, way] : corners) {
      const Vector3d& place = cloud_.positions[skin];
      const Vector3d& normal = cloud_.normals[skin];
      if (stretches.empty() || !goes_on(stretches.back(), place, normal)) {
        stretches.push_back({place, normal, 0.0});
      }
      stretches.back().growth += cloud_.local_errors.sigma_mm[skin] * a_millimetre;
    }
    return stretches;
  }

  double local_variance(const std::vector<Corner>& corners) const {
    if (cloud_.local_errors.empty()) return 0.0;
    const double reach = cloud_.local_errors.reach_mm;
    const auto stretches = stretches_of(corners);
    double variance = 0.0;
    for (std::size_t i = 0; i < stretches.size(); ++i) {
      const Stretch& one = stretches[i];
      variance += one.growth * one.growth;
      for (std::size_t j = 0; j < i; ++j) {
        const Stretch& other = stretches[j];
        // Of a thin part the two sides err apart.
        const double facing = 0.5 * (1.0 + one.normal.dot(other.normal));
        const double square = (one.place - other.place).squaredNorm() / (reach * reach);
        variance += 2.0 * one.growth * other.growth * facing * std::exp(-square);
      }
    }
    return std::max(0.0, variance);
  }

  /// By how much the waves of local errors make a line that follows them longer: half their mean
  /// square slope, of which a bell has twice the variance over the square of its reach.
  double waves_along(const std::vector<Corner>& corners) const {
    if (cloud_.local_errors.empty()) return 0.0;
    const double reach = std::max(kShortestWaves, cloud_.local_errors.reach_mm);
    double longer = 0.0;
    for (const auto& corner : corners) {
      longer += corner.way * std::pow(cloud_.local_errors.sigma_mm[corner.skin] / reach, 2);
    }
    return longer;
  }

  const TapePlane& plane_;
  const PointCloud& cloud_;
  SeenSkin seen_;
};

}  // namespace

SharedLengthDoubt shared_doubt_of(const std::vector<Vector2d>& line, const TapePlane& plane,
                                  const PointCloud& cloud) {
  if (cloud.shared_errors_mm.empty() && cloud.local_errors.empty()) return {};
  const ErringSkin skin(plane, cloud);
  return {skin.u95_of(line), skin.u95_of(convex_hull(line))};
}

}  // namespace instep
