#pragma once

#include <cstddef>
#include <functional>
#include <limits>
#include <optional>
#include <vector>

#include "question/motion_bounds.h"

namespace careen {

/// [s] While something is true.
struct TrueSpan {
  double from = 0;
  double to = 0;
  bool lasts = false;  ///< and at the end of the run
};

/// A part of a run in which a value is smooth.
struct SmoothPart {
  double from = 0;         ///< [s]
  double to = 0;           ///< [s]
  RateBounds bounds = {};  ///< of the value
  double rounding = 0;     ///< of the value: it says nothing up to this
  double size = 0;         ///< of the value, its order of magnitude, if it may change by much more than that
  /// Of the value: how far it may go beyond 0 and come back, unseen. Only where `bounds.bend` is infinite may
  /// that be more than rounding.
  double unseen = 0;
  /// [s] In parts as short a value that is positive at both ends and thrice between stays so.
  double settled = 0;
  /// By how much a chord may be below the value, times 8 and per square of its length: of the largest of
  /// several smooth values, where `bounds.bend` is infinite.
  double lift = std::numeric_limits<double>::infinity();
};

/// Finds while a value is positive, from part to part of a run. Signs change at roots, which are bracketed
/// and closed in on to neighbouring doubles, or at the beginning of a part, where the value may jump. A part
/// is halved until bounds of the first or second derivative exclude that the value changes its sign between
/// two looks, so that no pair of roots is missed but one that encloses less than `unseen`, or comes after
/// kMostLooks while it changes by its size, which only a value that stays very near to 0 takes.
class TrueSpans {
 public:
  using Value = std::function<double(double time)>;

  /// Parts come in order of time; `value` is called with times in it.
  void look(const SmoothPart& part, const Value& value);
  /// All, the last of which may last to the end, or be the end alone. What is between two that are nearer
  /// than `same` [s] is rounding.
  std::vector<TrueSpan> finish(double end, double same);

  static constexpr std::size_t kMostLooks = 1 << 16;

 private:
  struct Look {
    double time = 0;
    double value = 0;
  };
  void divide(const Look& left, const Look& right);
  bool isSettled(const Look& left, const Look& right);
  void note(const Look& look);
  double rootBetween(double before, double after, bool rises);
  double at(double time);

  const SmoothPart* part_ = nullptr;
  const Value* value_ = nullptr;
  std::size_t looks_ = 0;
  double lastTime_ = 0;  // [s] at which it was as true as it is
  bool isTrue_ = false;
  bool wasFalse_ = false;               // beyond rounding, since it was true
  std::optional<double> changesAtEnd_;  // [s] of the last part: to what differs by less than rounding
  std::vector<TrueSpan> spans_;
};

}  // namespace careen
