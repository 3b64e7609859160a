#include "physics/motion/joined_steps.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

namespace careen {
namespace {

class KeptSteps : public Recorder {
 public:
  void moves(BodyIndex /*body*/, double time, const Motion& motion) override {
    motions.emplace_back(time, asContactStep(std::get<CrowdStep>(motion)));
  }
  void strikes(const Impact& /*impact*/) override {}
  std::vector<std::pair<double, ContactStep>> motions;
};

struct Leg {
  double length = 0;  // [s]
  Vec3 velocity = Vec3::Zero();
  bool sharp = false;
};

// Straight steps, each with one velocity.
KeptSteps joined(const std::vector<Leg>& legs) {
  KeptSteps kept;
  JoinedSteps steps;
  double time = 0;
  Vec3 position = Vec3::Zero();
  for (const Leg& leg : legs) {
    const StepEnd from{.position = position, .velocity = leg.velocity};
    position += leg.length * leg.velocity;
    steps.add(kept, {}, time, from, {.position = position, .velocity = leg.velocity}, leg.length, 0.5,
              leg.sharp ? JoinedSteps::Begin::kCorner : JoinedSteps::Begin::kRounded);
    time += leg.length;
  }
  steps.flush(kept, {});
  return kept;
}

const std::vector<Leg> kLegs = {{1e-3, Vec3(1, 0, 0)},   {1e-3, Vec3(0, 1, 0)}, {2e-3, Vec3(-1, 0, 2)},
                                {0.3e-3, Vec3(0, 0, 0)}, {3e-3, Vec3(5, 0, 0)}, {1e-7, Vec3(0, 0, 9)},
                                {1.5e-3, Vec3(0, 2, -1)}};

TEST(JoinedSteps, haveNeitherGapsNorCorners) {
  const KeptSteps kept = joined(kLegs);
  ASSERT_GE(kept.motions.size(), kLegs.size());
  for (std::size_t k = 1; k < kept.motions.size(); ++k) {
    const auto& [start, step] = kept.motions[k - 1];
    const auto& [time, next] = kept.motions[k];
    EXPECT_NEAR(start + step.duration, time, 1e-16);
    EXPECT_LT((positionAt(step, step.duration) - positionAt(next, 0)).norm(), 1e-15) << k;
    EXPECT_LT((velocityAt(step, step.duration) - velocityAt(next, 0)).norm(), 1e-8) << k;
  }
}

// Each velocity is a mean of those of the two nearest steps, however long these are.
TEST(JoinedSteps, goAsFastAsTheirSteps) {
  const KeptSteps kept = joined(kLegs);
  double begin = 0;
  for (std::size_t leg = 0; leg + 1 < kLegs.size(); ++leg) {
    const Vec3& before = kLegs[leg].velocity;
    const Vec3& after = kLegs[leg + 1].velocity;
    const double from = begin + 0.5 * kLegs[leg].length;
    const double until = begin + kLegs[leg].length + 0.5 * kLegs[leg + 1].length;
    for (const auto& [start, step] : kept.motions) {
      for (double part = 0.01; part < 1; part += 0.07) {
        const double time = start + part * step.duration;
        if (time > from && time < until) {
          const Vec3 velocity = velocityAt(step, part * step.duration);
          const Vec3 change = after - before;
          const double along = (velocity - before).dot(change) / change.squaredNorm();
          EXPECT_GT(along, -1e-7) << leg;
          EXPECT_LT(along, 1 + 1e-7) << leg;
          EXPECT_LT((velocity - before - along * change).norm(), 1e-7) << leg;
        }
      }
    }
    begin += kLegs[leg].length;
  }
}

// Two members that touch at the ends of steps, and are bent alike, do not overlap between them.
TEST(JoinedSteps, overlapNoMoreThanTheirEnds) {
  const std::vector<Leg> hit = {{1e-3, Vec3(4, 0, 0)}, {1e-3, Vec3(3, 0, 0)}, {0.5e-3, Vec3(1, 0, 0)}};
  const std::vector<Leg> struck = {{1e-3, Vec3(0, 0, 0)}, {1e-3, Vec3(3, 0, 0)}, {0.5e-3, Vec3(2, 0, 0)}};
  const KeptSteps first = joined(hit);
  const KeptSteps second = joined(struck);
  const auto at = [](const KeptSteps& kept, double time) {
    const auto next = std::find_if(kept.motions.begin() + 1, kept.motions.end(),
                                   [&](const auto& each) { return each.first > time; });
    return positionAt((next - 1)->second, time - (next - 1)->first).x();
  };
  for (double time = 0; time < 2.5e-3; time += 1e-5) {
    EXPECT_LE(at(first, time) - 4e-3, at(second, time) + 1e-15) << time;
  }
}

TEST(JoinedSteps, areBesideJointsAsTheyTellUnlessThoseAreSharp) {
  for (const double length : {1e-3, 3e-3}) {
    for (const bool sharp : {false, true}) {
      for (const double part : {-1.0, -0.6, 0.0, 0.3, 1.0}) {
        const JoinedSteps::Beside known = JoinedSteps::beside(1e-3, length, part);
        double beside = 0;
        for (const auto& [start, step] :
             joined({{1e-3, Vec3(4, 0, 0)}, {length, Vec3(-4, 0, 0), sharp}}).motions) {
          if (start <= 1e-3 + known.time) {
            beside = 4e-3 - 4 * std::abs(known.time) - positionAt(step, 1e-3 + known.time - start).x();
          }
        }
        EXPECT_NEAR(beside, sharp ? 0 : 8 * known.off, 1e-15) << length << sharp << part;
        EXPECT_TRUE(sharp || part != 0 || beside > 8e-4);
      }
    }
  }
}

TEST(JoinedSteps, keepAParabola) {
  const auto thrown = [](double time) {
    return StepEnd{.position = Vec3(time, 0, 3 * time - 4.905 * time * time),
                   .velocity = Vec3(1, 0, 3 - 9.81 * time),
                   .spinBody = Vec3(0, 2, 0)};
  };
  KeptSteps kept;
  JoinedSteps steps;
  double time = 0;
  for (const double length : {1e-3, 1e-3, 4e-3, 1e-4, 2e-3}) {
    steps.add(kept, {}, time, thrown(time), thrown(time + length), length, 0.5);
    time += length;
  }
  steps.flush(kept, {});
  for (const auto& [start, step] : kept.motions) {
    for (double part = 0; part <= 1; part += 0.1) {
      EXPECT_LT(
          (positionAt(step, part * step.duration) - thrown(start + part * step.duration).position).norm(),
          1e-15);
    }
  }
}

// What was recorded before, by others, ends half a step early, and the path goes on from there.
TEST(JoinedSteps, bendWhatOthersRecordedBefore) {
  KeptSteps kept;
  JoinedSteps steps;
  const StepEnd still{.position = Vec3(1, 2, 3)};
  const StepEnd from{.position = Vec3(1, 2, 3), .velocity = Vec3(2, 0, 0)};
  const StepEnd to{.position = Vec3(1.002, 2, 3), .velocity = Vec3(2, 0, 0)};
  EXPECT_TRUE(steps.isNew());
  steps.follows(0.9995, still, still, 0.0005);
  EXPECT_FALSE(steps.isNew());
  steps.add(kept, {}, 1, from, to, 1e-3, 0.5);
  steps.flush(kept, {});
  ASSERT_EQ(kept.motions.size(), 2U);
  EXPECT_EQ(kept.motions[0].first, 0.9995);
  EXPECT_EQ(velocityAt(kept.motions[0].second, 0).norm(), 0);
  EXPECT_NEAR(velocityAt(kept.motions[0].second, 0.0005).x(), 1, 1e-9);
  EXPECT_EQ(positionAt(kept.motions[1].second, kept.motions[1].second.duration), to.position);
  EXPECT_TRUE(steps.isNew());
}

}  // namespace
}  // namespace careen
