#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/foot/foot_scan.h"
#include "core/foot/measure_set.h"

namespace instep {

/// The three measures that sizes of shoes are told from, millimetres; nothing where one is missing.
struct SizedFoot {
  std::optional<double> length_mm;
  std::optional<double> ball_girth_mm;
  std::optional<double> breadth_mm;  ///< metatarsale tibiale to fibulare, in floor projection
};

/// What a set of measures has of them. A value that is no positive number counts as missing, and so
/// does a length whose interval holds more than a size of the EU to either side.
SizedFoot sized_foot(const MeasureSet& measures);

/// The foot that a pair of shoes must take: of each measure the larger one. One that only one foot
/// has is that foot's.
SizedFoot larger_of(const SizedFoot& one, const SizedFoot& other);

/// A note for each of the three that only one foot of a pair has: the other one may be larger.
std::vector<std::string> notes_of_one_foot(const SizedFoot& left, const SizedFoot& right);

/// One row of a shop's own table: a shoe that takes feet up to these measures.
struct ShopSize {
  std::string size;                             ///< as it stands on the box
  double longest_foot_mm = 0.0;                 ///< 80 to 400
  std::optional<double> largest_ball_girth_mm;  ///< 80 to 500
};

/// A shop's table of one brand, model or last, shortest first.
struct ShopTable {
  std::string name;
  std::vector<ShopSize> sizes;
};

/// How sizes are told.
struct SizeRules {
  /// What a last is longer than the foot it is for, 0 to 40. Makers differ: 15 to 20 is usual.
  double allowance_mm = 15.0;
  std::vector<ShopTable> shop_tables;
};

/// A size of a scale of numbers: as computed, and to the nearest half that a shoe may be marked
/// with.
struct MarkedSize {
  double exact = 0.0;
  double marked = 0.0;
};

/// A row of a shop's table, or why there is none.
struct ShopChoice {
  std::string table;
  std::optional<std::string> size;
  std::string note;  ///< empty if there is nothing to say
};

/// Sizes of shoes, as guidance: no two makers' shoes of one size are alike. Each is told from the
/// foot itself, never from another system's rounded size.
struct ShoeSizes {
  SizedFoot foot;             ///< what they were told from
  double allowance_mm = 0.0;  ///< that was used

  /// ISO 9407: the length of the foot to the nearest 5 mm, and its breadth to the nearest one.
  std::optional<double> mondopoint_mm;
  std::optional<double> mondopoint_width_mm;
  /// Paris points: two thirds of a centimetre of last.
  std::optional<MarkedSize> eu;
  /// Thirds of an inch of last, from 25 thirds on: sizes of grown feet.
  std::optional<MarkedSize> uk;
  /// Brannock's scale: thirds of an inch of foot, men from 22 and women from 21 thirds on. It goes
  /// by the foot, so the allowance has no part in it.
  std::optional<MarkedSize> us_men;
  std::optional<MarkedSize> us_women;
  /// JIS S 5037: the length to 5 mm as centimetres, and a letter for the ball girth, from A to G
  /// for men and to F for women; such as "27.5 EEE".
  std::optional<std::string> jis_men;
  std::optional<std::string> jis_women;

  std::vector<ShopChoice> shop;
  std::vector<std::string> notes;  ///< what is missing and why
};

/// Without the length of the foot there is none, and the notes say so; without the ball girth there
/// is no width. A scale that does not reach so short or so long a foot is left out.
///
/// Of a shop's table, the first row that takes the length, and the ball girth where the row has a
/// limit for it. If the girth was not measured, the length alone decides, and the note says so; it
/// says too where the foot is so short that even the smallest size may be too long.
ShoeSizes shoe_sizes(const SizedFoot& foot, const SizeRules& rules = {});

/// Of a scanned foot, or of the larger of a pair of which it is one. A shoe last has none, since it
/// is longer than the foot it is for, and the notes say so.
ShoeSizes shoe_sizes(const FootScan& foot, const SizedFoot& sized, const SizeRules& rules = {});
ShoeSizes shoe_sizes(const FootScan& foot, const MeasureSet& measures, const SizeRules& rules = {});

}  // namespace instep
