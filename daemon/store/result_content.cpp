#include "daemon/store/result_content.h"

#include "daemon/cloud_files/cloud_ply_writer.h"
#include "daemon/page/report_page.h"
#include "daemon/report/result_json.h"
#include "daemon/report/sections_svg.h"

namespace instep {

Result<ResultContent> content_of(const ScanRecord& record) {
  auto cloud = cloud_to_ply(record.foot.cloud);
  if (!cloud) return tl::make_unexpected(cloud.error());
  const Json json = result_json(record);
  constexpr int kIndent = 2;
  return ResultContent{json.dump(kIndent, ' ', false, Json::error_handler_t::replace) + "\n",
                       std::move(*cloud), sections_svg(record.foot, record.measures),
                       report_page(record)};
}

}  // namespace instep
