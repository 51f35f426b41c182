#pragma once

#include <Eigen/Core>
#include <vector>

#include "core/geometry/point_cloud.h"
#include "core/geometry/rigid_transform.h"

namespace instep {

/// An error that all points of a view share, as what is left unknown of its pose and its lens.
/// Unlike the noise of the points it does not average out round a section.
///
/// How it moves the points of a view, one sigma: a point at (x, 1) by field * (x, 1).
using ErrorField = Eigen::Matrix<double, 3, 4>;

/// The errors of one view, in its camera's frame. The first of one view and the first of another
/// one are the same error of all views, and so on; different ones are independent. A view without
/// any is taken to have none.
struct ViewErrors {
  std::vector<ErrorField> fields;
  double share = 1.0;  ///< how much the view counts among the others
  RigidTransform station_from_camera = RigidTransform::Identity();
};

/// The same field, of points and displacements in another frame.
ErrorField in_frame(const RigidTransform& target_from_source, const ErrorField& field);

/// Takes out of the errors what moves the views together, by their shares, as one rigid body about
/// `centre` (station frame): no shape knows of it.
void take_common_motion_out(const Eigen::Vector3d& centre, std::vector<ViewErrors>& views);

/// What these errors do to a thinned cloud: PointCloud::shared_errors_mm of its points, as the few
/// errors that leave less than a hundredth of their variance untold, each point's variance weighing
/// the same. `shares`: how much each view (row) counts in each point (column). Some 5 ms for 30,000
/// points of four views.
std::vector<std::vector<double>> shared_errors_of(const PointCloud& cloud,
                                                  const Eigen::MatrixXd& shares,
                                                  const std::vector<ViewErrors>& views);

}  // namespace instep
