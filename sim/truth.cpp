#include "sim/truth.h"

#include <fmt/format.h>

#include <cmath>

#include "core/degree.h"
#include "core/foot/full_size.h"
#include "core/girth/tape_plane.h"
#include "sim/outline_probe.h"
#include "sim/section_contour.h"

namespace instep {
namespace {

using Eigen::Vector3d;
using PlanePoints = std::array<Vector3d, 3>;

constexpr double kFineStepMm = 0.1;
constexpr double kSearchStepMm = 0.5;
// Between these angles over the floor the back of the foot is seen from the heel.
constexpr double kLeastRise = 0.40;
constexpr double kMostRise = 0.85;

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

/// Distance as it looks from the side.
double seen_from_side(const Vector3d& a, const Vector3d& b) {
  return std::hypot(a.x() - b.x(), a.z() - b.z());
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
    find_arch_height();
    find_heel_points();
    find_malleolus();
    find_toe_height();
    find_toe_angles();
    for (const auto& [id, points] : {std::pair("ball_girth", ball_points()),
                                     {"instep_girth", instep_points(landmark("medial_arch"))},
                                     {"waist_girth", waist_points()},
                                     {"short_heel_girth", heel_points(landmark("junction"))},
                                     {"long_heel_girth", heel_points(landmark("instep"))},
                                     {"ankle_girth", ankle_points()}}) {
      if (auto stored = store(id, points); !stored) return tl::make_unexpected(stored.error());
    }
    return truth_;
  }

 private:
  /// Millimetres at full size, of this foot. The solid keeps its nominal length.
  double at_full_size(double mm) const {
    return mm / full_size_factor(foot_.parameters().length_mm);
  }

  OutlineProbe probe() const { return {foot_, solid_from_foot_, at_full_size(25.0)}; }

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

  /// A millimetre of handicap, at full size, at a twenty-fifth of FL off the usual place, growing
  /// as its square.
  auto off_usual(double usual) const {
    return [usual, spread = 0.04 * length_, one = at_full_size(1.0)](double at) {
      return one * std::pow((at - usual) / spread, 2);
    };
  }

  void find_ball_points() {
    const Vector3d mt = landmark("mt") =
        most_protruding(medial_, 0.60 * length_, 0.80 * length_, off_usual(0.69 * length_));
    const double foremost = std::min(0.75 * length_, mt.x() - at_full_size(15.0));
    const Vector3d mf = landmark("mf") = most_protruding(
        -medial_, 0.50 * length_, foremost, off_usual(std::min(0.63 * length_, foremost)));
    truth_.measures["foot_breadth"] = (mt - mf).head<2>().norm();
    truth_.measures["ball_length"] = mt.x();
    truth_.measures["outside_ball_length"] = mf.x();
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
    if (id == "ball_girth") store_ball_height(*plane, *contour);
    return {};
  }

  void store_ball_height(const TapePlane& plane, const SectionContour& contour) {
    double& highest = truth_.measures["ball_height"];
    for (const auto& corner : contour.polygon) highest = std::max(highest, plane.lift(corner).z());
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
    truth_.measures["instep_height"] = instep.z();

    const auto nearness = [&](double x) {
      return -(felt.side(x, -medial_) - instep).head<2>().norm();
    };
    const double lateral = place_of_maximum(nearness, 0.25 * length_, 0.45 * length_, 2.0);
    landmark("lateral_midfoot") = felt.side(lateral, -medial_);

    const double medial = place_of_maximum([&](double x) { return -girth_over(x); }, 0.35 * length_,
                                           0.60 * length_, 4.0);
    landmark("medial_arch") = felt.side(medial, medial_);
  }

  /// The underside a quarter of the breadth inwards from the medial border.
  void find_arch_height() {
    const OutlineProbe felt = probe();
    const auto underside = [&](double x) {
      const double inner = felt.side(x, medial_).y();
      const double outer = felt.side(x, -medial_).y();
      return felt.underside(x, inner + 0.25 * (outer - inner));
    };
    const double x = place_of_maximum([&](double at) { return underside(at).z(); }, 0.35 * length_,
                                      0.60 * length_, 4.0);
    landmark("arch_point") = underside(x);
    truth_.measures["arch_height"] = underside(x).z();
  }

