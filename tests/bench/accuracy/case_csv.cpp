#include "tests/bench/accuracy/case_csv.h"

#include <fmt/core.h>

#include <stdexcept>

#include "core/geometry/point_index.h"
#include "core/geometry/point_spacing.h"

namespace instep::bench {
namespace {

std::string number(const std::optional<double>& value) {
  return value ? fmt::format("{:.9g}", *value) : "";
}

double spacing_of(const PointCloud& cloud) {
  return median_nearest_distance(PointIndex(cloud.positions));
}

}  // namespace

CaseCsv::CaseCsv(const std::filesystem::path& file) {
  if (file.empty()) return;
  file_.open(file);
  if (!file_) throw std::runtime_error("cannot write " + file.string());
  file_ << "name,kind,body,sampling,points,spacing_mm,noise_mm,hole_mm,normals_told,sigma_told,"
           "stretched_mm,contact_mm,refused,stretched_error_mm,contact_error_mm,stretched_u95_mm,"
           "contact_u95_mm,sigma_used_mm,band_points,floor_mm,cpu_ms\n";
}

void CaseCsv::add(const std::string& kind, const test::GirthCase& measured_case,
                  const test::Outcome& outcome) {
  if (!file_.is_open()) return;
  const auto& making = measured_case.making;
  file_ << fmt::format("\"{}\",\"{}\",{},{},{},{:.4f},{:.4f},{:.2f},{:d},{:d},{:.6f},{:.6f},{:d},",
                       measured_case.name, kind, making.body, making.sampling,
                       measured_case.cloud.size(), spacing_of(measured_case.cloud), making.sigma_mm,
                       making.hole_mm, making.normals_told, making.sigma_told,
                       measured_case.stretched_mm, measured_case.contact_mm,
                       outcome.refusal.has_value());
  if (!outcome.refusal) {
    file_ << fmt::format("{:.9g},{:.9g},{},{},{:.9g},{},{},", outcome.stretched_error_mm,
                         outcome.contact_error_mm, number(outcome.stretched_u95_mm),
                         number(outcome.contact_u95_mm), outcome.sigma_mm, outcome.band_points,
                         number(outcome.floor_mm));
  } else {
    file_ << ",,,,,,,";
  }
  file_ << fmt::format("{:.3f}\n", outcome.milliseconds) << std::flush;
}

}  // namespace instep::bench
