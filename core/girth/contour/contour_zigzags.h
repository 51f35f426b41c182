#pragma once

#include "core/girth/contour/contour_course.h"

namespace instep {

/// Where a contour turns to and fro within so short a way that the points it goes through can
/// hardly tell: as where it runs through strays beside the skin, or back and forth between two
/// views of it that do not fit. A fold, a rib or a step that is no wider than a few points looks
/// like that too. In the unit of the contour.
struct Zigzags {
  double way = 0.0;        ///< along all of them; 0 if there is none
  double contact = 0.0;    ///< by how much the contour is longer than straight across them
  double stretched = 0.0;  ///< and a tape round it, than one that leaves out what lies on them
};

/// `way` > 0: eight times as far as the points are apart. Zigzags that overlap are one. A step of
/// two right angles within it is one too. O(corners log corners + corners x zigzags).
Zigzags zigzags_of(const ContourCourse& course, double way);

}  // namespace instep
