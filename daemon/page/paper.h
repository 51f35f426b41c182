#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <vector>

namespace instep::paper {

/// The page of a report: A4, upright, drawn in tenths of a millimetre of paper, so that coordinates
/// to a tenth of a unit are far finer than print.
inline constexpr double kPerMm = 10.0;
inline constexpr double kWidth = 2100.0;
inline constexpr double kHeight = 2970.0;
inline constexpr double kMargin = 140.0;

/// The scales that drawings are made in, 1 to so much, largest first.
inline constexpr std::array kScales = {1.5, 2.0, 2.5, 3.0, 4.0, 5.0, 8.0};

/// The first of kScales at which `extent_mm` of a foot takes at most `room` on the page; the last
/// one if none is small enough.
double scale_that_fits(double extent_mm, double room);

/// Page units for a millimetre of foot at 1 to `scale`.
inline double per_foot_mm(double scale) {
  return kPerMm / scale;
}

/// How wide a line of text is at a size of letters. The width of a letter is that of a wide type,
/// since nobody knows which one the reader has.
double text_width(const std::string& text, double letter_size);

/// Cuts text into lines of at most `width` at a size of letters, at spaces where it can, but
/// for one between a number and "%".
std::vector<std::string> wrapped(const std::string& text, double width, double letter_size);

}  // namespace instep::paper
