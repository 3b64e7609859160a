#include "physics/contact/event_functions.h"

#include <gtest/gtest.h>

#include <cmath>
#include <utility>
#include <vector>

#include "support/touching_bodies.h"

namespace careen {
namespace {

using EventKind = EventFunction::Kind;

// Bodies with contacts whose modes are found.
struct Listed {
  Listed(World of, const std::vector<ContactFeature>& features)
      : world(std::move(of)), system(world, touching(world), features), events(system) {
    y = system.pack();
    EXPECT_TRUE(system.findModes(y));
    events.list();
    events.noteStart();
  }
  std::vector<std::size_t> of(EventKind kind) const {
    std::vector<std::size_t> found;
    for (std::size_t w = 0; w < events.all().size(); ++w) {
      if (events[w].kind == kind) {
        found.push_back(w);
      }
    }
    return found;
  }
  World world;
  ContactSystem system;
  EventFunctions events;
  std::vector<double> y;
};

// 10 N on four corners, each of effective mass 1/4 kg: J M⁻¹ Jᵀ = 1 + 2 · 0.1² · 150 = 4 per kg.
TEST(EventFunctions, ofWhatSticksAreItsForces) {
  const World world = cubeAbove(0.1);
  const Listed rest(world, lowerCorners(world, 0, 0.5));
  ASSERT_EQ(rest.of(EventKind::kPush).size(), 4U);
  ASSERT_EQ(rest.of(EventKind::kStick).size(), 4U);
  for (const std::size_t event : rest.of(EventKind::kPush)) {
    EXPECT_NEAR(rest.events.value(event), 2.5 * 4, 1e-12);
    EXPECT_EQ(rest.events[event].start, rest.events.value(event));
  }
  EXPECT_NEAR(rest.events.lowest(rest.of(EventKind::kStick)), 0.5 * 2.5 * 4, 1e-12);
  EXPECT_FALSE(rest.events.hasTension());
  EXPECT_FALSE(rest.events.areClear());
}

// What slides cannot begin to. Its upper corners are 0.2 m above the floor.
TEST(EventFunctions, ofCornersAreTheirGaps) {
  const World world = cubeAbove(0.1, Vec3(1, 0, 0));
  Listed slide(world, lowerCorners(world, 0, 0.5));
  EXPECT_TRUE(slide.of(EventKind::kStick).empty());
  const std::vector<std::size_t> corners = slide.of(EventKind::kCorner);
  ASSERT_EQ(corners.size(), 4U);
  EXPECT_NEAR(slide.events.value(corners[0]), 0.2, 1e-15);
  slide.y[9] = -3;
  slide.system.look(slide.y);
  EXPECT_EQ(slide.events.rateOf(slide.events[corners[0]]), -3);
}

// One that has opened by a millimetre is in flight; that it may be deeper than rounding ends with its gap.
TEST(EventFunctions, ofOpenContactsAreTheirGaps) {
  const World world = cubeAbove(0.101, Vec3(0, 0, 1));
  Listed flies(world, lowerCorners(world));
  flies.system.modes().assign(4, ContactForces::Mode::kOff);
  flies.events.list();
  const std::vector<std::size_t> gaps = flies.of(EventKind::kGap);
  ASSERT_EQ(gaps.size(), 4U);
  EXPECT_NEAR(flies.events.value(gaps[0]), 1e-3, 1e-10);
  EXPECT_GT(flies.events.value(gaps[0]), 1e-3);
  EXPECT_TRUE(flies.events.areClear());
  EXPECT_NEAR(flies.events.depth(gaps), flies.system.touching(0) / 1024, 1e-20);
}

// A cube on another, 0.03 m before the end of its face, and one on the floor beside them.
TEST(EventFunctions, ofPairsAreTheirGapAndTheEndOfTheFace) {
  World world = floorWith(0, 0);
  world.bodies.push_back(box("upper", Vec3(0.1, 0.1, 0.1), 1, Vec3(0, 0, 0.3)));
  world.bodies.push_back(box("lower", Vec3(0.13, 0.13, 0.1), 1, Vec3(0, 0, 0.1)));
  world.bodies.push_back(box("beside", Vec3(0.1, 0.1, 0.1), 1, Vec3(1, 0, 0.1)));
  std::vector<ContactFeature> features = lowerCorners(world, 1);
  for (const ContactFeature& corner : lowerCorners(world, 0)) {
    features.push_back({.kind = ContactFeature::Kind::kPointOnFace,
                        .a = 0,
                        .b = 1,
                        .boxA = 0,
                        .boxB = 0,
                        .onA = corner.onA,
                        .axisB = 2});
  }
  const Listed stack(world, features);
  ASSERT_EQ(stack.of(EventKind::kOverlap).size(), 1U);
  ASSERT_EQ(stack.of(EventKind::kWithin).size(), 4U);
  EXPECT_NEAR(stack.events.lowest(stack.of(EventKind::kWithin)), 0.03, 1e-10);
  EXPECT_TRUE(stack.events.coverBoxes({0, 0}, {1, 0}));
  EXPECT_TRUE(stack.events.coverBoxes({1, 0}, {0, 0}));
  EXPECT_FALSE(stack.events.coverBoxes({0, 0}, {2, 0}));
}

}  // namespace
}  // namespace careen