  /// Seen from the side: direction that rises by an angle.
  static Vector3d rising(double radians) { return {std::cos(radians), 0.0, std::sin(radians)}; }

  void find_heel_points() {
    const OutlineProbe felt = probe();
    const Vector3d inner = felt.side(length_ / 6.0, medial_);
    const Vector3d outer = felt.side(length_ / 6.0, -medial_);
    landmark("heel_medial") = inner;
    landmark("heel_lateral") = outer;
    truth_.measures["heel_breadth"] = std::abs(inner.y() - outer.y());

    // Down and back from the instep point to the far end of the heel; the rays that leave through
    // the sole in front of it are shorter.
    const double half_width = 0.12 * length_;
    const Vector3d instep = landmark("instep");
    const auto heel = [&](double down) { return felt.profile(instep, -rising(down), half_width); };
    const double down = place_of_maximum(
        [&](double at) { return seen_from_side(heel(at), instep); }, 0.25, 0.60, 0.02);
    landmark("heel_point") = heel(down);

    const Vector3d rear = landmark("heel_point");
    const auto back = [&](double up) { return felt.profile(rear, rising(up), half_width); };
    const double up = place_of_maximum([&](double at) { return -seen_from_side(back(at), rear); },
                                       kLeastRise, kMostRise, 0.03);
    landmark("junction") = back(up);
  }

  PlanePoints heel_points(const Vector3d& dorsal) {
    const Vector3d heel = landmark("heel_point");
    return {heel, dorsal, Vector3d(heel + 0.1 * length_ * Vector3d::UnitY())};
  }

  void find_malleolus() {
    const OutlineProbe felt = probe();
    const auto protrusion = [&](double z) {
      const auto reach = [&](double x) {
        return felt.reach({x, 0.0, z}, medial_ * Vector3d::UnitY());
      };
      const double x = place_of_maximum(reach, 0.10 * length_, 0.45 * length_, 4.0);
      return Vector3d(x, medial_ * reach(x), z);
    };
    const auto weighed = [&](double z) {
      return medial_ * protrusion(z).y() - at_full_size(std::pow((z / length_ - 0.30) / 0.03, 2));
    };
    landmark("medial_malleolus") =
        protrusion(place_of_maximum(weighed, 0.22 * length_, 0.38 * length_, 2.0));
  }

  PlanePoints ankle_points() {
    const Vector3d skin = landmark("medial_malleolus");
    const Vector3d inside = skin - medial_ * 0.1 * length_ * Vector3d::UnitY();
    return {inside, inside + 5.0 * Vector3d::UnitX(), inside + 5.0 * Vector3d::UnitY()};
  }

  void find_toe_height() {
    const OutlineProbe felt = probe();
    const double inner = landmark("mt").y();
    const double border = inner + 0.30 * (landmark("mf").y() - inner);
    const double from = std::min(inner, border), to = std::max(inner, border);
    const double tip =
        place_of_maximum([&](double y) { return felt.end(y, 1.0).x(); }, from, to, 2.0);
    landmark("toe1_tip") = felt.end(tip, 1.0);
    const double x = landmark("toe1_tip").x() - at_full_size(15.0);
    const auto height = [&](double y) { return felt.top(x, y, at_full_size(6.0)).z(); };
    truth_.measures["toe1_height"] = height(place_of_maximum(height, from, to, 1.5));
  }

  /// By how much the toe whose border lies in a range turns from the line of the side: medial for
  /// `sign` +1.
  double toe_angle(const Vector3d& heel, const Vector3d& ball, double sign, double from,
                   double to) {
    const OutlineProbe felt = probe();
    const double outwards = sign * medial_;
    const auto bearing = [&](double x) {
      return std::atan2(outwards * (felt.side(x, outwards).y() - ball.y()), x - ball.x());
    };
    const double toe = bearing(place_of_maximum(bearing, from * length_, to * length_, 2.0));
    const double side = std::atan2(outwards * (ball.y() - heel.y()), ball.x() - heel.x());
    return (side - toe) / kDegree;
  }

  void find_toe_angles() {
    truth_.measures["toe1_angle"] =
        toe_angle(landmark("heel_medial"), landmark("mt"), 1.0, 0.80, 0.95);
    truth_.measures["toe5_angle"] =
        toe_angle(landmark("heel_lateral"), landmark("mf"), -1.0, 0.70, 0.85);
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
