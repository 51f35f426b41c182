#include <gtest/gtest.h>
#include <sys/mount.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>

#include "drivers/recording/recording_reader.h"
#include "tests/support/run_program.h"
#include "tests/support/small_recording.h"
#include "tests/support/temporary_folder.h"

namespace instep {
namespace {

namespace fs = std::filesystem;

constexpr const char* kPlane = "0,0,50,1,0,50,0,1,50";

class BadInput : public testing::Test {
 protected:
  std::string file(const std::string& name, const std::string& bytes) {
    std::ofstream(folder_.path() / name, std::ios::binary) << bytes;
    return folder_.path() / name;
  }

  /// The program must end with that code, one line on stderr that holds `said`, and no output.
  static void expect_failure(const std::vector<std::string>& arguments, int exit_code,
                             const std::string& said, test::Stdout to = test::Stdout::kCaptured) {
    const auto run = test::run_program("instep", arguments, to);
    EXPECT_EQ(run.exit_code, exit_code) << run.errors;
    EXPECT_EQ(run.output, "");
    EXPECT_EQ(std::count(run.errors.begin(), run.errors.end(), '\n'), 1) << run.errors;
    EXPECT_EQ(run.errors.substr(0, 8), "instep: ");
    EXPECT_NE(run.errors.find(said), std::string::npos) << run.errors;
    EXPECT_NE(run.errors.find(": ", 8), std::string::npos) << "no advice: " << run.errors;
  }

  static void expect_bad_girth(const std::string& cloud, const std::string& said,
                               const std::string& plane = kPlane) {
    for (const char* method : {"rbf", "rbf-paper", "hull", "mesh"}) {
      expect_failure({"girth", cloud, "--plane", plane, "--method", method}, 1, said);
    }
  }

