#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "core/result.h"

namespace instep {

/// The few calls of a file system that the result store makes, each as bare as the system's own, so
/// that tests can let any of them fail, and can cut the power between any two. Failures are
/// kNoSpace, kPermissionDenied, kNotFound or kIo, all of them for the operator.
class Storage {
 public:
  using File = int;
  struct Entry {
    std::string name;
    bool is_folder = false;          ///< itself
    bool is_link_to_folder = false;  ///< such as to an archive on another disk
  };

  virtual ~Storage() = default;

  /// A new file, mode 0640; it must not be there yet.
  virtual Result<File> create_file(const std::filesystem::path& path) = 0;
  /// Writes the head of `bytes`, possibly not all of it, and says how much.
  virtual Result<std::size_t> write(File file, std::string_view bytes) = 0;
  /// Returns when what was written is durable.
  virtual Result<void> sync(File file) = 0;
  virtual void close(File file) = 0;

  /// Mode 0750; one that is there already is fine.
  virtual Result<void> make_folder(const std::filesystem::path& path) = 0;
  virtual Result<void> rename(const std::filesystem::path& from,
                              const std::filesystem::path& to) = 0;
  virtual Result<void> remove_file(const std::filesystem::path& path) = 0;
  /// Must be empty.
  virtual Result<void> remove_folder(const std::filesystem::path& path) = 0;
  /// Returns when the names in a folder are durable.
  virtual Result<void> sync_folder(const std::filesystem::path& path) = 0;

  /// Fails if nothing can be made in a folder that is there.
  virtual Result<void> check_writing(const std::filesystem::path& path) = 0;

  /// Takes hold of a folder, until the Storage ends or its program does, and lets go of the one it
  /// held: alone, so that nobody else takes hold of it before share_hold(), or beside others who
  /// have it. False if there are others.
  virtual Result<bool> take_hold(const std::filesystem::path& path) = 0;
  /// From now on others may take hold of it too.
  virtual void share_hold() = 0;
  /// Sees that the folder of which this took hold is there under its name; who has it alone keeps
  /// it so. Fails with kNotFound if it is gone, and with kDeviceGone if another has taken its
  /// place, or it was missed before: whether it is the same nobody can tell then, so that it is let
  /// go of until take_hold(). Fails with kBusy while another program has it alone. Fine where
  /// nothing was taken hold of.
  virtual Result<void> keep_hold(const std::filesystem::path& path) = 0;

  /// In the order of the names.
  virtual Result<std::vector<Entry>> list(const std::filesystem::path& path) = 0;
  /// Of a plain file. Fails with kCorruptData if it is none, or has more bytes than `most`.
  virtual Result<std::string> read(const std::filesystem::path& path, std::size_t most) = 0;
};

}  // namespace instep
