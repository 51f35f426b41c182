#include "tests/bench/shared/girth_methods.h"

namespace instep::bench {

std::vector<NamedMethod> girth_methods() {
  return {
      {"rbf", [](const auto& cloud, const auto& plane) { return girth_by_rbf(cloud, plane); }},
      {"rbf-paper",
       [](const auto& cloud, const auto& plane) { return girth_by_paper(cloud, plane); }},
      {"mesh", [](const auto& cloud, const auto& plane) { return girth_by_mesh(cloud, plane); }},
      {"hull", [](const auto& cloud, const auto& plane) { return girth_by_hull(cloud, plane); }},
  };
}

}  // namespace instep::bench
