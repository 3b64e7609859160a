#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "physics/contact/contact_system.h"
#include "physics/world/world.h"

namespace careen {

/// A function of the state of a smooth motion: positive until its event happens.
struct EventFunction {
  enum class Kind {
    kPush,     ///< a contact force reaches zero
    kStick,    ///< slip begins
    kGap,      ///< a contact without force closes
    kWithin,   ///< a contact leaves its face
    kOverlap,  ///< the gap of two boxes closes
    kCorner,   ///< a corner that is no contact meets a half-space
    kOpenEnd,  ///< an open end of a joint closes
    kHalt,     ///< a grip that slips comes to the rate that it keeps
  };
  Kind kind{};
  std::size_t contact = 0;     ///< or the body of a corner, or an open end
  int halfSpace = 0;           ///< index in the group
  Vec3 corner = Vec3::Zero();  ///< [m] body frame
  double margin = 0;           ///< [m]
  double start = 0;            ///< its value at the start of the step
  double rate = 0;             ///< its rate then, if it has one

  bool isOfPlaces() const { return kind == Kind::kOverlap || isOfOne(); }
  bool isOfOne() const { return kind == Kind::kCorner || kind == Kind::kOpenEnd; }
  bool hasRate() const { return kind == Kind::kCorner || kind == Kind::kHalt; }
  bool isOfForces() const { return kind == Kind::kPush || kind == Kind::kStick; }
};

/// The event functions of a contact system, which must outlive it, as of the state at which that was last
/// looked at.
class EventFunctions {
 public:
  /// Gaps within this many touching tolerances are checked for penetration, the others for closing.
  static constexpr double kTouching = 8;

  explicit EventFunctions(const ContactSystem& system) : system_(system) {}

  /// Those of the system's contacts, in their modes.
  void list();
  /// A step starts.
  void noteStart();
  const std::vector<EventFunction>& all() const { return functions_; }
  const EventFunction& operator[](std::size_t event) const { return functions_[event]; }

  double value(std::size_t event) const { return valueOf(functions_[event]); }
  /// The lowest of several.
  double lowest(std::span<const std::size_t> events) const;
  /// How far below zero events of one kind are located, at most four times that: a part of what the contacts
  /// count as zero anyway, above rounding errors.
  double depth(std::span<const std::size_t> events) const;
  /// [m/s] Of the gap of a corner; [m/s²] of a grip's slip.
  double rateOf(const EventFunction& event) const;
  /// The end of a joint that closes in it; null: it is another event.
  const ContactFeature* endOf(const EventFunction& event) const;
  /// At the start of the step some contact force is tensile, and its friction would drive the slip: the modes
  /// found are inconsistent.
  bool hasTension() const;
  /// Whether they cover two boxes, because those were in contact at the start of the step.
  bool coverBoxes(const BoxOf& a, const BoxOf& b) const;
  /// Whether all contacts are open for good: the bodies are in free flight.
  bool areClear() const;

 private:
  void listContacts();
  void listCorners();
  double valueOf(const EventFunction& event) const;
  double marginOf(const EventFunction& event, double gap) const;
  std::size_t bodyOf(const EventFunction& event) const;
  std::size_t firstBody(std::size_t contact) const {
    return static_cast<std::size_t>(system_.features()[contact].a);
  }
  std::size_t secondBody(std::size_t contact) const {
    return static_cast<std::size_t>(system_.features()[contact].b);
  }

  /// Of the half-space of a corner.
  WallPlane planeFor(const EventFunction& corner) const;

  const ContactSystem& system_;
  std::vector<EventFunction> functions_;
};

}  // namespace careen
