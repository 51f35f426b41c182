#include "daemon/json/untrusted_json.h"

#include <gtest/gtest.h>

#include <string>

namespace instep {
namespace {

std::string nested(std::size_t levels) {
  return R"({"x":)" + std::string(levels, '[') + std::string(levels, ']') + "}";
}

TEST(ObjectIn, IsNoneOfTextThatHoldsNoObject) {
  for (const char* text : {"", "3", "[]", "{", "{\"a\":}", "null"}) {
    EXPECT_TRUE(object_in(text).is_null()) << text;
  }
  EXPECT_EQ(object_in(R"({"a":[1,{"b":2}]})").at("a").at(1).at("b"), 2);
}

TEST(ObjectIn, IsNoneThatIsNestedTooDeep) {
  EXPECT_TRUE(object_in(nested(60)).is_object());
  EXPECT_TRUE(object_in(nested(70)).is_null());
  EXPECT_TRUE(object_in(nested(200000)).is_null());
}

TEST(ObjectIn, TakesBracketsInStringsForLetters) {
  const std::string brackets(1000, '[');
  for (const std::string& text :
       {"{\"a\":\"" + brackets + "\"}", "{\"a\":\"\\\"" + brackets + "\",\"b\":1}",
        "{\"" + brackets + "\":1}"}) {
    EXPECT_EQ(object_in(text).dump(), text);
  }
  EXPECT_TRUE(object_in("{\"a\":\"\\\\\"," + nested(70).substr(1)).is_null()) << "after a string";
}

}  // namespace
}  // namespace instep
