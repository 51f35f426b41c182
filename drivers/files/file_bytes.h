#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>

#include "core/result.h"

namespace instep {

/// The whole content of a regular file of at most `most_bytes`. It is read, not mapped: a mapped
/// file that another program cuts short kills its reader.
///
/// Fails with kNotFound, kPermissionDenied, kInvalidInput (a folder or a device), kUnsupported
/// (larger than the limit) or kIo; the message names the file. Never waits on a pipe.
Result<std::string> read_file_bytes(const std::filesystem::path& path, std::size_t most_bytes);

/// Who may read a new file.
enum class Readers { kByUmask, kAll };

/// Puts `bytes` under the name `path`, whole or not at all: they are written to a temporary name in
/// the same folder, brought to the disk and renamed. A file of that name is replaced, with the same
/// owner, if that is allowed, and the same permissions; where `path` is a link, what it leads to
/// is. On failure all stays as it was and nothing is left behind.
///
/// Fails with kInvalidInput (a folder, a device or a pipe has that name), kNoSpace,
/// kPermissionDenied, kNotFound (no such folder) or kIo.
Result<void> write_file_bytes(const std::filesystem::path& path, std::string_view bytes,
                              Readers of_new = Readers::kByUmask);

/// All of `bytes` to an open file, however often a signal breaks in. False with errno set.
bool write_all(int descriptor, std::string_view bytes);

/// What write_file_bytes() writes to: where a link leads to, which need not be there, and the links
/// after it; `path` itself if it is none.
std::filesystem::path end_of_links(std::filesystem::path path);

/// What to do where a file system takes nothing: the kernel itself takes writing away from one that
/// has errors.
inline constexpr const char* kReadOnlyAdvice =
    "its disk is mounted read-only, often after a disk error: see dmesg, then remount it";

/// The Error for an errno value met while doing something to a file: "cannot write /x/y (No space
/// left on device): free some disk space ...".
Error file_error(int error_number, const std::string& doing, const std::filesystem::path& path);

}  // namespace instep
