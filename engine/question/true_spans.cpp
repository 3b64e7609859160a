#include "question/true_spans.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace careen {

double TrueSpans::at(double time) {
  ++looks_;
  return (*value_)(time);
}

// In as many equal pieces as it may change by its size, each of which has its looks.
void TrueSpans::look(const SmoothPart& part, const Value& value) {
  constexpr double kMostPieces = 1e7;
  part_ = &part;
  value_ = &value;
  const double change = part.size > 0 ? part.bounds.rate * (part.to - part.from) / part.size : 0;
  const int pieces = change > 1 ? static_cast<int>(std::ceil(std::min(change, kMostPieces))) : 1;
  Look last{.time = part.from, .value = at(part.from)};
  lastTime_ = part.from;  // so that a jump is there
  note(last);
  for (int piece = 1; piece <= pieces; ++piece) {
    looks_ = 0;
    const double time =
        piece < pieces ? part.from + (static_cast<double>(piece) / pieces) * (part.to - part.from) : part.to;
    const Look next{.time = time, .value = at(time)};
    divide(last, next);
    note(next);
    last = next;
  }
  const bool changes = isTrue_ ? last.value <= 0 : wasFalse_ && last.value > 0;
  changesAtEnd_ = changes ? std::optional(rootBetween(lastTime_, part.to, !isTrue_)) : std::nullopt;
}

// Notes what is between the two.
void TrueSpans::divide(const Look& left, const Look& right) {
  const double width = right.time - left.time;
  const double l = left.value;
  const double r = right.value;
  const auto& [rate, bend] = part_->bounds;
  if (!(std::isfinite(l) && std::isfinite(r)) || looks_ >= kMostLooks || width <= 0) {
    return;
  }
  // |f − chord| ≤ bend · width²/8, and |f' − slope of the chord| ≤ bend · width/2.
  const double bent = bend * width * width;
  const double lifted = std::min(bent, part_->lift * width * width);
  const double nearest = 0.5 * (std::fabs(l) + std::fabs(r) - rate * width);
  if ((l > 0 && r > 0) || (l < 0 && r < 0)) {
    if (nearest > -part_->unseen || 8 * std::min(std::fabs(l), std::fabs(r)) > (l > 0 ? bent : lifted) ||
        isSettled(left, right)) {
      return;
    }
  } else if (2 * std::fabs(r - l) > bent || rate * width <= std::max(part_->rounding, part_->unseen)) {
    return;
  }
  const double time = left.time + 0.5 * width;
  if (time <= left.time || time >= right.time) {
    return;
  }
  const Look middle{.time = time, .value = at(time)};
  divide(left, middle);
  note(middle);
  divide(middle, right);
}

bool TrueSpans::isSettled(const Look& left, const Look& right) {
  const double width = right.time - left.time;
  if (!(left.value > 0) || width > part_->settled) {
    return false;
  }
  const auto isPositive = [&](double part) { return at(left.time + part * width) > 0; };
  return isPositive(0.25) && isPositive(0.5) && isPositive(0.75);
}

// In order of time. What is within rounding of 0 is as true as before.
void TrueSpans::note(const Look& look) {
  const bool changes = isTrue_ ? look.value < -part_->rounding : look.value > part_->rounding;
  if (changes) {
    const double time = rootBetween(lastTime_, look.time, !isTrue_);
    isTrue_ = !isTrue_;
    if (isTrue_) {
      spans_.push_back({.from = time, .to = std::numeric_limits<double>::infinity(), .lasts = true});
    } else {
      spans_.back() = {.from = spans_.back().from, .to = time};
    }
  }
  wasFalse_ = !isTrue_ && (wasFalse_ || look.value < -part_->rounding);
  const bool agrees = isTrue_ ? look.value > 0 : look.value <= 0;
  if (agrees) {
    lastTime_ = look.time;
  }
}

// By turns where the chord is 0, a little beyond, and halfway.
double TrueSpans::rootBetween(double before, double after, bool rises) {
  double left = (*value_)(before);
  double right = (*value_)(after);
  for (bool halves = false;; halves = !halves) {
    const double middle = before + 0.5 * (after - before);
    if (middle <= before || middle >= after) {
      return after;
    }
    const double chord = before + left / (left - right) * (after - before);
    const double beyond = (middle - chord) * 0x1p-10;  // so that both sides come nearer
    const double aimed = chord + beyond;
    const double time = !halves && aimed > before && aimed < after ? aimed : middle;
    const double value = (*value_)(time);
    if ((value > 0) == rises) {
      after = time;
      right = value;
    } else {
      before = time;
      left = value;
    }
  }
}

std::vector<TrueSpan> TrueSpans::finish(double end, double same) {
  if (changesAtEnd_ && isTrue_) {
    spans_.back() = {.from = spans_.back().from, .to = *changesAtEnd_};
  } else if (changesAtEnd_) {
    spans_.push_back({.from = *changesAtEnd_, .to = end, .lasts = true});
  }
  std::vector<TrueSpan> spans;
  for (const TrueSpan& span : spans_) {
    const double to = std::min(span.to, end);
    if (!spans.empty() && span.from - spans.back().to <= same) {
      spans.back() = {.from = spans.back().from, .to = to, .lasts = span.lasts};
    } else {
      spans.push_back({.from = span.from, .to = to, .lasts = span.lasts});
    }
  }
  return spans;
}

}  // namespace careen
