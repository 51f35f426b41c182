#include "core/fusion/poses/rough_placing.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstdint>
#include <unordered_map>

#include "core/degree.h"
#include "core/mean.h"
#include "core/stride.h"
#include "core/while_wanted.h"

namespace instep {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

/// How far a camera may stand from where it is said to: its view is sought turned by up to that,
/// and with its middle so far from that of what is known of the object already. This and what
/// follows is set by eye.
constexpr double kMostTurnDeg = 40.0;
constexpr double kMostShiftMm = 120.0;
constexpr double kTurnStepDeg = 5.0;
constexpr double kShiftStepMm = 12.0;
/// How near a spot must lie to the other view's skin to agree with it, about, and how far before
/// what that sees to contradict it; half of it at the end.
constexpr double kMarginMm = 12.0;
constexpr std::size_t kAskedSpots = 200;  // of a view's skin
constexpr std::size_t kBestKept = 8;      // places that are looked at closer
constexpr double kLeastAgreement = 0.1;   // of the asked spots
/// What is seen through speaks against a place more than what is confirmed speaks for it: a wall
/// confirms any other wall.
constexpr double kAgainst = 2.0;
/// Between normals of the same skin as two views see it, turned by half a step.
constexpr double kLeastCosine = 0.8;
/// How often the steps are halved at the best places.
constexpr int kHalvings = 3;
constexpr int kMovesAStep = 6;  // at most

/// A place of the object's surface.
struct Spot {
  Vector3d point;
  Vector3d normal;

  Spot moved(const RigidTransform& move) const { return {move * point, move.linear() * normal}; }
};

/// Those of a view that are asked about, evenly.
std::vector<Spot> asked_spots(const PointCloud& skin) {
  const std::size_t stride = stride_to_at_most(kAskedSpots, skin.size());
  std::vector<Spot> some;
  for (std::size_t i = 0; i < skin.size(); i += stride) {
    some.push_back({skin.positions[i], skin.normals[i]});
  }
  return some;
}

Vector2d middle_of(const std::vector<Spot>& spots) {
  return mean_of(spots, [](const Spot& spot) -> Vector2d { return spot.point.head<2>(); });
}

/// How the surface of what a view shows lies, roughly, wherever it is near.
class LeanMap {
 public:
  LeanMap(const PointCloud& skin, double cell_mm) : cell_mm_(cell_mm) {
    for (std::size_t i = 0; i < skin.size(); ++i) {
      const Eigen::Vector3i cell = cell_of(skin.positions[i]);
      for (int near = 0; near < 27; ++near) {
        const Eigen::Vector3i step(near % 3 - 1, near / 3 % 3 - 1, near / 9 - 1);
        leans_.try_emplace(key_of(cell + step), Vector3d::Zero()).first->second += skin.normals[i];
      }
    }
    for (auto& lean : leans_) lean.second.normalize();
  }

  bool agrees_with(const Spot& spot) const {
    const auto lean = leans_.find(key_of(cell_of(spot.point)));
    return lean != leans_.end() && lean->second.dot(spot.normal) >= kLeastCosine;
  }

 private:
  Eigen::Vector3i cell_of(const Vector3d& point) const {
    return (point / cell_mm_).array().floor().cast<int>();
  }
  /// Of cells within 2^20 of the origin, which all near a station are.
  static std::uint64_t key_of(const Eigen::Vector3i& cell) {
    const auto part = [](int number) { return static_cast<std::uint64_t>(number + (1 << 20)); };
    return (part(cell.x()) << 42) | (part(cell.y()) << 21) | part(cell.z());
  }

  double cell_mm_;
  std::unordered_map<std::uint64_t, Vector3d> leans_;
};

/// A view that is asked what it thinks of spots of another's skin.
class SkinWitness {
 public:
  SkinWitness(const LevelView& view, double margin_mm)
      : witness_(view.posed), leans_(view.skin, margin_mm), margin_mm_(margin_mm) {}

  /// `spot`: in the station as this view was given in it.
  double judge(const Spot& spot) const {
    if (leans_.agrees_with(spot)) return 1.0;
    return witness_.judge(spot.point, margin_mm_) == Verdict::kSeesThrough ? -kAgainst : 0.0;
  }

