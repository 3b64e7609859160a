#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "core/math/falling_bracket.h"
#include "physics/contact/contact_system.h"
#include "physics/contact/event_functions.h"
#include "physics/contact/smooth_step.h"

namespace careen {

/// Finds when the first event of a smooth step happens. Each look at it costs a whole step from the start, a
/// look at the step's polynomials hardly anything.
class EventLocator {
 public:
  /// `tolerance` [m]: of positions. All others must outlive it.
  EventLocator(ContactSystem& system, SmoothStep& step, const EventFunctions& events, double tolerance)
      : system_(system), step_(step), events_(events), tolerance_(tolerance) {}

  /// Ends the step where the first event function falls below zero. Returns false if none does.
  bool locate();
  /// Whether two bodies are in each other within the step.
  bool dips();

 private:
  struct Fall {                       // of event functions of one kind below zero, of the lowest of them
    std::vector<std::size_t> events;  // located together
    EventFunction::Kind kind{};
    double until = 0;  // [s] from the start of the step: where it is below
    double start = 0;
    double value = 0;     // then
    double estimate = 0;  // [s] when, by linear interpolation
  };

  struct Estimate {    // of the root of an event function
    double time = 0;   // [s] from the start of the step
    double value = 0;  // there
    double slope = 0;  // [1/s] of it
  };

  std::optional<Fall> fallOf(std::size_t event);
  static Fall firstOf(std::span<const Fall> falls);
  double lowestWithin(std::size_t event, double atEnd);
  double dipOf(std::size_t event);
  double lowestOfEnd(const ContactFeature& end, double margin) const;
  double deepMomentOf(std::size_t contact) const;
  FallingBracket bracketOf(const Fall& fall);
  Estimate estimateOf(const Fall& fall, FallingBracket bracket, std::span<const ContactStep> path);
  double rootOf(const Fall& fall);

  ContactSystem& system_;
  SmoothStep& step_;
  const EventFunctions& events_;
  double tolerance_;
  std::vector<std::optional<double>> dips_;  // by event: deepMomentOf(), if it was asked for
  double dipsOf_ = 0;                        // [s] the length of the step that they are of
};

}  // namespace careen
