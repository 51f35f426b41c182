#include "core/foot/standing/things_beside.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <optional>
#include <utility>

#include "core/foot/cloud/skin_pieces.h"
#include "core/geometry/moments.h"
#include "core/geometry/place_hash.h"
#include "core/geometry/point_index.h"
#include "core/geometry/point_spacing.h"
#include "core/girth/contour/section_gaps.h"
#include "core/picked.h"

namespace instep {
namespace {

using Eigen::Vector3d;
using Points = std::vector<Vector3d>;
using Piece = std::vector<std::size_t>;

constexpr std::size_t kMostPoints = 20000;
constexpr double kBodyShare = 0.4;
constexpr double kFewPointsShare = 0.005;  ///< a piece smaller than this is a handful of strays
constexpr std::size_t kFewPoints = 12;
constexpr std::size_t kLooks = 300;  ///< places of a piece at which it is looked at
constexpr double kNearMm = 80.0;     ///< a place farther from the skin does not face it
constexpr double kFacingShare = 0.6;
constexpr double kUpright = 0.7;  ///< cosine of the way to a place with the skin's normal
constexpr double kSkinMm = 5.0;   ///< round a place, that tells how the skin lies there
constexpr double kSkinSpacings = 3.0;
constexpr std::size_t kSkinPoints = 64;  ///< there at most
constexpr double kBulkMm = 40.0;         ///< round a place, that tells on which side the body is
constexpr std::size_t kBulkPoints = 3000;
constexpr double kWidestOpening = 2.0 * std::numbers::pi / 3.0;  ///< round a place within the skin
constexpr double kSeenGapSpacings = 1.4;

Points places_of(const Points& points, const Piece& piece, std::size_t most) {
  const Points all = picked(points, piece);
  return picked(all, some_by_place(all, most));
}

/// The skin of a body, and on which side of it the body is.
class Skin {
 public:
  explicit Skin(Points points) : index_(std::move(points)) {
    const auto& all = index_.points();
    bulk_ = picked(all, some_by_place(all, kBulkPoints));
    for (const auto& point : bulk_) middle_ += point / static_cast<double>(bulk_.size());
  }

  double distance_to(const Vector3d& place) const {
    return std::sqrt(index_.nearest(place, 1).front().squared_distance);
  }

  /// Whether the way from the skin to a place leaves it upright, outwards and from within its
  /// borders.
  bool faces(const Vector3d& place) const {
    const Vector3d start = index_.points()[index_.nearest(place, 1).front().index];
    const Vector3d way = (place - start).normalized();
    const double reach = std::max(kSkinMm, kSkinSpacings * own_spacing(index_, start));
    Points around;
    Moments moments;
    for (const auto& other : index_.nearest(start, kSkinPoints)) {
      if (other.squared_distance > reach * reach) break;
      around.push_back(index_.points()[other.index] - start);
      moments.add(around.back());
    }
    const Vector3d normal = moments.flattest();
    return std::abs(normal.dot(way)) > kUpright && is_outwards(start, way) &&
           is_within(around, normal);
  }

 private:
  bool is_outwards(const Vector3d& start, const Vector3d& way) const {
    Vector3d near = Vector3d::Zero();
    for (const auto& point : bulk_) {
      if ((point - start).squaredNorm() < kBulkMm * kBulkMm) near += point - start;
    }
    return way.dot(near) < 0.0 || way.dot(middle_ - start) < 0.0;
  }

  static bool is_within(const Points& around, const Vector3d& normal) {
    const Vector3d across = normal.unitOrthogonal();
    const Vector3d along = normal.cross(across);
    std::vector<double> turns;
    for (const auto& arm : around) {
      if (arm.squaredNorm() > 0.0) turns.push_back(std::atan2(arm.dot(along), arm.dot(across)));
    }
    if (turns.size() < 3) return false;
    std::sort(turns.begin(), turns.end());
    return largest_gap_between(turns, 2.0 * std::numbers::pi) < kWidestOpening;
  }

  PointIndex index_;
  Points bulk_;
  Vector3d middle_ = Vector3d::Zero();
};

bool is_beside(const Skin& skin, const Points& places) {
  std::size_t near = 0;
  std::size_t facing = 0;
  for (const auto& place : places) {
    if (skin.distance_to(place) > kNearMm) continue;
    ++near;
    if (skin.faces(place)) ++facing;
  }
  return near > 0 && static_cast<double>(facing) >= kFacingShare * static_cast<double>(near);
}

/// Tells things from the body piece by piece, one way of parting after the other.
class Telling {
 public:
  enum class Kind : std::uint8_t { kUntold, kBody, kThing };

