#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <string>
#include <utility>
#include <vector>

#include "core/foot/foot_scan.h"
#include "daemon/page/silhouette.h"

namespace instep {

/// A foot as it is seen from above or from its medial side, to be drawn on a page.
///
/// Both views have the medial side at the bottom of the one from above, where the one from the side
/// looks from: toes to the right for a left foot, to the left for a right one.
class FootView {
 public:
  enum class From { kAbove, kMedial };

  /// Takes the points up to `highest_mm` above the floor; from above, a leg that goes on there is
  /// closed by its cut.
  FootView(const FootScan& foot, From from, double highest_mm);

  /// Where the left upper corner of bounds() comes to lie on the page, in which size.
  void place(const Eigen::Vector2d& corner, double units_per_mm);

  /// What is seen, in millimetres: x to the right of the page, y down.
  const Eigen::AlignedBox2d& bounds() const { return bounds_; }
  bool is_empty() const { return nearest_.empty(); }

  /// A point of the foot frame on the page, and the direction towards who looks.
  Eigen::Vector2d operator()(const Eigen::Vector3d& point) const;
  const Eigen::Vector3d& towards_viewer() const { return towards_; }

  /// Of the toes: +1 to the right of the page, -1 to the left.
  double heading() const { return right_.x(); }

  /// Whether the body stands before a point.
  bool hides(const Eigen::Vector3d& point) const;

  /// The body as SVG: its outline, and a relief of dots that are the larger the darker the skin
  /// would be with light from the upper left.
  std::string relief() const { return outline() + shading(); }

 private:
  /// How near the body is in a cell to who looks; minus infinity where it is not, or off the grid.
  double nearness(const GridCell& cell) const;
  double& nearness(const GridCell& cell);
  std::vector<GridCell> body() const;  ///< the cells in which it is, row by row
  GridCell cell_of(const Eigen::Vector3d& point) const;
  Eigen::Vector2d seen(const Eigen::Vector3d& point) const;
  void keep_nearest(const std::vector<Eigen::Vector3d>& points);
  Eigen::Vector2d centre(const GridCell& cell) const;
  double darkness(const GridCell& cell) const;
  void cap_the_cut(const FootScan& foot, double highest_mm);
  std::string outline() const;
  std::string shading() const;

  Eigen::Vector3d right_;
  Eigen::Vector3d down_;
  Eigen::Vector3d towards_;
  Eigen::AlignedBox2d bounds_;
  double cell_mm_ = 0.0;
  int rows_ = 0;
  int columns_ = 0;
  std::vector<double> nearest_;  ///< row by row
  Eigen::Vector2d corner_ = Eigen::Vector2d::Zero();
  double units_per_mm_ = 1.0;
};

}  // namespace instep