 private:
  Witness witness_;
  LeanMap leans_;
  double margin_mm_;
};

/// Each view as a witness with a wide margin and with a narrow one.
struct Witnesses {
  std::vector<SkinWitness> wide;
  std::vector<SkinWitness> narrow;
};

/// Where a view may stand: turned about the middle of its skin, then shifted.
struct Place {
  double turn_deg = 0.0;
  Vector2d shift = Vector2d::Zero();
  double agreement = 0.0;  ///< of the spots that were asked about, at most 1 for each other view

  RigidTransform new_from_given(const Vector2d& middle) const {
    const Vector3d centre(middle.x(), middle.y(), 0.0);
    RigidTransform moved = RigidTransform::Identity();
    moved.linear() = Eigen::AngleAxisd(turn_deg * kDegree, Vector3d::UnitZ()).toRotationMatrix();
    moved.translation() = centre + Vector3d(shift.x(), shift.y(), 0.0) - moved.linear() * centre;
    return moved;
  }
};

/// The views that have their place, as they stand now, and one that is sought.
class PlaceSearch {
 public:
  PlaceSearch(const std::vector<LevelView>& views, const Witnesses& witnesses,
              const std::vector<std::size_t>& placed, const std::vector<RigidTransform>& moves,
              std::size_t sought)
      : witnesses_(witnesses),
        placed_(placed),
        sought_(sought),
        own_(asked_spots(views[sought].skin)),
        own_middle_(middle_of(own_)) {
    for (const std::size_t at : placed) {
      given_from_new_.push_back(moves[at].inverse());
      for (const auto& spot : asked_spots(views[at].skin)) {
        known_.push_back(spot.moved(moves[at]));
      }
    }
    known_middle_ = middle_of(known_);
    asked_ = static_cast<double>(own_.size()) +
             static_cast<double>(known_.size()) / static_cast<double>(placed.size());
  }

  /// The best there is; any if it is no longer wanted.
  Place best(const GoOn& go_on) const {
    auto places = looked_at_all_over(go_on);
    const std::size_t kept = std::min(kBestKept, places.size());
    std::partial_sort(places.begin(), places.begin() + static_cast<std::ptrdiff_t>(kept),
                      places.end(),
                      [](const Place& a, const Place& b) { return a.agreement > b.agreement; });
    Place best;
    best.agreement = -kAgainst;
    for (std::size_t i = 0; i < kept && go_on(); ++i) {
      const Place near = best_near(places[i]);
      if (near.agreement > best.agreement) best = near;
    }
    return best;
  }

  RigidTransform move_to(const Place& place) const { return place.new_from_given(own_middle_); }

 private:
  std::vector<Place> looked_at_all_over(const GoOn& go_on) const {
    constexpr int kTurns = static_cast<int>(kMostTurnDeg / kTurnStepDeg);
    constexpr int kShifts = static_cast<int>(kMostShiftMm / kShiftStepMm);
    std::vector<Place> places;
    for (int turn = -kTurns; turn <= kTurns && go_on(); ++turn) {
      for (int along = -kShifts; along <= kShifts; ++along) {
        for (int across = -kShifts; across <= kShifts; ++across) {
          const Vector2d aside = kShiftStepMm * Vector2d(along, across);
          places.push_back(judged({turn * kTurnStepDeg, known_middle_ - own_middle_ + aside, 0.0},
                                  witnesses_.wide));
        }
      }
    }
    return places;
  }

  /// Goes to the best of its neighbours as long as one is better, with shorter and shorter steps.
  Place best_near(Place place) const {
    double share = 1.0;
    for (int halving = 0; halving < kHalvings; ++halving) {
      share *= 0.5;
      place = judged(place, witnesses_.narrow);
      for (int move = 0; move < kMovesAStep; ++move) {
        const Place next = best_neighbour(place, share);
        if (!(next.agreement > place.agreement)) break;
        place = next;
      }
    }
    return place;
  }

  /// Within the limits, give or take a step.
  bool is_within_limits(const Place& place) const {
    const Vector2d aside = place.shift - (known_middle_ - own_middle_);
    return std::abs(place.turn_deg) <= kMostTurnDeg + kTurnStepDeg &&
           aside.cwiseAbs().maxCoeff() <= kMostShiftMm + kShiftStepMm;
  }

