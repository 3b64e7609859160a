#include "exchange/animation_keys.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <string>
#include <utility>

#include "core/brief.h"
#include "core/error.h"
#include "core/math/elementary.h"

namespace careen {
namespace {

double single(double value) {
  constexpr double kLargest = std::numeric_limits<float>::max();
  return static_cast<double>(static_cast<float>(std::clamp(value, -kLargest, kLargest)));
}
Vec3 single(const Vec3& value) { return {single(value.x()), single(value.y()), single(value.z())}; }
Quat single(const Quat& value) {
  return {single(value.w()), single(value.x()), single(value.y()), single(value.z())};
}
LinePlacement single(const LinePlacement& line) {
  return {
      .from = single(line.from), .worldFromLine = single(line.worldFromLine), .length = single(line.length)};
}

bool isSame(const Vec3& a, const Vec3& b) { return a == b; }
bool isSame(const Quat& a, const Quat& b) { return a.coeffs() == b.coeffs(); }
bool isSame(const LinePlacement& a, const LinePlacement& b) { return a == b; }

Quat alignedWith(const Quat& reference, const Quat& q) {
  return reference.dot(q) < 0 ? Quat(-q.w(), -q.x(), -q.y(), -q.z()) : q;
}
void align(const Vec3& /*before*/, Vec3& /*value*/) {}
void align(const Quat& before, Quat& value) { value = alignedWith(before, value); }
void align(const LinePlacement& before, LinePlacement& value) {
  align(before.worldFromLine, value.worldFromLine);
}

Quat weighted(const Quat& a, const Quat& b, double ofA, double ofB) {
  Quat sum;
  sum.coeffs() = ofA * a.coeffs() + ofB * b.coeffs();
  return sum.normalized();
}

Quat spherical(const Quat& a, const Quat& b, double part) {
  const double cosine = a.dot(b);
  const double squaredSine = 1 - cosine * cosine;
  constexpr double kNearlyOne = 1e-12;  // linear there, to rounding
  if (!(squaredSine > kNearlyOne)) {
    return weighted(a, b, 1 - part, part);
  }
  const double angle = elementary::atan2(std::sqrt(squaredSine), cosine);
  return weighted(a, b, elementary::sinCos((1 - part) * angle).sin, elementary::sinCos(part * angle).sin);
}

double angleBetween(const Quat& a, const Quat& b) {
  const Quat turned = a.conjugate() * b;
  return 2 * elementary::atan2(turned.vec().norm(), std::abs(turned.w()));
}

// Error of what players make of keys a and b at this part of the way.
double errorAt(const Vec3& a, const Vec3& b, double part, const Vec3& exact) {
  return ((1 - part) * a + part * b - exact).norm();
}
double errorAt(const Quat& a, const Quat& b, double part, const Quat& exact) {
  const Quat near = alignedWith(a, b);
  if (a.dot(near) < 0.1) {
    return std::numeric_limits<double>::infinity();  // nearly half a turn: the shorter way is in doubt
  }
  return std::max(angleBetween(weighted(a, near, 1 - part, part), exact),
                  angleBetween(spherical(a, near, part), exact));
}
double errorAt(const LinePlacement& a, const LinePlacement& b, double part, const LinePlacement& exact) {
  const Quat near = alignedWith(a.worldFromLine, b.worldFromLine);
  LinePlacement line{.from = (1 - part) * a.from + part * b.from,
                     .worldFromLine = {},
                     .length = (1 - part) * a.length + part * b.length};
  double error = (line.from - exact.from).norm();
  for (const Quat& turn :
       {weighted(a.worldFromLine, near, 1 - part, part), spherical(a.worldFromLine, near, part)}) {
    line.worldFromLine = turn;
    error = std::max(error, (line.to() - exact.to()).norm());
  }
  return error;
}

float below(double time) {
  const auto nearest = static_cast<float>(time);
  return nearest > time ? std::nextafter(nearest, 0.0F) : nearest;
}
float after(float time) { return std::nextafter(time, std::numeric_limits<float>::infinity()); }

template <class Value>
class Chooser {
 public:
  Chooser(const AnimatedSpan& span, double within, const std::function<Value(double)>& at)
      : span_(span), within_(kPart * within), at_(at) {}

  AnimationKeys<Value> keys() {
    add(0);
    const float end = below(span_.duration);
    for (const double kink : span_.kinks) {
      const float before = below(kink);
      if (kink > 0 && after(before) < end) {
        reach(before);
        add(after(before));
      }
    }
    reach(end);
    return std::move(keys_);
  }

 private:
  static constexpr std::size_t kMostKeys = 10'000'000;
  static constexpr double kPart = 0.97;  // of the bound: errors are found at single moments

  void add(float time) {
    if (!keys_.times.empty() && time <= keys_.times.back()) {
      return;
    }
    const Value there = exact(time);
    Value value = single(there);
    if (const double rounding = errorAt(value, value, 0, there); !(rounding <= within_)) {
      throw InputError("found a motion that single precision, which is all that glTF has, holds only to " +
                       brief(rounding, 2) + " at " + brief(time) + " s, expected a larger --within than " +
                       brief(within_ / kPart));
    }
    if (keys_.times.size() >= kMostKeys) {
      throw InputError("found a motion that needs more than " + std::to_string(kMostKeys) +
                       " keys, expected a shorter or slower one, or a larger --within than " +
                       brief(within_ / kPart));
    }
    if (!keys_.times.empty()) {
      align(keys_.values.back(), value);
    }
    keys_.times.push_back(time);
    keys_.values.push_back(value);
  }

