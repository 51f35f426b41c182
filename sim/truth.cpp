#include "sim/truth.h"

#include <fmt/format.h>

#include <cmath>

#include "sim/outline_probe.h"
#include "sim/section_contour.h"

namespace instep {
namespace {

using Eigen::Vector3d;
using PlanePoints = std::array<Vector3d, 3>;

constexpr double kFineStepMm = 0.1;
constexpr double kSearchStepMm = 0.5;

RigidTransform frame_at(const Vector3d& origin, const Vector3d& along) {
  RigidTransform frame = RigidTransform::Identity();
  frame.linear() =
      Eigen::AngleAxisd(std::atan2(along.y(), along.x()), Vector3d::UnitZ()).toRotationMatrix();
  frame.translation() = Vector3d(origin.x(), origin.y(), 0.0);
  return frame;
}

/// Builds the truth in the order in which its parts rest on each other.
class Measurer {
 public:
  explicit Measurer(const FootSolid& foot) : foot_(foot) {
    truth_.side = foot.parameters().side;
    medial_ = truth_.side == Side::kRight ? 1.0 : -1.0;
  }

  Result<FootTruth> run() {
    find_axis();
    find_length();
    find_ball_points();
    if (auto done = measure_ball(); !done) return tl::make_unexpected(done.error());
    if (auto done = measure_instep(); !done) return tl::make_unexpected(done.error());
    if (auto done = measure_waist(); !done) return tl::make_unexpected(done.error());
    return truth_;
  }

 private:
  OutlineProbe probe() const { return {foot_, solid_from_foot_}; }

  Vector3d& landmark(const std::string& name) { return truth_.landmarks[name]; }

  Vector3d rearmost() const {
    const OutlineProbe felt = probe();
    const double y =
        place_of_maximum([&](double at) { return -felt.end(at, -1.0).x(); }, -30.0, 30.0, 2.0);
    return felt.end(y, -1.0);
  }

  /// The rearmost point depends on the axis and the axis on it; they settle within a few turns.
  void find_axis() {
    const Vector3d toe = foot_.second_toe();
    solid_from_foot_ = frame_at(Vector3d::Zero(), toe);
    for (int turn = 0; turn < 6; ++turn) {
      const Vector3d pternion = solid_from_foot_ * rearmost();
      solid_from_foot_ = frame_at(pternion, toe - pternion);
    }
    truth_.foot_from_solid = solid_from_foot_.inverse();
    landmark("pternion") = rearmost();
    landmark("toe2") = probe().end(0.0, 1.0);
  }

  void find_length() {
    const OutlineProbe felt = probe();
    const double half = 0.25 * landmark("toe2").x();
    const double y =
        place_of_maximum([&](double at) { return felt.end(at, 1.0).x(); }, -half, half, 2.0);
    landmark("acropodion") = felt.end(y, 1.0);
    length_ = landmark("acropodion").x() - landmark("pternion").x();
    truth_.measures["foot_length"] = length_;
  }

  Vector3d most_protruding(double sign, double from, double to) const {
    const OutlineProbe felt = probe();
    const double x = place_of_maximum([&](double at) { return sign * felt.side(at, sign).y(); },
                                      from * length_, to * length_, 1.0);
    return felt.side(x, sign);
  }

  void find_ball_points() {
    const Vector3d mt = landmark("mt") = most_protruding(medial_, 0.60, 0.80);
    const Vector3d mf = landmark("mf") = most_protruding(-medial_, 0.50, 0.75);
    truth_.measures["foot_breadth"] = (mt - mf).head<2>().norm();
    truth_.measures["foot_breadth_horizontal"] = std::abs(mt.y() - mf.y());
  }

  /// The section of a plane given in the foot frame, round the mean of its points.
  Result<SectionContour> section(const TapePlane& plane, const Vector3d& inside,
                                 double step_mm) const {
    return trace_section(foot_, plane.transformed(solid_from_foot_), solid_from_foot_ * inside,
                         step_mm);
  }

