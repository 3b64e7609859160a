#include "study/dice.h"

#include <gtest/gtest.h>

#include <cmath>
#include <stop_token>
#include <string>

#include "core/error.h"

namespace careen {
namespace {

TEST(Dice, areThoseOfThePaper) {
  int rolls = 0;
  double before = 0;
  for (const MeasuredDie& die : kMeasuredDice) {
    rolls += die.rolls;
    EXPECT_GT(die.ratio, before);
    before = die.ratio;
  }
  EXPECT_EQ(rolls, 9329);
}

ThrowSettings few(int throws, int threads = 1) { return {.throws = throws, .threads = threads}; }

// Three pairs of faces of a cube: a third each, 0.027 the standard deviation of 300 throws.
TEST(Dice, ofACubeAreFair) {
  const Faces faces = throwDice(1, few(300, 2), {});
  EXPECT_EQ(faces.square + faces.other + faces.undecided, 300);
  EXPECT_EQ(faces.undecided, 0);
  EXPECT_NEAR(faces.probability(), 1. / 3, 4 * 0.027);
}

// Thin ones lie on their square faces, long ones stand on them never.
TEST(Dice, ofOtherShapesLieOnTheirLargeFaces) {
  EXPECT_GT(throwDice(0.3, few(40), {}).probability(), 0.9);
  EXPECT_LT(throwDice(3, few(40), {}).probability(), 0.1);
}

TEST(Dice, areTheSameWhateverTheThreadsAndTheNumber) {
  const Faces one = throwDice(0.81, few(40), {});
  const Faces three = throwDice(0.81, few(40, 3), {});
  EXPECT_EQ(one.square, three.square);
  EXPECT_EQ(one.other, three.other);
  const Faces half = throwDice(0.81, few(20), {});
  EXPECT_LE(half.square, one.square);
  EXPECT_LE(half.other, one.other);
}

TEST(Dice, endWhenInterrupted) {
  std::stop_source source;
  source.request_stop();
  EXPECT_THROW(throwDice(0.81, few(1000, 2), source.get_token()), Interrupted);
}

// E. B. Wilson: of 10 in 100, 0.0552 to 0.1744; of none in 100, 0 to 0.0370.
TEST(Dice, haveBandsOfWilson) {
  EXPECT_NEAR(bandOf(0.1, 100).low, 0.0552, 5e-5);
  EXPECT_NEAR(bandOf(0.1, 100).high, 0.1744, 5e-5);
  EXPECT_NEAR(bandOf(0, 100).low, 0, 1e-15);
  EXPECT_NEAR(bandOf(0, 100).high, 0.0370, 5e-5);
}

// 500 of 1000 and 460 of 1000: pooled 0.48, deviation 0.04/sqrt(0.2496 · 0.002).
TEST(Dice, areAsManyDeviationsApart) {
  const Faces faces{.square = 500, .other = 500, .undecided = 7};
  EXPECT_NEAR(deviationOf(faces, {.ratio = 1, .square = 0.46, .rolls = 1000}),
              0.04 / std::sqrt(0.2496 * 0.002), 1e-12);
  EXPECT_EQ(deviationOf({.square = 0, .other = 10, .undecided = 0}, {.ratio = 1, .square = 0, .rolls = 10}),
            0);
}

TEST(Dice, areTables) {
  DiceResult result;
  for (const MeasuredDie& die : kMeasuredDice) {
    const int square = static_cast<int>(std::lround(10000 * die.square));
    result.faces.push_back({.square = square, .other = 10000 - square, .undecided = 0});
  }
  EXPECT_EQ(result.within(), 15);
  result.faces[3] = {.square = 9000, .other = 1000, .undecided = 2};
  EXPECT_EQ(result.within(), 14);
  const std::string csv = diceCsv({result});
  EXPECT_NE(csv.find("\n0.5,0.3,0.2,1,40,0.81,10000,9000,2,0.9,0.89396"), std::string::npos) << csv;
  const std::string text = diceMarkdown({result, result});
  EXPECT_NE(text.find("| 0.47 | 0.916 | 0.91"), std::string::npos) << text;
  EXPECT_NE(text.find("| 0.5 | 0.3 | 0.2 | 1 | 40 | 14 of 15 | 0.027 | 2 |"), std::string::npos) << text;
  EXPECT_NE(diceMarkdown({}).find("9329 rolls"), std::string::npos);
}

}  // namespace
}  // namespace careen
