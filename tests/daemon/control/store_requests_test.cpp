#include "daemon/control/store_requests.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>

#include "daemon/store/posix_storage.h"
#include "tests/support/temporary_folder.h"

namespace instep {
namespace {

using nlohmann::json;

const std::string kLeft = "20261121T091502417Z-k3f9";
const std::string kRight = "20261121T091502418Z-aaaa";
const std::string kAlone = "20261121T091502419Z-bbbb";

class StoreRequest : public testing::Test {
 protected:
  StoreRequest() : store(std::make_shared<PosixStorage>(), folder.path() / "scans") {
    EXPECT_TRUE(store.prepare());
    const json pair{{"left", kLeft}, {"right", kRight}};
    put(kLeft, json{{"pair", pair}}.dump());
    put(kRight, json{{"pair", pair}}.dump());
  }
  void put(const std::string& id, const std::string& result) {
    ASSERT_TRUE(store.put(id, {result, "ply", "<svg/>", "<svg/>"}));
  }
  json answer(const std::string& verb, const std::string& id) {
    return json::parse(answer_from_store(store, {verb, id}));
  }

  test::TemporaryFolder folder;
  ResultStore store;
};

TEST_F(StoreRequest, DeletingTellsTheScanThatStillHoldsTheNumbersOfTheFoot) {
  EXPECT_EQ(answer("delete", kLeft).at("pair"), kRight);
  EXPECT_FALSE(store.find(kLeft));
  EXPECT_FALSE(answer("delete", kRight).contains("pair")) << "the other is gone";
  EXPECT_FALSE(store.find(kRight));
}

TEST_F(StoreRequest, DeletingTellsOfNoneForOneFootNorForADamagedResult) {
  for (const std::string result :
       {"{}", "[1", R"({"pair":3})", R"({"pair":{"left":"latest","right":"../x"}})",
        R"({"pair":{"left":7}})"}) {
    put(kAlone, result);
    const json gone = answer("delete", kAlone);
    EXPECT_EQ(gone.at("id"), kAlone) << result;
    EXPECT_FALSE(gone.contains("pair")) << result;
    EXPECT_FALSE(store.find(kAlone)) << result;
  }
}

/// As a scan says it; of an empty folder there it said that there were no scans.
TEST_F(StoreRequest, AreRefusedWhereTheResultsFolderIsGoneOrAnother) {
  std::filesystem::rename(store.root(), folder.path() / "taken-away");
  for (const char* verb : {"list", "show", "export", "delete"}) {
    const std::string said = answer(verb, kLeft).dump();
    EXPECT_NE(said.find("is gone"), std::string::npos) << said;
    EXPECT_NE(said.find("mount its disk again"), std::string::npos) << said;
  }
  std::filesystem::create_directory(store.root());
  for (const char* verb : {"list", "show", "export", "delete"}) {
    const std::string said = answer(verb, kLeft).dump();
    EXPECT_NE(said.find("is another folder"), std::string::npos) << said;
  }
}

TEST_F(StoreRequest, ShowingTellsOfAResultThatIsNone) {
  put(kAlone, R"({"measures":5})");
  EXPECT_NE(answer("show", kAlone).dump().find("is damaged"), std::string::npos);
  std::filesystem::remove(store.folder_of(kAlone) / "result.json");
  EXPECT_NE(answer("show", kAlone).dump().find("has no result.json"), std::string::npos);
  put("20261121T091502420Z-bbbb", R"({"measures":[]})");
  EXPECT_TRUE(answer("show", "20261121T091502420Z-bbbb").contains("result"));
}

TEST_F(StoreRequest, ShowingIsNotEndedByAResultNestedTooDeep) {
  const std::string deep = std::string(100000, '[') + std::string(100000, ']');
  put(kAlone, R"({"measures":[],"x":)" + deep + "}");
  EXPECT_NE(answer("show", kAlone).dump().find("is damaged"), std::string::npos);
}

/// A result could not be taken away once its page to print was gone.
TEST_F(StoreRequest, ExportingNamesWhatIsThere) {
  const json whole = {"result.json", "cloud.ply", "sections.svg", "report.svg"};
  EXPECT_EQ(answer("export", kLeft).at("files"), whole);
  std::filesystem::remove(store.folder_of(kLeft) / "report.svg");
  const json rest = {"result.json", "cloud.ply", "sections.svg"};
  EXPECT_EQ(answer("export", kLeft).at("files"), rest);
}

}  // namespace
}  // namespace instep
