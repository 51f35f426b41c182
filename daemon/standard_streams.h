#pragma once

namespace instep {

/// Fills those of stdin, stdout and stderr that are closed with a place that can be neither read
/// nor written. Without it the next file that is opened would take their number, and what is
/// printed would go into it. Call first of all, before anything is opened.
void fill_closed_standard_streams();

}  // namespace instep
