#include "daemon/page/views_block.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "daemon/page/foot_view.h"
#include "daemon/page/paper.h"
#include "daemon/page/tape_ring.h"
#include "daemon/report/length_drawing.h"
#include "daemon/report/number_text.h"

namespace instep {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

/// What is drawn from above is the foot without the leg, which would hide it.
constexpr double kHighestFromAboveMm = 90.0;
constexpr double kHighestFromSideMm = 125.0;
constexpr double kTallestSide = 640.0;

constexpr double kCaption = 30.0;
constexpr double kNames = 112.0;
constexpr double kLengthLine = 116.0;
constexpr double kBelowFloor = 30.0;
constexpr double kLegendLine = 34.0;
constexpr double kLegendLetters = 25.0;
constexpr double kNumberApartAcross = 46.0;  // of two figures each
constexpr double kNumberApartDown = 28.0;
constexpr double kNumberOut = 30.0;
constexpr double kLittleConfidence = 0.35;

/// The places of the numbers of landmarks in one view.
class Numbers {
 public:
  /// Beside `place`, on the side away from `middle` if that is free, or else further out.
  Vector2d beside(const Vector2d& place, const Vector2d& middle) {
    const Vector2d away = place - middle;
    const double start = std::atan2(away.y(), away.x());
    constexpr int kTurns = 16;
    constexpr int kRings = 2;
    Vector2d best = place;
    for (int attempt = 0; attempt < kRings * kTurns; ++attempt) {
      const int turn = attempt % kTurns;
      // Alternately to either side: 0, 1, -1, 2, -2, ...
      const int steps = turn % 2 == 0 ? -turn / 2 : (turn + 1) / 2;
      const double angle = start + steps * 2.0 * std::numbers::pi / kTurns;
      const double out = kNumberOut * (1 + attempt / kTurns);
      best = place + out * Vector2d(std::cos(angle), std::sin(angle));
      if (is_free(best)) break;
    }
    taken_.push_back(best);
    return best;
  }

 private:
  bool is_free(const Vector2d& place) const {
    return std::none_of(taken_.begin(), taken_.end(), [&](const Vector2d& other) {
      return std::abs(other.x() - place.x()) < kNumberApartAcross &&
             std::abs(other.y() - place.y()) < kNumberApartDown;
    });
  }

  std::vector<Vector2d> taken_;
};

bool shows(const FootView& view, const Landmark& landmark) {
  return landmark.position_mm.allFinite() && !view.hides(landmark.position_mm);
}

/// Those that one of the views shows, which are numbered from 1 on.
Landmarks shown_by(const FootView& one, const FootView& other, Landmarks landmarks) {
  std::erase_if(landmarks, [&](const auto& named) {
    return !shows(one, named.second) && !shows(other, named.second);
  });
  return landmarks;
}

std::string landmarks_svg(const Landmarks& landmarks, const FootView& view,
                          const Vector2d& middle) {
  std::string text;
  Numbers numbers;
  int number = 0;
  for (const auto& [name, landmark] : landmarks) {
    ++number;
    if (!shows(view, landmark)) continue;
    const Vector2d place = view(landmark.position_mm);
    const Vector2d beside = numbers.beside(place, middle);
    text += svg::dots({place}, 5.5, "mark");
    text += svg::line(place, place + 0.62 * (beside - place), "mark-line");
    text += svg::label(beside + Vector2d(0.0, 8.5), "mark-number", std::to_string(number));
  }
  return text;
}

/// "1 acropodion, 2 instep point ...", and which of them are placed by proportion.
svg::Block legend(const Landmarks& landmarks, const Vector2d& corner, double width) {
  svg::Block block{{}, corner.y()};
  const auto end_line = [&](const std::string& line) {
    block.bottom += kLegendLine;
    block.svg += svg::label({corner.x(), block.bottom}, "legend", line);
  };
  std::string line;
  int number = 0;
  for (const auto& [name, landmark] : landmarks) {
    const std::string item =
        fmt::format("{} {}{}", ++number, as_words(name),
                    landmark.confidence < kLittleConfidence ? " (by proportion)" : "");
    const std::string longer = line.empty() ? item : line + ",  " + item;
    if (!line.empty() && paper::wrapped(longer, width, kLegendLetters).size() > 1) {
      end_line(line + ",");
      line = item;
    } else {
      line = longer;
    }
  }
  if (!line.empty()) end_line(line);
  return block;
}

std::string length_line(const FootScan& foot, const MeasureSet& measures, const FootView& view,
                        double y) {
  const auto length = draw_length(foot, measures);
  if (!length) return {};
  const Vector2d from(view(length->rear).x(), y);
  const Vector2d to(view(length->front).x(), y);
  return svg::measuring_line(from, to, 12.0, "rule") +
         svg::label((from + to) / 2.0 + Vector2d(0.0, 40.0), "length",
                    "foot length " + length->interval);
}

std::string tapes_svg(const std::vector<TapeRing>& rings, const FootView& view) {
  std::string text;
  for (const auto& ring : rings) text += ring_svg(ring, view);
  return text;
}

}  // namespace

svg::Block views_block(const FootScan& foot, const MeasureSet& measures, const Vector2d& corner,
                       double width) {
  FootView above(foot, FootView::From::kAbove, kHighestFromAboveMm);
  FootView side(foot, FootView::From::kMedial, kHighestFromSideMm);
  if (above.is_empty() || side.is_empty()) {
    return {svg::label(corner + Vector2d(0.0, kCaption), "note", "no points to draw"),
            corner.y() + kCaption};
  }
  // What is above one another on the page is so on the foot.
  const double leftmost = std::min(above.bounds().min().x(), side.bounds().min().x());
  const double rightmost = std::max(above.bounds().max().x(), side.bounds().max().x());
  const double scale = std::max(paper::scale_that_fits(rightmost - leftmost, width),
                                paper::scale_that_fits(side.bounds().sizes().y(), kTallestSide));
  const double per_mm = paper::per_foot_mm(scale);
  const auto rings = tape_rings(measures);
  const Landmarks landmarks = shown_by(above, side, foot.landmarks);
  const auto draw = [&](FootView& view, double top) {
    const Vector2d at(corner.x() + per_mm * (view.bounds().min().x() - leftmost), top);
    view.place(at, per_mm);
    return view.relief() + tapes_svg(rings, view) +
           ring_names(rings, view, top - kNames + 62.0, corner.x(), corner.x() + width) +
           landmarks_svg(landmarks, view, at + per_mm * Vector2d(view.bounds().sizes()) / 2.0);
  };
  const std::string to_scale = fmt::format(", 1 : {:g}", scale);

  svg::Block block;
  double y = corner.y() + kCaption;
  block.svg += svg::label({corner.x(), y}, "caption", "from above" + to_scale);
  y += kNames;
  block.svg += draw(above, y);
  y += per_mm * above.bounds().sizes().y();
  block.svg += length_line(foot, measures, above, y + 46.0);
  y += kLengthLine + kCaption;
  block.svg += svg::label({corner.x(), y}, "caption", "from the medial side" + to_scale);
  y += kNames;
  block.svg += draw(side, y);
  y += per_mm * side.bounds().sizes().y();
  block.svg += svg::line({corner.x(), y}, {corner.x() + width, y}, "floor");
  const svg::Block names = legend(landmarks, {corner.x(), y + kBelowFloor}, width);
  return {block.svg + names.svg, names.bottom};
}

}  // namespace instep
