#pragma once

#include <functional>
#include <string>
#include <vector>

#include "core/girth/girth.h"

namespace instep::bench {

using GirthMethod = std::function<Result<Girth>(const PointCloud& cloud, const TapePlane& plane)>;

struct NamedMethod {
  std::string name;
  GirthMethod girth;
};

/// All methods of this project that work on points, the default first; named as on the command
/// line.
std::vector<NamedMethod> girth_methods();

}  // namespace instep::bench
