#include "scene/color_shape.h"

#include <gtest/gtest.h>

#include <set>
#include <string>

#include "support/input_error.h"

namespace careen {
namespace {

Color colorOf(const std::string& text) {
  const JsonTree tree(text, "f");
  return readColor(JsonValue(tree, tree.root(), "color"));
}

int sumOf(const Color& color) { return 65536 * color.red + 256 * color.green + color.blue; }

TEST(ColorShape, readsDigitsAndNames) {
  EXPECT_EQ(sumOf(colorOf(R"("#0aF03c")")), 0x0af03c);
  EXPECT_EQ(sumOf(colorOf(R"("teal")")), 0x008080);
  EXPECT_EQ(sumOf(colorOf(R"("grey")")), sumOf(colorOf(R"("gray")")));
}

TEST(ColorShape, namesAreDifferentColours) {
  std::set<std::string_view> names;
  std::set<int> colors;
  for (const NamedColor& each : kNamedColors) {
    names.insert(each.name);
    colors.insert(sumOf(each.color));
  }
  EXPECT_EQ(names.size(), kNamedColors.size());
  EXPECT_EQ(colors.size() + 1, kNamedColors.size());  // grey is written in two ways
}

TEST(ColorShape, oneColourIsTwoAlike) {
  const JsonTree tree(R"(["red", "navy", "pink"])", "f");
  const JsonValue list(tree, tree.root(), "background");
  EXPECT_EQ(inputErrorOf([&] { readColorPair(list); }),
            "f:1:1: found an array of 3 for background, expected a colour or [above, below]");
  const ColorPair pair = readColorPair(list.elements("")[1]);
  EXPECT_EQ(sumOf(pair.above), 0x80);
  EXPECT_EQ(sumOf(pair.below), 0x80);
}

TEST(ColorShape, whatIsNoColourIsToldWhere) {
  EXPECT_EQ(inputErrorOf([] { colorOf(R"("#12345g")"); }),
            "f:1:1: found \"#12345g\" for color, expected a colour \"#rrggbb\"");
  EXPECT_NE(inputErrorOf([] { colorOf(R"("reddish")"); }).find("found the unknown colour \"reddish\""),
            std::string::npos);
  EXPECT_EQ(inputErrorOf([] { colorOf("7"); }),
            "f:1:1: found 7 for color, expected a colour \"#rrggbb\" or its name");
}

}  // namespace
}  // namespace careen
