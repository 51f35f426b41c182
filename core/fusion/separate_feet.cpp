#include "core/fusion/separate_feet.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>
#include <optional>

#include "core/geometry/plane_vectors.h"
#include "core/geometry/point_index.h"
#include "core/geometry/polygon.h"
#include "core/geometry/rectangle.h"
#include "core/geometry/voxel_grid.h"
#include "core/mean.h"

namespace instep {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double kLinkMm = 4.0;  // points within about this (up to twice) belong together
constexpr double kMostLengthMm = 350.0;
constexpr double kMostWidthMm = 155.0;
constexpr double kLeastLengthMm = 120.0;  // no foot that can be measured is shorter
constexpr double kMostGapMm = 40.0;  // between two pieces of one foot, where no camera saw between
constexpr double kStandsBelowMm = 45.0;  // a foot comes this near to the platform; a leg does not
constexpr double kLeastShare = 0.15;  // of the larger foot's surface that the other one must have
constexpr std::size_t kMostPieces = 40;      // the largest ones; the rest is small
constexpr double kLargeShare = 0.02;         // of the largest piece's surface
constexpr double kWidestFoot = 0.55;         // width over length
constexpr double kFootLikeLengthMm = 120.0;  // a piece as long as this may be a foot by itself
constexpr double kOutlineMarginMm = 6.0;     // a small piece may lie so far outside the outline
constexpr double kSplitBandMm = 8.0;         // width of the strip that is searched for a waist
constexpr double kLeastSplitShare = 0.25;    // of a piece on the smaller side of a split
constexpr double kWaistShare = 0.7;          // of the most ground at a line, between two feet
constexpr double kNotableShare = 0.05;       // of the larger foot's surface, of a part left out
constexpr double kCrumbMm = 40.0;            // shorter, it is not worth a word

/// Connected cells, each standing for the points in it.
struct Piece {
  std::vector<Vector3d> cells;
  std::vector<std::size_t> points;
  double lowest_mm = std::numeric_limits<double>::infinity();

