#pragma once

#include <string>

#include "tests/support/cases/case_classes.h"
#include "tests/support/cases/outcome.h"

namespace instep::bench {

/// Prints the report's lines to standard output; all lengths in mm.
void print_heading(const std::string& title);
void print_class(const std::string& name, const test::Bar& bar, const test::Summary& summary);

/// A line of the sort of cases that the name says, without a bar.
void print_kind(const std::string& name, const test::Summary& summary);

/// A single figure beside its bar, marked.
void print_figure(const std::string& name, const std::string& figure, const std::string& bar,
                  bool pass);

}  // namespace instep::bench
