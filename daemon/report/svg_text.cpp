#include "daemon/report/svg_text.h"

#include <fmt/format.h>

#include "daemon/report/mended_text.h"

namespace instep::svg {

std::string escaped(std::string_view text) {
  std::string safe;
  for (const char letter : mended_text(text)) {
    switch (letter) {
      case '&':
        safe += "&amp;";
        break;
      case '<':
        safe += "&lt;";
        break;
      case '>':
        safe += "&gt;";
        break;
      case '"':
        safe += "&quot;";
        break;
      case '\'':
        safe += "&apos;";
        break;
      default:
        if (static_cast<unsigned char>(letter) >= 0x20) safe += letter;
    }
  }
  return safe;
}

std::vector<Eigen::Vector2d> thinned(const std::vector<Eigen::Vector2d>& line, double least) {
  std::vector<Eigen::Vector2d> kept;
  for (const auto& point : line) {
    if (kept.empty() || (point - kept.back()).norm() >= least) kept.push_back(point);
  }
  return kept;
}

std::string point_list(const std::vector<Eigen::Vector2d>& points) {
  std::string list;
  for (const auto& point : points) {
    list += fmt::format("{}{:.1f},{:.1f}", list.empty() ? "" : " ", point.x(), point.y());
  }
  return list;
}

std::string polygon(const std::vector<Eigen::Vector2d>& points, std::string_view style) {
  return fmt::format("<polygon class=\"{}\" points=\"{}\"/>\n", style, point_list(points));
}

std::string polyline(const std::vector<Eigen::Vector2d>& points, std::string_view style) {
  return fmt::format("<polyline class=\"{}\" points=\"{}\"/>\n", style, point_list(points));
}

std::string dots(const std::vector<Eigen::Vector2d>& points, double radius,
                 std::string_view style) {
  if (points.empty()) return {};
  // One path of zero-length round strokes is far smaller than a circle for each point.
  std::string path;
  for (const auto& point : points) path += fmt::format("M{:.1f} {:.1f}h0", point.x(), point.y());
  return fmt::format("<path class=\"{}\" stroke-width=\"{:.1f}\" d=\"{}\"/>\n", style, 2.0 * radius,
                     path);
}

std::string label(const Eigen::Vector2d& place, std::string_view style, std::string_view text) {
  return fmt::format("<text class=\"{}\" x=\"{:.1f}\" y=\"{:.1f}\">{}</text>\n", style, place.x(),
                     place.y(), escaped(text));
}

std::string line(const Eigen::Vector2d& from, const Eigen::Vector2d& to, std::string_view style) {
  return fmt::format(
      "<line class=\"{}\" x1=\"{:.1f}\" y1=\"{:.1f}\" x2=\"{:.1f}\" y2=\"{:.1f}\"/>\n", style,
      from.x(), from.y(), to.x(), to.y());
}

std::vector<Eigen::Vector2d> placed(const std::vector<Eigen::Vector2d>& points,
                                    const Eigen::Vector2d& origin, double per_mm) {
  std::vector<Eigen::Vector2d> on_page;
  on_page.reserve(points.size());
  for (const auto& point : points) on_page.push_back(origin + per_mm * point);
  return on_page;
}

std::string measuring_line(const Eigen::Vector2d& from, const Eigen::Vector2d& to, double half_end,
                           std::string_view style) {
  const Eigen::Vector2d end(0.0, half_end);
  return line(from, to, style) + line(from - end, from + end, style) +
         line(to - end, to + end, style);
}

}  // namespace instep::svg
