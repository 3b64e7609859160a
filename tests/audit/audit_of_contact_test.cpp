// Scenes of contact that once broke a promise, or did not end: the audit finds nothing.
#include <gtest/gtest.h>

#include <filesystem>
#include <ostream>
#include <string>
#include <utility>

#include "audit/audit.h"
#include "scene/plan.h"
#include "scene/scene_reader.h"
#include "trajectory/trajectory.h"

namespace careen {
namespace {

class AuditOfContact : public testing::TestWithParam<const char*> {};

Trajectory contactRunOf(const std::string& scene) {
  const std::filesystem::path scenes = CAREEN_SOURCE_DIR "/tests/scenes/contact";
  return record(setupOf(readScene(scenes / (scene + ".json"))));
}

struct EarlyCrowd {
  std::string scene;
  double before = 0;  // [s]
};

void PrintTo(const EarlyCrowd& early, std::ostream* out) { *out << early.scene; }

class AuditOfCrowd : public testing::TestWithParam<EarlyCrowd> {};

// Or a film would take minutes, or hours.
TEST_P(AuditOfCrowd, beginsWhereContactCostsTooMuch) {
  RunSetup setup = setupOf(
      readScene(std::filesystem::path(CAREEN_SOURCE_DIR "/assets/scenes") / (GetParam().scene + ".json")));
  setup.settings.duration = GetParam().before;
  const Trajectory run = record(std::move(setup));
  ASSERT_TRUE(run.figures.boundedFrom);
  EXPECT_LT(*run.figures.boundedFrom, GetParam().before);
}

// The pile from 0.40 s on, the wall from 0.436 on: the ball strikes it at 0.434, and while the first steps
// after that were never too long, they cost 5 s.
INSTANTIATE_TEST_SUITE_P(, AuditOfCrowd, testing::Values(EarlyCrowd{"pile", 1}, EarlyCrowd{"wall", 0.438}));

TEST_P(AuditOfContact, findsNothing) {
  const Trajectory run = contactRunOf(GetParam());
  for (const AuditBreach& breach : audit(run, AuditDepth::kFull).breaches) {
    ADD_FAILURE() << describe(breach, run);
  }
}

INSTANTIATE_TEST_SUITE_P(
    , AuditOfContact,
    testing::Values(
        // Bodies meet again and again at one moment, and one of their corners parts: its speed was taken
        // away.
        "parting-corner",
        // A body in flight meets others that are moved apart by less than the tolerance, and turned by it:
        // its angular momentum turned, too.
        "flying-aligned",
        // Bodies moved apart at the end of a short time step, which was a speed in its motion.
        "corrected-step",
        // The forces of a step's two halves, recorded as if they had been one: friction beyond its cone.
        "two-halves",
        // Edges that were parallel turn on each other, 1e-15 and 1e-12 m apart: 50,000 proofs that a
        // nanosecond is free of contact, again and again: 71 s and 12 s, now 0.7 and 0.2.
        "edges-turning", "edges-turning-slowly",
        // Light boxes jammed between heavy ones, whose impulses no method found.
        "jam-of-two", "heavy-on-light",
        // A corner at the edge of an all but parallel face, and a contact where the boxes are not.
        "beside-a-face",
        // A jolt that an event of the same moment cut to nothing, while its impulses stayed on record.
        "cut-jolt",
        // A box beside one that comes to rest at the start: it flew without its spring.
        "sprung-late",
        // A crowd under a spring and without gravity: steps that took every approach for an impact lost half
        // of the spring's impulse.
        "sprung-crowd",
        // A member of a crowd that is pushed into a box at rest within one step: 1.8e-3 m deep.
        "pushed-at-rest",
        // The same with a member of another crowd.
        "two-crowds",
        // Bodies turned out of each other, whose middles hardly moved: a jump of 15 tolerances at their
        // corners.
        "turned-apart",
        // A rod of 1.2 m by 6 mm rolled by 2e-5 rad: no point of it moves far.
        "rolling-rod",
        // Half of an impulse of walls without approach, in the middle of the moment in which it acted.
        "jolt-at-walls",
        // Bodies that rocked together at .02 m/s stopped, because a contact between them parted with .002.
        "low-hops",
        // Springs pull together what was at rest, without gravity: chattering was followed for ever.
        "springs-alone",
        // An impact of 18 contacts whose impulses no method found until friction was raised step by step.
        "impact-on-slope",
        // Slip that ends, off by 1e-5 m/s for too short a time to count in the error of a step: momentum from
        // nothing, 5 times and 3 times what is promised.
        "slip-stops", "slip-stops-on-springs",
        // Springs press what is at rest. A change of 1e-10 m/s was taken for an impulse, whose moment moved
        // all by 2e-6 m; and steps began as if nothing pressed back.
        "springs-press", "springs-press-column",
        // Crowds under springs: their torques acted half a step ahead of their forces; and steps were merged
        // that moved a millimetre in a second, by velocities that were off by a tenth.
        "springs-press-crowd", "springs-press-crowd-slowly",
        // Two that become members of a crowd, pressed together by 320 m/s²: one was struck and began its path
        // anew, the other went on into it, 1.4 mm deep.
        "pressed-meets"));

// Light boxes between heavy ones, without gravity: whatever changes a velocity is an impact on record, also
// impulses without approach and those that reach a contact through its neighbours.
TEST(AuditOfJams, impactsExplainEveryJumpOfAVelocity) {
  const Trajectory run = contactRunOf("jolts");
  const Audit found = audit(run, AuditDepth::kFull);
  EXPECT_TRUE(found.breaches.empty());
  EXPECT_LT(found.figures[static_cast<std::size_t>(AuditKind::kImpulse)].size,
            1e-4);  // measured 2.3e-6; was .87
}

}  // namespace
}  // namespace careen
