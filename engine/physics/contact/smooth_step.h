#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "physics/contact/contact_system.h"
#include "physics/contact/dormand_prince5.h"
#include "physics/contact/kept_energy.h"
#include "physics/contact/undamped_springs.h"
#include "physics/motion/motion.h"

namespace careen {

/// A step of a contact system in which its contacts keep their modes, by Dormand–Prince 5: how long it may
/// be, its motion, its error. Gaps and rates of active contacts are kept at zero by projection, energies and
/// momenta where nothing changes them.
class SmoothStep {
 public:
  using State = DormandPrince5::State;

  /// `tolerance` [m]: of positions, corners included; `timeScale` [s]: see timeScaleOf(). World and system
  /// must outlive it.
  SmoothStep(const World& world, ContactSystem& system, double tolerance, double timeScale);

  /// Where the last step ended and the next one starts.
  State& state() { return end_.y; }
  /// Forces at the state are to be found anew: a mode, or the state itself, is another.
  void forgetForces() { goesOn_ = false; }
  bool goesOn() const { return goesOn_; }
  /// Likewise, and what it did so far is not to be kept to.
  void restart();
  /// A step begins at the state. Returns false if there are no forces.
  bool begin();
  /// Takes a step of at most so long [s] with an error that is allowed. Returns false where it would be so
  /// short that time steps do better; the state is of no use then.
  bool take(double most);
  /// Takes it again, of this length [s] from its start.
  void retake(double length);

  /// [s] Of the step. Shorter ones do not pay.
  double length() const { return length_; }
  double shortest() const;
  /// Its error, relative to the error allowed; halfway, where it costs an evaluation of forces.
  double error() const { return sizeOf(error_); }
  double errorBetween();
  /// Whether the correction of places at its end displaced a body by more than the tolerance.
  bool isMovedByCorrection() const;
  /// Contacts give no energy, unless something is driven. A step that gained some passed a moment at which
  /// the forces are without bound, in a wedge for one, and went on with forces that pull.
  bool gainsEnergy() const;

  /// Motion of a movable body in it; of all of them, and the state on these after `time` [s].
  ContactStep motion(std::size_t body) const;
  std::vector<ContactStep> motions() const;
  State stateWithin(std::span<const ContactStep> motions, double time) const;

 private:
  struct End {
    State y;
    State rate;
    bool isTurned = false;  // the forces, see ContactForces::isTurned()
  };

  bool findRate(End& end);
  bool integrate();
  void finish();
  double longest();
  double timeToFall(const Body& body) const;
  double sizeOf(const State& difference) const;
  double awayFromEquilibrium() const;

  const World& world_;
  ContactSystem& system_;
  UndampedSprings springs_;
  KeptEnergy energy_;  // of joints
  DormandPrince5 integrator_;
  double tolerance_;
  double timeScale_;
  End start_;
  End end_;
  State error_;
  double length_ = 0;
  double proposed_ = 0;  // [s] of the next step
  double away_ = 1;      // awayFromEquilibrium() at the start
  double lifetime_ = 0;  // [s] for which the current speeds matter
  bool goesOn_ = false;  // the end's rate is the next start's
};

}  // namespace careen
