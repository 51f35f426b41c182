#include "core/built_for.h"

namespace instep {

const char* built_for() {
  return INSTEP_BUILT_FOR;
}

}  // namespace instep
