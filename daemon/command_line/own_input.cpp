#include "daemon/command_line/own_input.h"

#include <system_error>

namespace instep {

Result<void> spare_input(const std::filesystem::path& out, const std::string& option,
                         const std::filesystem::path& input, const std::string& what) {
  std::error_code is_new;
  if (!std::filesystem::equivalent(out, input, is_new)) return {};
  return fail(ErrorCode::kInvalidInput,
              out.string() + " is " + what + " itself, and is not replaced",
              "choose another " + option);
}

}  // namespace instep
