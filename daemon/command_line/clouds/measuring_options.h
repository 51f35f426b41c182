#pragma once

#include <string>

#include "core/foot/measuring_rules.h"

namespace CLI {
class App;
}

namespace instep {

/// Adds --axis, --ball-girth, --instep-girth and --heel-breadth to a command: which definitions it
/// measures by. What is not said stays as `rules` has it when the command runs.
class MeasuringOptions {
 public:
  void add_to(CLI::App& command);

  /// `rules` with what was said on the command line.
  MeasuringRules over(MeasuringRules rules) const;

 private:
  std::string axis_;
  std::string ball_girth_;
  std::string instep_girth_;
  std::string heel_breadth_;
};

}  // namespace instep
