#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <vector>

#include "physics/contact/contact_system.h"
#include "physics/exact/bodies.h"
#include "physics/exact/contact_group.h"
#include "physics/exact/event_queue.h"
#include "physics/exact/mover.h"
#include "physics/geometry/box_at.h"
#include "physics/impact/impact_law.h"
#include "physics/world/contact_residuals.h"

namespace careen {

class CrowdGroup;
class IslandGroup;

/// What a body does after an encounter.
enum class NextMotion { kGoesOn, kFlies, kRests, kSteps };

/// A body that takes part in an encounter.
struct EncounterBody {
  Mover* mover = nullptr;
  Quat attitude = Quat::Identity();  ///< that of its states, but may not reproduce their matrix to the bit
  BodyState before = {};
  BodyState after = {};
  NextMotion next = NextMotion::kGoesOn;
  Instant since{};  ///< when that begins

  const Body& body() const { return *mover->body; }
  int listed() const { return mover->listed.value; }
  BoxAt box() const { return boxAt(before.pose, body()); }
  BoxAt box(int index) const { return boxAt(before.pose, body(), index); }
  /// As it is after the encounter, at that time.
  TouchingBody touching(const Instant& time) const;
};

/// Bodies that touch at one moment: who, where, what impact they have, and what becomes of them.
struct Encounter {
  Instant time;
  EventKind cause{};
  std::vector<EncounterBody> bodies;    ///< by rank; all walls are among them, at the end, and nowhere()
  std::vector<ImpactContact> contacts;  ///< their bodies are indices into `bodies`
  std::vector<ContactFeature> joints;   ///< the conditions of all joints, likewise
  std::vector<ImpactShare> shares;
  std::vector<char> persists;                         ///< of each contact: it stays closed
  std::vector<std::shared_ptr<IslandGroup>> islands;  ///< that bodies are in from now on
  std::vector<std::shared_ptr<CrowdGroup>> crowds;    ///< that bodies meet
  ContactResiduals residuals;                         ///< of the islands' first forces
  int timeSteps = 0;                                  ///< its islands go on by so many
  double pull = 0;                                    ///< [m/s²] see pulls()
  double passing = 0;  ///< [1] contacts without an impulse persist that part with so many roundings

  std::size_t indexOf(int rank) const;
  std::vector<int> ranks() const;
  /// Those that are no walls.
  std::span<const EncounterBody> boxes() const;
  const EncounterBody& a(std::size_t contact) const { return bodies[indexA(contact)]; }
  std::size_t indexA(std::size_t contact) const { return static_cast<std::size_t>(contacts[contact].a); }
  const EncounterBody& b(std::size_t contact) const { return bodies[indexB(contact)]; }
  std::size_t indexB(std::size_t contact) const { return static_cast<std::size_t>(contacts[contact].b); }
  /// [m] Scale of the lengths whose difference is the gap at that contact.
  double lengthsAt(std::size_t contact) const;
  /// The contact, at which both bodies' impulses act at one point: at two, a gap apart, friction would change
  /// angular momentum.
  ImpactContact joined(std::size_t contact) const;
};

/// [1] roundings: contacts that meet again and again, and part no faster, pass each other.
inline constexpr double kHardlyParts = 0x1p20;

/// Who touches whom at an event: an impact propagates to every body that touches one it reaches, except
/// through immovable bodies. Ends the steps of their groups at that moment.
Encounter gather(Bodies& bodies, const Event& event);
/// Whether two of its bodies do, up to a gap of `apart` [m].
bool areTouching(const EncounterBody& a, const EncounterBody& b, double apart = 0);
/// Adds a box, once, with the members of its group and those that springs join to it.
void join(Bodies& bodies, Encounter& encounter, int rank);

/// [m] Bodies that go on by time steps take those with them that they would meet at once: an arrival costs
/// more.
double nearness(const Bodies& bodies, const Encounter& encounter);
/// Of all bodies of the world: those of the encounter as in that member, the others as at the start.
std::vector<BodyState> statesIn(const World& world, const Encounter& encounter,
                                BodyState EncounterBody::*state);
/// [m/s] gained by falling, or being pulled, through the tolerance; where nothing pulls that takes for ever.
inline double fallSpeed(const Bodies& bodies, const Encounter& encounter) {
  return encounter.pull > 0 ? encounter.pull * bodies.timeScale() : 0;
}
bool isAnyForced(const Bodies& bodies, const Encounter& encounter);

}  // namespace careen
