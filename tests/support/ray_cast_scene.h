#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/fusion/frames/depth_frame.h"

namespace instep {

/// A surface that knows where a ray meets it and how far a point is from it: the truth that tests
/// of the fusion compare with.
class AnalyticSurface {
 public:
  virtual ~AnalyticSurface() = default;
  /// Smallest t > 0 with origin + t * direction on the surface.
  virtual std::optional<double> hit(const Eigen::Vector3d& origin,
                                    const Eigen::Vector3d& direction) const = 0;
  /// Signed distance, positive outside; exact near the surface.
  virtual double distance(const Eigen::Vector3d& point) const = 0;
  /// Unit outward normal at a point near the surface.
  virtual Eigen::Vector3d normal(const Eigen::Vector3d& point) const = 0;
};

using Surfaces = std::vector<std::shared_ptr<const AnalyticSurface>>;

/// The plane through `point`, as far as `radius` round it.
std::shared_ptr<const AnalyticSurface> disc_surface(const Eigen::Vector3d& point,
                                                    const Eigen::Vector3d& normal, double radius);

/// An ellipsoid turned by `degrees` about z; a sphere if all semi-axes are equal.
std::shared_ptr<const AnalyticSurface> ellipsoid_surface(const Eigen::Vector3d& centre,
                                                         const Eigen::Vector3d& semi_axes,
                                                         double degrees = 0.0);

/// An upright cylinder wall from z = bottom to z = top.
std::shared_ptr<const AnalyticSurface> cylinder_surface(const Eigen::Vector2d& centre,
                                                        double radius, double bottom, double top);

/// A block with a flat top and bottom whose outline is a disc, its bottom edge rounded off with
/// `rounding`; stands on z = 0.
std::shared_ptr<const AnalyticSurface> rounded_puck(const Eigen::Vector2d& centre, double radius,
                                                    double height, double rounding);

/// How the rendered camera errs.
struct RenderNoise {
  double axial_per_mm = 0.0;  ///< sigma = this * Z^2
  double flying_share = 0.0;  ///< of silhouette pixels that float between front and back
  double dropout_share = 0.0;
};

/// A camera at `eye` that looks at `target`, its image upright.
CameraGeometry camera_looking_at(const std::string& id, const Eigen::Vector3d& eye,
                                 const Eigen::Vector3d& target, int width = 640, int height = 480,
                                 double focal = 575.8);

/// `count` cameras on a circle of `radius` about the z axis at `height`, looking at `target`.
std::vector<CameraGeometry> ring_of_cameras(int count, double radius, double height,
                                            const Eigen::Vector3d& target);

/// What the camera sees of the surfaces, in units of `unit_mm`.
DepthFrame render(const CameraGeometry& camera, const Surfaces& surfaces, const RenderNoise& noise,
                  std::uint64_t seed, double unit_mm = 1.0);

}  // namespace instep
