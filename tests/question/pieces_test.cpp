#include "question/pieces.h"

#include <gtest/gtest.h>

#include <array>

#include "support/trajectories.h"

namespace careen {
namespace {

// The drifter's segments begin at 0 and 0.5 s, those that are given to the anchor at 0, 0.2, 0.2 and 0.7 s.
class PiecesOfTwo : public testing::Test {
 protected:
  PiecesOfTwo() {
    const Motion rest = run_.tracks[1].segments[0].motion;
    run_.tracks[1].segments = {{.start = 0, .motion = rest},
                               {.start = 0.2, .motion = Flight()},
                               {.start = 0.2, .motion = rest},
                               {.start = 0.7, .motion = rest}};
  }
  Trajectory run_ = driftAndReturn();
};

TEST_F(PiecesOfTwo, endWhereOneOfThemDoes) {
  Pieces pieces(run_, std::array<std::size_t, 2>{0, 1}, 1);
  std::vector<double> ends;
  while (pieces.next()) {
    EXPECT_LT(pieces.from(), pieces.to());
    EXPECT_EQ(pieces.from(), ends.empty() ? 0 : ends.back());
    EXPECT_EQ(pieces[0].segment.start, pieces.from() < 0.5 ? 0 : 0.5);
    EXPECT_TRUE(std::holds_alternative<Rest>(pieces[1].segment.motion));  // no segment without length
    ends.push_back(pieces.to());
  }
  EXPECT_EQ(ends, (std::vector<double>{0.2, 0.5, 0.7, 1}));
}

TEST_F(PiecesOfTwo, goNoFartherThanAsked) {
  Pieces pieces(run_, std::array<std::size_t, 1>{0}, 0.4);
  EXPECT_TRUE(pieces.next());
  EXPECT_EQ(pieces.to(), 0.4);
  EXPECT_FALSE(pieces.next());
  Pieces none(run_, std::array<std::size_t, 1>{0}, 0);
  EXPECT_FALSE(none.next());
}

// The state at the end is that of the later one.
TEST_F(PiecesOfTwo, endWithWhatBeginsAtTheEnd) {
  Pieces pieces(run_, std::array<std::size_t, 2>{0, 1}, 0.5);
  EXPECT_TRUE(pieces.next());
  EXPECT_TRUE(pieces.next());
  EXPECT_EQ(pieces.to(), 0.5);
  EXPECT_EQ(pieces[0].segment.start, 0);
  EXPECT_TRUE(pieces.next());
  EXPECT_EQ(pieces.from(), 0.5);
  EXPECT_EQ(pieces.to(), 0.5);
  EXPECT_EQ(pieces[0].segment.start, 0.5);
  EXPECT_FALSE(pieces.next());
}

// 2 m/s out and back from x = 1 m, with the middle 0.05 m beside the centre of mass.
TEST_F(PiecesOfTwo, knowWhereTheMiddleIs) {
  run_.world.bodies[0].boxCenter = Vec3(0, 0.05, 0);
  Pieces pieces(run_, std::array<std::size_t, 1>{0}, 1);
  pieces.next();
  EXPECT_NEAR((pieces[0].middleAt(0.25) - Vec3(1.5, 0.05, 0)).norm(), 0, 1e-15);
  MotionBounds bounds;
  bounds.place = {.rate = 3, .bend = 4};
  bounds.spin = 2;
  bounds.angularVelocity.rate = 5;
  EXPECT_DOUBLE_EQ(pieces[0].middleBounds(bounds).rate, 3 + 2 * 0.05);
  EXPECT_DOUBLE_EQ(pieces[0].middleBounds(bounds).bend, 4 + (5 + 4) * 0.05);
}

}  // namespace
}  // namespace careen