  Result<SectionContour> store(const std::string& id, const PlanePoints& points,
                               const Vector3d& inside) {
    const auto plane = TapePlane::through(points[0], points[1], points[2]);
    if (!plane) return tl::make_unexpected(plane.error());
    auto contour = section(*plane, inside, kFineStepMm);
    if (!contour) {
      return fail(ErrorCode::kInternal,
                  fmt::format("the foot has no {}: {}", id, contour.error().message),
                  "report the seed");
    }
    truth_.planes[id] = points;
    truth_.measures[id] = contour->stretched_mm;
    truth_.contact_mm[id] = contour->contact_mm;
    return contour;
  }

  Result<void> measure_ball() {
    const Vector3d mt = landmark("mt"), mf = landmark("mf");
    const PlanePoints points{mt, mf, mt + Vector3d(0.0, 0.0, 40.0)};
    const auto contour = store("ball_girth", points, 0.5 * (mt + mf));
    if (!contour) return tl::make_unexpected(contour.error());
    const TapePlane plane = TapePlane::through(points[0], points[1], points[2]).value();
    Vector3d& top = landmark("ball_top") = mt;
    for (const Eigen::Vector2d& corner : contour->polygon) {
      const Vector3d in_foot = plane.lift(corner);
      if (in_foot.z() > top.z()) top = in_foot;
    }
    return {};
  }

  /// The girth of the plane (instep, P2, P3) with P3 at the station x; infinite if there is none.
  double girth_over(double x) {
    const Vector3d instep = landmark("instep"), lateral = landmark("lateral_midfoot");
    const Vector3d medial = probe().side(x, medial_);
    const auto plane = TapePlane::through(instep, lateral, medial);
    if (!plane) return INFINITY;
    const auto contour = section(*plane, (instep + lateral + medial) / 3.0, kSearchStepMm);
    return contour ? contour->stretched_mm : INFINITY;
  }

  Result<void> measure_instep() {
    const OutlineProbe felt = probe();
    const double middle = 0.5 * length_;
    const double inside = 0.05 * length_;
    const auto height = [&](double y) { return felt.top(middle, y, inside).z(); };
    const double y = place_of_maximum(height, -0.15 * length_, 0.15 * length_, 1.0);
    const Vector3d instep = landmark("instep") = felt.top(middle, y, inside);

    const auto nearness = [&](double x) {
      return -(felt.side(x, -medial_) - instep).head<2>().norm();
    };
    const double lateral = place_of_maximum(nearness, 0.25 * length_, 0.45 * length_, 1.0);
    landmark("lateral_midfoot") = felt.side(lateral, -medial_);

    const double medial = place_of_maximum([&](double x) { return -girth_over(x); }, 0.35 * length_,
                                           0.60 * length_, 2.5);
    landmark("medial_arch") = felt.side(medial, medial_);

    const PlanePoints points{instep, landmark("lateral_midfoot"), landmark("medial_arch")};
    const auto contour = store("instep_girth", points, (points[0] + points[1] + points[2]) / 3.0);
    if (!contour) return tl::make_unexpected(contour.error());
    return {};
  }

  Result<void> measure_waist() {
    const PlanePoints points{0.5 * (landmark("mt") + landmark("medial_arch")),
                             0.5 * (landmark("mf") + landmark("lateral_midfoot")),
                             0.5 * (landmark("ball_top") + landmark("instep"))};
    const auto contour = store("waist_girth", points, (points[0] + points[1] + points[2]) / 3.0);
    if (!contour) return tl::make_unexpected(contour.error());
    return {};
  }

  const FootSolid& foot_;
  double medial_ = 1.0;
  double length_ = 0.0;
  RigidTransform solid_from_foot_ = RigidTransform::Identity();
  FootTruth truth_;
};

}  // namespace

Result<FootTruth> foot_truth(const FootSolid& foot) {
  return Measurer(foot).run();
}

}  // namespace instep
