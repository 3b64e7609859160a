#include "audit/passage.h"

#include <gtest/gtest.h>

#include "support/exact_runs.h"

namespace careen {
namespace {

// Twenty rows, 0.05 s apart, of a cube of 2 m, 1 kg, that moves at 1 m/s.
struct TwentyRows {
  Trajectory run;
  std::vector<Passage> passages = std::vector<Passage>(20);
  explicit TwentyRows(Passage::Kind kind) {
    run.settings = {.duration = 1};
    run.given = GivenPoses{.velocities = true, .angularVelocities = true};
    run.world.bodies.push_back(box("cube", Vec3::Ones(), 1, Vec3::Zero()));
    run.tracks.resize(1);
    const BodyState state{.velocity = Vec3(1, 0, 0)};
    for (std::size_t k = 0; k < passages.size(); ++k) {
      run.tracks[0].segments.open().push_back(
          {.start = 0.05 * static_cast<double>(k),
           .motion = SampledStep{.duration = 0.05, .start = state, .end = state}});
      passages[k].kind = kind;
      if (kind == Passage::Kind::kTouched) {
        passages[k].missing = 0;
      }
    }
  }
  double largest(AuditKind kind) const {
    Findings findings(run.settings, {0});
    addUp(run, 0, passages, 0, findings);
    return findings.largest(kind).size;
  }
};

TEST(Passage, impulsesInFlightAddUp) {
  TwentyRows flight(Passage::Kind::kFlew);
  EXPECT_EQ(flight.largest(AuditKind::kLinearMomentum), 0);
  for (Passage& passage : flight.passages) {
    passage.impulse = Vec3(0, 0.001, 0);
    passage.way = Vec3(0, 0, 0.002);
  }
  EXPECT_NEAR(flight.largest(AuditKind::kLinearMomentum), 0.02, 1e-12);
  EXPECT_NEAR(flight.largest(AuditKind::kContinuity), 0.04, 1e-12);
  flight.passages[10].kind = Passage::Kind::kUnknown;  // its neighbours are not settled
  EXPECT_NEAR(flight.largest(AuditKind::kLinearMomentum), 0.009, 1e-12);
}

TEST(Passage, frictionThatIsMissingAddsUpAndWhatPassesDoesNot) {
  TwentyRows slide(Passage::Kind::kTouched);
  slide.passages[8].missing = 0.5;
  slide.passages[9].missing = -0.5;
  EXPECT_EQ(slide.largest(AuditKind::kFriction), 0);
  for (Passage& passage : slide.passages) {
    passage.missing = 0.001;
  }
  EXPECT_NEAR(slide.largest(AuditKind::kFriction), 0.019, 1e-12);
}

}  // namespace
}  // namespace careen
