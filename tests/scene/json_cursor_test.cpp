#include "scene/json_cursor.h"

#include <gtest/gtest.h>

#include <string>
#include <string_view>
#include <vector>

namespace careen {
namespace {

// Where the tokens of a text begin, until its end.
std::vector<std::size_t> placesIn(std::string_view text) {
  JsonCursor cursor(text);
  std::vector<std::size_t> places;
  for (std::size_t place = cursor.next(); place < text.size(); place = cursor.next()) {
    places.push_back(place);
  }
  return places;
}

std::vector<char> firstsIn(std::string_view text) {
  std::vector<char> firsts;
  for (const std::size_t place : placesIn(text)) {
    firsts.push_back(text[place]);
  }
  return firsts;
}

TEST(JsonCursor, stepsFromTokenToToken) {
  EXPECT_EQ(placesIn(R"({"a": [1, -2e3], true})"), (std::vector<std::size_t>{0, 1, 6, 7, 10, 14, 17, 21}));
  EXPECT_EQ(firstsIn("[[null],{}]"), (std::vector<char>{'[', '[', 'n', ']', '{', '}', ']'}));
  EXPECT_TRUE(placesIn("").empty());
  EXPECT_TRUE(placesIn(" \n\t").empty());
}

TEST(JsonCursor, takesAStringWhole) {
  EXPECT_EQ(placesIn(R"("a\"b, // [" 7)"), (std::vector<std::size_t>{0, 13}));
  EXPECT_EQ(placesIn(R"("\\" 1)"), (std::vector<std::size_t>{0, 5}));
}

TEST(JsonCursor, skipsComments) {
  EXPECT_EQ(firstsIn("// one, two\n3 /* , : [ */ , 4//end"), (std::vector<char>{'3', '4'}));
  EXPECT_EQ(firstsIn("1 /**/ 2 // x\r3"), (std::vector<char>{'1', '2', '3'}));
}

TEST(JsonCursor, skipsTheMarkOfSomeEditors) {
  EXPECT_EQ(placesIn(std::string(kByteOrderMark) + " 1"), (std::vector<std::size_t>{4}));
}

TEST(JsonCursor, tellsTheSeparatorBetweenTwoTokensAndMovesNothing) {
  const std::string_view text = R"({ "a" : 1 , "b":/* , */2 })";
  JsonCursor cursor(text);
  cursor.next();
  EXPECT_EQ(cursor.gap(text.size()).separator, '\0');
  cursor.next();
  const JsonCursor::Gap colon = cursor.gap(text.size());
  EXPECT_EQ(colon.separator, ':');
  EXPECT_EQ(text[colon.end], '1');
  EXPECT_EQ(cursor.gap(text.size()).end, colon.end);
  EXPECT_EQ(cursor.gap(6).end, 6U) << "no further than the limit";
  EXPECT_EQ(cursor.next(), colon.end);
  EXPECT_EQ(cursor.gap(text.size()).separator, ',');
}

// The parser has accepted no such text, but the cursor must end on it all the same.
TEST(JsonCursor, endsOnWhatIsCutShort) {
  for (const std::string text : {R"({ "a)", R"("\)", "/* no end", "/", "[1,", "tru"}) {
    JsonCursor cursor(text);
    for (int k = 0; k < 10; ++k) {
      EXPECT_LE(cursor.next(), text.size()) << text;
    }
    EXPECT_EQ(cursor.gap(text.size()).end, text.size()) << text;
  }
}

}  // namespace
}  // namespace careen
