// Every measure of a foot, found without a hand, over simulated feet whose truth is known, and over
// real feet and lasts that are turned, mirrored and thinned.
#include <fmt/core.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <string>
#include <vector>

#include "tests/bench/feet/drawn_feet_report.h"
#include "tests/bench/feet/real_feet_report.h"

int main(int count, char** words) {
  CLI::App app("Errors of the measures of feet whose truth is known, and their steadiness");
  std::vector<std::string> parts;
  instep::bench::DrawnFeetWishes drawn;
  app.add_option("parts", parts, "Only these: drawn real lasts time")
      ->check(CLI::IsMember({"drawn", "real", "lasts", "time"}));
  app.add_option("--feet", drawn.feet, "How many feet to draw")->capture_default_str();
  app.add_option("--first", drawn.first_seed, "The first one's seed")->capture_default_str();
  app.add_option("--threads", drawn.threads, "Feet measured at once")->capture_default_str();
  app.add_flag("--open", drawn.all_open, "Draw no foot with a sole that is seen");
  app.add_flag("-v,--verbose", drawn.verbose, "Print each foot");
  CLI11_PARSE(app, count, words);
  const auto wants = [&](const char* part) {
    return parts.empty() || std::find(parts.begin(), parts.end(), part) != parts.end();
  };
  if (wants("drawn")) instep::bench::report_drawn_feet(drawn);
  if (wants("real")) instep::bench::report_real_feet();
  if (wants("lasts")) instep::bench::report_lasts();
  if (wants("time")) instep::bench::report_time();
  return 0;
}
