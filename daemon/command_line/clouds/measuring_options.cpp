#include "daemon/command_line/clouds/measuring_options.h"

#include <CLI/CLI.hpp>
#include <vector>

namespace instep {
namespace {

template <typename Rule, std::size_t Count>
void add_choice(CLI::App& command, const char* option, std::string& word,
                const RuleNames<Rule, Count>& rules, const char* help) {
  std::vector<std::string> names;
  for (const auto& rule : rules) names.emplace_back(rule.first);
  command.add_option(option, word, help)->check(CLI::IsMember(names));
}

template <typename Rule, std::size_t Count>
void take_choice(const std::string& word, const RuleNames<Rule, Count>& rules, Rule& rule) {
  for (const auto& [name, one] : rules) {
    if (name == word) rule = one;
  }
}

}  // namespace

void MeasuringOptions::add_to(CLI::App& command) {
  add_choice(
      command, "--axis", axis_, kAxisRules,
      "what lengths are measured along (/etc/instep/instep.toml explains them, or "
      "config/instep.toml of the sources); like the next three as [measures] of the settings "
      "says, if not given");
  add_choice(command, "--ball-girth", ball_girth_, kBallGirthRules, "plane of the ball girth");
  add_choice(command, "--instep-girth", instep_girth_, kInstepGirthRules,
             "plane of the instep girth");
  add_choice(command, "--heel-breadth", heel_breadth_, kHeelBreadthRules,
             "where the heel's breadth is taken");
}

MeasuringRules MeasuringOptions::over(MeasuringRules rules) const {
  take_choice(axis_, kAxisRules, rules.axis);
  take_choice(ball_girth_, kBallGirthRules, rules.ball_girth);
  take_choice(instep_girth_, kInstepGirthRules, rules.instep_girth);
  take_choice(heel_breadth_, kHeelBreadthRules, rules.heel_breadth);
  return rules;
}

}  // namespace instep
