#pragma once

#include <string>
#include <vector>

#include "core/result.h"

namespace instep {

/// Why a source of cameras could not be opened.
struct SourceTrouble {
  std::string camera;  ///< empty where the source is of several
  Error error;
};

/// Why not all devices could be opened, each source for itself.
struct OpeningFailure {
  std::vector<SourceTrouble> sources;
  std::vector<std::string> without_fault;  ///< cameras of the others, which may not be there either

  /// All in one, for whoever gives up.
  Error as_one() const;
};

}  // namespace instep
