#include "scene/json_tree.h"

#include <gtest/gtest.h>

#include <string>
#include <utility>
#include <vector>

#include "support/input_error.h"

namespace careen {
namespace {

using namespace std::string_literals;

std::string errorIn(const std::string& text) {
  return inputErrorOf([&text] { JsonTree(text, "f"); });
}

TEST(JsonTree, everyValueKnowsItsPlace) {
  const JsonTree tree(
      "// a comment, with {\"keys\": 1}\n"
      "{ \"a\": [1, -2.5e3,true\n"
      "  ,null , \"x\\\"]\" /* [ , */ , {}],\r\n"
      "\t\"b\" /*\n*/ : { \"c\":[ ] } }",
      "f");
  const JsonNode& root = tree.root();
  ASSERT_EQ(root.kind, JsonNode::Kind::kObject);
  EXPECT_EQ(tree.place(root.offset), "2:1");
  const JsonNode& a = *root.find("a");
  EXPECT_EQ(tree.place(a.keyOffset), "2:3");
  EXPECT_EQ(tree.place(a.offset), "2:8");
  ASSERT_EQ(a.children.size(), 6U);
  const std::vector<std::string> places = {"2:9", "2:12", "2:19", "3:4", "3:11", "3:30"};
  for (std::size_t i = 0; i < places.size(); ++i) {
    EXPECT_EQ(tree.place(a.children[i].offset), places[i]) << i;
  }
  EXPECT_EQ(a.children[0].number, 1);
  EXPECT_EQ(a.children[1].number, -2500);
  EXPECT_EQ(a.children[1].text, "-2.5e3");
  EXPECT_TRUE(a.children[2].boolean);
  EXPECT_EQ(a.children[3].kind, JsonNode::Kind::kNull);
  EXPECT_EQ(a.children[4].text, R"(x"])");
  EXPECT_EQ(a.children[5].kind, JsonNode::Kind::kObject);
  const JsonNode& b = *root.find("b");
  EXPECT_EQ(tree.place(b.keyOffset), "4:2");
  EXPECT_EQ(tree.place(b.offset), "5:6");
  EXPECT_EQ(tree.place(b.find("c")->offset), "5:12");
  EXPECT_EQ(root.find("c"), nullptr);
}

// The number's end is known only from what follows it: each follower must leave the next place right.
TEST(JsonTree, placesHoldBehindNumbers) {
  for (const char* follower : {",", " ,", "\t,", ", ", "/**/,", ",//\n"}) {
    for (const char* number : {"0", "-0", "12", "1.5", "1e5", "1.5E-7", "18446744073709551616"}) {
      const std::string before = "["s + number + follower;
      const JsonTree tree(before + "7]", "f");
      ASSERT_EQ(tree.root().children.size(), 2U);
      EXPECT_EQ(tree.root().children[0].text, number);
      EXPECT_EQ(tree.root().children[1].offset, before.size()) << before;
    }
  }
  const JsonTree tree(R"({"a":1})", "f");
  EXPECT_EQ(tree.root().find("a")->offset, 5U);
}

TEST(JsonTree, columnsCountCharactersAndNotBytes) {
  const JsonTree tree("\xEF\xBB\xBF{ \"höhe\": \"→\", \"b\": 2 }", "f");
  EXPECT_EQ(tree.place(tree.root().offset), "1:1");
  EXPECT_EQ(tree.place(tree.root().find("höhe")->offset), "1:11");
  EXPECT_EQ(tree.place(tree.root().find("b")->offset), "1:21");
}

TEST(JsonTree, readsEscapes) {
  const JsonTree tree(R"(["\u00e4\n\\", "\ud83d\ude00", 3])", "f");
  EXPECT_EQ(tree.root().children[0].text, "ä\n\\");
  EXPECT_EQ(tree.root().children[1].text, "😀");
  EXPECT_EQ(tree.place(tree.root().children[2].offset), "1:32");
}

TEST(JsonTree, saysWhatIsNotJson) {
  const std::vector<std::pair<std::string, std::string>> cases = {
      {"", "1:1: found the end of the file, expected a JSON object"},
      {" \n ", "2:2: found the end of the file, expected a JSON object"},
      {"// only a comment", "1:18: found the end of the file, expected a JSON object"},
      {"hello", R"(1:1: found "hello", expected a JSON object)"},
      {"<xml/>", R"(1:1: found "<", expected a JSON object)"},
      {"]", R"(1:1: found "]", expected a JSON object)"},
      {"{", "1:2: found the end of the file, expected a key in quotes or '}'"},
      {"{,}", R"(1:2: found ",", expected a key in quotes or '}')"},
      {"{a: 1}", R"(1:2: found "a", expected a key in quotes or '}')"},
      {"{NaN: 1}", R"(1:2: found "NaN", expected a key in quotes or '}')"},
      {R"({"a" 12})", R"(1:6: found "12", expected ':')"},
      {R"({"a" "b"})", "1:6: found a string, expected ':'"},
      {R"({"a"})", R"(1:5: found "}", expected ':')"},
      {R"({"a"::1})", R"(1:6: found ":", expected a value)"},
      {R"({"a":})", R"(1:6: found "}", expected a value)"},
      {R"({"a":,})", R"(1:6: found ",", expected a value)"},
      {R"({"a":)", "1:6: found the end of the file, expected a value"},
      {R"({"a": 1)", "1:8: found the end of the file, expected ',' or '}'"},
      {"{\"a\": 1\n\n", "3:1: found the end of the file, expected ',' or '}'"},
      {R"({"a": 1,)", "1:9: found the end of the file, expected a key in quotes after the comma"},
      {R"({"a": 1,})", R"(1:9: found "}", expected a key in quotes after the comma)"},
      {R"({"a": 1 "b": 2})", "1:9: found a string, expected ',' or '}'"},
      {R"({"a": 1])", R"(1:8: found "]", expected ',' or '}')"},
      {"[", "1:2: found the end of the file, expected a value or ']'"},
      {"[,1]", R"(1:2: found ",", expected a value or ']')"},
      {"[1,,2]", R"(1:4: found ",", expected a value after the comma)"},
      {"[1, ]", R"(1:5: found "]", expected a value after the comma)"},
      {"[1 2]", R"(1:4: found "2", expected ',' or ']')"},
      {"[1}", R"(1:3: found "}", expected ',' or ']')"},
      {"[1,// x\n 2 3]", R"(2:4: found "3", expected ',' or ']')"},
      {"{} x", R"(1:4: found "x", expected the end of the file)"},
      {"{},", R"(1:3: found ",", expected the end of the file)"},
      {"{} {}", R"(1:4: found "{", expected the end of the file)"},
      {"[01]", R"(1:3: found "1", expected ',' or ']')"},
      {"[tru]", R"(1:2: found "tru", expected a value or ']')"},
      {"[1.]", R"(1:2: found "1.", expected a value or ']')"},
      {"[.5]", R"(1:2: found ".5", expected a value or ']')"},
      {"[+1]", R"(1:2: found "+1", expected a value or ']')"},
      {"[0x10]", R"(1:3: found "x10", expected ',' or ']')"},
      {"['a']", R"(1:2: found "'", expected a value or ']')"},
      {"[\xC3\xA4]", "1:2: found a character outside a string, expected a value or ']'"},
      {"[1, NaN]", R"(1:5: found "NaN", expected a finite number)"},
      {"[nan]", R"(1:2: found "nan", expected a finite number)"},
      {"[Infinity]", R"(1:2: found "Infinity", expected a finite number)"},
      {"[-Infinity]", R"(1:2: found "-Infinity", expected a finite number)"},
      {"[-inf]", R"(1:2: found "-inf", expected a finite number)"},
      {"[1, 1e400]", R"(1:5: found "1e400", expected a number no larger than 1.8e308)"},
      {"[-1e400]", R"(1:2: found "-1e400", expected a number no larger than 1.8e308)"},
      {R"({"a": "bc)", R"(1:7: found a string without its closing quote, expected '"' on the same line)"},
      {"{\"a\": \"bc\n}", R"(1:7: found a string without its closing quote, expected '"' on the same line)"},
      {R"({"a)", R"(1:2: found a string without its closing quote, expected '"' on the same line)"},
      {"[\"a\tb\"]", "1:4: found a control character in a string, expected an escape such as \\t"},
      {R"(["a\x"])",
       R"(1:5: found a wrong escape in a string, expected one of \" \\ \/ \b \f \n \r \t \u0000)"},
      {R"(["\u12"])",
       R"(1:7: found a wrong escape in a string, expected one of \" \\ \/ \b \f \n \r \t \u0000)"},
      {R"(["\ud800"])",
       R"(1:9: found a wrong escape in a string, expected one of \" \\ \/ \b \f \n \r \t \u0000)"},
      {"[\"\xFF\"]", "1:3: found a byte that is not UTF-8, expected text in UTF-8"},
      {"[1, /* x", "1:5: found a comment without its end, expected a value after the comma"},
      {"[1 / 2]", R"(1:4: found "/", expected ',' or ']')"},
      {"{\"a\": 1\0}"s, "1:8: found a zero byte, expected JSON text"},
      {"{\"a\": 1, \"b\": 2,\n  \"a\": 3}",
       R"(2:3: found the key "a" again, expected each key once; it stands at 1:2 already)"},
      {R"({"x": {"a": 1, "a": {}}})",
       R"(1:16: found the key "a" again, expected each key once; it stands at 1:8 already)"},
  };
  for (const auto& [text, message] : cases) {
    EXPECT_EQ(errorIn(text), "f:" + message) << text;
  }
}

