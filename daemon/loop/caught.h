#pragma once

#include <string_view>
#include <type_traits>

#include "core/result.h"

namespace instep {

/// The error that the exception being handled stands for: no memory, or a fault of the program.
/// `doing`: what broke off, "the scan". In a catch block only.
Error error_of_thrown(std::string_view doing);

/// What `work` returns, a Result; what it throws, as its error. On a thread whose exceptions would
/// end the whole daemon.
template <class Work>
std::invoke_result_t<const Work&> caught(std::string_view doing, const Work& work) {
  try {
    return work();
  } catch (...) {
    return tl::make_unexpected(error_of_thrown(doing));
  }
}

}  // namespace instep
