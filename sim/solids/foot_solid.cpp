#include "sim/solids/foot_solid.h"

#include <cmath>
#include <functional>

#include "core/degree.h"

namespace instep {
namespace {

using Eigen::Vector3d;

/// The model is a right foot of this length; positions below are read off it, in millimetres.
constexpr double kModelLength = 250.0;
/// Flesh fills the corners between neighbouring parts: little between the toes, more elsewhere.
constexpr double kBodySoftness = 5.0;
constexpr double kTightToes = 5.0;
constexpr double kSpreadToes = 1.2;

/// Turned about the vertical through `centre`, towards -y for positive angles.
Vector3d turned_outwards(const Vector3d& point, const Vector3d& centre, double degrees) {
  return centre + Eigen::AngleAxisd(-degrees * kDegree, Vector3d::UnitZ()) * (point - centre);
}

struct Ray {
  Vector3d base;
  double base_radius;
  Vector3d head;
  double head_radius;
  Vector3d middle;
  double middle_radius;
  Vector3d tip;
  double tip_radius;
};

/// Returns the middle of the second toe's tip.
Vector3d add_rays(Blend& body, Blend& toes, const FootParameters& foot, double per_model) {
  const double second = foot.second_toe_mm * per_model;
  Ray rays[] = {
      {{108, 13, 36}, 20, {171, 22, 12}, 18, {208, 25, 9}, 11, {235, 24, 7.5}, 10.5},
      {{108, 3, 40}, 20, {179, 6, 12}, 17, {213, 6, 11}, 7.5, {0, 5, 6}, 6.5},
      {{103, -8, 35}, 20, {174, -9, 11}, 16.5, {205, -9, 10}, 7, {229, -10.5, 5.5}, 6.2},
      {{95, -18, 27}, 18, {164, -22, 10}, 15.5, {193, -23.5, 9}, 6.8, {216, -25, 5.5}, 6.2},
      {{85, -25, 16}, 16.5, {152, -35, 8}, 14.5, {180, -37, 8}, 6.8, {200, -39, 5.5}, 6.5},
  };
  rays[0].middle = turned_outwards(rays[0].middle, rays[0].head, foot.hallux_angle_deg - 5.0);
  rays[0].tip = turned_outwards(rays[0].tip, rays[0].head, foot.hallux_angle_deg - 5.0);
  rays[1].tip.x() = rays[0].tip.x() + rays[0].tip_radius + second - rays[1].tip_radius;
  for (const Ray& ray : rays) {
    body.add({ray.base, ray.base_radius, ray.head, ray.head_radius});
    toes.add({ray.head, ray.middle_radius, ray.middle, ray.middle_radius});
    toes.add({ray.middle, ray.middle_radius, ray.tip, ray.tip_radius});
  }
  return rays[1].tip;
}

void add_hindfoot(Blend& body, const FootParameters& foot, double per_model) {
  const double heel = 0.5 * foot.heel_breadth_mm * per_model - 2.5;
  const double arch = foot.arch_lift_mm * per_model;
  body.add({{heel + 1, 0, 18}, heel, {37, 0, 60}, heel - 7});  // heel
  body.add({{40, -6, 14}, 22, {100, -21, 11}, 18});            // outer edge
  body.add({{45, 5, 40}, 24, {105, 13, 37 + arch}, 18});       // arch, inner side
  body.add({{60, 2, 75}, 24, {108, 4, 41}, 19});               // instep
  body.add({{22, 0, 50}, 13, {22, 0, 95}, 9});                 // tendon of Achilles
}

void add_leg(Blend& body, const FootParameters& foot, double per_model) {
  const double girth = foot.ankle_girth_mm * per_model;
  const double top = foot.leg_height_mm * per_model;
  const auto on_leg = [&](double x, double y, double z) {
    const double above = z - 75.0;
    return Vector3d(x + above * std::tan(foot.lean_forward_deg * kDegree),
                    y + above * std::tan(foot.lean_medial_deg * kDegree), z);
  };
  const double shin = girth / 8.6;
  const double calf = girth / 5.6;
  body.add({on_leg(60, 2, 75), shin, on_leg(58, 3, 125), shin});
  body.add({on_leg(58, 3, 125), shin, on_leg(54, 3, top), 1.3 * shin});
  body.add({on_leg(22, 0, 95), 9, on_leg(32, 0, 150), 20});
  body.add({on_leg(32, 0, 150), 20, on_leg(38, 0, top), calf});
  body.add({on_leg(57, 23, 74), 9, on_leg(55, 17, 105), 7});    // medial malleolus
  body.add({on_leg(46, -22, 62), 9, on_leg(49, -16, 105), 7});  // lateral malleolus
}

/// Where `value` turns negative on the way from `outside` to `inside`; nothing on the way gives
/// `inside`.
Vector3d first_skin(const std::function<double(const Vector3d&)>& value, const Vector3d& outside,
                    const Vector3d& inside) {
  const Vector3d direction = (inside - outside).normalized();
  const double length = (inside - outside).norm();
  double travelled = 0.0;
  while (travelled < length) {
    const double distance = value(outside + travelled * direction);
    if (distance < 1e-3) break;
    travelled += 0.7 * distance;
  }
  return outside + std::min(travelled, length) * direction;
}

}  // namespace

FootSolid::FootSolid(const FootParameters& parameters)
    : parameters_(parameters),
      rim_(parameters.rim_radius_mm * kModelLength / parameters.length_mm),
      toes_(kTightToes + (kSpreadToes - kTightToes) * parameters.toe_separation),
      body_(kBodySoftness) {
  const double per_model = kModelLength / parameters.length_mm;
  second_toe_ = add_rays(body_, toes_, parameters, per_model);
  add_hindfoot(body_, parameters, per_model);
  add_leg(body_, parameters, per_model);
  fit_scale();
  Eigen::AlignedBox3d box = body_.bounds().merged(toes_.bounds());
  Vector3d lowest = box.min().array() - kBodySoftness;
  Vector3d highest = box.max().array() + kBodySoftness;
  lowest.z() = 0.0;
  if (parameters_.side == Side::kLeft) {
    std::swap(lowest.y(), highest.y());
    lowest.y() = -lowest.y();
    highest.y() = -highest.y();
  }
  bounds_ = {lowest.cwiseProduct(scale_), highest.cwiseProduct(scale_)};
}

double FootSolid::model_value(const Vector3d& point) const {
  double share = 0.0;
  Eigen::Vector2d shares;
  const double flesh = soft_minimum(body_.value(point), toes_.value(point), kBodySoftness, share);
  return rounded_maximum(flesh, -point.z(), rim_, shares);
}

Vector3d FootSolid::model_gradient(const Vector3d& point) const {
  Vector3d of_body, of_toes;
  double share = 0.0;
  Eigen::Vector2d shares;
  const double body = body_.value(point, of_body);
  const double toes = toes_.value(point, of_toes);
  const double flesh = soft_minimum(body, toes, kBodySoftness, share);
  rounded_maximum(flesh, -point.z(), rim_, shares);
  return shares.x() * (share * of_body + (1.0 - share) * of_toes) - shares.y() * Vector3d::UnitZ();
}

Vector3d FootSolid::mirrored(const Vector3d& point) const {
  const double mirror = parameters_.side == Side::kLeft ? -1.0 : 1.0;
  return {point.x(), mirror * point.y(), point.z()};
}

Vector3d FootSolid::second_toe() const {
  return mirrored(second_toe_.cwiseProduct(scale_));
}

double FootSolid::value(const Vector3d& point) const {
  return model_value(mirrored(point).cwiseQuotient(scale_)) * scale_.minCoeff();
}

Vector3d FootSolid::gradient(const Vector3d& point) const {
  const Vector3d slope = model_gradient(mirrored(point).cwiseQuotient(scale_));
  return mirrored(slope.cwiseQuotient(scale_)) * scale_.minCoeff();
}

/// Measures the model on lines parallel to its axes, and sets the scale that gives it the asked
/// length, breadth and height.
void FootSolid::fit_scale() {
  const auto value = [this](const Vector3d& point) { return model_value(point); };
  double back = 0.0, front = 0.0, medial = 0.0, lateral = 0.0, top = 0.0;
  for (double z = 2.0; z <= 25.0; z += 1.0) {
    for (double y = -45.0; y <= 45.0; y += 1.5) {
      back = std::min(back, first_skin(value, {-80, y, z}, {60, y, z}).x());
      front = std::max(front, first_skin(value, {340, y, z}, {120, y, z}).x());
    }
    for (double x = 150.0; x <= 190.0; x += 2.0) {
      medial = std::max(medial, first_skin(value, {x, 150, z}, {x, 0, z}).y());
      lateral = std::min(lateral, first_skin(value, {x, -150, z}, {x, 0, z}).y());
    }
  }
  const double middle = 0.5 * (back + front);
  for (double y = -30.0; y <= 40.0; y += 1.0) {
    top = std::max(top, first_skin(value, {middle, y, 150}, {middle, y, 5}).z());
  }
  scale_ = {parameters_.length_mm / (front - back),
            parameters_.ball_breadth_mm / (medial - lateral), parameters_.instep_height_mm / top};
}

}  // namespace instep
