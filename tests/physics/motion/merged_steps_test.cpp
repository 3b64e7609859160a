#include "physics/motion/merged_steps.h"

#include <gtest/gtest.h>

#include <cmath>
#include <utility>
#include <vector>

namespace careen {
namespace {

class Kept : public Recorder {
 public:
  void moves(BodyIndex /*body*/, double time, const Motion& motion) override {
    motions.emplace_back(time, motion);
  }
  void strikes(const Impact& /*impact*/) override {}
  std::vector<std::pair<double, Motion>> motions;
};

constexpr double kWithin = 1e-5;  // [m]
constexpr double kStep = 1e-3;    // [s]

StepEnd thrown(double time) {
  return {.position = Vec3(time, 0, 3 * time - 4.905 * time * time), .velocity = Vec3(1, 0, 3 - 9.81 * time)};
}

StepEnd shaken(double time) {
  return {.position = Vec3(1e-3 * std::sin(2000 * time), 0, 0),
          .velocity = Vec3(2 * std::cos(2000 * time), 0, 0)};
}

template <class Path>
Kept recorded(const Path& path, int steps) {
  Kept kept;
  MergedSteps merged(kWithin);
  for (int k = 0; k < steps; ++k) {
    merged.add(kept, {}, k * kStep, path(k * kStep), path((k + 1) * kStep), kStep, 0.5);
  }
  merged.flush(kept, {});
  return kept;
}

TEST(MergedSteps, aFallIsFewOfThem) {
  const Kept kept = recorded(thrown, 90);
  EXPECT_EQ(kept.motions.size(), 10U);  // nine steps each
  for (const auto& [time, motion] : kept.motions) {
    const ContactStep step = asContactStep(std::get<CrowdStep>(motion));
    for (double part = 0; part <= 1; part += 0.1) {
      EXPECT_LT(
          (positionAt(step, part * step.duration) - thrown(time + part * step.duration).position).norm(),
          0x1p-22 * kWithin);  // they are rounded to less than a millionth of the bound
    }
  }
}

// One step in which the velocity changes, of a hundredth of the next, which is straight: the cubic through
// both passes their joint, but not where the long one goes.
TEST(MergedSteps, keepsWithinItsBoundInTheMiddleOfALongStepAfterAShortOne) {
  constexpr double kShort = 1e-5;  // [s]
  const StepEnd begin{.velocity = Vec3(-15, 0, 0)};
  const StepEnd joint{.position = Vec3(-12e-5, 0, 0), .velocity = Vec3(-9, 0, 0)};
  const StepEnd end{.position = Vec3(-12e-5 - 9e-3, 0, 0), .velocity = Vec3(-9, 0, 0)};
  Kept kept;
  MergedSteps merged(1e-4);
  merged.add(kept, {}, 0, begin, joint, kShort, 0.5);
  merged.add(kept, {}, kShort, joint, end, kStep, 0.5);
  merged.flush(kept, {});
  const auto& [time, motion] = kept.motions.back();
  const ContactStep step = asContactStep(std::get<CrowdStep>(motion));
  for (double late = 0; late <= kStep; late += 0.1 * kStep) {
    const Vec3 there = positionAt(step, kShort - time + late);
    EXPECT_LT((there - (joint.position - 9 * late * Vec3::UnitX())).norm(), 1e-4) << late;
  }
}

TEST(MergedSteps, keepsWithinItsBoundAtTheEndsOfAllSteps) {
  const Kept kept = recorded(shaken, 40);
  EXPECT_GT(kept.motions.size(), 15U);
  std::size_t at = 0;
  for (int k = 0; k <= 40; ++k) {
    const double time = k * kStep;
    while (at + 1 < kept.motions.size() && kept.motions[at + 1].first <= time) {
      ++at;
    }
    const ContactStep step = asContactStep(std::get<CrowdStep>(kept.motions[at].second));
    EXPECT_LE((positionAt(step, time - kept.motions[at].first) - shaken(time).position).norm(), kWithin);
  }
}

TEST(MergedSteps, anImpactEndsOne) {
  Kept kept;
  MergedSteps merged(kWithin);
  StepEnd end = thrown(kStep);
  merged.add(kept, {}, 0, thrown(0), end, kStep, 0.5);
  end.velocity.z() = -end.velocity.z();
  StepEnd next = end;
  next.position += kStep * end.velocity;
  merged.add(kept, {}, kStep, end, next, kStep, 0.5);
  EXPECT_EQ(kept.motions.size(), 1U);
  merged.flush(kept, {});
  EXPECT_EQ(kept.motions.size(), 2U);
  merged.flush(kept, {});
  EXPECT_EQ(kept.motions.size(), 2U);
}

}  // namespace
}  // namespace careen
