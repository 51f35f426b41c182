#include "daemon/control/store_requests.h"

#include <gtest/gtest.h>

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

class DeleteRequest : public testing::Test {
 protected:
  DeleteRequest() : store(std::make_shared<PosixStorage>(), folder.path() / "scans") {
    EXPECT_TRUE(store.prepare());
    const json pair{{"left", kLeft}, {"right", kRight}};
    put(kLeft, json{{"pair", pair}}.dump());
    put(kRight, json{{"pair", pair}}.dump());
  }
  void put(const std::string& id, const std::string& result) {
    ASSERT_TRUE(store.put(id, {result, "ply", "<svg/>", "<svg/>"}));
  }
  json remove(const std::string& id) {
    return json::parse(answer_from_store(store, {"delete", id}));
  }

  test::TemporaryFolder folder;
  ResultStore store;
};

TEST_F(DeleteRequest, TellsTheScanThatStillHoldsTheNumbersOfTheFoot) {
  EXPECT_EQ(remove(kLeft).at("pair"), kRight);
  EXPECT_FALSE(store.find(kLeft));
  EXPECT_FALSE(remove(kRight).contains("pair")) << "the other is gone";
  EXPECT_FALSE(store.find(kRight));
}

TEST_F(DeleteRequest, TellsOfNoneForOneFootNorForADamagedResult) {
  for (const std::string result :
       {"{}", "[1", R"({"pair":3})", R"({"pair":{"left":"latest","right":"../x"}})",
        R"({"pair":{"left":7}})"}) {
    put(kAlone, result);
    const json answer = remove(kAlone);
    EXPECT_EQ(answer.at("id"), kAlone) << result;
    EXPECT_FALSE(answer.contains("pair")) << result;
    EXPECT_FALSE(store.find(kAlone)) << result;
  }
}

}  // namespace
}  // namespace instep
