#include <algorithm>
#include <cstddef>
#include <optional>
#include <utility>
#include <vector>

#include "core/geometry/polygon.h"
#include "core/girth/bodies_apart.h"
#include "core/girth/girth.h"
#include "core/girth/section_warnings.h"
#include "core/girth/told_girth.h"

namespace instep {
namespace {

/// By how much the section of one may be the larger if it is the same body, taken apart in another
/// way.
constexpr double kSameBody = 1.2;
/// The doubt of a body alone against that of all together, which is blind to what they share.
constexpr double kAboutAsSure = 1.5;
constexpr const char* kAloneWarning =
    "the body was measured alone, without what lies beside it: strays, a wall, a floor or another "
    "body";

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
    if (!told) {
      if (is_too_few_or_noisy(told.error())) unsure_.push_back({body.points, body.area});
      return true;
    }
    if (!told->is_plain()) {
      unsure_.push_back({body.points, told->area()});
      return false;
    }
    if (counts_before_best(*told)) {
      best_ = std::move(*told);
      point_of_best_ = body.points.front();
    }
    return true;
  }

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

  /// Whether there is a larger one that the best one is no part of.
  bool has_larger() const {
    return best_ && std::any_of(unsure_.begin(), unsure_.end(), [&](const Unsure& unsure) {
             return unsure.area > kSameBody * best_->area() &&
                    !std::binary_search(unsure.points.begin(), unsure.points.end(), point_of_best_);
           });
  }

  bool counts_before_best(const ToldGirth& told) const {
    if (!best_ || told.area() > kSameBody * best_->area()) return true;
    return kSameBody * told.area() > best_->area() && told.doubt() < best_->doubt();
  }

  const PointCloud& cloud_;
  const TapePlane& plane_;
  const GirthOptions& options_;
  std::optional<ToldGirth> best_;
  std::size_t point_of_best_ = 0;
  std::vector<Unsure> unsure_;
};

std::optional<ToldGirth> girth_of_one_body(const PointCloud& cloud, const TapePlane& plane,
                                           const GirthOptions& options) {
  BodiesAlone alone(cloud, plane, options);
  look_at_bodies_apart(cloud, plane, alone);
  auto told = std::move(alone).best();
  if (!told) return told;
  told->girth.points = cloud.size();
  told->girth.warnings.emplace_back(kAloneWarning);
  return told;
}

/// Whether it is the same body, or what a loop round more than that encloses too.
bool is_part_of(const ToldGirth& one, const ToldGirth& all) {
  if (kSameBody * one.area() >= all.area()) return true;
  auto corners = all.girth.contour;
  const double area = signed_area(convex_hull(corners));
  corners.insert(corners.end(), one.girth.contour.begin(), one.girth.contour.end());
  return signed_area(convex_hull(std::move(corners))) < kSameBody * area;
}

/// `one`: of a body alone. `all`: of all points together.
bool counts_before(const ToldGirth& one, const ToldGirth& all) {
  if (all.of_few) return true;
  return !all.has_layers && is_part_of(one, all) && one.doubt() < kAboutAsSure * all.doubt();
}

}  // namespace

Result<Girth> girth_by_rbf(const PointCloud& cloud, const TapePlane& plane,
                           const GirthOptions& options) {
  if (auto sound = check_cloud(cloud); !sound) return tl::make_unexpected(sound.error());
  if (auto sound = check_options(options); !sound) return tl::make_unexpected(sound.error());
  auto told = girth_of_all(cloud, plane, options);
  if (!told || told->is_doubtful() || told->has_others_beside) {
    auto one = girth_of_one_body(cloud, plane, options);
    if (one && (!told || counts_before(*one, *told))) told = std::move(*one);
  }
  if (!told) return tl::make_unexpected(std::move(told).error());
  return std::move(told->girth);
}

}  // namespace instep
