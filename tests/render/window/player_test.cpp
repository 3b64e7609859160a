#include "render/window/player.h"

#include <gtest/gtest.h>

namespace careen {
namespace {

constexpr FrameRate kRate = {.numerator = 10, .denominator = 1};

// A clock that stands elsewhere than at 0 when the film begins.
class PlayerTest : public testing::Test {
 protected:
  PlayerTest() { player_.update(now_); }
  void pass(double seconds) {
    now_ += seconds;
    player_.update(now_);
  }

  double now_ = 1000;
  Player player_{kRate, 20};
};

TEST_F(PlayerTest, standsAtTheFirstFrameUntilItPlays) {
  pass(5);
  EXPECT_EQ(player_.frame(), 0);
  EXPECT_FALSE(player_.isPlaying());
  EXPECT_EQ(player_.lastFrame(), 19);
}

TEST_F(PlayerTest, showsEachFrameWhenItIsDue) {
  player_.toggle();
  EXPECT_TRUE(player_.isPlaying());
  EXPECT_NEAR(player_.secondsToNext(), 0.1, 1e-9);
  pass(0.09);
  EXPECT_EQ(player_.frame(), 0);
  EXPECT_NEAR(player_.secondsToNext(), 0.01, 1e-9);
  pass(0.02);
  EXPECT_EQ(player_.frame(), 1);
  EXPECT_EQ(player_.time(), kRate.frameTime(1));
  EXPECT_NEAR(player_.secondsToNext(), 0.09, 1e-9);
}

TEST_F(PlayerTest, leavesOutFramesThereIsNoTimeFor) {
  player_.toggle();
  pass(0.75);
  EXPECT_EQ(player_.frame(), 7);
  pass(0.8);
  EXPECT_EQ(player_.frame(), 15);
}

TEST_F(PlayerTest, pausesAtTheEndAndPlaysFromTheBeginningThen) {
  player_.toggle();
  pass(1e9);
  EXPECT_EQ(player_.frame(), 19);
  EXPECT_FALSE(player_.isPlaying());
  EXPECT_EQ(player_.secondsToNext(), 0);
  player_.toggle();
  EXPECT_EQ(player_.frame(), 0);
  EXPECT_TRUE(player_.isPlaying());
  pass(0.25);
  EXPECT_EQ(player_.frame(), 2);
}

TEST_F(PlayerTest, goesOnFromWhereItWasPaused) {
  player_.toggle();
  pass(0.35);
  player_.toggle();
  pass(10);
  EXPECT_EQ(player_.frame(), 3);
  player_.toggle();
  pass(0.15);
  EXPECT_EQ(player_.frame(), 4);
}

TEST_F(PlayerTest, stepsPauseAndStayWithinTheFilm) {
  player_.toggle();
  pass(0.35);
  player_.step(1);
  EXPECT_FALSE(player_.isPlaying());
  EXPECT_EQ(player_.frame(), 4);
  player_.step(-5);
  EXPECT_EQ(player_.frame(), 0);
  player_.step(100);
  EXPECT_EQ(player_.frame(), 19);
}

TEST_F(PlayerTest, seeksAndPlaysOnIfItPlayed) {
  player_.seek(0.5);
  EXPECT_EQ(player_.frame(), 10);  // of 19 steps
  EXPECT_FALSE(player_.isPlaying());
  player_.toggle();
  pass(0.3);
  player_.seek(0.25);
  EXPECT_EQ(player_.frame(), 5);
  pass(0.21);
  EXPECT_EQ(player_.frame(), 7);
  player_.seek(-1);
  EXPECT_EQ(player_.frame(), 0);
  player_.seek(2);
  EXPECT_EQ(player_.frame(), 19);
  EXPECT_EQ(player_.part(), 1);
}

TEST_F(PlayerTest, seeksAFilmTime) {
  player_.seekTime(0.74);
  EXPECT_EQ(player_.frame(), 7);
  player_.seekTime(0.76);
  EXPECT_EQ(player_.frame(), 8);
  player_.seekTime(99);
  EXPECT_EQ(player_.frame(), 19);
}

TEST(Player, filmOfOneFrameDoesNotPlay) {
  Player player(kRate, 1);
  player.toggle();
  EXPECT_FALSE(player.isPlaying());
  player.seekTime(1);
  player.step(1);
  EXPECT_EQ(player.frame(), 0);
  EXPECT_EQ(player.part(), 0);
}

}  // namespace
}  // namespace careen