  std::vector<Vector2d> hull() const {
    std::vector<Vector2d> plan;
    for (const auto& cell : cells) plan.push_back(cell.head<2>());
    return convex_hull(std::move(plan));
  }
};

Piece joined(const Piece& a, const Piece& b) {
  Piece piece = a;
  piece.cells.insert(piece.cells.end(), b.cells.begin(), b.cells.end());
  piece.points.insert(piece.points.end(), b.points.begin(), b.points.end());
  piece.lowest_mm = std::min(a.lowest_mm, b.lowest_mm);
  return piece;
}

bool larger(const Piece& a, const Piece& b) {
  return a.cells.size() > b.cells.size();
}

std::vector<Piece> find_pieces(const std::vector<Vector3d>& positions) {
  const VoxelGrid grid(positions, kLinkMm);
  const auto clusters = grid.clusters();
  std::vector<Piece> pieces;
  for (std::size_t cell = 0; cell < grid.cell_count(); ++cell) {
    if (clusters[cell] >= pieces.size()) pieces.resize(clusters[cell] + 1);
    auto& piece = pieces[clusters[cell]];
    for (const std::uint32_t index : grid.members(cell)) {
      piece.points.push_back(index);
      piece.lowest_mm = std::min(piece.lowest_mm, positions[index].z());
    }
    piece.cells.push_back(
        mean_of(grid.members(cell), [&](std::uint32_t index) { return positions[index]; }));
  }
  std::stable_sort(pieces.begin(), pieces.end(), larger);
  return pieces;
}

bool is_too_broad(const Piece& piece) {
  const auto sides = enclosing_rectangle(piece.hull());
  return sides.width > kWidestFoot * sides.length;
}

bool fits_a_foot(const Piece& piece) {
  const auto sides = enclosing_rectangle(piece.hull());
  return sides.length <= kMostLengthMm && sides.width <= kMostWidthMm;
}

double gap_between(const Piece& a, const Piece& b) {
  const auto& [small, large] = a.cells.size() < b.cells.size() ? std::tie(a, b) : std::tie(b, a);
  const PointIndex index(large.cells);
  double least = std::numeric_limits<double>::infinity();
  for (const auto& cell : small.cells) {
    least = std::min(least, index.nearest(cell, 1)[0].squared_distance);
  }
  return std::sqrt(least);
}

/// Whether two pieces can be parts of one foot.
bool may_join(const Piece& a, const Piece& b) {
  const Piece both = joined(a, b);
  if (!fits_a_foot(both)) return false;
  const bool two_feet = enclosing_rectangle(a.hull()).length > kFootLikeLengthMm &&
                        enclosing_rectangle(b.hull()).length > kFootLikeLengthMm;
  return !two_feet || !is_too_broad(both);
}

/// Joins the nearest two pieces that can be one foot, until none can.
void join_pieces(std::vector<Piece>& pieces) {
  for (;;) {
    double least = kMostGapMm;
    std::optional<std::pair<std::size_t, std::size_t>> nearest;
    for (std::size_t a = 0; a < pieces.size(); ++a) {
      for (std::size_t b = a + 1; b < pieces.size(); ++b) {
        const double gap = gap_between(pieces[a], pieces[b]);
        if (gap >= least || !may_join(pieces[a], pieces[b])) continue;
        least = gap;
        nearest = {a, b};
      }
    }
    if (!nearest) return;
    pieces[nearest->first] = joined(pieces[nearest->first], pieces[nearest->second]);
    pieces.erase(pieces.begin() + static_cast<std::ptrdiff_t>(nearest->second));
  }
}

/// A line in plan: points with direction.dot(xy) < offset lie on its first side.
struct SplitLine {
  Vector2d direction;
  double offset;
  bool is_at_waist;  ///< much less ground lies near it than near other lines
};

/// The ground that a piece covers, as squares of kLinkMm.
std::vector<Vector2d> covered_ground(const Piece& piece) {
  std::vector<std::pair<double, double>> squares;
  for (const auto& cell : piece.cells) {
    squares.emplace_back(std::floor(cell.x() / kLinkMm), std::floor(cell.y() / kLinkMm));
  }
  std::sort(squares.begin(), squares.end());
  squares.erase(std::unique(squares.begin(), squares.end()), squares.end());
  std::vector<Vector2d> ground;
  for (const auto& [x, y] : squares) ground.emplace_back((x + 0.5) * kLinkMm, (y + 0.5) * kLinkMm);
  return ground;
}

/// Of the parallel lines, the one with the least ground near it that leaves a fair part on both
/// sides.
std::optional<SplitLine> thinnest_line(const std::vector<Vector2d>& ground,
                                       const Vector2d& direction) {
  std::optional<SplitLine> best;
  const auto count = ground.size();
  const auto share = static_cast<std::size_t>(kLeastSplitShare * static_cast<double>(count));
  std::vector<double> offsets;
  for (const auto& square : ground) offsets.push_back(direction.dot(square));
  std::sort(offsets.begin(), offsets.end());
  std::size_t past = 0;
  std::size_t fewest = count;
  std::size_t most = 0;
  for (std::size_t first = share; first + share < count; ++first) {
    while (past < count && offsets[past] <= offsets[first] + kSplitBandMm) ++past;
    most = std::max(most, past - first);
    if (past + share > count || past - first >= fewest) continue;
    fewest = past - first;
    best = SplitLine{direction, offsets[first] + 0.5 * kSplitBandMm, false};
  }
  if (best) {
    best->is_at_waist = static_cast<double>(fewest) < kWaistShare * static_cast<double>(most);
  }
  return best;
}

std::array<Piece, 2> split_along(const Piece& piece, const SplitLine& line,
                                 const std::vector<Vector3d>& positions) {
  std::array<Piece, 2> sides;
  const auto side_of = [&](const Vector3d& point) -> Piece& {
    return sides[line.direction.dot(point.head<2>()) < line.offset ? 0 : 1];
  };
  for (const auto& cell : piece.cells) side_of(cell).cells.push_back(cell);
  for (const std::size_t index : piece.points) {
    auto& side = side_of(positions[index]);
    side.points.push_back(index);
    side.lowest_mm = std::min(side.lowest_mm, positions[index].z());
  }
  return sides;
}

/// Area of the rectangle round a piece, or infinity if no foot has such a rectangle.
double area_as_a_foot(const Piece& piece) {
  const auto sides = enclosing_rectangle(piece.hull());
  const bool fits = sides.length <= kMostLengthMm && sides.width <= kMostWidthMm &&
                    sides.width <= kWidestFoot * sides.length;
  return fits ? sides.length * sides.width : std::numeric_limits<double>::infinity();
}

/// Splits a piece that is too large for one foot, if that gives two feet: of the thinnest lines of
/// all directions the one that leaves the two tightest rectangles. One that is only too broad for
/// its length may be a forefoot alone; it is split at a waist.
void split_piece(std::vector<Piece>& pieces, std::size_t at,
                 const std::vector<Vector3d>& positions) {
  const bool is_too_large = !fits_a_foot(pieces[at]);
  if (!is_too_large && !is_too_broad(pieces[at])) return;
  std::optional<std::array<Piece, 2>> best;
  double least_area = std::numeric_limits<double>::infinity();
  const auto ground = covered_ground(pieces[at]);
  for (int degree = 0; degree < 180; degree += 5) {
    const double angle = degree * std::numbers::pi / 180.0;
    const auto line = thinnest_line(ground, {std::cos(angle), std::sin(angle)});
    if (!line || !(is_too_large || line->is_at_waist)) continue;
    auto sides = split_along(pieces[at], *line, positions);
    const double area = area_as_a_foot(sides[0]) + area_as_a_foot(sides[1]);
    if (area >= least_area) continue;
    least_area = area;
    best = std::move(sides);
  }
  if (!best) return;
  pieces[at] = std::move((*best)[0]);
  pieces.push_back(std::move((*best)[1]));
}

/// Gives the small pieces to the foot whose outline they lie in. What is left of them.
std::vector<Piece> adopt(std::vector<Piece>& feet, std::vector<Piece> small) {
  std::vector<std::vector<Vector2d>> hulls;
  for (const auto& foot : feet) hulls.push_back(foot.hull());
  std::erase_if(small, [&](const Piece& piece) {
    const auto middle =
        mean_of(piece.cells, [](const Vector3d& cell) -> Vector2d { return cell.head<2>(); });
    for (std::size_t i = 0; i < feet.size(); ++i) {
      if (depth_in(hulls[i], middle) < -kOutlineMarginMm) continue;
      feet[i].points.insert(feet[i].points.end(), piece.points.begin(), piece.points.end());
      return true;
    }
    return false;
  });
  return small;
}

/// Whether it comes down to where a foot stands.
bool stands(const Piece& piece, double standing_height_mm) {
  return piece.lowest_mm < standing_height_mm + kStandsBelowMm;
}

/// Whether it is large enough, beside the larger foot, to be the other one.
bool is_fair(const Piece& piece, const Piece& larger_foot) {
  return static_cast<double>(piece.cells.size()) >=
         kLeastShare * static_cast<double>(larger_foot.cells.size());
}

/// What stands beside a foot and could be a part of it, a heel without the arch before it, or is as
/// large as the other foot may be, but too short.
std::vector<std::string> named_parts(const std::vector<Piece>& feet,
                                     const std::vector<Piece>& left_out,
                                     double standing_height_mm) {
  std::vector<std::string> warnings;
  for (const auto& piece : left_out) {
    const bool notable = static_cast<double>(piece.cells.size()) >=
                         kNotableShare * static_cast<double>(feet.front().cells.size());
    if (!notable || !stands(piece, standing_height_mm)) continue;
    const auto beside = warnings.size();
    for (std::size_t i = 0; i < feet.size(); ++i) {
      if (!may_join(feet[i], piece)) continue;
      const auto gap_mm = std::lround(gap_between(feet[i], piece));
      warnings.push_back(
          "what stands some " + std::to_string(gap_mm) + " mm from foot " + std::to_string(i + 1) +
          " was left out: if it is a part of it, turn a camera to what lies between");
      break;
    }
    const double length = enclosing_rectangle(piece.hull()).length;
    if (warnings.size() == beside && is_fair(piece, feet.front())) {
      warnings.push_back("something " + std::to_string(std::lround(length)) +
                         " mm long was left out, which is too short for a foot: leave nothing else "
                         "on the platform, and have both feet in full view");
    }
  }
  return warnings;
}

/// Where nothing is long enough for a foot: how long the longest is that stands and is no crumb.
std::vector<std::string> named_short_ones(const std::vector<Piece>& none,
                                          double standing_height_mm) {
  double longest = 0.0;
  for (const auto& piece : none) {
    if (!stands(piece, standing_height_mm)) continue;
    longest = std::max(longest, enclosing_rectangle(piece.hull()).length);
  }
  if (longest < kCrumbMm) return {};
  const auto in_mm = [](double length) { return std::to_string(std::lround(std::floor(length))); };
  return {"the longest thing that stands there is " + in_mm(longest) +
          " mm long, and feet of less than " + in_mm(kLeastLengthMm) + " mm are not measured"};
}

struct PiecesBySize {
  std::vector<Piece> large;  ///< some of which may be feet, or parts of them
  std::vector<Piece> small;
};

PiecesBySize by_size(std::vector<Piece> pieces) {
  PiecesBySize sorted;
  const auto largest = pieces.empty() ? 0.0 : static_cast<double>(pieces.front().cells.size());
  for (auto& piece : pieces) {
    const bool is_large = static_cast<double>(piece.cells.size()) >= kLargeShare * largest;
    auto& own = is_large && sorted.large.size() < kMostPieces ? sorted.large : sorted.small;
    own.push_back(std::move(piece));
  }
  return sorted;
}

/// Splits what touches and joins what belongs together; the largest first.
void make_whole(std::vector<Piece>& pieces, const std::vector<Vector3d>& positions) {
  for (std::size_t i = 0, count = pieces.size(); i < count; ++i) {
    split_piece(pieces, i, positions);
  }
  join_pieces(pieces);
  std::stable_sort(pieces.begin(), pieces.end(), larger);
}

/// Takes what may be a foot from the large pieces; the others of them are small from now on.
std::vector<Piece> take_feet(PiecesBySize& pieces, double standing_height_mm) {
  std::vector<Piece> feet;
  for (auto& piece : pieces.large) {
    const bool long_enough = enclosing_rectangle(piece.hull()).length >= kLeastLengthMm;
    const bool fair = feet.empty() || is_fair(piece, feet.front());
    const bool may_be_foot = stands(piece, standing_height_mm) && long_enough && fair;
    (may_be_foot ? feet : pieces.small).push_back(std::move(piece));
  }
  pieces.large.clear();
  return feet;
}

}  // namespace

