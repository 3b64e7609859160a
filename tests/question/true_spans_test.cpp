#include "question/true_spans.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace careen {
namespace {

struct Wave {
  double at(double t) const { return std::sin(rate * t) + level; }
  RateBounds bounds() const { return {.rate = rate, .bend = rate * rate}; }
  double rate = 1;
  double level = 0;
};

std::vector<TrueSpan> spansOf(const Wave& wave, double end, RateBounds bounds, double unseen = 1e-12) {
  TrueSpans spans;
  spans.look({.from = 0, .to = end, .bounds = bounds, .rounding = 1e-15, .unseen = unseen},
             [&](double t) { return wave.at(t); });
  return spans.finish(end, 1e-12);
}

// sin(7t) > 0.5 from (π/6 + 2πk)/7 to (5π/6 + 2πk)/7, by either bound alone.
TEST(TrueSpans, areBetweenTheRootsOfASine) {
  constexpr double kUnknown = std::numeric_limits<double>::infinity();
  for (const RateBounds bounds : {RateBounds{7, kUnknown}, RateBounds{7, 49}, RateBounds{1e3, 49}}) {
    const std::vector<TrueSpan> spans = spansOf({.rate = 7, .level = -0.5}, 20, bounds);
    ASSERT_EQ(spans.size(), 23U);  // the last begins at 19.82 and would end at 20.12
    for (std::size_t k = 0; k < spans.size(); ++k) {
      const double turns = 2 * M_PI * static_cast<double>(k);
      EXPECT_NEAR(spans[k].from, (M_PI / 6 + turns) / 7, 1e-14);
      EXPECT_NEAR(spans[k].to, std::min(20.0, (5 * M_PI / 6 + turns) / 7), 1e-14);
    }
  }
}

// Peaks of 1 over −1 + ε: a span of half width √(2ε). One that is not there is not seen.
TEST(TrueSpans, grazesAreSeenAsFarAsTheyAreAboveZero) {
  for (const double above : {1e-3, 1e-6, 1e-9, 1e-11}) {
    const std::vector<TrueSpan> spans = spansOf({.rate = 1, .level = above - 1}, 3, {1, 1});
    ASSERT_EQ(spans.size(), 1U) << above;
    // 2 acos(1 − ε) = 2 √(2ε) (1 + ε/12 + …)
    EXPECT_NEAR(spans[0].to - spans[0].from, 2 * std::sqrt(2 * above) * (1 + above / 12),
                1e-4 * std::sqrt(above))
        << above;
    EXPECT_TRUE(spansOf({.rate = 1, .level = -above - 1}, 3, {1, 1}).empty()) << above;
  }
  EXPECT_EQ(spansOf({.rate = 1, .level = 1e-6 - 1}, 3, {1, std::numeric_limits<double>::infinity()}).size(),
            1U);
}

// A jump is at the time at which parts meet; what lasts from part to part is one.
TEST(TrueSpans, jumpsAreWherePartsMeet) {
  TrueSpans spans;
  const auto look = [&](double from, double to, double value) {
    spans.look({.from = from, .to = to}, [value](double) { return value; });
  };
  look(0, 0.1, -1);
  look(0.1, 0.3, 2);
  look(0.3, 0.7, 1);
  look(0.7, 1, -3);
  const std::vector<TrueSpan> found = spans.finish(1, 0);
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].from, 0.1);
  EXPECT_EQ(found[0].to, 0.7);
}

// What stays within rounding of 0 changes nothing, and what is true at the end lasts to it.
TEST(TrueSpans, roundingIsNoChange) {
  TrueSpans spans;
  std::mt19937 random(1);
  const auto noise = [&](double) { return 1e-16 * std::uniform_real_distribution<double>(-1, 1)(random); };
  spans.look({.from = 0, .to = 1, .bounds = {1e-3, 1}, .rounding = 1e-15, .unseen = 1e-12}, noise);
  spans.look({.from = 1, .to = 2, .bounds = {1, 0}, .rounding = 1e-15}, [](double t) { return t - 1.5; });
  spans.look({.from = 2, .to = 3, .bounds = {1e-3, 1}, .rounding = 1e-15, .unseen = 1e-12}, noise);
  const std::vector<TrueSpan> found = spans.finish(3, 0);
  ASSERT_EQ(found.size(), 1U);
  EXPECT_NEAR(found[0].from, 1.5, 1e-15);  // the first double after it
  EXPECT_EQ(found[0].to, 3);
}

