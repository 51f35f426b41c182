#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "core/geometry/polygon.h"
#include "core/girth/girth.h"
#include "tests/fuzz/body_from_bytes.h"
#include "tests/fuzz/fuzz_target.h"

namespace instep {
namespace {

using test::require;

/// Rounding, against the length of a tape.
constexpr double kRounding = 1e-9;
/// Of a contour, hollows and all, what rbf may add to its lengths or take off them.
constexpr double kUnshownWaves = 1.1e-3;

/// The shortest tape round everything that is there, seen along the plane's normal.
double tape_round_all(const std::vector<Eigen::Vector3d>& places, const TapePlane& plane) {
  std::vector<Eigen::Vector2d> flat;
  for (const auto& place : places) flat.push_back(plane.project(place));
  return perimeter(convex_hull(std::move(flat)));
}

void check_refusal(const Error& error, const std::string& method) {
  require(!error.message.empty() && !error.advice.empty(), method + " says why it refuses");
  require(error.code != ErrorCode::kInternal, method + " has no bug: " + error.line());
}

/// What every girth keeps to, whatever it is a girth of.
void check_girth(const Girth& girth, const std::string& method) {
  require(std::isfinite(girth.stretched_mm) && girth.stretched_mm > 0.0,
          method + " gives a stretched length");
  require(std::isfinite(girth.contact_mm) && girth.contact_mm > 0.0,
          method + " gives a contact length");
  for (const auto& half_width : {girth.stretched_u95_mm, girth.contact_u95_mm}) {
    require(!half_width || (std::isfinite(*half_width) && *half_width >= 0.0),
            method + " gives an interval or none");
  }
  require(std::isfinite(girth.sigma_mm) && girth.sigma_mm >= 0.0, method + " tells the noise");
  require(std::isfinite(girth.largest_gap_mm) && girth.largest_gap_mm >= 0.0,
          method + " tells the gap");
  require(girth.band_points <= girth.points, method + " uses points that are there");
  require(girth.contour.size() >= 3, method + " gives a contour");
  for (const auto& corner : girth.contour) {
    require(corner.allFinite(), method + " gives a contour of numbers");
  }
  const double hull = perimeter(convex_hull(girth.contour));
  const double unshown = kUnshownWaves * perimeter(girth.contour);
  require(std::abs(hull - girth.stretched_mm) <= unshown + kRounding,
          method + " gives the contour that it measured");
}

void check(const Result<Girth>& girth, const std::string& method, double most) {
  if (!girth) return check_refusal(girth.error(), method);
  check_girth(*girth, method);
  require(girth->stretched_mm <= most * (1.0 + kUnshownWaves) + kRounding,
          method + " gives no longer tape than one round everything");
}

}  // namespace
}  // namespace instep

/// All methods on one body. None crashes or hangs; each measures, or says why not.
int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace instep;
  const auto body = test::body_from_bytes(data, size);
  if (!body.plane) {
    check_refusal(body.plane.error(), "the plane");
    return 0;
  }
  const TapePlane& plane = *body.plane;
  const double all = check_cloud(body.cloud) ? tape_round_all(body.cloud.positions, plane) : 0.0;
  check(girth_by_hull(body.cloud, plane), "hull", all);
  check(girth_by_mesh(body.cloud, plane), "mesh", all);
  // A smooth surface may swell beyond its points, most where they are few.
  check(girth_by_rbf(body.cloud, plane), "rbf", 2.0 * all);
  check(girth_by_paper(body.cloud, plane), "rbf-paper", 1.25 * all);
  const auto section = girth_by_section(body.mesh, plane);
  check(section, "section", section ? tape_round_all(body.mesh.positions, plane) : 0.0);
  return 0;
}
