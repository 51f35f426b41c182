#include "config/measuring_settings.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <regex>
#include <string>
#include <vector>

#include "config/settings_file.h"
#include "tests/support/temporary_folder.h"

namespace instep {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

Result<MeasuringSettings> read(const std::string& toml) {
  const test::TemporaryFolder folder;
  std::ofstream(folder.path() / "s.toml") << toml;
  return load_measuring_settings(folder.path() / "s.toml");
}

TEST(MeasuringSettings, AreReadWhateverIsWrongWithTheStation) {
  const auto settings = read(
      "[measures]\naxis = \"brannock\"\n[sizes]\nallowance_mm = 18\n[station]\nside = 3\n"
      "[capture]\nframes_per_camera = 99999999999999999999\n[[camera]]\nkind = \"none\"\n");
  ASSERT_FALSE(settings) << "a number that hides what stands behind it";
  EXPECT_THAT(settings.error().message,
              AllOf(HasSubstr("s.toml:8: no number can be as large"), Not(HasSubstr("side"))));
  const auto sound = read(
      "[measures]\naxis = \"brannock\"\n[sizes]\nallowance_mm = 18\n[station]\nside = 3\n"
      "[capture]\nframes_per_camera = 0\n[[camera]]\nkind = \"none\"\n");
  ASSERT_TRUE(sound) << sound.error().line();
  EXPECT_EQ(sound->measures.axis, AxisRule::kMedialTangent);
  EXPECT_EQ(sound->sizes.allowance_mm, 18.0);
}

TEST(MeasuringSettings, TellAllThatIsWrongWithThem) {
  const auto settings = read("[measures]\naxis = 3\n[sizes]\nallowance_mm = 99\n[sices]\n");
  ASSERT_FALSE(settings);
  EXPECT_EQ(settings.error().code, ErrorCode::kInvalidInput);
  EXPECT_THAT(settings.error().message,
              AllOf(HasSubstr(":2: measures.axis"), HasSubstr(":4: sizes.allowance_mm"),
                    HasSubstr(":5: there is no setting sices: did you mean sizes?")));
  EXPECT_FALSE(load_measuring_settings("/nowhere/s.toml"));
}

// What the whole settings are made of, as they themselves say it.
TEST(MeasuringSettings, KnowEveryTableOfTheSettings) {
  const auto reading = read_settings("zzzzzzzzzzzz = 1\n", "s.toml");
  const std::string& known = reading.faults.back();
  ASSERT_THAT(known, HasSubstr("known here are"));
  const std::regex quoted("\"([a-z]+)\"");
  int tables = 0;
  for (std::sregex_iterator word(known.begin(), known.end(), quoted), end; word != end; ++word) {
    const auto settings = read(word->str(1) + " = {}\n");
    EXPECT_TRUE(settings) << settings.error().line();
    ++tables;
  }
  EXPECT_GE(tables, 12);
}

}  // namespace
}  // namespace instep
