#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/geometry/polygon.h"
#include "core/girth/band/bodies_apart.h"
#include "core/girth/contour/control_points.h"
#include "core/girth/doubt/shared_length_doubt.h"
#include "core/girth/girth.h"
#include "core/girth/girth_of_all.h"
#include "core/girth/open_section.h"
#include "core/girth/section/section_warnings.h"
#include "core/girth/told_girth.h"

namespace instep {
namespace {

/// Whether the section goes by the control points.
bool is_pointed_at(const ToldGirth& told, const TapePlane& plane) {
  return goes_by_control_points(told.girth.contour, plane);
}

/// By how much the section of a body may be the larger, taken apart in another way.
constexpr double kSameBody = 1.2;
/// The doubt of a body alone against that of all together, which is blind to what they share.
constexpr double kAboutAsSure = 1.2;

/// Round the points of a body, for control points that are read off noisy ones.
constexpr double kBeyondBox = 0.05;

std::string alone_warning(std::size_t own_points, std::size_t points) {
  return "the body was measured alone, by " + std::to_string(own_points) + " of the " +
         std::to_string(points) +
         " points, without what lies beside it: strays, a wall, a floor or another body; take it "
         "away, or scan from elsewhere";
}

/// The girths of bodies alone: of that whose section is largest, taken apart in the way that leaves
/// the least doubt. Between a body and what is still joined to it a surface may go astray.
class BodiesAlone : public BodiesLook {
 public:
  BodiesAlone(const PointCloud& cloud, const TapePlane& plane, const GirthOptions& options)
      : cloud_(cloud), plane_(plane), options_(options) {}

  bool may_count(const BodyApart& body) const override {
    return !best_ || kSameBody * body.area >= best_->area();
  }

  bool look_at(const BodyApart& body) override {
    auto told = girth_of_all(cloud_.subset(body.points), plane_, options_);
    if (!told) return true;
    if (!told->is_plain()) {
      unsure_.push_back({body.points, told->area()});
      return false;
    }
    if (counts_before_best(*told, body.points)) {
      best_ = std::move(*told);
      points_of_best_ = body.points;
      largest_ = std::max(largest_, best_->area());
    }
    return true;
  }

  void pass_over(const BodyApart& body) override { unsure_.push_back({body.points, body.area}); }

  bool is_settled() const override { return best_ && !has_larger(); }

  /// Nothing if none is plain, or another one's section is larger.
  std::optional<ToldGirth> best() && {
    if (has_larger()) return std::nullopt;
    return std::move(best_);
  }

 private:
  /// A body that may be two, or a part of one, or badly seen.
  struct Unsure {
    std::vector<std::size_t> points;
    double area;
  };

  /// Whether most points of the one that has fewer are of both.
  bool has_best(const std::vector<std::size_t>& points) const {
    const std::size_t fewer = std::min(points.size(), points_of_best_.size());
    return 2 * shared_points(points, points_of_best_) > fewer;
  }

  /// Whether there is a larger one that the best one is no part of.
  bool has_larger() const {
    return best_ && std::any_of(unsure_.begin(), unsure_.end(), [&](const Unsure& unsure) {
             return unsure.area > best_->area() && !has_best(unsure.points);
           });
  }

  bool counts_before_best(const ToldGirth& told, const std::vector<std::size_t>& points) const {
    if (!best_) return true;
    if (!has_best(points)) return told.area() > best_->area();
    return kSameBody * told.area() > largest_ && told.doubt() < best_->doubt();
  }

  const PointCloud& cloud_;
  const TapePlane& plane_;
  const GirthOptions& options_;
  std::optional<ToldGirth> best_;
  std::vector<std::size_t> points_of_best_;
  double largest_ = 0.0;  ///< area of any that was the best one
  std::vector<Unsure> unsure_;
};

constexpr const char* kPointedWarning =
    "of several bodies the one that all three control points lie on was measured; what lies beside "
    "it does not count";

/// The girth of the body alone that the control points lie on, taken apart in the way that leaves
/// the least doubt.
class PointedBody : public BodiesLook {
 public:
  PointedBody(const PointCloud& cloud, const TapePlane& plane, const GirthOptions& options)
      : cloud_(cloud), plane_(plane), options_(options) {}

  bool may_count(const BodyApart&) const override { return true; }

  bool look_at(const BodyApart& body) override {
    if (!may_have_control_points(body)) return true;
    auto told = girth_of_all(cloud_.subset(body.points), plane_, options_);
    if (!told || told->refusal || !is_pointed_at(*told, plane_)) return true;
    if (!best_ || told->doubt() < best_->doubt()) best_ = std::move(*told);
    return false;
  }

  void pass_over(const BodyApart&) override {}

  bool is_settled() const override { return best_ && best_->is_plain(); }

  std::optional<ToldGirth> best() && { return std::move(best_); }