  Telling(const Points& points, double most_share)
      : points_(points), most_share_(most_share), kinds_(points.size(), Kind::kUntold) {}

  void look_at(SkinPieces::Pieces pieces) {
    for (auto& piece : pieces) {
      std::erase_if(piece, [&](std::size_t point) { return kinds_[point] == Kind::kThing; });
    }
    std::stable_sort(pieces.begin(), pieces.end(), [](const Piece& one, const Piece& other) {
      return one.size() > other.size();
    });
    const Piece& body = pieces.front();
    const auto all = static_cast<double>(points_.size());
    if (static_cast<double>(body.size()) < kBodyShare * all) return;
    const double few = std::max<double>(kFewPoints, kFewPointsShare * all);
    const double many = most_share_ * static_cast<double>(body.size());
    std::optional<Skin> skin;  // few feet have another piece
    SkinPieces::Pieces things;
    SkinPieces::Pieces kept;
    for (std::size_t i = 1; i < pieces.size(); ++i) {
      const auto size = static_cast<double>(pieces[i].size());
      if (size < few) break;
      if (!skin) skin.emplace(places_of(points_, body, body.size()));
      const bool is_thing = size <= many && is_beside(*skin, places_of(points_, pieces[i], kLooks));
      (is_thing ? things : kept).push_back(std::move(pieces[i]));
    }
    tell(body, Kind::kBody);
    for (const auto& piece : things) tell(piece, Kind::kThing);
    if (skin) tell_kept(kept, *skin);
  }

  bool has_things() const { return has_things_; }
  const std::vector<Kind>& kinds() const { return kinds_; }

 private:
  void tell(const Piece& piece, Kind kind) {
    for (const std::size_t point : piece) kinds_[point] = kind;
    has_things_ = has_things_ || kind == Kind::kThing;
  }

  /// What does not face the body may be a part of a thing that faces it, as the far side of another
  /// foot: only what is nearer to the body is of it.
  void tell_kept(const SkinPieces::Pieces& kept, const Skin& skin) {
    Points things;
    for (std::size_t i = 0; i < points_.size(); ++i) {
      if (kinds_[i] == Kind::kThing) things.push_back(points_[i]);
    }
    if (things.empty()) return;
    const PointIndex index(std::move(things));
    for (const auto& piece : kept) {
      double to_body = 1e300;
      double to_thing = 1e300;
      for (const auto& place : places_of(points_, piece, kLooks)) {
        to_body = std::min(to_body, skin.distance_to(place));
        to_thing = std::min(to_thing, std::sqrt(index.nearest(place, 1).front().squared_distance));
      }
      if (to_body <= to_thing) tell(piece, Kind::kBody);
    }
  }

  const Points& points_;
  double most_share_;
  std::vector<Kind> kinds_;
  bool has_things_ = false;
};

/// All points go with the nearest of those that were told.
void hand_out(ThingsBeside& things, const Points& points, const Points& told,
              const std::vector<Telling::Kind>& kinds) {
  Points known;
  std::vector<bool> is_thing;
  Points body;
  for (std::size_t i = 0; i < told.size(); ++i) {
    if (kinds[i] == Telling::Kind::kUntold) continue;
    known.push_back(told[i]);
    is_thing.push_back(kinds[i] == Telling::Kind::kThing);
    if (!is_thing.back()) body.push_back(told[i]);
  }
  const PointIndex known_index(std::move(known));
  const PointIndex body_index(std::move(body));
  things.gap_mm = 1e300;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (!is_thing[known_index.nearest(points[i], 1).front().index]) continue;
    things.points.push_back(i);
    things.gap_mm = std::min(things.gap_mm,
                             std::sqrt(body_index.nearest(points[i], 1).front().squared_distance));
  }
  const auto count = static_cast<double>(things.points.size());
  things.share = count / (static_cast<double>(points.size()) - count);
}

}  // namespace

ThingsBeside things_beside(const Points& points, double most_share) {
  ThingsBeside things;
  if (points.size() < kFewPoints) return things;
  const Points some = picked(points, some_by_place(points, kMostPoints));
  const SkinPieces parted(some);
  Telling telling(some, most_share);
  telling.look_at(parted.within_reach());
  telling.look_at(parted.within_least_reach());
  telling.look_at(parted.along_skin());
  if (!telling.has_things()) return things;
  hand_out(things, points, some, telling.kinds());
  things.is_gap_seen = things.gap_mm > kSeenGapSpacings * parted.usual_spacing();
  return things;
}

}  // namespace instep
