#pragma once

#include <sys/syscall.h>
#include <unistd.h>

#include <thread>

namespace instep::test {

/// Who owns nothing: "nobody".
inline constexpr uid_t kStranger = 65534;

/// Does it as the stranger, as whom a thread of its own runs alone; as who the test is where that
/// is not root.
template <class Work>
auto as_stranger(const Work& work) {
  decltype(work()) outcome;
  std::thread([&] {
    ::syscall(SYS_setresuid, kStranger, kStranger, kStranger);
    outcome = work();
  }).join();
  return outcome;
}

}  // namespace instep::test
