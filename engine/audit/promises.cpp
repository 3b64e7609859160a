#include "audit/promises.h"

#include "physics/world/method.h"

namespace careen {
namespace {

// In the order of AuditKind; {} is no promise.
constexpr Promise kNever{};
constexpr Promise kRotation{.absolute = 1e-12};
// Hops too short to follow end in rest, up to 1e-9 m aside.
constexpr Promise kApart{.absolute = 1e-9, .tolerances = 4};
constexpr Promise kSamePlace{.absolute = 1e-9, .tolerances = 8};  // both sides of a contact are corrected
constexpr Promise kRounding{.absolute = 1e-9};
// Impulses of several bodies at once are found by iteration.
constexpr Promise kImpulse{.absolute = 1e-7};
// Contact steps hold the tolerance in positions, and momentum and energy only as well: measured over 400
// random scenes, at most 40 (a box that slides in thick air).
constexpr Promise kByTolerance{.absolute = 1e-7, .tolerances = 100};

constexpr Promises kOfExact = {kNever,   kApart,       kApart,       kRotation,    kSamePlace,
                               kImpulse, kByTolerance, kByTolerance, kByTolerance, kByTolerance,
                               {},       {},           kApart,       kApart};
// A crowd's members move continuously, so that nothing jumps.
// Within a step its recorded speeds are means: of momentum and energy it promises what lasts.
constexpr Promise kApartInCrowd{.absolute = 1e-9, .crowdTolerances = 3};
// Measured over 399 random scenes of 2 to 20 boxes: at most 0.018 and 1.9e-3.
constexpr Promise kMomentumInCrowd{.absolute = 0.02};
constexpr Promise kRiseInCrowd{.absolute = 0.01};
constexpr Promises kOfCrowd = {kNever,           kApartInCrowd,    kApartInCrowd, kRotation, kSamePlace, {},
                               kMomentumInCrowd, kMomentumInCrowd, kRiseInCrowd,  {},        {},         {},
                               kApartInCrowd,    kApartInCrowd};
// Explicit Euler: nothing about energy; corners may be 1 mm behind a wall at the ends of steps, and more
// between them.
constexpr Promises kOfListing1 = {kNever, {}, {}, kRotation, kRounding, kRounding, {}, {}, {}, {}};
// The centre of mass moves in closed form, only the attitude is integrated: two ways to the same moment, in
// whole steps and in a last shorter one, differ by the method's error, which depends on dt.
constexpr Promises kOfSteppers = {kNever, {}, {}, kRotation, {}, {}, kRounding, {}, {}, {}};

}  // namespace

Promises promisesOf(Method method, bool crowd) {
  switch (method) {
    case Method::kExact:
      return crowd ? kOfCrowd : kOfExact;
    case Method::kListing1:
      return kOfListing1;
    default:
      return kOfSteppers;
  }
}

Promises promisesOfTable(double tolerance) {
  const Promise part{.absolute = tolerance};
  const Promise places{.tolerances = 1};
  // Impulses are unknown: tables have no impacts.
  return {kNever, places, places, kRotation, places, {}, part, part, part, part, part, part, places, places};
}

double allowed(const Promise& promise, const RunSettings& settings, double length) {
  return promise.absolute + promise.tolerances * settings.tolerance / length +
         promise.crowdTolerances * settings.crowds.tolerance;
}

std::optional<double> promisedDepth(const RunSettings& settings, bool crowd) {
  const std::optional<Promise> promise =
      promisesOf(settings.method, crowd)[static_cast<std::size_t>(AuditKind::kBoxOverlap)];
  return promise ? std::optional(allowed(*promise, settings, 1)) : std::nullopt;
}

}  // namespace careen
