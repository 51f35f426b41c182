#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "core/result.h"

namespace instep {

/// Why a device node could not be opened (errno), where it is one of the two causes that are the
/// same for all devices: kPermissionDenied, whose remedy is `advice_on_rights`, and kNotFound,
/// `advice_if_away`. Nothing for any other, of which each kind of device knows more.
std::optional<Error> node_error(int error_number, const std::filesystem::path& node,
                                const std::string& advice_on_rights,
                                const std::string& advice_if_away);

}  // namespace instep
