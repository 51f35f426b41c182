#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/result.h"
#include "daemon/cloud_files/ply_header.h"
#include "daemon/cloud_files/scalar_column.h"

namespace instep {

/// Where the numbers of one scalar property go.
struct PlyColumn {
  std::size_t property = 0;
  ColumnTarget target;
};

/// One list property, all records after each other.
struct PlyLists {
  std::size_t property = 0;
  std::vector<std::uint32_t> lengths;  ///< one for each record
  std::vector<double> items;
};

/// The data behind a PLY header, element by element in the order of the header.
class PlyBody {
 public:
  virtual ~PlyBody() = default;

  /// False if the bytes left cannot hold the element's records. To be asked before memory is taken
  /// for them.
  virtual bool can_hold(const PlyElement& element) const = 0;

  /// Reads all records of the element, which is passed over if nothing of it is wanted. Fails,
  /// saying how, with kCorruptData.
  virtual Result<void> read(const PlyElement& element, const std::vector<PlyColumn>& columns,
                            PlyLists* lists) = 0;

  /// Bytes that were not read yet, without blanks at the end.
  virtual std::size_t unread_bytes() const = 0;
};

/// Borrows `bytes` (the whole file).
std::unique_ptr<PlyBody> open_ply_body(const PlyHeader& header, std::string_view bytes,
                                       const std::string& file);

}  // namespace instep