 private:
  /// None lies far outside of the box round its points.
  bool may_have_control_points(const BodyApart& body) const {
    Eigen::AlignedBox3d box;
    for (const std::size_t point : body.points) box.extend(cloud_.positions[point]);
    const double beyond = kBeyondBox * box.diagonal().norm();
    const auto& points = plane_.control_points();
    return std::all_of(points.begin(), points.end(), [&](const Eigen::Vector3d& point) {
      return box.exteriorDistance(point) < beyond;
    });
  }

  const PointCloud& cloud_;
  const TapePlane& plane_;
  const GirthOptions& options_;
  std::optional<ToldGirth> best_;
};

std::optional<ToldGirth> girth_of_pointed_body(const PointCloud& cloud, const TapePlane& plane,
                                               const GirthOptions& options) {
  PointedBody pointed(cloud, plane, options);
  look_at_bodies_apart(cloud, plane, pointed);
  auto told = std::move(pointed).best();
  if (!told) return told;
  told->girth.warnings.emplace_back(kPointedWarning);
  told->girth.points = cloud.size();
  return told;
}

std::optional<ToldGirth> girth_of_one_body(const PointCloud& cloud, const TapePlane& plane,
                                           const GirthOptions& options) {
  BodiesAlone alone(cloud, plane, options);
  look_at_bodies_apart(cloud, plane, alone);
  auto told = std::move(alone).best();
  if (!told) return told;
  told->girth.warnings.push_back(alone_warning(told->girth.points, cloud.size()));
  told->girth.points = cloud.size();
  return told;
}

/// Whether a loop lies within another one, or hardly beyond it.
bool is_part_of(const ToldGirth& one, const ToldGirth& all) {
  auto corners = all.girth.contour;
  const double area = signed_area(convex_hull(corners));
  corners.insert(corners.end(), one.girth.contour.begin(), one.girth.contour.end());
  return signed_area(convex_hull(std::move(corners))) < kSameBody * area;
}

/// `one`: of a body alone. `all`: of all points together.
bool counts_before(const ToldGirth& one, const ToldGirth& all) {
  if (all.refusal) return true;
  if (all.has_layers) return false;
  if (all.of_few || one.area() > kSameBody * all.area()) return true;
  return is_part_of(one, all) && one.doubt() < kAboutAsSure * all.doubt();
}

/// With what the points' shared errors leave open, of which the surface through them knows nothing.
Result<Girth> with_shared_doubt(Girth girth, const TapePlane& plane, const PointCloud& cloud) {
  const auto shared = shared_doubt_of(girth.contour, plane, cloud);
  if (!(shared.contact_u95 > 0.0)) return girth;
  const bool is_wide = is_too_doubtful(girth);  // told all the same, over an opening
  girth.stretched_u95_mm = std::hypot(*girth.stretched_u95_mm, shared.stretched_u95);
  girth.contact_u95_mm = std::hypot(*girth.contact_u95_mm, shared.contact_u95);
  if (!is_wide && is_too_doubtful(girth)) {
    return fail(ErrorCode::kInsufficientData,
                "the errors that the points share, as of the cameras that saw them, leave nothing "
                "to be told of the girth",
                "calibrate the cameras (instep calibrate), or let them see more skin in common");
  }
  if (shared.stretched_u95 > kNotableDoubt * girth.stretched_mm) {
    girth.warnings.emplace_back(
        "the errors that the points share, as of the cameras that saw them, leave the girth "
        "uncertain: calibrate the cameras (instep calibrate), or let them see more skin in common");
  }
  return girth;
}

}  // namespace

Result<Girth> girth_by_rbf(const PointCloud& cloud, const TapePlane& plane,
                           const GirthOptions& options) {
  if (auto sound = check_cloud(cloud); !sound) return tl::make_unexpected(sound.error());
  if (auto sound = check_options(options); !sound) return tl::make_unexpected(sound.error());
  auto told = girth_of_all(cloud, plane, options);
  if (!told || told->is_doubtful() || told->has_others_beside) {
    // Beside the larger body, which does not count then.
    const bool is_smaller = told && told->is_smaller;
    auto one = is_smaller ? girth_of_pointed_body(cloud, plane, options)
                          : girth_of_one_body(cloud, plane, options);
    if (one && (!told || counts_before(*one, *told))) told = std::move(*one);
    if (!told || !is_pointed_at(*told, plane)) {
      if (auto pointed = girth_of_pointed_body(cloud, plane, options)) told = std::move(*pointed);
    }
  }
  if (!told || told->refusal) {
    if (auto open = girth_over_opening(cloud, plane, options)) {
      return with_shared_doubt(std::move(*open), plane, cloud);
    }
  }
  if (!told) return tl::make_unexpected(std::move(told).error());
  if (told->refusal) return tl::make_unexpected(std::move(*told->refusal));
  return with_shared_doubt(std::move(told->girth), plane, cloud);
}

}  // namespace instep
