#include "core/girth/told_girth.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/geometry/polygon.h"
#include "core/girth/section/section_warnings.h"

namespace instep {
namespace {

/// Contact against stretched length of a section that winds more than most bodies do.
constexpr double kWinding = 1.05;
/// Of what zigzags add: lengths that differ by less without some points are the same. Sharp edges
/// lose some too. Set by eye, as the next is, over some clumps of strays and some ribs and fins.
constexpr double kSameLength = 0.03;
/// The shares of a section between which it turns to and fro by what lies beside the body rather
/// than by fins, ribs or lobes: of bodies with some of these only prisms of few columns of points,
/// unsure anyway, are between; of 13 boxes whose section took in a strip of floor 8 are.
constexpr double kMoreThanFins = 0.3;
constexpr double kAllRound = 0.9;
/// A section that leaves so many more points beside it may have lost a part that they are of.
constexpr std::size_t kFewestOfAPart = 8;

/// By what zigzags leave open.
void widen(double contact, double stretched, ToldGirth& told) {
  widen(contact, stretched, too_many_zigzags(), told);
}

}  // namespace

bool is_told(const Result<ToldGirth>& girth) {
  return girth && !girth->refusal;
}

void refuse(Error why, ToldGirth& told) {
  Girth course;
  course.contour = std::move(told.girth.contour);
  told.girth = std::move(course);
  told.refusal = std::move(why);
}

void widen(double contact, double stretched, const tl::unexpected<Error>& why, ToldGirth& told) {
  if (told.refusal || !(contact > 0.0 || stretched > 0.0)) return;
  Girth& girth = told.girth;
  *girth.contact_u95_mm += contact;
  *girth.stretched_u95_mm += stretched;
  if (is_too_doubtful(girth)) refuse(why.value(), told);
}

bool is_too_doubtful(const Girth& girth) {
  return !(*girth.stretched_u95_mm <= kMostDoubt * girth.stretched_mm &&
           *girth.contact_u95_mm <= kMostFolded * girth.contact_mm);
}

double ToldGirth::doubt() const {
  return *girth.stretched_u95_mm + *girth.contact_u95_mm;
}

double ToldGirth::area() const {
  return signed_area(girth.contour);
}

bool ToldGirth::is_plain() const {
  return !refusal && !(zigzags.way > 0.0) && !of_few && !is_bridged && !has_layers &&
         !has_others_beside && *girth.stretched_u95_mm <= kNotableDoubt * girth.stretched_mm &&
         *girth.contact_u95_mm <= kNotableDoubt * girth.contact_mm;
}

bool ToldGirth::is_doubtful() const {
  return refusal || of_few || *girth.stretched_u95_mm > kNotableDoubt * girth.stretched_mm ||
         girth.contact_mm > kWinding * girth.stretched_mm;
}

void widen_by_zigzags(ToldGirth& told) {
  widen(told.zigzags.contact, told.zigzags.stretched, told);
}

void widen_by_lost_parts(const ToldGirth& before, ToldGirth& told) {
  if (!before.refusal && told.skin.points > before.skin.points + kFewestOfAPart) {
    widen(std::abs(before.girth.contact_mm - told.girth.contact_mm),
          std::abs(before.girth.stretched_mm - told.girth.stretched_mm), told);
  }
  widen(std::max(before.skin.contact - told.skin.contact, 0.0),
        std::max(before.skin.stretched - told.skin.stretched, 0.0), told);
}

bool is_unchanged(const ToldGirth& zigzagging, const ToldGirth& other) {
  const double same = kSameLength * zigzagging.zigzags.contact;
  return !zigzagging.refusal &&
         std::abs(zigzagging.girth.contact_mm - other.girth.contact_mm) < same &&
         std::abs(zigzagging.girth.stretched_mm - other.girth.stretched_mm) < same;
}

bool may_have_taken_in(const ToldGirth& told) {
  if (told.refusal) return false;
  const double share = told.zigzags.way / told.girth.contact_mm;
  return told.has_others_beside || (share > kMoreThanFins && share < kAllRound);
}

}  // namespace instep
