#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "physics/contact/found_contacts.h"
#include "physics/contact/group_step.h"
#include "physics/contact/touching_group.h"
#include "physics/geometry/separation.h"

namespace careen {

/// The event functions of a time step: gaps that may close in it, contacts that may leave their face. Each is
/// positive until its event happens; one that is near zero at the start may fall a little further.
class GapEvents {
 public:
  /// `closed` [m]: gaps up to this count as none.
  GapEvents(const TouchingGroup& group, double closed) : group_(group), closed_(closed) {}

  /// Those of a step of `h` [s] from a state at which the contacts were followed, if no body is accelerated
  /// by more than `acceleration` [m/s²].
  void list(const FoundContacts& contacts, const GroupState& start, double h, double acceleration);
  std::size_t size() const { return events_.size(); }
  /// [s] When the first of those that are below zero at the end of a step fell to about zero; else its
  /// length.
  double firstRoot(const GroupPath& path);
  /// [s] A time within a step at which a gap is closed that is open at both ends: of the gap for which it is
  /// the first. 0 if there is none.
  double firstDip(const GroupPath& path);

 private:
  enum class Kind { kFeature, kPair, kBeyond };
  struct Moment {                   // of an event function
    double time = 0;                // [s] from the start of the step
    double value = 0;               // [m]
    std::array<double, 6> faces{};  // [m] of a pair: separation along the faces' normals
    bool onEdges = false;           // of a pair: its gap is along the normal of two edges
  };
  struct Event {  // a gap that may close, or a contact's way to the end of its face
    Kind kind = Kind::kFeature;
    ContactFeature feature;  // or a pair, as its a and b
    double margin = 0;       // [m]
    Moment start = {};

    std::size_t a() const { return static_cast<std::size_t>(feature.a); }
    std::size_t b() const { return static_cast<std::size_t>(feature.b); }
  };
  struct Bounds {          // on an event function in the step
    double curvature = 0;  // [m/s²] second derivative
    double rate = 0;       // [m/s] of the gap of a pair
    double fixed = 0;      // [m/s²] second derivative of its separation along a direction fixed in space
  };

  void listPairs(std::size_t a, std::size_t b, const GroupState& start);
  void listCorners(const FoundContacts& contacts, const GroupState& start, std::size_t body, double reach,
                   double h);
  void add(const Event& event, const GroupState& start);
  double least() const { return -0.5 * closed_; }  // [m] less is closed
  BoxAxes axesOf(const Event& pair, const GroupState& at) const;
  double value(const Event& event, const GroupState& at) const;
  Moment momentOf(const Event& event, double time, const GroupState& at) const;
  const GroupState& within(const GroupPath& path, const Event& event, double time);
  double rootOf(const Event& event, const GroupPath& path, double atEnd);
  Bounds boundsOn(const Event& event, const GroupPath& path) const;
  bool staysOpen(const Event& event, const GroupPath& path, const Bounds& bounds, const Moment& from,
                 const Moment& to) const;
  bool staysOpenOnEdges(const Event& event, const GroupPath& path, double below, const Moment& from,
                        const Moment& to) const;
  double dipWithin(const Event& event, const GroupPath& path, const Bounds& bounds, const Moment& from,
                   const Moment& to, int depth);

  const TouchingGroup& group_;
  double closed_;
  std::vector<Event> events_;
  GroupState within_;  // a state within the step, of the bodies of one event
};

}  // namespace careen