  test::TemporaryFolder folder_;
};

/// A cylinder of radius 40 mm and 100 mm height, 4 mm between points.
std::string cylinder(double scale = 1.0) {
  std::string text;
  for (int ring = 0; ring <= 25; ++ring) {
    for (int i = 0; i < 64; ++i) {
      const double angle = i * 0.09817477042468103;
      text += std::to_string(scale * 40.0 * std::cos(angle)) + " " +
              std::to_string(scale * 40.0 * std::sin(angle)) + " " +
              std::to_string(scale * 4.0 * ring) + "\n";
    }
  }
  return text;
}

TEST_F(BadInput, SoundCloudIsMeasuredAsJsonAlone) {
  const auto run =
      test::run_program("instep", {"girth", file("c.xyz", cylinder()), "--plane", kPlane});
  EXPECT_EQ(run.exit_code, 0) << run.errors;
  EXPECT_EQ(run.errors, "");
  EXPECT_EQ(run.output.substr(0, 1), "{");
  EXPECT_NE(run.output.find("\"stretched_mm\""), std::string::npos);
}

TEST_F(BadInput, WrongUsageIsTwo) {
  const auto cloud = file("c.xyz", cylinder());
  expect_failure({}, 2, "see instep --help");
  expect_failure({"grith"}, 2, "no command or option grith");
  expect_failure({"--colour"}, 2, "no command or option --colour");
  expect_failure({"simulate", "--out", folder_.path() / "new", "--seed", "-1"}, 2, "--seed");
  expect_failure({"simulate", "--out", folder_.path() / "new", "--seed", "18446744073709551616"}, 2,
                 "--seed");
  expect_failure({"record", "--out", folder_.path() / "new", "--config", "x", "--seconds", "nan"},
                 2, "--seconds");
  EXPECT_FALSE(fs::exists(folder_.path() / "new"));
  expect_failure({"girth"}, 2, "see instep girth --help");
  expect_failure({"girth", cloud}, 2, "--plane");
  expect_failure({"girth", cloud, "--plane", kPlane, "--colour"}, 2, "--colour");
  expect_failure({"girth", cloud, "--plane", kPlane, "--unit", "inch"}, 2, "--unit");
  expect_failure({"girth", cloud, "--plane", kPlane, "--method", "magic"}, 2, "--method");
  expect_failure({"girth", cloud, "--plane", kPlane, "--sigma-mm", "-1"}, 2, "--sigma-mm");
  expect_failure({"girth", cloud, "--plane", kPlane, "--sigma-mm", "nan"}, 2, "--sigma-mm");
  for (const char* plane :
       {"", "1,2,3", "1,2,3,4,5,6,7,8,9,10", "1,2,3,4,5,6,7,8,", "nan,2,3,4,5,6,7,8,9",
        "1,2,3,4,5,6,7,8,inf", "1,2,3,4,5,6,7,8,1e999", "a,b,c,d,e,f,g,h,i"}) {
    expect_failure({"girth", cloud, std::string("--plane=") + plane}, 2, "plane");
  }
}

TEST_F(BadInput, OutputThatNobodyTakesIsOne) {
  const auto cloud = file("c.xyz", cylinder());
  for (const auto& arguments : std::vector<std::vector<std::string>>{
           {"--help"}, {"--version"}, {"girth", "--help"}, {"girth", cloud, "--plane", kPlane}}) {
    expect_failure(arguments, 1, "is full: make room", test::Stdout::kFullDisk);
    expect_failure(arguments, 1, "Bad file descriptor", test::Stdout::kClosed);
  }
}

TEST_F(BadInput, NothingIsPrintedIntoAFileThatTookTheNumberOfStdout) {
  const auto visit = folder_.path() / "visit";
  expect_failure({"simulate", "--out", visit, "--subject", "cylinder", "--noise", "none",
                  "--frames", "1", "--cameras", "1"},
                 1, "Bad file descriptor", test::Stdout::kClosed);
  const auto recording = read_recording(visit);
  ASSERT_TRUE(recording) << recording.error().line();
  EXPECT_TRUE(read_recorded_frames(*recording));
}

TEST_F(BadInput, SettingsThatAreNoTomlSayWhatToWrite) {
  expect_failure(
      {"record", "--out", folder_.path() / "new", "--config", file("s.toml", "\xff\x01")}, 1,
      "write TOML");
}

TEST_F(BadInput, HelpAndVersionAreZero) {
  EXPECT_EQ(test::run_program("instep", {"--help"}).exit_code, 0);
  EXPECT_NE(test::run_program("instep", {"girth", "--help"}).output.find("Examples"),
            std::string::npos);
  EXPECT_EQ(test::run_program("instep", {"--version"}).output.substr(0, 7), "instep ");
}

TEST_F(BadInput, BadCloudsAreOne) {
  expect_bad_girth(folder_.path() / "none.ply", "No such file");
  expect_bad_girth(folder_.path(), "is a folder");
  expect_bad_girth(file("empty.ply", ""), "is empty");
  expect_bad_girth(file("three.xyz", "0 0 0\n50 0 0\n0 50 0\n"), "");
  expect_bad_girth(file("same.xyz", "1 1 1\n1 1 1\n1 1 1\n1 1 1\n"), "the same");
  expect_bad_girth(file("nan.xyz", "nan 0 0\nnan nan nan\n"), "no number");
  expect_bad_girth(file("huge.xyz", "0 0 0\n9 0 0\n1e30 0 0\n"), "absurdly large");
  expect_bad_girth(file("metres.xyz", cylinder(0.001)), "--unit m");
  const auto sound = file("c.xyz", cylinder());
  expect_bad_girth(sound, "", "0,0,900,1,0,900,0,1,900");
  expect_bad_girth(sound, "on one line", "0,0,0,1,1,1,2,2,2");
  expect_failure({"girth", sound, "--plane", kPlane, "--method", "section"}, 1, "no faces");
}

TEST_F(BadInput, PointsThatAreNoneAreWarnedOf) {
  const auto cloud = file("nan.xyz", "nan nan nan\n" + cylinder() + "nan 0 0\n1e30 0 0\n");
  const auto mesh = folder_.path() / "mesh.ply";
  for (const auto& arguments : {std::vector<std::string>{"girth", cloud, "--plane", kPlane},
                                {"surface", cloud, "--out", mesh}}) {
    const auto run = test::run_program("instep", arguments);
    EXPECT_EQ(run.exit_code, 0) << run.errors;
    EXPECT_NE(run.output.find("2 of the file's 1667 points were left out"), std::string::npos)
        << run.output;
    EXPECT_NE(run.output.find("absurdly large"), std::string::npos) << run.output;
  }
  // Too few for a foot: the reason may be that most are none.
  expect_failure({"measure", file("few.xyz", "0 0 0\n100 0 0\nnan nan nan\n")}, 1,
                 "1 of the file's 3 points were left out");
}

TEST_F(BadInput, UnitsThatAreOffAreNamed) {
  expect_bad_girth(file("metres.xyz", cylinder(0.001)), "--unit m");
  expect_bad_girth(file("micrometres.xyz", cylinder(1000.0)), "micrometres");
  const auto in_centimetres = test::run_program(
      "instep", {"girth", file("cm.xyz", cylinder(0.1)), "--plane", "0,0,5,1,0,5,0,1,5"});
  EXPECT_EQ(in_centimetres.exit_code, 0) << in_centimetres.errors;
  EXPECT_NE(in_centimetres.output.find("--unit cm"), std::string::npos) << in_centimetres.output;
  // The plane in metres: through the body, but not where it was meant.
  const auto sound = file("c.xyz", cylinder());
  const auto plane_in_metres =
      test::run_program("instep", {"girth", sound, "--plane", "0,0,50,0.04,0,50,0,0.04,50"});
  EXPECT_EQ(plane_in_metres.exit_code, 0) << plane_in_metres.errors;
  EXPECT_NE(plane_in_metres.output.find("read in mm"), std::string::npos) << plane_in_metres.output;
  expect_bad_girth(sound, "read in mm", "0,0,-30,0.04,0,-30,0,0.04,-30");
}

TEST_F(BadInput, SurfaceIsWrittenWholeOrNotAtAll) {
  const auto cloud = file("c.xyz", cylinder());
  const auto out = folder_.path() / "mesh.ply";
  expect_failure({"surface", cloud}, 2, "--out");
  for (const char* bad : {"0", "-1", "nan", "x"}) {
    expect_failure({"surface", cloud, "--out", out, "--cube-mm", bad}, 2, "--cube-mm");
  }
  expect_failure({"surface", cloud, "--out", out, "--cube-mm", "0.001"}, 1, "larger cubes");
  expect_failure({"surface", folder_.path() / "none.ply", "--out", out}, 1, "No such file");
  expect_failure({"surface", file("three.xyz", "0 0 0\n50 0 0\n0 50 0\n"), "--out", out}, 1,
                 "too few");
  expect_failure({"surface", cloud, "--out", folder_.path() / "none" / "mesh.ply"}, 1,
                 "cannot write");
  expect_failure({"surface", cloud, "--out", folder_.path() / "mesh.stl"}, 2, "ends in .ply");
  EXPECT_FALSE(fs::exists(out));

  const auto coarse =
      test::run_program("instep", {"surface", cloud, "--out", out, "--cube-mm", "25"});
  EXPECT_NE(coarse.output.find("too large for a body"), std::string::npos) << coarse.output;
  const auto made = test::run_program("instep", {"surface", cloud, "--out", out});
  EXPECT_EQ(made.output.find("too large for a body"), std::string::npos) << made.output;
  EXPECT_EQ(made.exit_code, 0) << made.errors;
  EXPECT_EQ(made.errors, "");
  const auto girth =
      test::run_program("instep", {"girth", out, "--plane", kPlane, "--method", "section"});
  EXPECT_EQ(girth.exit_code, 0) << girth.errors;
  expect_failure({"surface", out, "--out", out}, 1, "is the cloud itself");
}

TEST_F(BadInput, ACloudIsNotReplacedByItsOwnReport) {
  const auto cloud = file("c.svg", cylinder());
  expect_failure({"measure", cloud, "--report", cloud}, 1, "is the cloud itself");
}

TEST_F(BadInput, ForbiddenFilesAreOne) {
  if (::geteuid() == 0) GTEST_SKIP() << "root may read everything";
  const auto cloud = file("c.xyz", cylinder());
  fs::permissions(cloud, fs::perms::none);
  expect_bad_girth(cloud, "permissions");
}

TEST_F(BadInput, AFolderThatTakesNoResultsIsOneBeforeAnythingIsMeasured) {
  const auto visit = folder_.path() / "visit";
  test::write_small_recording(visit);  // of nothing that could be measured
  const auto disk = folder_.path() / "disk";
  fs::create_directory(disk);
  if (::geteuid() != 0 || ::mount("tmpfs", disk.c_str(), "tmpfs", MS_RDONLY, "") != 0) {
    GTEST_SKIP() << "needs the right to mount a disk";
  }
  expect_failure({"replay", visit, "--out", disk}, 1, "choose another --out");
  expect_failure({"replay", visit, "--out", ""}, 2, "needs the name of a folder");
  ::umount(disk.c_str());
}

TEST_F(BadInput, BadRecordingsAreOne) {
  const auto visit = folder_.path() / "visit";
  test::write_small_recording(visit);
  const auto frame = visit / read_recording(visit)->frames[1].file;
  expect_failure({"replay", folder_.path() / "none"}, 1, "No such file");
  fs::resize_file(frame, fs::file_size(frame) / 2);
  expect_failure({"replay", visit}, 1, "damaged PNG");
  std::ofstream(frame, std::ios::binary) << "no PNG at all";
  expect_failure({"replay", visit}, 1, "damaged PNG");
  std::ifstream stream(visit / "recording.json");
  const std::string header{std::istreambuf_iterator<char>(stream), {}};
  for (const char* fx : {"1e30", "-1", "\"wide\"", "null", "NaN"}) {
    auto bent = header;
    const auto begin = bent.find(':', bent.find("\"fx\"")) + 1;
    bent.replace(begin, bent.find_first_of(",}\n", begin) - begin, fx);
    std::ofstream(visit / "recording.json") << bent;
    expect_failure({"replay", visit}, 1, "recording.json");
  }
  std::ofstream(visit / "recording.json") << "{\"format\": \"instep-recording\", \"version\": 1}";
  expect_failure({"replay", visit}, 1, "\"cameras\" is missing");
  std::ofstream(visit / "recording.json") << "[1, 2";
  expect_failure({"replay", visit}, 1, "no JSON");
}

TEST_F(BadInput, SimulateRefusesAFolderThatHoldsSomething) {
  file("mine.txt", "x");
  expect_failure({"simulate", "--out", folder_.path(), "--subject", "cylinder", "--frames", "1"}, 1,
                 "new folder");
}

/// It was computed for some seconds first; and a side was left alone without a word.
TEST_F(BadInput, SimulateRefusesBeforeItComputes) {
  file("mine.txt", "x");
  expect_failure({"simulate", "--out", folder_.path(), "--subject", "feet", "--side", "left"}, 1,
                 "--subject foot");
  expect_failure(
      {"simulate", "--out", folder_.path() / "new", "--subject", "last", "--side", "left"}, 1,
      "--subject foot");
  EXPECT_FALSE(std::filesystem::exists(folder_.path() / "new"));
}

TEST_F(BadInput, AnEmptyNameIsCalledSo) {
  expect_failure({"simulate", "--out", "", "--subject", "cylinder", "--frames", "1"}, 1,
                 "the name of what to make is empty");
  expect_failure({"girth", "", "--plane=0,0,0,1,0,0,0,1,0"}, 1,
                 "the name of what to read is empty");
  expect_failure({"replay", ""}, 1, "the name of the recording is empty");
}

// With other settings than those that were meant a station measures otherwise.
TEST_F(BadInput, InstepdRunsWithNoOtherSettingsThanThoseThatAreNamed) {
  const auto recording =
      file("recording.toml", "[[camera]]\nkind = \"recording\"\npath = \"none/there\"\n");
  const auto checked = test::run_program("instepd", {"--check", "--config", recording});
  EXPECT_EQ(checked.exit_code, 0) << "it may come";
  EXPECT_NE(checked.output.find("but "), std::string::npos) << checked.output;
  EXPECT_NE(checked.output.find("none/there"), std::string::npos) << checked.output;
  const auto simulated = file("simulated.toml",
                              "[[camera]]\nkind = \"simulated\"\n"
                              "[simulation]\nfault_script = \"missing.txt\"\n"
                              "[store]\nroot = \"one\"\n[control]\nsocket = \"one\"\n");
  const auto doubted = test::run_program("instepd", {"--check", "--config", simulated});
  EXPECT_NE(doubted.output.find("but the fault script"), std::string::npos) << doubted.output;
  EXPECT_NE(doubted.output.find("but store.root, control.socket are all"), std::string::npos);
  const auto nameless = test::run_program("instepd", {"--check", "--config", ""});
  EXPECT_EQ(nameless.exit_code, 2) << nameless.output;
  EXPECT_NE(nameless.errors.find("--config needs the name of a file"), std::string::npos);
  const auto folder = test::run_program("instepd", {"--check", "--config", folder_.path()});
  EXPECT_EQ(folder.exit_code, 1) << folder.output;
  EXPECT_NE(folder.errors.find("is a folder and no settings file"), std::string::npos);
}

}  // namespace
}  // namespace instep
