#include "tests/bench/accuracy/report_table.h"

#include <fmt/core.h>

#include <cstdio>

namespace instep::bench {
namespace {

std::string length(const std::optional<double>& value) {
  return value ? fmt::format("{:.4f}", *value) : "-";
}

std::string percent(const test::Held& held) {
  const auto share = held.share();
  return share ? fmt::format("{:.1f}", 100.0 * *share) : "-";
}

std::string text_of(const test::Bar& bar) {
  std::string text;
  const auto add = [&](const char* what, const std::optional<double>& limit) {
    if (limit) text += fmt::format("{}{} {:g}", text.empty() ? "" : ", ", what, *limit);
  };
  add("mean", bar.mean_mm);
  add("worst", bar.worst_mm);
  add("bias", bar.bias_mm);
  return text;
}

void print_row(const std::string& name, const test::Summary& summary, const std::string& bar,
               const std::string& mark) {
  fmt::print("{:<38}{:>5}{:>4}{:>9.4f}{:>9.4f}{:>+9.4f}{:>9.4f}{:>7}{:>7}{:>9}{:>7.1f}  {:<24}{}\n",
             name, summary.cases, summary.refused, summary.mean_mm, summary.worst_mm,
             summary.bias_mm, summary.contact_mean_mm, percent(summary.stretched),
             percent(summary.contact), length(summary.median_u95_mm), summary.median_milliseconds,
             bar, mark);
  std::fflush(stdout);
}

}  // namespace

void print_heading(const std::string& title) {
  fmt::print("\n{:<38}{:>5}{:>4}{:>9}{:>9}{:>9}{:>9}{:>14}{:>9}{:>7}\n", "", "", "", "stretched",
             "", "", "contact", "95 % held of", "median", "CPU");
  fmt::print("{:<38}{:>5}{:>4}{:>9}{:>9}{:>9}{:>9}{:>7}{:>7}{:>9}{:>7}  {}\n", title, "n", "ref",
             "mean", "worst", "bias", "mean", "str.", "con.", "+- mm", "ms", "bar");
}

void print_class(const std::string& name, const test::Bar& bar, const test::Summary& summary) {
  const std::string text = text_of(bar);
  print_row(name, summary, text, text.empty() ? "" : meets(summary, bar) ? "pass" : "MISS");
}

void print_kind(const std::string& name, const test::Summary& summary) {
  print_row(name, summary, "", "");
}

void print_figure(const std::string& name, const std::string& figure, const std::string& bar,
                  bool pass) {
  fmt::print("{:<38}{:>71}  {:<24}{}\n", name, figure, bar, pass ? "pass" : "MISS");
}

}  // namespace instep::bench
