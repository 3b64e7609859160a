#include "trajectory/segments.h"

#include <gtest/gtest.h>

#include <variant>
#include <vector>

namespace careen {
namespace {

// Steps of 1/4 s along x, on a grid of 2^-20 m unless told otherwise.
Segment stepAt(int k, double further = 0) {
  CrowdStep step{.duration = 0.25};
  step.position = {Vec3(k, 5, -0.0), Vec3(1 + further, 0, 0x1p-20), Vec3::Zero(), Vec3::Zero()};
  step.worldFromBody.fill(Vec4::Zero());
  step.worldFromBody[0] = Vec4(0, 0, 0, 1);
  return {.start = 0.25 * k, .motion = step};
}

void expectSame(const Segment& one, const Segment& other) {
  EXPECT_EQ(one.start, other.start);
  ASSERT_EQ(one.motion.index(), other.motion.index());
  if (const CrowdStep* const step = std::get_if<CrowdStep>(&one.motion)) {
    EXPECT_EQ(step->duration, std::get<CrowdStep>(other.motion).duration);
    EXPECT_EQ(step->position, std::get<CrowdStep>(other.motion).position);
    EXPECT_EQ(step->worldFromBody, std::get<CrowdStep>(other.motion).worldFromBody);
  }
}

// Some of them on no grid, and a rest.
std::vector<Segment> mixed() {
  std::vector<Segment> list;
  for (int k = 0; k < 50; ++k) {
    list.push_back(stepAt(k, k == 30 ? 0.1 : 0));
  }
  list[20] = {.start = 5, .motion = Rest{}};
  return list;
}

TEST(Segments, arePackedAndGivenBackInAnyOrder) {
  const std::vector<Segment> list = mixed();
  Segments packed;
  for (const Segment& segment : list) {
    packed.addPacked(segment);
  }
  ASSERT_EQ(packed.size(), list.size());
  EXPECT_LT(packed.unpacked().size(), list.size());
  for (std::size_t k = 0; k < list.size(); ++k) {
    const std::size_t other = 17 * k % list.size();
    expectSame(packed[other], list[other]);
  }
  std::size_t k = 0;
  for (const Segment& segment : packed) {
    expectSame(segment, list[k++]);
  }
  EXPECT_EQ(k, list.size());
  expectSame(packed.front(), list.front());
  expectSame(packed.back(), list.back());
}

TEST(Segments, twoTracksDoNotMixWhatTheyUnpacked) {
  Segments here;
  Segments there;
  for (int k = 0; k < 20; ++k) {
    here.addPacked(stepAt(k));
    there.addPacked(stepAt(k, 1));
  }
  for (int k = 0; k < 20; ++k) {
    const auto index = static_cast<std::size_t>(k);
    expectSame(here[index], stepAt(k));
    expectSame(there[index], stepAt(k, 1));
  }
}

// They begin at 0, 1/4 s …; two at 1 s.
TEST(Segments, areCountedUntilATime) {
  Segments segments;
  for (int k = 0; k < 20; ++k) {
    Segment segment = stepAt(k);
    segment.start = k == 5 ? 1 : segment.start;
    segments.addPacked(segment);
  }
  EXPECT_EQ(segments.countUntil(-1), 0U);
  EXPECT_EQ(segments.countUntil(0), 1U);
  EXPECT_EQ(segments.countUntil(0.99), 4U);
  EXPECT_EQ(segments.countUntil(1), 6U);
  EXPECT_EQ(segments.countUntil(1.99), 8U);  // the last of those packed together
  EXPECT_EQ(segments.countUntil(2), 9U);
  EXPECT_EQ(segments.countUntil(4.75), 20U);
  EXPECT_EQ(segments.countUntil(100), 20U);
}

TEST(Segments, areAsTheyAreOnceOpened) {
  const std::vector<Segment> list = mixed();
  Segments packed;
  for (const Segment& segment : list) {
    packed.addPacked(segment);
  }
  const Segments copy = packed;
  packed.open()[3].start = 0.8;
  EXPECT_EQ(packed.unpacked().size(), list.size());
  EXPECT_EQ(packed[3].start, 0.8);
  expectSame(packed[30], list[30]);
  expectSame(copy[3], list[3]);
}

}  // namespace
}  // namespace careen
