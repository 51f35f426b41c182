#pragma once

namespace instep::bench {

/// Real feet of the trial data, turned, shifted, mirrored, thinned to a half and with noise: how
/// far each measure moves. Their lengths and sides.
void report_real_feet();

/// Lasts: whether they are taken for lasts, and how far their ball planes are from the public ones.
void report_lasts();

/// Time of a whole measure of a 50,000-point cloud on one core.
void report_time();

}  // namespace instep::bench
