#pragma once

#include <string>
#include <string_view>

#include "core/result.h"
#include "daemon/cloud_files/raw_cloud.h"

namespace instep {

/// Reads points from lines of text: x y z, or x y z nx ny nz, or x y z and others that are not
/// used, which a note tells, parted by spaces, tabs, commas or semicolons, with decimal points or,
/// where no commas part them and there are no decimal points, decimal commas. A semicolon may end a
/// line. Empty lines, comments (# or //) and one heading line before the first point are passed
/// over; so is a lone count of points there. A heading, or a comment before the first point with as
/// many words as it has numbers, that names x, y and z says which columns count
/// (columns_named_by()).
///
/// Fails with kCorruptData and the number of the line where another line is no point, holds a word,
/// is a second heading, has its numbers in quotes or another number of columns than the heading or
/// the first, and where it cannot be told what commas mean.
Result<RawCloud> read_text_cloud(std::string_view text, const std::string& file);

/// True if one of the first four lines that are no comments is of numbers, in quotes or not, or has
/// any under a heading of x, y and z: to tell a cloud from other text, be there a heading too many
/// in it.
bool looks_like_text_cloud(std::string_view text);

}  // namespace instep
