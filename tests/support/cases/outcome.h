#pragma once

#include <optional>
#include <string>
#include <vector>

#include "tests/support/cases/case_classes.h"
#include "tests/support/cases/girth_case.h"

namespace instep::test {

/// How girth_by_rbf() did on a case.
struct Outcome {
  std::optional<std::string> refusal;
  double stretched_error_mm = 0.0;
  double contact_error_mm = 0.0;
  std::optional<double> stretched_u95_mm;
  std::optional<double> contact_u95_mm;
  double sigma_mm = 0.0;  ///< noise that was used
  std::size_t band_points = 0;
  double milliseconds = 0.0;  ///< processor time
  std::optional<double> floor_mm;
};

Outcome measured(const GirthCase& measured_case);

/// Numbers that a share of the cases keep: errors against their 95 % intervals.
struct Held {
  int intervals = 0;
  int held = 0;

  std::optional<double> share() const;
};

/// A class of cases in figures; means and medians are not numbers where there is no case.
struct Summary {
  int cases = 0;
  int refused = 0;
  double mean_mm = 0.0;  ///< of the stretched errors' sizes
  double worst_mm = 0.0;
  double bias_mm = 0.0;
  double contact_mean_mm = 0.0;
  Held stretched;
  Held contact;
  std::optional<double> median_u95_mm;  ///< stretched
  double median_milliseconds = 0.0;
  /// Root of the mean squared stretched error, each in units of its floor; cases without do not
  /// count.
  std::optional<double> times_floor;
};

Summary summary_of(const std::vector<Outcome>& outcomes);

/// Whether a class meets its bar: a refusal never does.
bool meets(const Summary& summary, const Bar& bar);

}  // namespace instep::test
