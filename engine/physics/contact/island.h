#pragma once

#include <cstddef>
#include <limits>
#include <memory>
#include <vector>

#include "physics/contact/contact_system.h"
#include "physics/contact/event_functions.h"
#include "physics/contact/event_locator.h"
#include "physics/contact/island_time_steps.h"
#include "physics/contact/smooth_step.h"
#include "physics/contact/stillness.h"
#include "physics/motion/motion.h"

namespace careen {

/// [s] Time in which a body at rest falls by the tolerance; without gravity, in which the body that is the
/// fastest at the start moves by the root of tolerance × size, or springs move one by the tolerance: infinite
/// if none moves and none pulls. Steps much shorter do not pay: contacts that change that often chatter.
double timeScaleOf(const World& world, double tolerance);

/// The motion Contact: bodies that slide, roll, rock, lean or stand on walls and on each other, from one
/// change of their contacts to the next. While the same contacts are active, each in its mode (stick or
/// slip), the motion is smooth: it is integrated by Dormand–Prince 5 with step sizes chosen by `tolerance`.
/// Events are detected at the end of every step and located by shorter steps from its start: a contact force
/// that reaches zero, slip that begins or ends, a contact that leaves its face, a gap that closes. Gaps and
/// rates of active contacts are kept at zero by projection: no penetration, and no velocity that corrects
/// one.
class Island {
 public:
  /// `tolerance` [m]: for the position of every body and of its corners; `timeScale` [s]: timeScaleOf() with
  /// it. `features`: contacts that are closed; `joints`: all conditions of the bodies' joints.
  Island(const World& world, std::vector<TouchingBody> bodies, std::vector<ContactFeature> features,
         double tolerance, double timeScale, std::vector<ContactFeature> joints = {});
  Island(const Island&) = delete;
  Island& operator=(const Island&) = delete;

  /// Finds the mode of each contact. Where no forces meet the conditions (Painlevé's paradox, jams), the
  /// motion begins with a few time steps.
  void begin();
  /// Goes on by so many time steps (TimeStepper), which find their contacts themselves.
  void beginTimeSteps(int count);
  bool isSmooth() const { return !timeSteps_; }
  /// Time steps yet to be taken.
  int timeStepsLeft() const { return timeSteps_ ? timeSteps_->left() : 0; }
  /// Impacts at the start of the last step.
  const std::vector<GroupImpact>& impacts() const;
  /// The contacts at the end of the last step, if it was a time step, become those of system().
  void endTimeSteps();
  /// Whether some contact is active.
  bool pushes() const { return system_.pushes(); }
  /// Removes from `features`, those of system(), what has a choice of directions and does not push in smooth
  /// motion: whether it will have to is seen from the gap of the boxes. Returns whether there were some.
  bool dropIdle(std::vector<ContactFeature>& features) const;
  /// Whether nothing moves or begins to. Call after begin().
  bool rests() const { return isSmooth() && isAtRest(system_); }

  enum class End {
    kGoesOn,   ///< nothing happened
    kChanges,  ///< a contact closes, opens, sticks or slips: contacts must be found again
  };
  struct Step {
    double length = 0;  ///< [s]
    End end = End::kGoesOn;
  };
  /// One step of at most `most` [s]: afterwards bodies() holds the states at its end and motion() the motion
  /// during it. Throws NumericalError where a time step has no solution, or none for so much work(); the
  /// island is of no use then.
  Step step(double most, double mostWork = std::numeric_limits<double>::infinity());
  /// Cuts the last step to `length` [s] from its start; the contacts stay unchanged.
  void cutTo(double length);

  const ContactSystem& system() const { return system_; }
  const std::vector<TouchingBody>& bodies() const { return system_.bodies(); }
  const std::vector<ContactFeature>& joints() const { return joints_; }
  /// Whether the event functions cover two boxes, because they were in contact at the start of the step.
  bool handles(const BoxOf& a, const BoxOf& b) const { return timeSteps_ || events_.coverBoxes(a, b); }
  /// Motion of a movable body in the last step.
  ContactStep motion(std::size_t body) const {
    return timeSteps_ ? timeSteps_->stepper().motion(body) : step_.motion(body);
  }
  /// [m] deepest penetration at the end of a step.
  double deepest() const { return deepest_; }
  /// Cost of the last step, or of that which ended with NumericalError: of a time step, contacts and bodies
  /// in factorisations, and geometry, whose cost for a body is that of about sixty; of a smooth one that
  /// contacts changed in, four times that; of others none, as they end by themselves.
  double work() const;
  /// Of the contact problems solved since it was last asked.
  ContactResiduals takeResiduals();
  /// Whether the last step may have dissipated energy: by friction, or because it was a time step.
  bool mayLose() const;

  /// No hop ends deeper than so many touching tolerances.
  static constexpr double kTouching = EventFunctions::kTouching;

 private:
  Step takeTimeStep(double most, double mostWork);
  bool isCredible(double tried, End end);
  bool jumps(double tried) const;
  void adopt();

  const World& world_;
  double tolerance_;
  std::vector<ContactFeature> joints_;
  ContactSystem system_;
  SmoothStep step_;
  EventFunctions events_;
  EventLocator locator_;
  std::unique_ptr<IslandTimeSteps> timeSteps_;  // if it goes on by them
  double deepest_ = 0;
};

}  // namespace careen
