#include "study/peer.h"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <stop_token>
#include <vector>

#include "core/error.h"
#include "study/case.h"
#include "support/physics_worlds.h"

namespace careen {
namespace {

/// An engine that counts: its bodies lie at x = the time stepped so far. Keeps the steps it was told to take.
class Counter : public Peer {
 public:
  class CountingEngine : public Engine {
   public:
    explicit CountingEngine(const Counter& peer) : peer_(peer) {}
    void step(double h) override {
      peer_.steps_.push_back(h);
      now_ += h;
    }
    BodyState state(std::size_t body) const override {
      BodyState state;
      state.pose.position.x() = now_ < peer_.lostFrom ? now_ : std::nan("");
      state.pose.position.y() = static_cast<double>(body);
      return state;
    }

   private:
    const Counter& peer_;
    double now_ = 0;
  };

  std::string name() const override { return "counter"; }
  std::string settings() const override { return "none"; }
  const std::vector<double>& taken() const { return steps_; }

  double lostFrom = 1e9;  // [s]

 protected:
  std::unique_ptr<Engine> feed(const World& /*world*/) const override {
    steps_.clear();
    return std::make_unique<CountingEngine>(*this);
  }

 private:
  mutable std::vector<double> steps_;
};

World twoBodies() {
  World world;
  world.bodies = {makeBox({.position = {9, 9, 9}, .velocity = {1, 0, 0}, .name = "held"}), makeBox({})};
  world.bodies[0].mass = immovable();
  return world;
}

TEST(Peer, takesEqualStepsNoLongerThanItWasTold) {
  const Counter peer;
  const std::vector<double> times = {0, 1, 1.25};
  peer.run(twoBodies(), 0.3, times, {});
  EXPECT_EQ(peer.taken(), (std::vector<double>{0.25, 0.25, 0.25, 0.25, 0.25}));
  peer.run(twoBodies(), 10, times, {});
  EXPECT_EQ(peer.taken(), (std::vector<double>{1, 0.25}));
}

// 0.1 · 60 > 6 in doubles, and 3 · 0.1 > 0.3: still 6 and 3 steps.
TEST(Peer, takesNoStepMoreForARounding) {
  const Counter peer;
  peer.run(twoBodies(), 1.0 / 60, std::vector<double>{0.1}, {});
  EXPECT_EQ(peer.taken().size(), 6U);
  peer.run(twoBodies(), 0.1, std::vector<double>{0.3}, {});
  EXPECT_EQ(peer.taken().size(), 3U);
}

TEST(Peer, asksItsEngineOnlyForWhatMoves) {
  const Counter peer;
  const std::vector<std::vector<BodyState>> states =
      peer.run(twoBodies(), 0.5, std::vector<double>{0, 0.5, 2}, {});
  ASSERT_EQ(states.size(), 3U);
  for (const std::vector<BodyState>& moment : states) {
    ASSERT_EQ(moment.size(), 2U);
    EXPECT_EQ(moment[0].pose.position, Vec3(9, 9, 9));
    EXPECT_EQ(moment[0].velocity, Vec3::Zero());
  }
  EXPECT_EQ(states[0][1].pose.position, Vec3(0, 1, 0));
  EXPECT_EQ(states[1][1].pose.position, Vec3(0.5, 1, 0));
  EXPECT_EQ(states[2][1].pose.position, Vec3(2, 1, 0));
}

TEST(Peer, saysWhenABodyIsLost) {
  Counter peer;
  peer.lostFrom = 1.5;
  EXPECT_NO_THROW(peer.run(twoBodies(), 0.5, std::vector<double>{1}, {}));
  EXPECT_THROW(peer.run(twoBodies(), 0.5, std::vector<double>{1, 2}, {}), NumericalError);
}

TEST(Peer, endsBeforeTheNextStepWhenAskedToStop) {
  const Counter peer;
  std::stop_source source;
  source.request_stop();
  EXPECT_THROW(peer.run(twoBodies(), 1, std::vector<double>{1}, source.get_token()), Interrupted);
  EXPECT_TRUE(peer.taken().empty());
}

TEST(Peer, saysWhichJointsAndMotorsItHasNot) {
  const Counter peer;
  World world = twoBodies();
  world.joints.resize(2);
  EXPECT_EQ(peer.refuses(world), "");
  world.joints[1].kind = Joint::Kind::kRope;
  EXPECT_EQ(peer.refuses(world), "no rods, no ropes");
  world.joints[1].kind = Joint::Kind::kHinge;
  world.joints[1].damping = 1;
  EXPECT_EQ(peer.refuses(world), "no springs, no friction of joints");
  world.joints[1].until = 1;
  EXPECT_EQ(peer.refuses(world), "no joints that let go");
  world.control.emplace();
  EXPECT_EQ(peer.refuses(world), "no motors");
}

TEST(Peer, knowsNeitherSpringsNorDrag) {
  const Counter peer;
  EXPECT_TRUE(peer.steps());
  World world = twoBodies();
  EXPECT_EQ(peer.refuses(world), "");
  world.springs.emplace_back();
  EXPECT_EQ(peer.refuses(world), "no springs, no drag");
  world.springs.clear();
  world.drag.emplace();
  EXPECT_EQ(peer.refuses(world), "no springs, no drag");
}

// The cases that only exact has.
TEST(Peer, knowsNothingThatMovesByItself) {
  const Counter peer;
  for (const char* const name : {"shaking-table", "lift-stops", "pusher"}) {
    EXPECT_EQ(peer.refuses(readCase(name).world), "no fixed boxes that move") << name;
  }
  EXPECT_EQ(peer.refuses(readCase("belt").world), "no surfaces that move");
  EXPECT_EQ(peer.refuses(readCase("braked").world), "no gravity that changes");
}

}  // namespace
}  // namespace careen
