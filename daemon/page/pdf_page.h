#pragma once

#include <string>

#include "core/result.h"

namespace instep {

/// A page of SVG as PDF, with its own size and its letters as text.
///
/// The work is done by the program rsvg-convert (Debian package librsvg2-bin), so that neither the
/// daemon nor any other command carries a drawing library, and a machine that prints no PDF needs
/// none. Fails with kUnsupported if there is no such program, with kTimeout if it takes longer than
/// ten seconds (it is then killed), and with kIo if it fails.
Result<std::string> pdf_of_page(const std::string& svg);

}  // namespace instep
