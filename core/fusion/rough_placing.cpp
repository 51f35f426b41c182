#include "core/fusion/rough_placing.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "core/stride.h"

namespace instep {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double kDegree = std::numbers::pi / 180.0;
/// What is seen through speaks against a place more than what is confirmed speaks for it: a wall
/// confirms any other wall.
constexpr double kAgainst = 2.0;
/// How often the steps are halved at the best places.
constexpr int kHalvings = 3;
constexpr int kMovesAStep = 20;  // at most

/// Some of a view's points, evenly.
std::vector<Vector3d> some_of(const std::vector<Vector3d>& skin, std::size_t most) {
  const std::size_t stride = stride_to_at_most(most, skin.size());
  std::vector<Vector3d> some;
  for (std::size_t i = 0; i < skin.size(); i += stride) some.push_back(skin[i]);
  return some;
}

Vector2d middle_of(const std::vector<Vector3d>& points) {
  Vector2d sum = Vector2d::Zero();
  for (const auto& point : points) sum += point.head<2>();
  return sum / static_cast<double>(std::max<std::size_t>(1, points.size()));
}

/// Where a view may stand: turned about the middle of its skin, then shifted.
struct Place {
  double turn_deg = 0.0;
  Vector2d shift = Vector2d::Zero();
  double agreement = 0.0;  ///< of the points that were asked about, at most 1

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
  PlaceSearch(const std::vector<LevelView>& views, const std::vector<std::size_t>& placed,
              const std::vector<RigidTransform>& moves, std::size_t sought,
              const RoughPlacing& settings)
      : settings_(settings),
        own_witness_(views[sought].posed),
        own_(some_of(views[sought].skin, settings.points)),
        own_middle_(middle_of(own_)) {
    for (const std::size_t at : placed) {
      auto posed = views[at].posed;
      posed.station_from_camera = moves[at] * posed.station_from_camera;
      witnesses_.emplace_back(posed);
      for (const auto& point : some_of(views[at].skin, settings.points)) {
        known_.push_back(moves[at] * point);
      }
    }
    known_middle_ = middle_of(known_);
  }

  /// The best there is.
  Place best() const {
    auto places = looked_at_all_over();
    const std::size_t kept = std::min(settings_.best_kept, places.size());
    std::partial_sort(places.begin(), places.begin() + static_cast<std::ptrdiff_t>(kept),
                      places.end(),
                      [](const Place& a, const Place& b) { return a.agreement > b.agreement; });
    Place best;
    best.agreement = -kAgainst;
    for (std::size_t i = 0; i < kept; ++i) {
      const Place near = best_near(places[i]);
      if (near.agreement > best.agreement) best = near;
    }
    return best;
  }

  RigidTransform move_to(const Place& place) const { return place.new_from_given(own_middle_); }

 private:
  std::vector<Place> looked_at_all_over() const {
    const int turns = static_cast<int>(settings_.most_turn_deg / settings_.turn_step_deg);
    const int shifts = static_cast<int>(settings_.most_shift_mm / settings_.shift_step_mm);
    std::vector<Place> places;
    for (int turn = -turns; turn <= turns; ++turn) {
      for (int along = -shifts; along <= shifts; ++along) {
        for (int across = -shifts; across <= shifts; ++across) {
          const Vector2d aside = settings_.shift_step_mm * Vector2d(along, across);
          places.push_back(
              judged({turn * settings_.turn_step_deg, known_middle_ - own_middle_ + aside, 0.0},
                     settings_.margin_mm));
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
      const double margin = settings_.margin_mm * std::max(share, 0.5);
      place = judged(place, margin);
      for (int move = 0; move < kMovesAStep; ++move) {
        const Place next = best_neighbour(place, share, margin);
        if (!(next.agreement > place.agreement)) break;
        place = next;
      }
    }
    return place;
  }

  Place best_neighbour(const Place& place, double share, double margin) const {
    Place best = place;
    for (int turn = -1; turn <= 1; ++turn) {
      for (int along = -1; along <= 1; ++along) {
        for (int across = -1; across <= 1; ++across) {
          Place next = place;
          next.turn_deg += share * settings_.turn_step_deg * turn;
          next.shift += share * settings_.shift_step_mm * Vector2d(along, across);
          next = judged(next, margin);
          if (next.agreement > best.agreement) best = next;
        }
      }
    }
    return best;
  }

  Place judged(Place place, double margin) const {
    const RigidTransform move = place.new_from_given(own_middle_);
    double sum = 0.0;
    const auto ask = [&](const Witness& witness, const Vector3d& point) {
      const Verdict verdict = witness.judge(point, margin);
      if (verdict == Verdict::kConfirms) sum += 1.0;
      if (verdict == Verdict::kSeesThrough) sum -= kAgainst;
    };
    for (const auto& witness : witnesses_) {
      for (const auto& point : own_) ask(witness, move * point);
    }
    const RigidTransform back = move.inverse();
    for (const auto& point : known_) ask(own_witness_, back * point);
    place.agreement = sum / static_cast<double>(own_.size() * witnesses_.size() + known_.size());
    return place;
  }

  const RoughPlacing& settings_;
  Witness own_witness_;
  std::vector<Vector3d> own_;
  Vector2d own_middle_;
  std::vector<Witness> witnesses_;
  std::vector<Vector3d> known_;
  Vector2d known_middle_ = Vector2d::Zero();
};

std::size_t with_most_skin(const std::vector<LevelView>& views) {
  const auto most = std::max_element(
      views.begin(), views.end(),
      [](const LevelView& a, const LevelView& b) { return a.skin.size() < b.skin.size(); });
  return static_cast<std::size_t>(most - views.begin());
}

}  // namespace

Result<std::vector<RigidTransform>> place_roughly(const std::vector<LevelView>& views,
                                                  const RoughPlacing& settings, const GoOn& go_on) {
  std::vector<RigidTransform> moves(views.size(), RigidTransform::Identity());
  if (views.empty()) return moves;
  std::vector<std::size_t> placed = {with_most_skin(views)};
  std::vector<std::size_t> waiting;
  for (std::size_t i = 0; i < views.size(); ++i) {
    if (i != placed.front() && !views[i].skin.empty()) waiting.push_back(i);
  }
  while (!waiting.empty()) {
    std::optional<Place> plainest;
    std::size_t whose = 0;
    RigidTransform move = RigidTransform::Identity();
    for (const std::size_t at : waiting) {
      const PlaceSearch search(views, placed, moves, at, settings);
      const Place place = search.best();
      if (!go_on()) return cancelled();
      if (plainest && place.agreement <= plainest->agreement) continue;
      plainest = place;
      whose = at;
      move = search.move_to(place);
    }
    if (plainest->agreement < settings.least_agreement) break;
    moves[whose] = move;
    placed.push_back(whose);
    std::erase(waiting, whose);
  }
  return moves;
}

}  // namespace instep
