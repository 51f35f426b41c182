#include "daemon/store/result_content.h"

#include "daemon/cloud_files/cloud_ply_writer.h"
#include "daemon/report/result_json.h"
#include "daemon/report/sections_svg.h"

namespace instep {

ResultContent content_of(const ScanRecord& record) {
  return {result_json(record).dump(2) + "\n", cloud_to_ply(record.foot.cloud).value_or(""),
          sections_svg(record.foot, record.measures)};
}

}  // namespace instep
