#include "core/surface/normals/cell_normals.h"

#include <algorithm>
#include <cmath>
#include <queue>
#include <utility>

#include "core/mean.h"

namespace instep {
namespace {

/// Across a larger bend (one less its cosine) a normal tells little of its neighbour's side; across
/// a smaller one than the second, of 8 degrees, there is no doubt.
constexpr double kLargestBend = 0.12;
constexpr double kHardlyABend = 0.01;
constexpr double kReached = -1.0;
/// A part whose normals face away from the middle by this share of what they could needs no
/// neighbours to tell its side.
constexpr double kPlainlyOutward = 0.25;

/// A bend between two facets; the flattest comes first.
struct Bend {
  double size;
  std::size_t from;
  std::size_t to;

  bool operator<(const Bend& other) const {
    return std::pair(size, to) > std::pair(other.size, other.to);
  }
};

}  // namespace

CellNormals::CellNormals(const PointIndex& index, double side, double sigma, std::size_t fewest)
    : facets_(index, side, sigma, fewest) {}

void CellNormals::orient_by_neighbours() {
  std::vector<double> least_bends(facets_.size(), kLargestBend);
  std::vector<Part> parts;
  const Eigen::Vector2d middle = middle_of_all();
  for (std::size_t root = 0; root < facets_.size(); ++root) {
    if (least_bends[root] == kReached) continue;
    Part part{orient_part(root, least_bends), 0.0};
    part.outward = outward_share(part.facets, middle);
    parts.push_back(std::move(part));
  }
  std::stable_sort(parts.begin(), parts.end(), [](const Part& a, const Part& b) {
    return std::abs(a.outward) > std::abs(b.outward);
  });
  std::vector<bool> sure(facets_.size(), false);
  for (const Part& part : parts) {
    double outward = part.outward;
    if (std::abs(outward) < kPlainlyOutward) {
      const double agreement = agreement_with(sure, part.facets);
      if (agreement != 0.0) outward = agreement;
    }
    for (const std::size_t facet : part.facets) {
      if (outward < 0.0) facets_.turn(facet);
      sure[facet] = true;
    }
  }
}

Eigen::Vector2d CellNormals::middle_of_all() const {
  return mean_of(facets_, [](const SurfaceFacets::Facet& facet) -> Eigen::Vector2d {
    return facet.middle.head<2>();
  });
}

/// Between -1 and 1: how far the normals of some facets face away from the middle.
double CellNormals::outward_share(const std::vector<std::size_t>& facets,
                                  const Eigen::Vector2d& middle) const {
  double outward = 0.0;
  double most = 0.0;
  for (const std::size_t facet : facets) {
    const Eigen::Vector2d arm = facets_[facet].middle.head<2>() - middle;
    outward += facets_[facet].normal.head<2>().dot(arm);
    most += arm.norm();
  }
  return most > 0.0 ? outward / most : 0.0;
}

/// Sum of the cosines between the normals of some facets and those of their neighbours that are
/// sure.
double CellNormals::agreement_with(const std::vector<bool>& sure,
                                   const std::vector<std::size_t>& facets) const {
  double agreement = 0.0;
  std::vector<std::size_t> links;
  for (const std::size_t facet : facets) {
    facets_.find_links(facet, links);
    for (const std::size_t other : links) {
      if (sure[other] && facets_.goes_on(facet, other)) {
        agreement += facets_[facet].normal.dot(facets_[other].normal);
      }
    }
  }
  return agreement;
}

/// Turns the facets that hang together with `root`, round no sharp bend; returns them.
/// `least_bends`: to each facet from those reached so far.
std::vector<std::size_t> CellNormals::orient_part(std::size_t root,
                                                  std::vector<double>& least_bends) {
  std::vector<std::size_t> part;
  std::vector<std::size_t> links;
  std::priority_queue<Bend> bends;
  std::vector<Bend> flat;  // those that hardly bend wait for no other
  flat.push_back({0.0, root, root});
  while (!flat.empty() || !bends.empty()) {
    const Bend bend = flat.empty() ? bends.top() : flat.back();
    flat.empty() ? bends.pop() : flat.pop_back();
    if (least_bends[bend.to] == kReached) continue;
    least_bends[bend.to] = kReached;
    part.push_back(bend.to);
    if (facets_[bend.from].normal.dot(facets_[bend.to].normal) < 0.0) {
      facets_.turn(bend.to);
    }
    facets_.find_links(bend.to, links);
    for (const auto next : links) {
      // Rounding could leave less than none.
      const double cosine = facets_[bend.to].normal.dot(facets_[next].normal);
      const double size = std::max(1.0 - std::abs(cosine), 0.0);
      if (!(size < least_bends[next]) || !facets_.goes_on(bend.to, next)) continue;
      least_bends[next] = size < kHardlyABend ? 0.0 : size;
      if (size < kHardlyABend) {
        flat.push_back({size, bend.to, next});
      } else {
        bends.push({size, bend.to, next});
      }
    }
  }
  return part;
}

}  // namespace instep
