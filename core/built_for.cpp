#include "core/built_for.h"

namespace instep {

const char* built_for() {
#ifdef __AVX2__
  return "x86-64-v3";
#else
  return "any processor";
#endif
}

}  // namespace instep