// A run that was ended at the first double at which it is true.
TEST(TrueSpans, theEndAloneMayBeTrue) {
  const auto value = [](double t) { return t - 1; };
  for (const double beyond : {-1e-15, 0.0, 1e-15}) {
    const double end = 1 + beyond;
    TrueSpans spans;
    spans.look({.from = 0, .to = 0.5, .bounds = {1, 0}, .rounding = 1e-14}, value);
    spans.look({.from = 0.5, .to = end, .bounds = {1, 0}, .rounding = 1e-14}, value);
    const std::vector<TrueSpan> found = spans.finish(end, 0);
    ASSERT_EQ(found.size(), beyond > 0 ? 1U : 0U) << beyond;
    if (beyond > 0) {
      EXPECT_NEAR(found[0].from, 1, 1e-15);
      EXPECT_EQ(found[0].to, end);
    }
  }
}

TEST(TrueSpans, whatIsTrueMayEndAtTheEnd) {
  for (const double beyond : {-1e-15, 1e-15}) {
    const double end = 1 + beyond;
    TrueSpans spans;
    spans.look({.from = 0, .to = end, .bounds = {1, 0}, .rounding = 1e-14}, [](double t) { return 1 - t; });
    const std::vector<TrueSpan> found = spans.finish(end, 0);
    ASSERT_EQ(found.size(), 1U);
    EXPECT_EQ(found[0].lasts, beyond < 0);
  }
}

TEST(TrueSpans, whatIsNearerThanRoundingIsOne) {
  TrueSpans spans;
  const auto look = [&](double from, double to, double value) {
    spans.look({.from = from, .to = to}, [value](double) { return value; });
  };
  look(0, 1, 1);
  look(1, 1 + 1e-13, -1);
  look(1 + 1e-13, 2, 1);
  look(2, 2.1, -1);
  look(2.1, 3, 1);
  const std::vector<TrueSpan> found = spans.finish(3, 1e-12);
  ASSERT_EQ(found.size(), 2U);
  EXPECT_EQ(found[0].to, 2);
  EXPECT_EQ(found[1].from, 2.1);
}

// The larger of two parabolas with peaks of −1e-5 at 1 and 2, where a bound of the first derivative alone
// needs steps of 1e-5.
TEST(TrueSpans, theLargestOfSmoothValuesIsFollowedByItsLift) {
  std::size_t looks = 0;
  const auto value = [&](double t) {
    ++looks;
    return std::max(-1e-5 - (t - 1) * (t - 1), -1e-5 - (t - 2) * (t - 2));
  };
  SmoothPart part{.from = 0, .to = 4, .bounds = {4, std::numeric_limits<double>::infinity()}};
  part.unseen = 1e-12;
  part.lift = 2;
  TrueSpans spans;
  spans.look(part, value);
  EXPECT_TRUE(spans.finish(4, 0).empty());
  EXPECT_LT(looks, 200U);  // measured 55
}

// Neither numbers that are none nor a value that stays at 0 take forever.
TEST(TrueSpans, looksEnd) {
  std::size_t looks = 0;
  TrueSpans spans;
  constexpr double kInfinite = std::numeric_limits<double>::infinity();
  spans.look({.from = 0, .to = 1, .bounds = {kInfinite, kInfinite}}, [&](double t) {
    ++looks;
    return t < 0.5 ? 0 : std::nan("");
  });
  spans.look({.from = 1, .to = 2, .bounds = {kInfinite, kInfinite}}, [&](double) {
    ++looks;
    return 0.0;
  });
  EXPECT_LE(looks, 4 * TrueSpans::kMostLooks);
  EXPECT_TRUE(spans.finish(2, 0).empty());
}

}  // namespace
}  // namespace careen
