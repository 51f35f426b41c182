#pragma once

#include <cstddef>
#include <vector>

#include "core/geometry/point_cloud.h"
#include "core/girth/tape_plane.h"

namespace instep {

/// What hangs together in a slab round a tape plane.
struct BodyApart {
  std::vector<std::size_t> points;  ///< their numbers in the cloud, ascending, each place once
  /// That a tape round those encloses that lie within a spacing of the plane, mm^2.
  double area = 0.0;
};

/// How many numbers two such lists share. O(both).
std::size_t shared_points(const std::vector<std::size_t>& one,
                          const std::vector<std::size_t>& other);

/// Looks at bodies apart as they are found.
class BodiesLook {
 public:
  virtual ~BodiesLook() = default;
  /// Whether it is to be looked at. If not, none after it is that was taken apart in the same way.
  virtual bool may_count(const BodyApart& body) const = 0;
  /// Whether the next one that was taken apart in the same way is to be looked at too.
  virtual bool look_at(const BodyApart& body) = 0;
  /// Of one that has too many points to be looked at.
  virtual void pass_over(const BodyApart& body) = 0;
  /// Whether thinner slabs need not be looked at any more.
  virtual bool is_settled() const = 0;
};

/// Takes what lies near a tape plane apart where nothing joins it, in several ways: a body from a
/// wall, a floor or another body beside it, which as one cloud share their noise, their spacing and
/// the normals that neighbours agree on. First in thick slabs, in which much is joined, then in
/// thinner ones; in each by wide gaps, then by narrower ones. In each way bodies are those of a
/// fiftieth of the slab's points or more, and what is left strays. They are looked at one by one,
/// that round the largest area first, but for those nearly all of whose points were looked at in
/// the same slab before, until they have twice the points of the thickest slab and 50,000 together.
/// Of a plain body there are none.
///
/// The cloud has passed check_cloud(). O(n), and m log m for the m near the plane, for each of up
/// to fifty ways.
void look_at_bodies_apart(const PointCloud& cloud, const TapePlane& plane, BodiesLook& look);

}  // namespace instep
