#include "core/girth/contour/section_line.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <tuple>
#include <utility>

#include "core/geometry/disjoint_sets.h"
#include "core/geometry/point_index.h"
#include "core/geometry/polygon.h"

namespace instep {
namespace {

/// Of each end, what lies nearest: of a crowd the rest is looked at when these are joined.
constexpr std::size_t kNeighbours = 8;
/// Ends are joined up to some times the narrowest gap that is left, then the next ones looked at.
constexpr double kAtOnce = 4.0;

/// Two open ends; the front of line n is 2 n, its back 2 n + 1.
struct Seam {
  double gap = 0.0;
  std::size_t first = 0;
  std::size_t second = 0;

  bool operator<(const Seam& other) const {
    return std::tie(gap, first, second) < std::tie(other.gap, other.first, other.second);
  }
};

/// Finds which ends belong together; the lines themselves are laid together at the end.
class Stitching {
 public:
  Stitching(std::vector<SectionLine> lines, double own)
      : lines_(std::move(lines)), own_(own), seam_at_(2 * lines_.size()), chains_(lines_.size()) {
    for (const auto& line : lines_) lengths_.push_back(line.length());
  }

  void join_up_to(double widest) {
    double within = 0.0;
    for (auto seams = nearest_seams(); !seams.empty() && seams.front().gap <= widest;
         seams = nearest_seams()) {
      within = std::clamp(kAtOnce * seams.front().gap, within, widest);
      for (const auto& seam : seams) {
        if (seam.gap > within) break;
        const bool are_free = !seam_at_[seam.first] && !seam_at_[seam.second];
        if (are_free && may_join(seam)) join(seam);
      }
    }
  }

  std::vector<SectionLine> laid_together() && {
    laid_.assign(lines_.size(), false);
    std::vector<SectionLine> result;
    for (const bool from_open_ends : {true, false}) {
      for (std::size_t end = 0; end < seam_at_.size(); ++end) {
        if (laid_[end / 2] || (from_open_ends && (lines_[end / 2].closed || seam_at_[end]))) {
          continue;
        }
        result.push_back(line_from(end));
      }
    }
    return result;
  }

 private:
  const Eigen::Vector2d& place_of(std::size_t end) const {
    const auto& points = lines_[end / 2].points;
    return end % 2 == 0 ? points.front() : points.back();
  }

  /// As far as the lines are joined by now.
  bool may_join(const Seam& seam) {
    if (seam.first == seam.second) return false;
    const std::size_t one = seam.first / 2;
    const std::size_t other = seam.second / 2;
    const std::size_t chain = chains_.of(one);
    if (chain != chains_.of(other)) return true;
    if (one == other && lines_[one].points.size() <= 2) return false;
    return seam.gap <= own_ * (lengths_[chain] + seam.gap);
  }

  void join(const Seam& seam) {
    seam_at_[seam.first] = Seam{seam.gap, seam.first, seam.second};
    seam_at_[seam.second] = Seam{seam.gap, seam.second, seam.first};
    const std::size_t one = chains_.of(seam.first / 2);
    const std::size_t other = chains_.of(seam.second / 2);
    if (chains_.join(one, other)) {
      lengths_[chains_.of(one)] = lengths_[one] + lengths_[other] + seam.gap;
    }
  }

  /// Of the ends that are free, narrowest first.
  std::vector<Seam> nearest_seams() {
    std::vector<std::size_t> ends;
    std::vector<Eigen::Vector3d> places;
    for (std::size_t end = 0; end < seam_at_.size(); ++end) {
      if (lines_[end / 2].closed || seam_at_[end]) continue;
      ends.push_back(end);
      places.emplace_back(place_of(end).x(), place_of(end).y(), 0.0);
    }
    const PointIndex index(std::move(places));
    std::vector<Seam> seams;
    for (std::size_t i = 0; i < ends.size(); ++i) {
      for (const auto& near : index.nearest(index.points()[i], kNeighbours)) {
        const auto [first, second] = std::minmax(ends[i], ends[near.index]);
        const Seam seam{std::sqrt(near.squared_distance), first, second};
        if (may_join(seam)) seams.push_back(seam);
      }
    }
    std::sort(seams.begin(), seams.end());
    return seams;
  }

  /// From an end over all seams, to an open end or round to itself.
  SectionLine line_from(std::size_t start) {
    SectionLine result;
    for (std::size_t end = start;;) {
      auto& line = lines_[end / 2];
      laid_[end / 2] = true;
      if (end % 2 == 1) std::reverse(line.points.begin(), line.points.end());
      result.points.insert(result.points.end(), line.points.begin(), line.points.end());
      result.widest_seam = std::max(result.widest_seam, line.widest_seam);
      result.closed = line.closed;
      const auto& seam = seam_at_[end ^ 1U];
      if (!seam) return result;
      result.widest_seam = std::max(result.widest_seam, seam->gap);
      result.closed = seam->second == start;
      if (result.closed) return result;
      end = seam->second;
    }
  }

  std::vector<SectionLine> lines_;
  double own_;
  std::vector<std::optional<Seam>> seam_at_;
  DisjointSets chains_;
  std::vector<double> lengths_;  ///< of each chain, at the number that it goes by
  std::vector<bool> laid_;
};

}  // namespace

double SectionLine::length() const {
  if (points.size() < 2) return 0.0;
  return perimeter(points) - (closed ? 0.0 : (points.front() - points.back()).norm());
}

std::vector<SectionLine> stitched(std::vector<SectionLine> lines, const Seams& seams) {
  // As of faces that touch the plane in a corner alone: thousands may lie at one place.
  std::erase_if(lines, [](const SectionLine& line) { return !(line.length() > 0.0); });
  Stitching stitching(std::move(lines), seams.own);
  stitching.join_up_to(seams.widest);
  return std::move(stitching).laid_together();
}

}  // namespace instep
