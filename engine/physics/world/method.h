#pragma once

#include <array>
#include <optional>
#include <string_view>

namespace careen {

/// Simulation methods. To add one: one line here, one in kMethods, one in simulate or in freeMethods().
enum class Method : int { kExact, kListing1, kStrang, kRungeKutta4, kTaylor8, kMoserVeselov10 };

/// Name and capabilities of a method.
struct MethodTraits {
  Method method;
  std::string_view name;  ///< as scene files and commands spell it
  int order = 0;          ///< order of convergence in dt; 0: it takes no steps of RunSettings::dt
  bool forces = false;    ///< springs and drag
  bool boxBox = false;    ///< box–box contact
  bool friction = false;
  bool rests = false;  ///< bounces may come to rest
  bool joints = false;
  bool gravityChanges = false;
  bool belts = false;  ///< surfaces that move along themselves, and fixed boxes and walls that move

  constexpr bool steps() const { return order > 0; }
};

/// A method that steps free bodies, see FreeMethod: impacts with walls, with friction, at the roots of the
/// gap.
constexpr MethodTraits steppedFlight(Method method, std::string_view name, int order) {
  return {.method = method, .name = name, .order = order, .friction = true};
}

inline constexpr std::array kMethods = {
    MethodTraits{.method = Method::kExact,
                 .name = "exact",
                 .forces = true,
                 .boxBox = true,
                 .friction = true,
                 .rests = true,
                 .joints = true,
                 .gravityChanges = true,
                 .belts = true},
    MethodTraits{.method = Method::kListing1, .name = "listing1", .order = 1, .forces = true},
    steppedFlight(Method::kStrang, "strang", 2),
    steppedFlight(Method::kRungeKutta4, "runge-kutta-4", 4),
    steppedFlight(Method::kTaylor8, "taylor-8", 8),
    steppedFlight(Method::kMoserVeselov10, "moser-veselov-10", 10)};

/// What RunSettings says unless told otherwise.
static_assert(Method{} == Method::kExact);

inline constexpr auto kMethodNames = [] {
  std::array<std::string_view, kMethods.size()> names;
  for (std::size_t i = 0; i < names.size(); ++i) {
    names[i] = kMethods[i].name;
  }
  return names;
}();

constexpr const MethodTraits& traitsOf(Method method) {
  const MethodTraits* known = kMethods.data();
  while (known->method != method) {
    ++known;
  }
  return *known;
}

constexpr std::optional<Method> methodNamed(std::string_view name) {
  for (const MethodTraits& known : kMethods) {
    if (known.name == name) {
      return known.method;
    }
  }
  return std::nullopt;
}

}  // namespace careen
