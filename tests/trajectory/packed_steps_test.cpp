#include "trajectory/packed_steps.h"

#include <gtest/gtest.h>

#include <array>
#include <bit>
#include <cstdint>
#include <string>
#include <utility>
#include <variant>
#include <vector>

namespace careen {
namespace {

constexpr double kGrid = 0x1p-10;

// Along x from one place to another in steps of the grid, without turning.
Segment stepOf(double start, double duration, const std::array<double, 4>& along) {
  CrowdStep step{.duration = duration};
  for (std::size_t k = 0; k < along.size(); ++k) {
    step.position[k] = Vec3(kGrid * along[k], 0, 0);
    step.worldFromBody[k] = Vec4(0, 0, 0, k == 0 ? 1 : 0);
  }
  return {.start = start, .motion = step};
}

struct Packed {
  std::string times;
  std::string bits;
  std::vector<Segment> others;
};

Packed packedOf(const std::vector<Segment>& segments) {
  StepPacker packer(segments);
  Packed packed;
  for (const Segment& segment : segments) {
    if (!packer.add(segment)) {
      packed.others.push_back(segment);
    }
  }
  packed.times = packer.times();
  packed.bits = packer.bits();
  return packed;
}

std::vector<std::uint64_t> bitsOf(const Segment& segment) {
  std::vector<std::uint64_t> bits = {std::bit_cast<std::uint64_t>(segment.start)};
  if (const CrowdStep* const step = std::get_if<CrowdStep>(&segment.motion)) {
    bits.push_back(std::bit_cast<std::uint64_t>(step->duration));
    for (std::size_t k = 0; k < step->position.size(); ++k) {
      for (const double x : step->position[k]) {
        bits.push_back(std::bit_cast<std::uint64_t>(x));
      }
      for (const double x : step->worldFromBody[k]) {
        bits.push_back(std::bit_cast<std::uint64_t>(x));
      }
    }
  }
  return bits;
}

void expectSame(const std::vector<Segment>& segments) {
  const Packed packed = packedOf(segments);
  StepUnpacker unpacker(packed.times, packed.bits);
  std::size_t other = 0;
  for (const Segment& segment : segments) {
    Segment again;
    if (unpacker.next(again) != StepUnpacker::Next::kPacked) {
      again = packed.others.at(other++);
    }
    EXPECT_EQ(again.motion.index(), segment.motion.index());
    EXPECT_EQ(bitsOf(again), bitsOf(segment));
  }
  EXPECT_TRUE(unpacker.atEnd());
}

// The second step goes on from 5 + 1 as fast as the first one, and nothing of it is new: two bits, eight
// widths of six, and one for zeros. The first has three numbers up to 10 (4 bits), four up to 2048 (12), and
// three up to 2 (2) more, as twice a number tells its sign. The power of two takes 12.
TEST(PackedSteps, keepsWhatIsNew) {
  const std::vector<Segment> segments = {stepOf(0, 0.5, {5, 1, 0, 0}), stepOf(0.5, 0.5, {6, 1, 0, 0})};
  const Packed packed = packedOf(segments);
  EXPECT_TRUE(packed.others.empty());
  EXPECT_EQ(packed.times.size(), 3 * sizeof(double));  // a start and two lengths
  constexpr std::size_t kBits = 12 + (51 + 3 * 4 + 4 * 12 + 3 * 2) + 51;
  EXPECT_EQ(packed.bits.size(), (kBits + 7) / 8);
  expectSame(segments);
}

// Twice as long: 1 + 2 × 3 + 3 × 2 in half a second is 26 in a whole one.
TEST(PackedSteps, knowsVelocitiesOfStepsOfOtherLengths) {
  const std::vector<Segment> segments = {stepOf(0, 0.5, {5, 1, 3, 2}), stepOf(0.5, 1, {11, 26, 0, 0})};
  const std::vector<Segment> first(segments.begin(), segments.begin() + 1);
  EXPECT_EQ(packedOf(segments).bits.size(), (8 * packedOf(first).bits.size() + 51) / 8);
  expectSame(segments);
}

TEST(PackedSteps, bringsBackEveryBit) {
  Segment zeros = stepOf(1.5, 0.25, {7, -3, 1, -0.0});
  std::get<CrowdStep>(zeros.motion).worldFromBody[2] = Vec4(-0.0, kGrid, -kGrid, 0);
  expectSame({stepOf(0, 0.5, {1, -2, 3, -4}),
              stepOf(0.7, 0.1, {-5e10, 0, 0, 7}),
              {.start = 0.9, .motion = Rest{}},
              stepOf(0.95, 0x1p-1060, {0, 0, 0, 0}),
              zeros,
              stepOf(1.75, 3, {-5, 2, 0, 9})});
  expectSame({});
  expectSame({{.start = 0, .motion = Rest{}}});
}

// 0.1 is no multiple of 2⁻¹⁰, and 2⁶³ of them are beyond what fits.
TEST(PackedSteps, leavesWhatIsNotOnTheGrid) {
  const std::vector<Segment> segments = {stepOf(0, 0.5, {1, 0, 0, 0}),
                                         stepOf(0.5, 0.5, {1, 0.1 / kGrid, 0, 0}),
                                         stepOf(1, 0.5, {0x1p63, 0, 0, 0}), stepOf(1.5, 0.5, {3, 0, 0, 0})};
  EXPECT_EQ(packedOf(segments).others.size(), 2U);
  expectSame(segments);
}

TEST(PackedSteps, tellsWhenItIsCutShort) {
  const Packed packed = packedOf({stepOf(0, 0.5, {5, 1, 0, 0})});
  Segment segment;
  StepUnpacker withoutTimes(std::string_view(packed.times).substr(1), packed.bits);
  EXPECT_EQ(withoutTimes.next(segment), StepUnpacker::Next::kDamaged);
  for (std::size_t size = 0; size < packed.bits.size(); ++size) {
    StepUnpacker unpacker(packed.times, std::string_view(packed.bits).substr(0, size));
    EXPECT_EQ(unpacker.next(segment), StepUnpacker::Next::kDamaged) << size;
  }
}

}  // namespace
}  // namespace careen
