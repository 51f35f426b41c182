#include "core/fusion/views/seen_through.h"

namespace instep {

std::vector<std::size_t> points_not_seen_through(const ViewedCloud& points,
                                                 const std::vector<PosedDepth>& views,
                                                 double margin_mm) {
  const std::vector<Witness> witnesses(views.begin(), views.end());
  std::vector<std::size_t> kept;
  for (std::size_t i = 0; i < points.cloud.size(); ++i) {
    bool confirmed = false;
    bool seen_through = false;
    for (std::size_t view = 0; view < witnesses.size() && !confirmed; ++view) {
      if (view == points.views[i]) continue;
      const Verdict verdict = witnesses[view].judge(points.cloud.positions[i], margin_mm);
      confirmed = verdict == Verdict::kConfirms;
      seen_through = seen_through || verdict == Verdict::kSeesThrough;
    }
    if (confirmed || !seen_through) kept.push_back(i);
  }
  return kept;
}

}  // namespace instep
