#pragma once

#include <Eigen/Core>
#include <string>
#include <string_view>
#include <vector>

namespace instep::svg {

/// A part of a page: its elements, and how far down it reaches.
struct Block {
  std::string svg;
  double bottom = 0.0;
};

/// The text with the five characters of XML escaped, control characters left out, and what is no
/// text mended.
std::string escaped(std::string_view text);

/// The points of a line without those nearer than `least` to the one kept before.
std::vector<Eigen::Vector2d> thinned(const std::vector<Eigen::Vector2d>& line, double least);

/// Points as an attribute value, "x,y x,y ...", to a tenth of a pixel.
std::string point_list(const std::vector<Eigen::Vector2d>& points);

/// A closed shape, and small round dots, of a class of the page's style sheet.
std::string polygon(const std::vector<Eigen::Vector2d>& points, std::string_view style);
std::string dots(const std::vector<Eigen::Vector2d>& points, double radius, std::string_view style);

/// An open line through points.
std::string polyline(const std::vector<Eigen::Vector2d>& points, std::string_view style);

/// A line of text; `style` names its class.
std::string label(const Eigen::Vector2d& place, std::string_view style, std::string_view text);

/// Points in millimetres (or whatever) on the page, from `origin` on.
std::vector<Eigen::Vector2d> placed(const std::vector<Eigen::Vector2d>& points,
                                    const Eigen::Vector2d& origin, double per_mm);

/// A level line with ends that show how far it goes.
std::string measuring_line(const Eigen::Vector2d& from, const Eigen::Vector2d& to, double half_end,
                           std::string_view style);

/// A straight line.
std::string line(const Eigen::Vector2d& from, const Eigen::Vector2d& to, std::string_view style);

}  // namespace instep::svg