  Place best_neighbour(const Place& place, double share) const {
    Place best = place;
    for (int turn = -1; turn <= 1; ++turn) {
      for (int along = -1; along <= 1; ++along) {
        for (int across = -1; across <= 1; ++across) {
          Place next = place;
          next.turn_deg += share * kTurnStepDeg * turn;
          next.shift += share * kShiftStepMm * Vector2d(along, across);
          if (!is_within_limits(next)) continue;
          next = judged(next, witnesses_.narrow);
          if (next.agreement > best.agreement) best = next;
        }
      }
    }
    return best;
  }

  Place judged(Place place, const std::vector<SkinWitness>& witnesses) const {
    const RigidTransform move = place.new_from_given(own_middle_);
    double sum = 0.0;
    for (std::size_t i = 0; i < placed_.size(); ++i) {
      const RigidTransform other_from_own = given_from_new_[i] * move;
      const SkinWitness& other = witnesses[placed_[i]];
      for (const auto& spot : own_) sum += other.judge(spot.moved(other_from_own));
    }
    const RigidTransform back = move.inverse();
    for (const auto& spot : known_) sum += witnesses[sought_].judge(spot.moved(back));
    place.agreement = sum / asked_;
    return place;
  }

  const Witnesses& witnesses_;
  const std::vector<std::size_t>& placed_;
  std::size_t sought_;
  std::vector<Spot> own_;
  Vector2d own_middle_;
  std::vector<RigidTransform> given_from_new_;  ///< of each that is placed
  std::vector<Spot> known_;
  Vector2d known_middle_ = Vector2d::Zero();
  double asked_ = 0.0;  ///< spots of a pair of views
};

Witnesses witnesses_of(const std::vector<LevelView>& views) {
  Witnesses witnesses;
  for (const auto& view : views) {
    witnesses.wide.emplace_back(view, kMarginMm);
    witnesses.narrow.emplace_back(view, 0.5 * kMarginMm);
  }
  return witnesses;
}

std::size_t with_most_skin(const std::vector<LevelView>& views) {
  const auto most = std::max_element(
      views.begin(), views.end(),
      [](const LevelView& a, const LevelView& b) { return a.skin.size() < b.skin.size(); });
  return static_cast<std::size_t>(most - views.begin());
}

}  // namespace

Result<std::vector<RigidTransform>> place_roughly(const std::vector<LevelView>& views,
                                                  const Workers& workers, const GoOn& go_on) {
  std::vector<RigidTransform> moves(views.size(), RigidTransform::Identity());
  if (views.empty()) return moves;
  const Witnesses witnesses = witnesses_of(views);
  std::vector<std::size_t> placed = {with_most_skin(views)};
  std::vector<std::size_t> waiting;
  for (std::size_t i = 0; i < views.size(); ++i) {
    if (i != placed.front() && !views[i].skin.empty()) waiting.push_back(i);
  }
  std::atomic<bool> wanted = true;
  // A search asks for each of its pieces, and nobody asks again after the first no.
  const GoOn still_wanted = [&] {
    if (wanted && !go_on()) wanted = false;
    return wanted.load();
  };
  const Workers search_each = while_wanted(workers, still_wanted, wanted);
  while (!waiting.empty()) {
    std::vector<Place> places(waiting.size());
    std::vector<RigidTransform> ways(waiting.size());
    search_each(waiting.size(), [&](std::size_t i) {
      const PlaceSearch search(views, witnesses, placed, moves, waiting[i]);
      places[i] = search.best(still_wanted);
      ways[i] = search.move_to(places[i]);
    });
    if (!wanted) return cancelled();
    const auto plainest = static_cast<std::size_t>(
        std::max_element(places.begin(), places.end(),
                         [](const Place& a, const Place& b) { return a.agreement < b.agreement; }) -
        places.begin());
    if (places[plainest].agreement < kLeastAgreement) break;
    moves[waiting[plainest]] = ways[plainest];
    placed.push_back(waiting[plainest]);
    waiting.erase(waiting.begin() + static_cast<std::ptrdiff_t>(plainest));
  }
  return moves;
}

}  // namespace instep
