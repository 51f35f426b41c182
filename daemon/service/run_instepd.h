#pragma once

namespace instep {

/// The program instepd: reads its command line and settings, and runs the station until it is told
/// to end. Returns the exit code: 0 done, 1 it could not be done (stderr says why), 2 wrong usage.
int run_instepd(int argc, char** argv);

}  // namespace instep
