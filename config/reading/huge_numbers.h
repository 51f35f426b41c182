#pragma once

#include <optional>
#include <string>

namespace instep {

/// A place in a TOML text as its parser counts: lines and characters of UTF-8, both from 1.
struct TomlPlace {
  unsigned line = 1;
  unsigned column = 1;
};

/// For a parser's complaint (`fault`, in the words of toml++) about a number that 64 bits cannot
/// hold, `place` being where it gave up: puts a 0 in that number's place, so that what else is
/// wrong with the text can be told, and returns the number as it was written. Nothing, and the text
/// as it was, if the fault is another.
std::optional<std::string> take_out_huge_number(std::string& text, TomlPlace place,
                                                const std::string& fault);

/// What the largest and smallest numbers of that kind are, for the one who wrote `number`.
std::string limits_of(const std::string& number);

}  // namespace instep