TEST(JsonTree, refusesBottomlessNesting) {
  EXPECT_EQ(errorIn(std::string(64, '[') + std::string(64, ']')), "no error");
  EXPECT_EQ(errorIn(std::string(65, '[') + std::string(65, ']')),
            "f:1:65: found values nested deeper than 64, expected a flatter file");
  EXPECT_EQ(errorIn(std::string(1'000'000, '[')),
            "f:1:65: found values nested deeper than 64, expected a flatter file");
}

TEST(JsonTree, messagesStayShortAndPrintable) {
  EXPECT_EQ(inQuotes("plain"), R"("plain")");
  EXPECT_EQ(inQuotes("a\nb\x7f"), R"("a?b?")");
  EXPECT_EQ(inQuotes(std::string(50, 'x')), R"(")" + std::string(40, 'x') + R"(…")");
  // 39 bytes and then characters of two: the cut falls between characters.
  EXPECT_EQ(inQuotes(std::string(39, 'x') + "ääääää"), R"(")" + std::string(39, 'x') + R"(…")");
}

TEST(JsonTree, describesEveryKind) {
  const JsonTree tree(R"([null, true, false, -1.50, "a", [1, 2], {"b": 1}])", "f");
  std::vector<std::string> words;
  for (const JsonNode& node : tree.root().children) {
    words.push_back(describe(node));
  }
  EXPECT_EQ(words, (std::vector<std::string>{"null", "true", "false", "-1.50", R"("a")", "an array of 2",
                                             "an object"}));
}

}  // namespace
}  // namespace careen
