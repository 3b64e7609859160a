#include "physics/search/first_contact_search.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

namespace careen {
namespace {

/// A gap given as a function of time, with a bound on its curvature: the search knows no more of a pair.
struct Curve {
  std::function<double(double)> gapAt;
  std::function<double(double)> rateAt;
  double curvature = 0;  // M ≥ −f̈
  double roundings = 1e-14;
  double sphere = 0;  // [s] ruled out by bounding spheres before
  double time = 0;

  double skip(double t) const { return std::max(t, sphere); }
  void moveTo(double t) { time = t; }
  double gap() const { return gapAt(time); }
  double tolerance() const { return roundings; }
  bool closing() const { return rateAt(time) < -1e-13; }
  bool closesHard() const { return fasterThanSinking(-rateAt(time), curvature, roundings); }
  double freeStep(double floor, double most) const {
    // First root of gap − floor + rate δ − ½Mδ².
    const double height = gap() - floor;
    const double rate = rateAt(time);
    const double root = std::sqrt(rate * rate + 2 * curvature * height);
    const double step = rate + root <= 0 && curvature == 0 ? height / -rate
                        : curvature == 0                   ? most
                        : rate <= 0                        ? 2 * height / (root - rate)
                                                           : (rate + root) / curvature;
    return std::min(step, most);
  }
  double polish(double level) const { return newtonStep(gap() - level, -rateAt(time), curvature); }
  FirstContact describe() const {
    FirstContact contact;
    contact.approach = -rateAt(time);
    return contact;
  }
};

Curve sine(double level) {
  return {.gapAt = [level](double t) { return level + std::sin(t); },
          .rateAt = [](double t) { return std::cos(t); },
          .curvature = 1};
}

// 0.5 + sin t = 0 at 7π/6, where it falls by √3/2.
TEST(FirstContactSearch, findsTheFirstRoot) {
  Curve curve = sine(0.5);
  const FirstContact contact = findFirstContact(curve, {.from = 0, .until = 100});
  EXPECT_EQ(contact.kind, ContactKind::kImpact);
  EXPECT_NEAR(contact.time, 7 * std::acos(-1.0) / 6, 1e-14);
  EXPECT_NEAR(contact.approach, std::sqrt(0.75), 1e-7);  // told where the search stood, a rounding before
  EXPECT_LT(contact.evaluations, 12);
}

// 1 + sin t stays above 0 by 1e-9 at its lowest: nothing is missed, nothing invented.
TEST(FirstContactSearch, passesWhatOnlyGrazes) {
  Curve above = sine(1 + 1e-9);
  const FirstContact none = findFirstContact(above, {.from = 0, .until = 20});
  EXPECT_EQ(none.kind, ContactKind::kNone);
  EXPECT_EQ(none.time, 20);
  Curve below = sine(1 - 1e-9);
  const FirstContact grazing = findFirstContact(below, {.from = 0, .until = 20});
  EXPECT_EQ(grazing.kind, ContactKind::kImpact);
  // 1 − 1e-9 + sin t = 0 where t lies √(2e-9) before 3π/2.
  EXPECT_NEAR(grazing.time, 1.5 * std::acos(-1.0) - std::sqrt(2e-9), 1e-9);
}

TEST(FirstContactSearch, keepsToItsWindow) {
  Curve curve = sine(0.5);
  const FirstContact before = findFirstContact(curve, {.from = 0, .until = 3.6});
  EXPECT_EQ(before.kind, ContactKind::kNone);
  EXPECT_EQ(before.time, 3.6);
  const FirstContact later = findFirstContact(curve, {.from = 6, .until = 20});
  EXPECT_EQ(later.kind, ContactKind::kImpact);
  EXPECT_NEAR(later.time, 19 * std::acos(-1.0) / 6, 1e-14);
  const FirstContact nothing = findFirstContact(curve, {.from = 3, .until = 3});
  EXPECT_EQ(nothing.kind, ContactKind::kNone);
  EXPECT_EQ(nothing.evaluations, 0);
}

TEST(FirstContactSearch, doesNotLookWhereSpheresRuleContactOut) {
  Curve curve = sine(0.5);
  curve.sphere = 8;  // beyond the first time below zero, which is 7π/6 to 11π/6
  EXPECT_NEAR(findFirstContact(curve, {.from = 0, .until = 20}).time, 19 * std::acos(-1.0) / 6, 1e-14);
}

// What lies in the wall and leaves it is let go, and met again when it comes back: −1e-15 + 4t − 4t².
TEST(FirstContactSearch, letsGoWhatLeaves) {
  Curve hop{.gapAt = [](double t) { return -1e-15 + 4 * t - 4 * t * t; },
            .rateAt = [](double t) { return 4 - 8 * t; },
            .curvature = 8};
  const FirstContact contact = findFirstContact(hop, {.from = 0, .until = 10});
  EXPECT_EQ(contact.kind, ContactKind::kImpact);
  EXPECT_NEAR(contact.time, 1, 1e-14);
}

// A gap that stays within rounding without closing is lasting contact, from where it began.
TEST(FirstContactSearch, callsWhatHoversWithinRoundingTouching) {
  Curve hovering{.gapAt = [](double t) { return t < 2 ? 1e-15 : t - 2; },
                 .rateAt = [](double t) { return t < 2 ? 0.0 : 1.0; },
                 .curvature = 0.5};
  const FirstContact contact = findFirstContact(hovering, {.from = 1, .until = 1e6});
  EXPECT_EQ(contact.kind, ContactKind::kTouching);
  EXPECT_EQ(contact.time, 1);
}

// Sinking from rest, −½ M t²: 2 tolerances deep it closes at √(4 M tolerance), half of what an impact takes.
TEST(FirstContactSearch, callsWhatSinksWithoutSpeedTouching) {
  Curve sinking{.gapAt = [](double t) { return -0.5e-4 * t * t; },
                .rateAt = [](double t) { return -1e-4 * t; },
                .curvature = 1e-4};
  const FirstContact contact = findFirstContact(sinking, {.from = 0, .until = 1e6});
  EXPECT_EQ(contact.kind, ContactKind::kTouching);
  EXPECT_EQ(contact.time, 0);
}

// v² > 16 M tolerance; a Newton step is safe where v² > 4 M |gap|.
TEST(FirstContactSearch, itsThresholdsByHand) {
  EXPECT_TRUE(fasterThanSinking(4.1, 1, 1));
  EXPECT_FALSE(fasterThanSinking(3.9, 1, 1));
  EXPECT_FALSE(fasterThanSinking(-10, 1, 1));
  EXPECT_EQ(newtonStep(1, 4, 1), 0.25);
  EXPECT_EQ(newtonStep(-1, 4, 1), -0.25);
  EXPECT_EQ(newtonStep(1, 2, 1), 0);
  Attitude still;
  const auto rotation = [&still](double) { return still; };
  const MovingBox box{.halfExtents = Vec3::Ones(),
                      .position = Vec3::Zero(),
                      .velocity = Vec3::Zero(),
                      .acceleration = Vec3::Zero(),
                      .angularSpeedBound = 3,
                      .angularAccelerationBound = 2,
                      .attitude = AttitudeView(rotation)};
  EXPECT_EQ(turningBound(box), 11);
}

// Where edges that were parallel turn on each other, no direction proves more than the gap over their speed,
// though the gap opens: a thousand proofs of 1e-11 s each tell that this will not end.
TEST(FirstContactSearch, givesUpWhereHardlyAnyTimeIsProvedFree) {
  Curve opening{.gapAt = [](double t) { return 1e-12 + 1e-4 * t * t; },
                .rateAt = [](double) { return -0.1; }};
  const FirstContact contact = findFirstContact(opening, {.from = 0, .until = 1});
  EXPECT_EQ(contact.kind, ContactKind::kTouching);
  EXPECT_LT(contact.evaluations, 1000);
  EXPECT_LT(contact.time, 1e-7);
}

}  // namespace
}  // namespace careen
