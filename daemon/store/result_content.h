#pragma once

#include <cstddef>
#include <string>

#include "core/result.h"
#include "daemon/scan/scan_record.h"

namespace instep {

/// The files of one result as ready bytes.
struct ResultContent {
  std::string result_json;
  std::string cloud_ply;
  std::string sections_svg;
  std::string report_svg;

  std::size_t bytes() const {
    return result_json.size() + cloud_ply.size() + sections_svg.size() + report_svg.size();
  }
};

/// Serialises a record. Pure; some milliseconds for a usual cloud. Fails with kInvalidInput on a
/// cloud that contradicts itself.
Result<ResultContent> content_of(const ScanRecord& record);

}  // namespace instep
