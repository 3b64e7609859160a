#pragma once

#include <algorithm>
#include <cstddef>
#include <span>
#include <vector>

#include "physics/contact/contact_feature.h"
#include "physics/contact/contact_forces.h"
#include "physics/contact/group_momentum.h"
#include "physics/contact/manifold_normals.h"
#include "physics/contact/touching_body.h"
#include "physics/world/world.h"

namespace careen {

/// Calls visit(feature) for the corners of a box, if it is not held, at those half-spaces of its group for
/// which isNear(index).
template <class IsNear, class Visit>
void forCorners(std::span<const TouchingBody> bodies, std::size_t box, const IsNear& isNear,
                const Visit& visit) {
  for (std::size_t b = bodies[box].isHeld() ? bodies.size() : boxesOf(bodies); b < bodies.size(); ++b) {
    if (!bodies[b].isNowhere() && isNear(b)) {
      ContactFeature feature{.a = static_cast<int>(box),
                             .b = static_cast<int>(b),
                             .material = touching(bodies[box].material(), bodies[b].material())};
      for (int k = 0; k < bodies[box].body->cornerCount(); ++k) {
        feature.onA = corner(*bodies[box].body, k);
        visit(feature);
      }
    }
  }
}

/// The equations of motion of bodies in persistent contact: Eqs. 10, 13, 14 and Euler's equations, with the
/// contact forces that ContactForces finds.
///
/// A state y has 13 numbers per movable body: position, quaternion w x y z, velocity, ω in the body's frame.
/// Where some are driven, or gravity slopes, it has one more, at its end: the time [s], on which that
/// depends.
class ContactSystem {
 public:
  using Mode = ContactForces::Mode;
  static constexpr std::size_t kNumbers = 13;
  /// [1] of the tolerance: how far positions are projected at an event. Bodies whose contacts are nearly
  /// redundant would jump.
  static constexpr double kMostMoved = 3;
  /// [1] of the largest gap, or rate: no projection moves a body further. Where contacts are nearly redundant
  /// but not quite, better some gap than a jump.
  static constexpr double kMostShift = 64;

  /// `joints`: all conditions of the bodies' joints; those that end on one side and are no features are open.
  ContactSystem(const World& world, std::vector<TouchingBody> bodies, std::vector<ContactFeature> features,
                std::span<const ContactFeature> joints = {});

  const std::vector<TouchingBody>& bodies() const { return bodies_; }
  /// Whether any of them is driven, or gravity slopes: time is part of the state. And whether they never
  /// rest: any box is driven, or a wall that a feature is at, or gravity slopes.
  bool hasTime() const { return hasTime_; }
  bool isCarried() const { return isCarried_; }
  const std::vector<ContactFeature>& features() const { return features_; }
  /// Ends of joints that are open, as slack ropes.
  const std::vector<ContactFeature>& openEnds() const { return openEnds_; }
  /// One of them, or of the features, where its bodies were last looked at.
  ContactState stateOf(const ContactFeature& feature) const;
  std::vector<Mode>& modes() { return modes_; }
  const std::vector<Mode>& modes() const { return modes_; }
  bool pushes(std::size_t contact) const { return modes_[contact] != Mode::kOff; }
  /// Whether any contact does.
  bool pushes() const;
  /// All of them, without friction.
  void closeAll();

  std::vector<double> pack() const;
  void unpack(std::span<const double> y);

  /// Finds the mode of each contact. Returns false if no forces were found.
  bool findModes(std::span<const double> y);
  /// Computes dy with the current modes. Returns false if no forces were found.
  bool rate(std::span<const double> y, std::vector<double>& dy);

  /// Projects the gaps of active contacts to zero by the least displacement (in the mass metric), and the
  /// sideways offsets of those in a cone that stick; their rates by the least impulse; removes the slip of
  /// sticking contacts. Returns false if there was only rounding error. No body moves by more than `most`
  /// [m]: rather some gap.
  bool project(std::vector<double>& y, double most);
  enum class Turns {
    kAll,       ///< angular momenta turn with the bodies: what is in contact keeps its rates
    kAttitude,  ///< they stay where they point
  };
  /// Returns how far the bodies were moved [m].
  double projectPositions(std::vector<double>& y, double most, Turns turns = Turns::kAll);
  bool projectVelocities(std::vector<double>& y);
  /// Gives groups of bodies that only push each other the momenta that they had `h` [s] before, by rigid
  /// motions (GroupMomentum). Returns false if there was only rounding error.
  bool keepMomenta(std::span<const double> before, double h, std::vector<double>& y) const;

  /// Contact states as of the last rate(), findModes() or look().
  const std::vector<ContactState>& states() const { return states_; }
  const ContactForces& forces() const { return forces_; }
  ContactResiduals takeResiduals() { return forces_.takeResiduals(); }
  void look(std::span<const double> y);
  /// [m/s] A grip that slips no faster keeps its rate: rounding error.
  double stillRate(std::size_t contact) const { return std::max(restSpeed_, states_[contact].still); }
  /// [1] The direction, along its row, in which a grip slips; of one that slips.
  double sideOf(std::size_t contact) const { return guess_[contact][0] > 0 ? -1 : 1; }
  /// [m/s²] rate of the slip speed of contact c.
  double slipSpeedRate(std::size_t contact) const {
    const auto& slip = forces_.contacts()[contact].slip;
    return slip[0] * forces_.excess(contact, 1) + slip[1] * forces_.excess(contact, 2);
  }
  std::size_t placeOf(std::size_t body) const { return places_[body]; }
  const Kinematics& kinematics(std::size_t body) const { return kinematics_[body]; }
  /// [m] What of a body's gaps is rounding error where it is.
  double touching(std::size_t body) const;

  /// [m/s] Speeds below this count as rest: rounding error.
  double restSpeed() const { return restSpeed_; }
  /// [m] the largest half diagonal; [m/s²] the scale of accelerations.
  double radius() const { return radius_; }
  double pull() const { return pull_; }

 private:
  BodyState stateIn(std::span<const double> y, std::size_t body) const;
  bool holdsSideways(std::size_t contact) const;
  Vec3 gapsOf(std::size_t contact) const;
  double shiftOf(std::span<const double> displacement) const;
  Vec3 angularOf(std::span<const double> solution, std::size_t mover) const;
  void findFree();
  void fillContacts();

  const World* world_;
  std::vector<TouchingBody> bodies_;
  std::vector<std::size_t> places_;  // by body: index among the movable ones, or kHeld
  std::vector<std::size_t> movers_;  // by movable body: index in bodies_
  std::vector<ContactFeature> features_;
  std::vector<ContactFeature> openEnds_;
  std::vector<Mode> modes_;
  std::vector<ContactForces::Force> guess_;  // forces found with the modes
  std::vector<Vec3> guessedFriction_;  // theirs [N], in the world: tangents may jump where a normal turns
  std::vector<Vec3> onset_;            // [1] direction in which a sticking contact begins to slip
  std::vector<Kinematics> kinematics_;
  std::vector<ContactState> states_;
  std::vector<char> pushing_;  // by contact, as of then
  ManifoldNormals normals_;
  std::vector<double> inverseMass_;
  std::vector<double> free_;
  std::vector<BodyState> worldStates_;  // for springs and drag
  ContactForces forces_;
  double restSpeed_ = 0;
  double radius_ = 0;
  double pull_ = 0;
  double time_ = 0;  // [s] where they were last looked at
  bool hasTime_ = false;
  bool isCarried_ = false;
};

}  // namespace careen
