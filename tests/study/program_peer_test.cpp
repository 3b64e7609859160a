#include "study/program_peer.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "core/error.h"
#include "study/deadline.h"
#include "support/physics_worlds.h"

namespace careen {
namespace {

// A program that answers the empty question, and every other one by this, in which $table is the table's
// path.
ProgramPeer answering(const std::string& script) {
  return {"theirs",
          "as shipped",
          {"sh", "-c",
           R"sh(while read -r line; do
             if [ "$line" = '{}' ]; then echo '{}'; continue; fi
             table=$(printf %s "$line" | sed 's/.*"table":"\([^"]*\)".*/\1/'); )sh" +
               script + "\ndone"}};
}

World oneBox() {
  World world;
  world.bodies = {makeBox({.halfExtents = Vec3(1, 1, 1), .name = "a"})};
  return world;
}

constexpr const char* kTable =
    R"(printf 'time,box,x,y,z,qw,qx,qy,qz,vx,vy,vz,wx,wy,wz\n0.5,a,1,2,3,1,0,0,0,4,5,6,0,0,0\n1,a,7,8,9,0,1,0,0,1,1,1,0,0,2\n' > "$table"; )";

TEST(ProgramPeer, hasThePosesOfTheTable) {
  const ProgramPeer peer = answering(std::string(kTable) + R"(echo '{"seconds": 0.25}')");
  EXPECT_TRUE(peer.steps());
  EXPECT_EQ(peer.name(), "theirs");
  EXPECT_EQ(peer.settings(), "as shipped");
  const World world = oneBox();
  const std::vector<std::vector<BodyState>> states = peer.run(world, 0.1, std::vector<double>{0.5, 1}, {});
  ASSERT_EQ(states.size(), 2U);
  EXPECT_EQ(states[0][0].pose.position, Vec3(1, 2, 3));
  EXPECT_EQ(states[0][0].pose.worldFromBody, Mat3::Identity());
  EXPECT_EQ(states[0][0].velocity, Vec3(4, 5, 6));
  EXPECT_EQ(states[1][0].pose.position, Vec3(7, 8, 9));
  EXPECT_EQ(states[1][0].pose.worldFromBody, Mat3(Vec3(1, -1, -1).asDiagonal()));
  EXPECT_EQ(states[1][0].angularMomentum, Vec3(0, 0, 2 * world.bodies[0].mass.inertiaBody.z()));
}

// The question has the step, the times and the world: the program puts what it was asked into the table.
TEST(ProgramPeer, asksForStepTimesAndWorld) {
  const ProgramPeer peer = answering(
      R"sh(number() { printf %s "$line" | sed "s/.*\"$1\":\[*\([0-9.]*\).*/\1/"; }
      printf 'time,box,x,y,z,qw,qx,qy,qz\n%s,a,%s,%s,0,1,0,0,0\n' "$(number times)" "$(number step)" \
        "$(number gravity)" > "$table"; echo '{"seconds": 1}')sh");
  World world = oneBox();
  world.gravity = Vec3(3, 0, 0);
  const BodyState state = peer.run(world, 0.125, std::vector<double>{0.75}, {}).front().front();
  EXPECT_EQ(state.pose.position, Vec3(0.125, 3, 0));
}

TEST(ProgramPeer, takesWhatTimeItsOwnClockSays) {
  const ProgramPeer peer = answering(std::string(kTable) + R"(echo '{"seconds": 0.25}')");
  EXPECT_EQ(peer.secondsTaken(), 0);
  for (int runs = 1; runs <= 3; ++runs) {
    peer.run(oneBox(), 0.1, std::vector<double>{0.5, 1}, {});
    EXPECT_EQ(peer.secondsTaken(), 0.25 * runs);
  }
}

TEST(ProgramPeer, saysWhyThereIsNoAnswer) {
  const ProgramPeer peer = answering(R"(echo '{"failure": "the state of a is not finite by t = 1 s"}')");
  try {
    peer.run(oneBox(), 0.1, std::vector<double>{1}, {});
    ADD_FAILURE() << "went on";
  } catch (const NumericalError& error) {
    EXPECT_STREQ(error.what(), "theirs: the state of a is not finite by t = 1 s");
  }
}

TEST(ProgramPeer, saysWhenItsTableIsNoAnswer) {
  const auto failure = [](const ProgramPeer& peer, const std::vector<double>& times) -> std::string {
    try {
      peer.run(oneBox(), 0.1, times, {});
      return "";
    } catch (const Error& error) {
      return error.what();
    }
  };
  EXPECT_EQ(failure(answering(std::string(kTable) + "echo '{}'"), {0.5, 1, 2}),
            "theirs: its table lacks 1 rows");
  EXPECT_EQ(failure(answering(R"(printf 'time,box,x\n' > "$table"; echo '{}')"), {1}).substr(0, 9),
            "theirs:1:");
}

// One that ends is started anew for the next run.
TEST(ProgramPeer, outlivesItsProgram) {
  const ProgramPeer peer = answering(std::string(kTable) +
                                     R"(if [ -e "$table.second" ]; then echo '{"seconds": 1}'
      else touch "$table.second"; echo 'the cause' >&2; exit 3; fi)");
  try {
    peer.run(oneBox(), 0.1, std::vector<double>{1}, {});
    ADD_FAILURE() << "went on";
  } catch (const MachineError& error) {
    EXPECT_STREQ(error.what(), "sh ended without an answer: the cause");
  }
  EXPECT_EQ(peer.run(oneBox(), 0.1, std::vector<double>{0.5, 1}, {}).size(), 2U);
}

// The deadline is one of the program's time, not of this one's, which waits.
TEST(ProgramPeer, isEndedWhenItsTimeIsUp) {
  const ProgramPeer peer = answering("while true; do :; done");
  const Deadline deadline(0.2, {}, [&peer] { return peer.secondsTaken(); });
  EXPECT_THROW(peer.run(oneBox(), 0.1, std::vector<double>{1}, deadline.token()), Interrupted);
  EXPECT_GE(peer.secondsTaken(), 0.19);
}

TEST(ProgramPeer, knowsNeitherSpringsNorDrag) {
  const ProgramPeer peer = answering("");
  World world = oneBox();
  EXPECT_EQ(peer.refuses(world), "");
  world.drag.emplace();
  EXPECT_EQ(peer.refuses(world), "no springs, no drag");
}

}  // namespace
}  // namespace careen
