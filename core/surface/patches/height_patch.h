#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "core/surface/heights/height_kriging.h"
#include "core/surface/heights/height_samples.h"
#include "core/surface/oriented_point.h"

namespace instep {

/// A field over a small neighbourhood: the height over the piece of surface that its points make.
/// Zero on the surface, positive outside, of slope near one across it.
///
/// The surface is the paper's radial basis functions (eqs. 6 and 7, phi = r^3, a smoothing for each
/// point; r^5, and after it r^7 with a cubic polynomial, where exact points are likelier by it)
/// with a quadratic polynomial (a plane for fewer than nine points), over the tangent plane, which
/// for two dozen exact points or more, unless told normals count, is bent round the body as they
/// are (HeightBase): as heights, points need no others put off the surface (eq. 5) and no normals
/// but for the side, and the system (HeightKriging), centred and in unit scale, is half as large.
/// Bodies bend more round their girths than along them, which is z or nearly so in the frame of a
/// tape plane: of noisy points a distance along z counts for less in r. Told normals of exact
/// points count as slopes, as exact as is likeliest for them. The roughness is the likeliest one
/// (restricted maximum likelihood) given the points and a prior; a point's smoothing is its
/// variance against twice that, since a length is asked for in the end, over which noise averages
/// out but flattened bends add up.
class HeightPatch {
 public:
  /// `outward`: unit length, out of the body, within some 60 degrees of all normals. `radius` > 0:
  /// of the neighbourhood round `centre`. `roughness` > 0: likely value, to within a factor of ten
  /// or so. More points than kMostHeightSamples are averaged over cells. Nothing if the points do
  /// not determine a surface (fewer than four, all on one line) or tell nothing of its likelihood.
  /// `crowded`: exact points lie so close, against the bends of the surface, that one kernel says
  /// the same as another; a third of the work. O(min(points, 64)^3 + points), 27 times that with
  /// told normals.
  static std::optional<HeightPatch> fit(const std::vector<OrientedPoint>& points,
                                        const Eigen::Vector3d& centre,
                                        const Eigen::Vector3d& outward, double radius,
                                        double roughness, bool crowded = false);

  FieldValue at(const Eigen::Vector3d& position) const;

  /// What sums of heights rest on.
  struct Sums {
    /// By how much each point's height, as given to fit(), moves each sum: a column.
    Eigen::MatrixXd influence;
    /// Of each sum round the true one, as the surface wanders between the points: noise apart.
    Eigen::ArrayXd variance;
  };

  /// Of the heights at `positions` times each column of `shares`. O(samples^2) for each.
  Sums sums(const std::vector<Eigen::Vector3d>& positions, const Eigen::MatrixXd& shares) const;

  /// How far exact points are off what the others predict, against what the patch expects of that
  /// from all of them: mean square. About one where the surface bends at the smallest scale as at
  /// larger ones, as facets and creases do; some 0.4 where it is smooth. One where there is noise,
  /// which hides it. O(samples^3).
  double fine_bending() const;

  /// How far each point, or the average that it went into, is off what the others predict, in the
  /// order given to fit(): above 0 where it lies higher. O(samples^3).
  std::vector<double> missed() const;

  /// The point that is most likely a stray, or all points of a cell that were averaged, and how
  /// much likelier the heights are (twice the log likelihood) if it may be off by anything: 0,
  /// whichever it is, where all lie within a hundredth of the radius of the polynomial, or are too
  /// few to tell. O(samples^3 + points), 27 times that with told slopes.
  struct Odd {
    std::vector<std::size_t> points;  ///< ascending
    double gain;
  };
  Odd odd_one() const;

  /// Whether the points carry no noise worth smoothing.
  bool is_exact() const { return exact_; }

  /// Whether the points are exact and plainly likelier by the smoothest kernel.
  bool is_smooth() const;

  /// The likeliest; for exact points the given one.
  double roughness() const { return roughness_; }

  /// Twice the negative log likelihood of the points, for comparing models of the same points.
  double misfit() const { return misfit_; }

 private:
  /// A number for each sample, kept in place: fields are read far more often than fitted.
  using Column = Eigen::Array<double, Eigen::Dynamic, 1, Eigen::ColMajor, kMostHeightSamples, 1>;

  /// So many samples at once.
  static constexpr int kGroup = 4;
  using Group = Eigen::Array<double, kGroup, 1>;
  static_assert(kMostHeightSamples % kGroup == 0);

  /// A height over the base and its slopes.
  struct Rise {
    double height;
    double along;
    double across;
  };

  explicit HeightPatch(const HeightBase& base) : base_(base) {}

  static Rise rise_of(const Polynomial& c, double x, double y);
  void add_slopes(double x, double y, Rise& rise) const;
  void set_columns(const Eigen::Matrix2Xd& places, const Eigen::VectorXd& weights);

  HeightBase base_;
  bool exact_ = false;
  std::optional<HeightKriging> kriging_;
  HeightKriging::Solution solution_;
  Column x_;  ///< of the samples
  Column y_;
  Column weights_;
  Column along_weights_;  ///< of the slopes; empty where none are told
  Column across_weights_;
  std::vector<Eigen::Index> cells_;  ///< the sample that each point went into; empty for itself
  Eigen::VectorXd shares_;
  double wander_ = 0.0;  ///< roughness in unit scale
  Polynomial polynomial_;
  double roughness_ = 0.0;
  double misfit_ = 0.0;
};

}  // namespace instep
