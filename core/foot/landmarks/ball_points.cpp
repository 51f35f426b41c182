#include "core/foot/landmarks/ball_points.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "core/foot/skin/border_crest.h"
#include "core/foot/skin/border_smoothing.h"
#include "core/foot/skin/hidden_crest.h"
#include "core/foot/skin/skin_round.h"
#include "core/normal_spread.h"

namespace instep {
namespace {

// Borders are nearly straight beside the ball, so that the furthest place alone jumps by a
// centimetre with the sampling: a place one spread of feet off the average must be a
// millimetre further out to win. So there always is one best place, and it moves little with the
// points: on a straight border it is the average one.
constexpr double kPriorSpreadShare = 0.04;
constexpr double kPriorHandicapMm = 1.0;
constexpr double kBehindTibialeMm = 15.0;
// The border is smoothed further than where its reach is asked for: what its furthest place wanders
// by falls as the square root of the cube of this, until the border's own bends pull it aside.
constexpr double kSmoothingMm = 13.0;
// The same for one surface fitted at once, which wanders less. The ball's girth moves by 0.8 mm for
// a millimetre of the fibulare, and by 0.1 mm for one of the tibiale, whose head bends tighter.
constexpr double kTibialePatchMm = 9.0;
constexpr double kFibularePatchMm = 13.0;
constexpr double kPatchAcrossMm = 10.0;
constexpr double kPriorConfidence = 0.3;  ///< where the border has no say
constexpr double kMostConfidence = 0.95;  ///< where it alone decides

constexpr double kUsualHalfShare = 0.085;  ///< of the foot's length, to either side

/// A border round the usual place of a point of the ball, of a foot one unit long: the reach's
/// first to third derivative by the place, and their spreads. Cubics over 0.06 and 0.08 of the
/// length to either side, of 23 drawn feet and three real ones, gave medial slopes of -0.05 to
/// 0.16, bends of -7.6 to -1.6 and thirds of -186 to -61; lateral -0.27 to 0.09, -7.1 to -0.5, -34
/// to 254.
struct UsualShape {
  Eigen::Vector3d derivatives;
  Eigen::Vector3d spreads;
};
const UsualShape kUsuallyMedial{{0.07, -4.5, -85.0}, {0.08, 2.5, 25.0}};
const UsualShape kUsuallyLateral{{-0.10, -4.0, 100.0}, {0.12, 2.0, 70.0}};

struct Rule {
  double from;
  double to;
  double prior;
  double patch_mm;  ///< half-length of what is fitted at once
  const UsualShape& shape;
  const char* name;
};

bool is_on_skin(const FootOutline& outline, const SkinBorder& border,
                const SkinBorder::Place& place) {
  return is_skin_all_round(outline.points(), border.position(place), border.view().outwards);
}

/// Where one surface through all points round `start` has the weighed border's furthest place.
std::optional<SkinBorder::Place> crest_in_range(const FootOutline& outline,
                                                const SkinBorder& border,
                                                const SkinBorder::Place& start, const Rule& rule) {
  const CrestPatch patch{rule.patch_mm, kPatchAcrossMm};
  const UsualPlace usual{rule.prior, kPriorSpreadShare * outline.length_mm()};
  const auto crest = crest_near(outline.points(), border.view(), start, patch, usual);
  if (!crest || crest->along < rule.from || crest->along > rule.to) return std::nullopt;
  auto place = border.at(crest->along);
  if (place) place->bend = crest->bend;
  return place;
}

/// The samples of a border, as far round a rule's range as what is usual of it reaches, that are no
/// rim of a hole.
SkinBorder on_skin(const FootOutline& outline, const SkinBorder& border, const Rule& rule) {
  constexpr double kBesideMm = 20.0;  // of what is_skin_all_round() looks at
  const double half = kUsualHalfShare * outline.length_mm();
  const auto is_within = [&](double along, double margin) {
    return along > rule.from - margin && along < rule.to + margin;
  };
  std::vector<Eigen::Vector3d> near;
  for (const auto& point : outline.points()) {
    const bool is_near = is_within(point.x(), half + kBesideMm) &&
                         border.view().outwards.dot(point) > 0.0 &&
                         point.z() < kLandmarkOutlineHeightMm + kBesideMm;
    if (is_near) near.push_back(point);
  }
  return border.where([&](const SkinBorder::Place& place) {
    return is_within(place.along, half) &&
           is_skin_all_round(near, border.position(place), border.view().outwards);
  });
}

/// The samples of a border that are on skin that was seen, or close under it.
SkinBorder told_part(const FootOutline& outline, const SkinBorder& border) {
  return border.where(
      [&](const SkinBorder::Place& place) { return outline.is_told(border.position(place)); });
}

/// Second derivative of the handicap.
double handicap_bend_per_mm(double length) {
  const double spread = kPriorSpreadShare * length;
  return 2.0 * kPriorHandicapMm / (spread * spread);
}

UsualBorder usual_border(const Rule& rule, double length) {
  const Eigen::Vector3d scale(1.0, 1.0 / length, 1.0 / (length * length));
  UsualBorder usual;
  usual.along = rule.prior;
  usual.half_width_mm = kUsualHalfShare * length;
  usual.from = rule.from;
  usual.to = rule.to;
  usual.derivatives = scale.cwiseProduct(rule.shape.derivatives);
  usual.spreads = scale.cwiseProduct(rule.shape.spreads);
  usual.handicap_bend_per_mm = handicap_bend_per_mm(length);
  return usual;
}

/// Where the border may be furthest in a stretch that was not seen.
std::optional<Landmark> hidden_point(const FootOutline& outline, const SkinBorder& told,
                                     const SkinBorder& border, const Rule& rule) {
  const auto crest = hidden_crest(told, border, usual_border(rule, outline.length_mm()));
  if (!crest) return std::nullopt;
  const auto& view = border.view();
  Landmark point{border.position(crest->place),
                 kPriorConfidence + (kMostConfidence - kPriorConfidence) * crest->told_share,
                 std::string(rule.name) +
                     "; not seen there: told by what was seen beside it and what is usual of feet"};
  for (const Eigen::Vector2d& off : crest->deviations_off_mm) {
    point.deviations_off_mm.emplace_back(off.x() * view.along + off.y() * view.outwards);
  }
  return point;
}

std::optional<Landmark> most_protruding(const FootOutline& outline, const SkinBorder& border,
                                        const Rule& rule) {
  const double by_prior = handicap_bend_per_mm(outline.length_mm());
  const auto handicap = [&](double place) {
    return 0.5 * by_prior * std::pow(place - rule.prior, 2);
  };
  const SkinBorder smooth = border.smoothed_over(kSmoothingMm);
  auto peak = smooth.furthest(rule.from, rule.to, handicap);
  const SkinBorder skin = on_skin(outline, border, rule);
  const SkinBorder told = told_part(outline, skin);
  const double place = peak ? peak->along : rule.prior;
  const double from = std::min(place, rule.prior) - rule.patch_mm;
  const double to = std::max(place, rule.prior) + rule.patch_mm;
  if (has_gap(told, from, to)) {
    // A wall of which nothing was seen reaches about as far as what was put below its rim.
    const SkinBorder& guessed = outline.has_unseen_points() ? border : skin;
    if (auto hidden = hidden_point(outline, told, guessed, rule)) return hidden;
  }
  if (!peak) return std::nullopt;
  if (const auto crest = crest_in_range(outline, border, *peak, rule)) peak = crest;
  if (!is_on_skin(outline, border, *peak)) return std::nullopt;
  // What holds the place is how the border falls off to either side, and how the handicap does.
  const double by_shape = std::max(0.0, -peak->bend);
  const double share = by_shape / (by_shape + by_prior);
  return Landmark{border.position(*peak),
                  kPriorConfidence + (kMostConfidence - kPriorConfidence) * share, rule.name};
}

/// The highest point of the section over two points.
std::optional<Eigen::Vector3d> top_over(const FootOutline& outline, const Eigen::Vector3d& medial,
                                        const Eigen::Vector3d& lateral) {
  constexpr double kSlabMm = 15.0;
  const Eigen::Vector3d up = Eigen::Vector3d::UnitZ();
  Eigen::Vector3d across = medial - lateral;
  across.z() = 0.0;
  if (!(across.norm() > 1.0)) return std::nullopt;
  across.normalize();
  const Eigen::Vector3d along = across.cross(up);
  const double place = along.dot(medial);
  std::vector<Eigen::Vector3d> slab;
  for (const auto& point : outline.points()) {
    if (std::abs(along.dot(point) - place) < kSlabMm) slab.push_back(point);
  }
  const SkinBorder section(slab, {along, up, across, across.dot(lateral), across.dot(medial)},
                           kBorderSmoothingMm);
  const auto top = section.at(place);
  return top ? std::optional(section.position(*top)) : std::nullopt;
}

/// What a hidden point that lies so much less far out leaves open of the furthest one, as one
/// standard deviation: by how much it may be further out than that after all.
std::vector<Eigen::Vector3d> may_be_further(const Landmark& hidden, double less_mm,
                                            const Eigen::Vector3d& outwards) {
  double squares = 0.0;
  for (const auto& off : hidden.deviations_off_mm) squares += std::pow(outwards.dot(off), 2);
  const double further = std::sqrt(squares) - less_mm / kDeviations;
  if (!(further > 0.0)) return {};
  return {further * outwards};
}

/// `metatarsal`: the point of the ball on that border.
std::optional<Landmark> broadest(const FootOutline& outline, const SkinBorder& border,
                                 const Landmark& metatarsal) {
  const double length = outline.length_mm();
  const auto peak = border.furthest(0.50 * length, 0.85 * length);
  if (!peak) return std::nullopt;
  Landmark furthest{border.position(*peak), 0.9,
                    "furthest point of the outline in 0.50-0.85 of the foot's length"};
  const bool is_skin = is_on_skin(outline, border, *peak);
  if (metatarsal.deviations_off_mm.empty()) {
    return is_skin ? std::optional(furthest) : std::nullopt;
  }
  const Eigen::Vector3d& outwards = border.view().outwards;
  const double less = outwards.dot(furthest.position_mm - metatarsal.position_mm);
  if (less < 0.0) {
    furthest = metatarsal;
    furthest.rule = "as the point of the ball, where the outline was not seen";
  } else if (!is_skin) {
    furthest.rule += "; a rim, beyond which it was not seen";
    furthest.confidence = std::min(furthest.confidence, metatarsal.confidence);
  }
  // Beyond a rim the border may go on, however far the point of the ball is behind it.
  const double surely = is_skin ? std::max(0.0, less) : 0.0;
  furthest.deviations_off_mm = may_be_further(metatarsal, surely, outwards);
  return furthest;
}

}  // namespace

std::optional<Landmark> find_metatarsale_tibiale(const FootOutline& outline) {
  const double length = outline.length_mm();
  return most_protruding(
      outline, outline.medial(),
      {0.60 * length, 0.80 * length, 0.69 * length, kTibialePatchMm, kUsuallyMedial,
       "most medial point of the outline in 0.60-0.80 of the foot's length, weighed by "
       "nearness to 0.69"});
}

std::optional<Landmark> find_metatarsale_fibulare(const FootOutline& outline,
                                                  const Landmark& tibiale) {
  const double length = outline.length_mm();
  const double foremost = std::min(0.75 * length, tibiale.position_mm.x() - kBehindTibialeMm);
  return most_protruding(
      outline, outline.lateral(),
      {0.50 * length, foremost, std::min(0.63 * length, foremost), kFibularePatchMm,
       kUsuallyLateral,
       "most lateral point of the outline in 0.50-0.75 of the foot's length, weighed by "
       "nearness to 0.63"});
}

std::optional<Landmark> find_ball_medial(const FootOutline& outline, const Landmark& tibiale) {
  return broadest(outline, outline.medial(), tibiale);
}

std::optional<Landmark> find_ball_lateral(const FootOutline& outline, const Landmark& fibulare) {
  return broadest(outline, outline.lateral(), fibulare);
}

std::optional<Landmark> find_ball_top(const FootOutline& outline, const Landmark& tibiale,
                                      const Landmark& fibulare) {
  const auto top = top_over(outline, tibiale.position_mm, fibulare.position_mm);
  if (!top || !is_skin_all_round(outline.points(), *top, Eigen::Vector3d::UnitZ())) {
    return std::nullopt;
  }
  Landmark found{*top, 0.8, "highest point of the ball's section"};
  double squares = 0.0;
  const auto rise = [&](const Eigen::Vector3d& medial, const Eigen::Vector3d& lateral) {
    const auto other = top_over(outline, medial, lateral);
    if (other) squares += std::pow(other->z() - top->z(), 2);
  };
  for (const auto& off : tibiale.deviations_off_mm) {
    rise(tibiale.position_mm + off, fibulare.position_mm);
  }
  for (const auto& off : fibulare.deviations_off_mm) {
    rise(tibiale.position_mm, fibulare.position_mm + off);
  }
  if (squares > 0.0) found.deviations_off_mm.emplace_back(0.0, 0.0, std::sqrt(squares));
  return found;
}

}  // namespace instep
