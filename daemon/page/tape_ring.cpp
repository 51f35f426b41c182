#include "daemon/page/tape_ring.h"

#include <fmt/format.h>

#include <algorithm>

#include "core/geometry/polygon.h"
#include "daemon/report/number_text.h"
#include "daemon/report/svg_text.h"

namespace instep {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double kLineHeight = 30.0;
constexpr double kBelowName = 9.0;
/// Room that a name takes; those of girths are two words.
constexpr double kNameWidth = 172.0;
constexpr double kElbow = 26.0;
/// Of a ring, on the foot.
constexpr double kStepMm = 1.0;

/// "short_heel_girth" is "short heel" beside its tape.
std::string short_name(const Measure& measure) {
  std::string name = as_words(measure.id);
  constexpr std::string_view kEnd = " girth";
  if (name.ends_with(kEnd)) name.erase(name.size() - kEnd.size());
  return name;
}

/// Moves places that are in order apart to at least `gap`, within a range.
void spread(std::vector<double>& places, double gap, double left, double right) {
  for (std::size_t i = 0; i < places.size(); ++i) {
    const double least = i == 0 ? left + gap / 2.0 : places[i - 1] + gap;
    places[i] = std::max(places[i], least);
  }
  for (std::size_t i = places.size(); i-- > 0;) {
    const double most = i + 1 == places.size() ? right - gap / 2.0 : places[i + 1] - gap;
    places[i] = std::min(places[i], most);
  }
}

}  // namespace

std::vector<TapeRing> tape_rings(const MeasureSet& measures) {
  std::vector<TapeRing> rings;
  for (const auto& measure : measures.measures) {
    if (!measure.girth || !measure.plane) continue;
    std::vector<Vector2d> section;
    for (const auto& corner : measure.girth->contour) {
      if (corner.allFinite()) section.push_back(corner);
    }
    if (section.size() < 3) continue;
    const auto hull = svg::thinned(convex_hull(section), kStepMm);
    if (hull.size() < 3) continue;
    TapeRing ring{&measure, {}, {}};
    for (std::size_t i = 0; i < hull.size(); ++i) {
      const Vector2d edge = hull[(i + 1) % hull.size()] - hull[i];
      ring.corners.push_back(measure.plane->lift(hull[i]));
      ring.outwards.push_back(edge.y() * measure.plane->u() - edge.x() * measure.plane->v());
    }
    rings.push_back(std::move(ring));
  }
  return rings;
}

std::string ring_svg(const TapeRing& ring, const FootView& view) {
  std::string hidden;
  std::string seen;
  bool was_seen = false;
  for (std::size_t i = 0; i < ring.corners.size(); ++i) {
    const Vector2d from = view(ring.corners[i]);
    const Vector2d to = view(ring.corners[(i + 1) % ring.corners.size()]);
    const bool is_seen = ring.outwards[i].dot(view.towards_viewer()) > 0.0;
    std::string& path = is_seen ? seen : hidden;
    if (path.empty() || is_seen != was_seen) {
      path += fmt::format("M{:.1f} {:.1f}", from.x(), from.y());
    }
    path += fmt::format("L{:.1f} {:.1f}", to.x(), to.y());
    was_seen = is_seen;
  }
  return fmt::format("<path class=\"tape-behind\" d=\"{}\"/>\n<path class=\"tape\" d=\"{}\"/>\n",
                     hidden, seen);
}

Vector2d top_of(const TapeRing& ring, const FootView& view) {
  Vector2d top = view(ring.corners.front());
  for (const auto& corner : ring.corners) {
    const Vector2d place = view(corner);
    if (place.y() < top.y()) top = place;
  }
  return top;
}

std::string ring_names(const std::vector<TapeRing>& rings, const FootView& view, double baseline,
                       double left, double right) {
  // From the heel on, so that names give way towards the toes, where no leg stands.
  const double heading = view.heading();
  std::vector<std::pair<Vector2d, const TapeRing*>> tops;
  for (const auto& ring : rings) tops.emplace_back(top_of(ring, view), &ring);
  std::sort(tops.begin(), tops.end(), [&](const auto& a, const auto& b) {
    return heading * a.first.x() < heading * b.first.x();
  });
  std::vector<double> places;
  for (const auto& [top, ring] : tops) places.push_back(heading * top.x());
  if (heading > 0.0) {
    spread(places, kNameWidth, left, right);
  } else {
    spread(places, kNameWidth, -right, -left);
  }
  std::string text;
  for (std::size_t i = 0; i < tops.size(); ++i) {
    const auto& [top, ring] = tops[i];
    const Vector2d name(heading * places[i], baseline);
    text += svg::polyline({name + Vector2d(0.0, kBelowName), {name.x(), baseline + kElbow}, top},
                          "leader");
    text += svg::label(name - Vector2d(0.0, kLineHeight), "tape-name", short_name(*ring->measure));
    text += svg::label(name, "tape-number", tenths(ring->measure->value_mm));
  }
  return text;
}

}  // namespace instep
