#pragma once

#include <Eigen/Core>

#include "daemon/report/svg_text.h"
#include "daemon/scan/scan_record.h"

namespace instep {

/// The numbers of a report: the measures with their intervals, beside them what the other foot has
/// more or less, then the sizes of shoes. Tables of the shop that reach below `lowest`, and these
/// alone, are left out, and their number is said.
svg::Block numbers_block(const ScanRecord& record, const Eigen::Vector2d& corner, double width,
                         double lowest);

/// What notes_block() takes for all it has to say.
double notes_height(const ScanRecord& record, double width);

/// What was withheld and why, and what to doubt, in lines that fit `width`; those below `lowest`
/// are left out, and their number is said.
svg::Block notes_block(const ScanRecord& record, const Eigen::Vector2d& corner, double width,
                       double lowest);

}  // namespace instep
