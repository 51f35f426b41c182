#include "sim/truth.h"

#include <fmt/format.h>

#include <cmath>

#include "core/girth/tape_plane.h"
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

Vector3d on_floor(const Vector3d& point) {
  return {point.x(), point.y(), 0.0};
}

Vector3d mean(const PlanePoints& points) {
  return (points[0] + points[1] + points[2]) / 3.0;
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
    find_midfoot_points();
    for (const auto& [id, points] : {std::pair("ball_girth", ball_points()),
                                     {"instep_girth", instep_points(landmark("medial_arch"))},
                                     {"waist_girth", waist_points()}}) {
      if (auto stored = store(id, points); !stored) return tl::make_unexpected(stored.error());
    }
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
    return most_protruding(sign, from, to, [](double) { return 0.0; });
  }

  /// With a handicap, by place, that makes a likely place win over one hardly further out.
  template <typename Handicap>
  Vector3d most_protruding(double sign, double from, double to, const Handicap& handicap) const {
    const OutlineProbe felt = probe();
    const auto reach = [&](double at) { return sign * felt.side(at, sign).y() - handicap(at); };
    return felt.side(place_of_maximum(reach, from, to, 1.5), sign);
  }

  /// A millimetre of handicap at a twenty-fifth of FL off the usual place, growing as its square.
  auto off_usual(double usual) const {
    return [usual, spread = 0.04 * length_](double at) {
      return std::pow((at - usual) / spread, 2);
    };
  }

  void find_ball_points() {
    const Vector3d mt = landmark("mt") =
        most_protruding(medial_, 0.60 * length_, 0.80 * length_, off_usual(0.69 * length_));
    const double foremost = std::min(0.75 * length_, mt.x() - 15.0);
    const Vector3d mf = landmark("mf") =
        most_protruding(-medial_, 0.50 * length_, foremost,
                        off_usual(std::min(0.63 * length_, foremost)));
    truth_.measures["foot_breadth"] = (mt - mf).head<2>().norm();
    const double from = 0.50 * length_, to = 0.85 * length_;
    truth_.measures["foot_breadth_horizontal"] =
        std::abs(most_protruding(medial_, from, to).y() - most_protruding(-medial_, from, to).y());
  }

  /// The section of a plane given in the foot frame, round the mean of its points.
  Result<SectionContour> section(const TapePlane& plane, const Vector3d& inside,
                                 double step_mm) const {
    return trace_section(foot_, plane.transformed(solid_from_foot_), solid_from_foot_ * inside,
                         step_mm);
  }

  Result<void> store(const std::string& id, const PlanePoints& points) {
    const auto plane = TapePlane::through(points[0], points[1], points[2]);
    if (!plane) return tl::make_unexpected(plane.error());
    const auto contour = section(*plane, mean(points), kFineStepMm);
    if (!contour) {
      return fail(ErrorCode::kInternal,
                  fmt::format("the foot has no {}: {}", id, contour.error().message),
                  "report the seed");
    }
    truth_.planes[id] = points;
    truth_.measures[id] = contour->stretched_mm;
    truth_.contact_mm[id] = contour->contact_mm;
    return {};
  }

  /// Medial, lateral and dorsal control points, as in instep_points().
  PlanePoints ball_points() {
    const Vector3d medial = on_floor(landmark("mt")), lateral = on_floor(landmark("mf"));
    return {medial, lateral, 0.5 * (medial + lateral) + landmark("instep").z() * Vector3d::UnitZ()};
  }

  PlanePoints instep_points(const Vector3d& arch) {
    return {on_floor(arch), on_floor(landmark("lateral_midfoot")), landmark("instep")};
  }

  PlanePoints waist_points() {
    PlanePoints middle = ball_points();
    const PlanePoints instep = instep_points(landmark("medial_arch"));
    for (std::size_t i = 0; i < middle.size(); ++i) middle[i] = 0.5 * (middle[i] + instep[i]);
    return middle;
  }

  /// The girth of the instep plane with P3 at the station x; infinite if there is none.
  double girth_over(double x) {
    const PlanePoints points = instep_points(probe().side(x, medial_));
    const auto plane = TapePlane::through(points[0], points[1], points[2]);
    if (!plane) return INFINITY;
    const auto contour = section(*plane, mean(points), kSearchStepMm);
    return contour ? contour->stretched_mm : INFINITY;
  }

  void find_midfoot_points() {
    const OutlineProbe felt = probe();
    const double middle = 0.5 * length_;
    const double inside = 0.05 * length_;
    const auto height = [&](double y) { return felt.top(middle, y, inside).z(); };
    const double y = place_of_maximum(height, -0.15 * length_, 0.15 * length_, 1.0);
    const Vector3d instep = landmark("instep") = felt.top(middle, y, inside);

    const auto nearness = [&](double x) {
      return -(felt.side(x, -medial_) - instep).head<2>().norm();
    };
    const double lateral = place_of_maximum(nearness, 0.25 * length_, 0.45 * length_, 2.0);
    landmark("lateral_midfoot") = felt.side(lateral, -medial_);

    const double medial = place_of_maximum([&](double x) { return -girth_over(x); }, 0.35 * length_,
                                           0.60 * length_, 4.0);
    landmark("medial_arch") = felt.side(medial, medial_);
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
