#include "core/geometry/point_index.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <nanoflann.hpp>
#include <utility>

namespace instep {
namespace {

constexpr std::size_t kPointsPerLeaf = 16;

struct PointsAdaptor {
  std::vector<Eigen::Vector3d> points;

  std::size_t kdtree_get_point_count() const { return points.size(); }
  double kdtree_get_pt(std::size_t index, std::size_t axis) const {
    return points[index][static_cast<Eigen::Index>(axis)];
  }
  template <class Box>
  bool kdtree_get_bbox(Box&) const {
    return false;
  }
};

using KdTree =
    nanoflann::KDTreeSingleIndexAdaptor<nanoflann::L2_Simple_Adaptor<double, PointsAdaptor>,
                                        PointsAdaptor, 3, std::size_t>;

bool comes_before(const PointIndex::Neighbour& a, const PointIndex::Neighbour& b) {
  if (a.squared_distance != b.squared_distance) return a.squared_distance < b.squared_distance;
  return a.index < b.index;
}

/// Keeps the nearest so many in order. Full of points at the query itself it
/// wants no others: the library would look at every one more that lies there, and a crowd at one
/// place would be searched whole for each of its points.
class NearestFound {
 public:
  using DistanceType = double;

  explicit NearestFound(std::size_t count) : count_(count) { found_.reserve(count); }

  bool full() const { return found_.size() == count_; }
  std::size_t size() const { return found_.size(); }
  double worstDist() const {
    if (!full()) return std::numeric_limits<double>::max();
    const double worst = found_.back().squared_distance;
    return worst > 0.0 ? worst : -1.0;
  }
  bool addPoint(double squared_distance, std::size_t index) {
    // The library may not have heard yet how near the last one has come.
    if (full() && squared_distance >= found_.back().squared_distance) return true;
    if (full()) found_.pop_back();
    const PointIndex::Neighbour neighbour{index, squared_distance};
    found_.insert(std::upper_bound(found_.begin(), found_.end(), neighbour, comes_before),
                  neighbour);
    return true;
  }

  /// Nearest first.
  std::vector<PointIndex::Neighbour> take() && { return std::move(found_); }

 private:
  std::size_t count_;
  std::vector<PointIndex::Neighbour> found_;
};

/// Keeps all within a distance.
class AllFound {
 public:
  using DistanceType = double;

  explicit AllFound(double squared_radius) : squared_radius_(squared_radius) {}

  bool full() const { return true; }
  std::size_t size() const { return found_.size(); }
  double worstDist() const { return squared_radius_; }
  bool addPoint(double squared_distance, std::size_t index) {
    if (squared_distance <= squared_radius_) found_.push_back({index, squared_distance});
    return true;
  }

  std::vector<PointIndex::Neighbour> take() && { return std::move(found_); }

 private:
  double squared_radius_;
  std::vector<PointIndex::Neighbour> found_;
};

}  // namespace

struct PointIndex::Tree {
  explicit Tree(std::vector<Eigen::Vector3d> points)
      : adaptor{std::move(points)},
        tree(3, adaptor, nanoflann::KDTreeSingleIndexAdaptorParams(kPointsPerLeaf)) {}

  PointsAdaptor adaptor;
  KdTree tree;
};

PointIndex::PointIndex(std::vector<Eigen::Vector3d> points)
    : tree_(std::make_unique<Tree>(std::move(points))) {}
PointIndex::~PointIndex() = default;
PointIndex::PointIndex(PointIndex&&) noexcept = default;
PointIndex& PointIndex::operator=(PointIndex&&) noexcept = default;

std::vector<PointIndex::Neighbour> PointIndex::nearest(const Eigen::Vector3d& query,
                                                       std::size_t count) const {
  count = std::min(count, tree_->adaptor.points.size());
  if (count == 0) return {};
  NearestFound nearest(count);
  tree_->tree.findNeighbors(nearest, query.data(), nanoflann::SearchParams());
  return std::move(nearest).take();
}

std::vector<PointIndex::Neighbour> PointIndex::within(const Eigen::Vector3d& query,
                                                      double radius) const {
  auto found = around(query, radius);
  std::sort(found.begin(), found.end(), comes_before);
  return found;
}

const std::vector<Eigen::Vector3d>& PointIndex::points() const {
  return tree_->adaptor.points;
}

std::vector<PointIndex::Neighbour> PointIndex::around(const Eigen::Vector3d& query,
                                                      double radius) const {
  if (tree_->adaptor.points.empty()) return {};
  // nanoflann leaves out points at exactly the squared radius.
  AllFound all(std::nextafter(radius * radius, radius * radius + 1.0));
  tree_->tree.findNeighbors(all, query.data(), nanoflann::SearchParams());
  return std::move(all).take();
}

}  // namespace instep
