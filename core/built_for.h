#pragma once

namespace instep {

/// The processors that the measuring which runs here was built for: "x86-64-v3", with wide vectors,
/// or "any processor". The dynamic loader chose it (two_builds.cmake); both give the same girths
/// to a billionth of a millimetre.
const char* built_for();

}  // namespace instep
