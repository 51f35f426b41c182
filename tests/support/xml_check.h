#pragma once

#include <string>

namespace instep::test {

/// What is wrong with a text as XML, as far as the project's own writers could err: a tag that is
/// not closed in order, a stray "<", a number that is none. Empty if nothing is.
std::string fault_in_xml(const std::string& xml);

}  // namespace instep::test
