#include "core/girth/rough_tape.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <iterator>
#include <utility>

#include "core/geometry/plane_vectors.h"
#include "core/geometry/polygon.h"

namespace instep {
namespace {

using Eigen::Vector2d;

constexpr double kBandMm = 4.0;
constexpr std::size_t kSectors = 72;
constexpr std::size_t kFewestSectors = 24;
/// Points in a sector that lie deeper than this under its outermost are of another face.
constexpr double kDeepestMm = 8.0;
/// Points that stand out further than this over those round their sector are strays.
constexpr double kStandsOutMm = 4.0;
constexpr std::size_t kSectorsAround = 2;  ///< to each side

struct SectionPoint {
  Vector2d place;
  double weight = 0.0;
  std::size_t sector = 0;
  double distance = 0.0;  ///< from the middle
};

struct Sector {
  double furthest = 0.0;
  double weight = 0.0;
  Vector2d sum = Vector2d::Zero();
};

/// Leaves out single points that stand off the skin: none may reach much further than the second
/// furthest of the outermost points of its sector and those round it.
void drop_strays(std::vector<SectionPoint>& section) {
  std::array<double, kSectors> outermost{};
  for (const auto& point : section) {
    outermost[point.sector] = std::max(outermost[point.sector], point.distance);
  }
  std::array<double, kSectors> usual{};
  for (std::size_t sector = 0; sector < kSectors; ++sector) {
    std::array<double, 2 * kSectorsAround + 1> around{};
    for (std::size_t i = 0; i < around.size(); ++i) {
      around[i] = outermost[(sector + kSectors - kSectorsAround + i) % kSectors];
    }
    std::nth_element(around.begin(), std::next(around.begin()), around.end(), std::greater<>());
    usual[sector] = around[1];
  }
  std::erase_if(section, [&](const SectionPoint& point) {
    return point.distance > usual[point.sector] + kStandsOutMm;
  });
}

}  // namespace

std::optional<double> rough_tape(const std::vector<Eigen::Vector3d>& points,
                                 const TapePlane& plane) {
  std::vector<SectionPoint> section;
  Eigen::AlignedBox2d box;
  for (const auto& point : points) {
    const double off = plane.distance(point) / kBandMm;
    if (std::abs(off) >= 1.0) continue;
    section.push_back({plane.project(point), 1.0 - off * off});
    box.extend(section.back().place);
  }
  if (section.size() < kFewestSectors) return std::nullopt;
  const Vector2d middle = box.center();
  std::array<Sector, kSectors> sectors;
  for (auto& point : section) {
    const Vector2d arm = point.place - middle;
    point.sector = sector_of(arm, kSectors);
    point.distance = arm.norm();
  }
  drop_strays(section);
  for (const auto& point : section) {
    auto& furthest = sectors[point.sector].furthest;
    furthest = std::max(furthest, point.distance);
  }
  for (const auto& point : section) {
    auto& sector = sectors[point.sector];
    if (point.distance < sector.furthest - kDeepestMm) continue;
    sector.weight += point.weight;
    sector.sum += point.weight * point.place;
  }
  std::vector<Vector2d> ring;
  for (const auto& sector : sectors) {
    if (sector.weight > 0.0) ring.push_back(sector.sum / sector.weight);
  }
  if (ring.size() < kFewestSectors) return std::nullopt;
  return perimeter(convex_hull(std::move(ring)));
}

}  // namespace instep