  Value exact(double time) const { return at_(std::min(time, span_.duration)); }

  // The largest error between the last key and one at `to`; what is beyond the bound is not looked at
  // further.
  double errorUntil(float to) const {
    const double from = keys_.times.back();
    const Value& start = keys_.values.back();
    const Value end = single(exact(to));
    double worst = errorAt(start, end, 0, exact(from));
    worst = std::max(worst, errorAt(start, end, 1, exact(to)));
    const auto look = [&](double time) {
      const double part = (time - from) / (to - from);
      worst = std::max(worst, errorAt(start, end, part, exact(time)));
      return worst <= within_;
    };
    constexpr int kParts = 8;
    for (const int eighth : {4, 2, 6, 1, 3, 5, 7}) {
      if (!look(from + eighth * (to - from) / kParts)) {
        return worst;
      }
    }
    constexpr std::ptrdiff_t kMostSeams = 32;
    const auto first = std::upper_bound(span_.seams.begin(), span_.seams.end(), from);
    const auto last = std::lower_bound(first, span_.seams.end(), to);
    const std::ptrdiff_t stride = 1 + std::distance(first, last) / kMostSeams;
    for (auto seam = first; std::distance(seam, last) > 0;
         seam += std::min(stride, std::distance(seam, last))) {
      if (!look(*seam)) {
        return worst;
      }
    }
    return worst;
  }

  // Adds keys up to `end`, with no kink before it.
  void reach(float end) {
    while (keys_.times.back() < end) {
      const float from = keys_.times.back();
      const auto [to, error] = farthest(from, end);
      add(to);
      keys_.error = std::max(keys_.error, error);
    }
  }

  struct Step {
    float to = 0;
    double error = 0;
  };

  // The error grows as the square of the step: a secant search for the step where it is the bound.
  Step farthest(float from, float end) {
    if (const double error = errorUntil(end); error <= within_) {
      return {.to = end, .error = error};
    }
    constexpr double kCloseEnough = 0.85;  // of the bound: 8 % more keys than the fewest
    constexpr int kMostTrials = 40;
    Step good{.to = from};
    double tooFar = static_cast<double>(end) - from;
    double step = std::min(step_, 0.5 * tooFar);
    for (int trial = 0; trial < kMostTrials; ++trial) {
      const auto to = static_cast<float>(from + step);
      if (to <= from) {
        break;
      }
      const double error = errorUntil(to);
      if (error <= within_) {
        good = {.to = to, .error = error};
        if (error >= kCloseEnough * within_) {
          break;
        }
      } else {
        tooFar = step;
      }
      const double reached = static_cast<double>(good.to) - from;
      if (tooFar - reached < 0.02 * tooFar) {
        break;
      }
      const double wanted = step * std::sqrt(0.93 * within_ / std::max(error, 1e-3 * within_));
      const double least = good.to > from ? reached + 0.02 * (tooFar - reached) : 0.05 * tooFar;
      step = std::clamp(wanted, least, tooFar - 0.02 * (tooFar - reached));
    }
    if (good.to <= from) {                // no key between can help
      constexpr double kShortest = 1e-8;  // of the whole: numbers near 0 are much closer together
      const float next =
          std::min(end, std::max(after(from), static_cast<float>(from + kShortest * span_.duration)));
      return {.to = next, .error = errorUntil(next)};
    }
    step_ = static_cast<double>(good.to) - from;
    return good;
  }

  const AnimatedSpan& span_;
  double within_;
  const std::function<Value(double)>& at_;
  AnimationKeys<Value> keys_;
  double step_ = 0.01;  // [s] the last
};

}  // namespace

template <class Value>
bool AnimationKeys<Value>::isConstant() const {
  return std::all_of(values.begin(), values.end(),
                     [this](const Value& value) { return isSame(value, values.front()); });
}
template struct AnimationKeys<Vec3>;
template struct AnimationKeys<Quat>;
template struct AnimationKeys<LinePlacement>;

LinePlacement linePlacement(const Vec3& from, const Vec3& to) {
  LinePlacement line{.from = from, .worldFromLine = Quat::Identity(), .length = (to - from).norm()};
  if (line.length > 0) {
    const Vec3 towards = (to - from) / line.length;
    // Half the sum of z and the direction, as a quaternion: the shortest turn between them.
    const Quat turn(1 + towards.z(), -towards.y(), towards.x(), 0);
    line.worldFromLine = 1 + towards.z() > 1e-12 ? turn.normalized() : Quat(0, 1, 0, 0);
  }
  return line;
}

AnimationKeys<Vec3> positionKeys(const AnimatedSpan& span, double within,
                                 const std::function<Vec3(double)>& at) {
  return Chooser<Vec3>(span, within, at).keys();
}
AnimationKeys<Quat> rotationKeys(const AnimatedSpan& span, double within,
                                 const std::function<Quat(double)>& at) {
  return Chooser<Quat>(span, within, at).keys();
}
AnimationKeys<LinePlacement> lineKeys(const AnimatedSpan& span, double within,
                                      const std::function<LinePlacement(double)>& at) {
  return Chooser<LinePlacement>(span, within, at).keys();
}

}  // namespace careen
