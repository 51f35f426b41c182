#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <optional>
#include <vector>

namespace instep {

/// Parts the points of one or more skins into pieces by how they lie to their neighbours.
class SkinPieces {
 public:
  /// Indices of points, ascending.
  using Pieces = std::vector<std::vector<std::size_t>>;

  /// O(n log n).
  explicit SkinPieces(const std::vector<Eigen::Vector3d>& points);

  /// What hangs together across the usual room between random points on a skin: all but single
  /// ones do.
  Pieces within_reach() const;

  /// What hangs together across less room: most of a skin does, and where two nearly touch, less
  /// bridges the room between them.
  Pieces within_least_reach() const;

  /// What hangs together along its skin, with no bend sharper than a right angle: two that touch do
  /// not, except over a rim.
  Pieces along_skin() const;

  /// The side of the square that a point has for itself, half of all points less.
  double usual_spacing() const { return usual_spacing_; }

 private:
  struct Pair {
    std::size_t one;
    std::size_t other;
    double spacings;  ///< so far apart
  };

  template <typename Joins>
  Pieces pieces_by(const Joins& joins) const;
  bool is_along(const Pair& pair) const;

  std::vector<Eigen::Vector3d> points_;
  std::vector<std::optional<Eigen::Vector3d>> normals_;  ///< where the points round lie on a skin
  std::vector<Pair> pairs_;
  double usual_spacing_ = 0.0;
};

}  // namespace instep
