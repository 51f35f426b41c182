#include "core/girth/length_doubt.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <utility>

#include "core/geometry/polygon.h"

namespace instep {
namespace {

double turn_between(const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
  return std::atan2(a.x() * b.y() - a.y() * b.x(), a.dot(b));
}

/// By how much each corner's move outwards lengthens the contour.
std::vector<double> turns_of(const Contour& contour) {
  const std::size_t count = contour.points.size();
  std::vector<double> turns(count, 0.0);
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t next = (i + 1) % count;
    const double turn = turn_between(contour.outward[i], contour.outward[next]);
    turns[i] += 0.5 * turn;
    turns[next] += 0.5 * turn;
  }
  return turns;
}

/// The same for a tape round it: it turns only at the corners of the hull.
std::vector<double> hull_turns_of(const Contour& contour) {
  const auto hull = convex_hull(contour.points);
  std::map<std::pair<double, double>, double> turn_at;
  for (std::size_t i = 0; i < hull.size(); ++i) {
    const Eigen::Vector2d before = hull[i] - hull[(i + hull.size() - 1) % hull.size()];
    const Eigen::Vector2d after = hull[(i + 1) % hull.size()] - hull[i];
    turn_at[{hull[i].x(), hull[i].y()}] = turn_between(before, after);
  }
  std::vector<double> turns;
  for (const auto& point : contour.points) {
    const auto found = turn_at.find({point.x(), point.y()});
    turns.push_back(found == turn_at.end() ? 0.0 : found->second);
  }
  return turns;
}

/// One sheet of a patch and the stretch of the contour on which it counts most.
struct Stretch {
  const HeightPatch* patch = nullptr;
  std::vector<std::size_t> members;
  std::vector<std::size_t> corners;
  double doubt = 0.0;
};

}  // namespace

ContourDoubt doubt_of(const Contour& contour, const BlendedSurface& surface) {
  const std::size_t count = contour.points.size();
  const auto turns = turns_of(contour);
  const auto hull_turns = hull_turns_of(contour);
  std::vector<Eigen::Vector3d> places;
  std::vector<double> slopes;
  std::vector<std::pair<const void*, Stretch>> stretches;
  for (std::size_t i = 0; i < count; ++i) {
    const Eigen::Vector3d place(contour.points[i].x(), contour.points[i].y(), 0.0);
    places.push_back(place);
    const SurfacePatch* patch = surface.leading_patch(place);
    const HeightPatch* sheet = nullptr;
    std::vector<std::size_t> members;
    double slope = 1.0;
    if (patch) {
      slope = patch->at(place).gradient.head<2>().norm();
      if (const auto* smooth = std::get_if<HeightPatch>(&patch->field)) {
        sheet = smooth;
        members = patch->members;
      } else if (const auto* creased = std::get_if<CreasedPatch>(&patch->field)) {
        const auto& one = creased->sheet_at(place);
        sheet = &one.patch;
        for (const auto member : one.members) members.push_back(patch->members[member]);
      }
    }
    slopes.push_back(std::max(slope, 0.1));
    if (!sheet) continue;
    auto found = std::find_if(stretches.begin(), stretches.end(),
                              [&](const auto& one) { return one.first == sheet; });
    if (found == stretches.end()) {
      stretches.push_back({sheet, {sheet, std::move(members), {}, 0.0}});
      found = std::prev(stretches.end());
    }
    found->second.corners.push_back(i);
  }

  ContourDoubt doubt;
  const auto& points = surface.points();
  std::vector<double> contact(points.size(), 0.0);
  std::vector<double> stretched(points.size(), 0.0);
  for (const auto& [key, stretch] : stretches) {
    std::vector<Eigen::Vector3d> at;
    const auto n = static_cast<Eigen::Index>(stretch.corners.size());
    Eigen::VectorXd shares(n);
    Eigen::VectorXd hull_shares(n);
    for (Eigen::Index k = 0; k < n; ++k) {
      const std::size_t corner = stretch.corners[static_cast<std::size_t>(k)];
      at.push_back(places[corner]);
      shares[k] = turns[corner] / slopes[corner];
      hull_shares[k] = hull_turns[corner] / slopes[corner];
    }
    const auto one = stretch.patch->sum(at, shares);
    const auto two = stretch.patch->sum(at, hull_shares);
    doubt.contact.wandering += one.variance;
    doubt.stretched.wandering += two.variance;
    for (std::size_t m = 0; m < stretch.members.size(); ++m) {
      contact[stretch.members[m]] += one.influence[static_cast<Eigen::Index>(m)];
      stretched[stretch.members[m]] += two.influence[static_cast<Eigen::Index>(m)];
    }
    // slope
    const std::size_t corner = stretch.corners[stretch.corners.size() / 2];
    const std::size_t next = (corner + 1) % count;
    const double step = (places[next] - places[corner]).norm();
    double way = 0.0;
    for (const std::size_t c : stretch.corners) way += (places[(c + 1) % count] - places[c]).norm();
    Eigen::VectorXd pair(2);
    pair << 1.0 / (step * slopes[corner]), -1.0 / (step * slopes[corner]);
    const auto tilt = stretch.patch->sum({places[next], places[corner]}, pair);
    double variance = 0.0;
    for (std::size_t m = 0; m < stretch.members.size(); ++m) {
      const double influence = tilt.influence[static_cast<Eigen::Index>(m)];
      variance += influence * influence * points[stretch.members[m]].variance;
    }
    doubt.wiggle += 0.5 * way * variance;
    doubt.unseen += 0.5 * way * tilt.variance;
  }
  for (std::size_t i = 0; i < points.size(); ++i) {
    doubt.contact.noise += contact[i] * contact[i] * points[i].variance;
    doubt.stretched.noise += stretched[i] * stretched[i] * points[i].variance;
  }
  return doubt;
}

}  // namespace instep