SeparatedFeet separate_feet(const std::vector<Vector3d>& positions, double standing_height_mm) {
  SeparatedFeet separated;
  auto pieces = by_size(find_pieces(positions));
  make_whole(pieces.large, positions);
  auto feet = take_feet(pieces, standing_height_mm);
  const bool are_many = feet.size() > 2;
  if (are_many) feet.resize(2);
  if (feet.empty()) {
    separated.strays = positions.size();
    separated.warnings = named_short_ones(pieces.small, standing_height_mm);
    return separated;
  }
  const auto left_out = adopt(feet, std::move(pieces.small));
  separated.warnings = named_parts(feet, left_out, standing_height_mm);
  if (are_many) {
    separated.warnings.push_back(
        "more than two foot-like things stand on the platform; the two largest are taken: leave "
        "nothing else on it");
  }
  std::size_t kept = 0;
  for (auto& foot : feet) {
    if (!fits_a_foot(foot)) {
      separated.warnings.push_back(
          "something larger than a foot stands on the platform: leave nothing else on it");
    }
    std::sort(foot.points.begin(), foot.points.end());
    kept += foot.points.size();
    separated.feet.push_back(std::move(foot.points));
  }
  separated.strays = positions.size() - kept;
  return separated;
}

}  // namespace instep
