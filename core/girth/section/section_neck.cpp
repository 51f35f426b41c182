#include "core/girth/section/section_neck.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/geometry/plane_vectors.h"
#include "core/girth/contour/contour_course.h"

namespace instep {
namespace {

/// Places that a neck is looked for between.
constexpr std::size_t kStations = 200;
/// Of the area, what is a part.
constexpr double kLeastPart = 0.05;
/// How wide a part is (four times its area by its outline: the diameter of a round one) against the
/// neck.
constexpr double kWiderThanNeck = 2.0;
/// Points so near to the plane and to the straight line across a neck lie along it, and a gap
/// between them, in grains or against the width, that tells it from two skins. Of 378 sections of
/// two cylinders -6 to 4 mm apart 17 ran round both though they were two, or hardly one: of their
/// necks all have gaps of 0.2 to 1.8 grains. Those of bodies that are one are 14 grains wide and
/// more, and empty. Of 1,997 girths of drawn bodies one has a neck, 0.6 grains wide, of those of
/// 120 feet none.
constexpr double kNearInGrains = 1.5;
constexpr double kWidestGapInGrains = 2.0;
constexpr double kWidestGap = 0.4;

/// A contour by places as far from each other along it, with the areas that these sweep.
class Stations {
 public:
  explicit Stations(const ContourCourse& course) : step_(course.length() / kStations) {
    for (std::size_t i = 0; i < kStations; ++i) {
      places_.push_back(course.place_at(static_cast<double>(i) * step_));
    }
    for (std::size_t i = 0; i < kStations; ++i) {
      swept_.push_back(swept_.back() + cross(places_[i], places_[(i + 1) % kStations]));
    }
  }

  const Eigen::Vector2d& place(std::size_t station) const { return places_[station]; }
  double area() const { return 0.5 * swept_.back(); }

  /// Between the way from one station on to a later one, and straight back.
  double area_between(std::size_t from, std::size_t to) const {
    return 0.5 * (swept_[to] - swept_[from] + cross(places_[to], places_[from]));
  }

  double width_between(std::size_t from, std::size_t to) const {
    return (places_[to] - places_[from]).norm();
  }

  double way_between(std::size_t from, std::size_t to) const {
    return static_cast<double>(to - from) * step_;
  }

  double length() const { return static_cast<double>(kStations) * step_; }

 private:
  double step_;
  std::vector<Eigen::Vector2d> places_;
  std::vector<double> swept_ = {0.0};  ///< twice the area from the first one on
};

bool is_part(double area, double way, double width, double whole) {
  return area > kLeastPart * whole && 4.0 * area > kWiderThanNeck * width * (way + width);
}

/// Between points near a neck, and its ends.
double widest_gap_along(const SectionNeck& neck, const PlaneBand& band) {
  if (!(neck.width > 0.0)) return 0.0;
  const double near = kNearInGrains * band.grain;
  const Eigen::Vector2d along = (neck.to - neck.from) / neck.width;
  std::vector<double> ways = {0.0, neck.width};
  for (const auto& point : band.points) {
    const Eigen::Vector2d off = point.position.head<2>() - neck.from;
    const double way = std::clamp(off.dot(along), 0.0, neck.width);
    if (std::abs(point.position.z()) <= near && (off - way * along).norm() <= near) {
      ways.push_back(way);
    }
  }
  std::sort(ways.begin(), ways.end());
  double widest = 0.0;
  for (std::size_t i = 1; i < ways.size(); ++i) widest = std::max(widest, ways[i] - ways[i - 1]);
  return widest;
}

}  // namespace

std::optional<SectionNeck> SectionNeck::of(const Contour& contour) {
  const Stations stations{ContourCourse(contour)};
  std::optional<SectionNeck> narrowest;
  for (std::size_t from = 0; from < kStations; ++from) {
    for (std::size_t to = from + 2; to < kStations; ++to) {
      const double width = stations.width_between(from, to);
      if (narrowest && width >= narrowest->width) continue;
      const double area = stations.area_between(from, to);
      const double way = stations.way_between(from, to);
      if (is_part(area, way, width, stations.area()) &&
          is_part(stations.area() - area, stations.length() - way, width, stations.area())) {
        narrowest = SectionNeck{stations.place(from), stations.place(to), width};
      }
    }
  }
  return narrowest;
}

bool may_be_two_bodies(const PlaneBand& band, const SectionNeck& neck) {
  return widest_gap_along(neck, band) <
         std::max(kWidestGapInGrains * band.grain, kWidestGap * neck.width);
}

}  // namespace instep
