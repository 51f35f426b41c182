#include "drivers/files/node_error.h"

#include <cerrno>
#include <cstring>

namespace instep {

std::optional<Error> node_error(int error_number, const std::filesystem::path& node,
                                const std::string& advice_on_rights,
                                const std::string& advice_if_away) {
  const std::string what = node.string() + " cannot be opened: " + std::strerror(error_number);
  switch (error_number) {
    case EACCES:
    case EPERM:
      return fail(ErrorCode::kPermissionDenied, what, advice_on_rights).value();
    case ENOENT:
    case ENOTDIR:
    case ENODEV:
    case ENXIO:
      return fail(ErrorCode::kNotFound, what, advice_if_away).value();
    default:
      return std::nullopt;
  }
}

}  // namespace instep
