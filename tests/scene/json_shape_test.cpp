#include "scene/json_shape.h"

#include <gtest/gtest.h>

#include <string>
#include <utility>
#include <vector>

#include "support/input_error.h"

namespace careen {
namespace {

// What reading `text`, an element of an array, says if it does not fit.
template <class Read>
std::string readingOf(const std::string& text, Read read) {
  return inputErrorOf([&] {
    const JsonTree tree("[" + text + "]", "f");
    read(JsonValue(tree, tree.root().children[0], "key"));
  });
}

TEST(JsonShape, numbersKeepToTheirRange) {
  const auto mass = [](const JsonValue& value) { value.number(positiveNumber("kg")); };
  const auto place = [](const JsonValue& value) { value.number(anyNumber("m")); };
  const auto drag = [](const JsonValue& value) { value.number(nonNegativeNumber()); };
  for (const char* good : {"1", "1e-60", "1e60", "0.5e3"}) {
    EXPECT_EQ(readingOf(good, mass), "no error");
  }
  const std::vector<std::pair<const char*, const char*>> masses = {
      {"0", "f:1:2: found 0 for key, expected a number above 0 [kg]"},
      {"-0.0", "f:1:2: found -0.0 for key, expected a number above 0 [kg]"},
      {"-1", "f:1:2: found -1 for key, expected a number above 0 [kg]"},
      {"1e-400", "f:1:2: found 1e-400 for key, expected a number above 0 [kg]"},
      {"9e-61", "f:1:2: found 9e-61 for key, expected a number of at least 1e-60 [kg]"},
      {"1e61", "f:1:2: found 1e61 for key, expected a number of at most 1e60 [kg]"},
      {R"("1")", R"(f:1:2: found "1" for key, expected a number above 0 [kg])"},
      {"null", "f:1:2: found null for key, expected a number above 0 [kg]"},
      {"[1]", "f:1:2: found an array of 1 for key, expected a number above 0 [kg]"}};
  for (const auto& [text, message] : masses) {
    EXPECT_EQ(readingOf(text, mass), message);
  }
  EXPECT_EQ(readingOf("-1e60", place), "no error");
  EXPECT_EQ(readingOf("1e151", place), "f:1:2: found 1e151 for key, expected a number of at most 1e60 [m]");
  EXPECT_EQ(readingOf("-1e151", place),
            "f:1:2: found -1e151 for key, expected a number of at least -1e60 [m]");
  EXPECT_EQ(readingOf("0", drag), "no error");
  EXPECT_EQ(readingOf("-1e-300", drag), "f:1:2: found -1e-300 for key, expected a number not below 0");
}

TEST(JsonShape, wholeNumbersMayHaveAPointButNoFraction) {
  const auto read = [](const JsonValue& value) { value.integer(1, 16384, "px"); };
  for (const char* good : {"1", "1280", "1280.0", "1.28e3", "16384"}) {
    EXPECT_EQ(readingOf(good, read), "no error");
  }
  for (const std::string bad :
       {"0", "-1", "16385", "100000", "0.5", "1280.5", "1e30", "18446744073709551615"}) {
    EXPECT_EQ(readingOf(bad, read),
              "f:1:2: found " + bad + " for key, expected a whole number from 1 to 16384 [px]");
  }
  EXPECT_EQ(readingOf("true", read),
            "f:1:2: found true for key, expected a whole number from 1 to 16384 [px]");
}

TEST(JsonShape, vectorsNameTheirElements) {
  const auto read = [](const JsonValue& value) { value.vector(anyNumber("m")); };
  EXPECT_EQ(readingOf("[1, 2]", read), "f:1:2: found an array of 2 for key, expected [x, y, z] [m]");
  EXPECT_EQ(readingOf("{}", read), "f:1:2: found an object for key, expected [x, y, z] [m]");
  EXPECT_EQ(readingOf(R"([1, "2", 3])", read), R"(f:1:6: found "2" for key[1], expected a number [m])");
}

TEST(JsonShape, directionsAreMadeUnitVectors) {
  Vec3 direction;
  const auto read = [&direction](const JsonValue& value) { direction = value.direction(); };
  EXPECT_EQ(readingOf("[0, 0, -5]", read), "no error");
  EXPECT_EQ(direction, Vec3(0, 0, -1));
  EXPECT_EQ(readingOf("[3e-320, 0, 4e-320]", read), "no error");  // whose squares are 0
  EXPECT_NEAR(direction.norm(), 1, 1e-15);
  EXPECT_NEAR(direction.x(), 0.6, 1e-3);  // of few bits down there: measured 0
  EXPECT_EQ(readingOf("[0, -0.0, 0]", read), "f:1:2: found a zero vector for key, expected a direction");
}

TEST(JsonShape, objectsNameTheKeyThatWasMeant) {
  const auto read = [](const JsonValue& value) { value.object({"name", "half_extents", "velocity", "dt"}); };
  const std::vector<std::pair<const char*, const char*>> cases = {
      {R"({"nmae": 1})", R"(f:1:3: found the unknown key "nmae" in key, expected "name")"},
      {R"({"name": 1, "halfExtents": 1})",
       R"(f:1:14: found the unknown key "halfExtents" in key, expected "half_extents")"},
      {R"({"VELOCITY": 1})", R"(f:1:3: found the unknown key "VELOCITY" in key, expected "velocity")"},
      {R"({"dT": 1})", R"(f:1:3: found the unknown key "dT" in key, expected "dt")"},
      {R"({"banana": 1})",
       R"(f:1:3: found the unknown key "banana" in key, expected one of name, half_extents, velocity, dt)"},
      {R"({"": 1})",
       R"(f:1:3: found the unknown key "" in key, expected one of name, half_extents, velocity, dt)"},
      {"3", "f:1:2: found 3 for key, expected an object"}};
  for (const auto& [text, message] : cases) {
    EXPECT_EQ(readingOf(text, read), message);
  }
}

TEST(JsonShape, missingKeysAreNamed) {
  const auto read = [](const JsonValue& value) { value.object({"eye"}).require("eye"); };
  EXPECT_EQ(readingOf("{}", read), "f:1:2: found no eye in key, expected that key");
}

TEST(JsonShape, wordsAreThoseOfTheList) {
  std::size_t index = 0;
  const auto read = [&index](const JsonValue& value) { index = value.word({"a", "bc"}, "side"); };
  EXPECT_EQ(readingOf(R"("bc")", read), "no error");
  EXPECT_EQ(index, 1U);
  EXPECT_EQ(readingOf(R"("b")", read), R"(f:1:2: found the unknown side "b", expected one of a, bc)");
  EXPECT_EQ(readingOf("1", read), "f:1:2: found 1 for key, expected the name of a side");
}

}  // namespace
}  // namespace careen
