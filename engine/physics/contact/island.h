#pragma once

#include <array>
#include <cstddef>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "core/math/falling_bracket.h"
#include "physics/contact/contact_system.h"
#include "physics/contact/dormand_prince5.h"
#include "physics/contact/time_stepper.h"
#include "physics/contact/undamped_springs.h"
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
  /// it.
  Island(const World& world, std::vector<TouchingBody> bodies, std::vector<ContactFeature> features,
         double tolerance, double timeScale);

  /// Finds the mode of each contact. Where no forces meet the conditions (Painlevé's paradox, jams), the
  /// motion begins with a few time steps.
  void begin();
  /// Goes on by so many time steps (TimeStepper), which find their contacts themselves.
  void beginTimeSteps(int count);
  bool isSmooth() const { return smooth_; }
  /// Time steps yet to be taken.
  int timeStepsLeft() const { return timeStepsLeft_; }
  /// Impacts at the start of the last step.
  const std::vector<GroupImpact>& impacts() const;
  /// The contacts at the end of the last step, if it was a time step, become those of system().
  void endTimeSteps();
  /// Whether some contact is active.
  bool pushes() const;
  /// Removes from `features`, those of system(), what has a choice of directions and does not push in smooth
  /// motion: whether it will have to is seen from the gap of the boxes. Returns whether there were some.
  bool dropIdle(std::vector<ContactFeature>& features) const;
  /// Whether nothing moves or begins to. Call after begin().
  bool rests() const;

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
  /// Whether the event functions cover two bodies, because they were in contact at the start of the step.
  bool handlesPair(std::size_t a, std::size_t b) const;
  /// Motion of a movable body in the last step.
  ContactStep motion(std::size_t body) const { return motion(body, length_); }
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

  /// Gaps within this many touching tolerances are checked for penetration, the others for closing; no hop
  /// ends deeper.
  static constexpr double kTouching = 8;

 private:
  using State = DormandPrince5::State;

  struct EventFunction {  // positive until the event happens
    enum class Kind { kPush, kStick, kGap, kWithin, kOverlap, kCorner };
    static bool isOfPlaces(Kind kind) { return kind == Kind::kOverlap || kind == Kind::kCorner; }
    static bool isOfForces(Kind kind) { return kind == Kind::kPush || kind == Kind::kStick; }
    Kind kind;
    std::size_t contact = 0;  // or the pair, or the body
    int wall = 0;
    int corner = 0;
    double margin = 0;  // [m]
    double rate = 0;    // [m/s] of a corner, at the start of the step
  };

  struct Fall {                       // of event functions of one kind below zero, of the lowest of them
    std::vector<std::size_t> events;  // located together
    EventFunction::Kind kind{};
    double until = 0;  // [s] from the start of the step: where it is below
    double atStart = 0;
    double value = 0;     // then
    double estimate = 0;  // [s] when, by linear interpolation
  };

  struct Estimate {    // of the root of an event function
    double time = 0;   // [s] from the start of the step
    double value = 0;  // there
    double slope = 0;  // [1/s] of it
  };

  void listEventFunctions();
  void noteStart();
  void locate(Step& step);
  std::optional<Fall> fallOf(std::size_t event, double length);
  double rateOf(const EventFunction& corner) const;
  double lowestWithin(double h, std::size_t event, double atEnd);
  double lowestOfCorner(double h, std::size_t event, double atEnd) const;
  double deepWithin(double h, const EventFunction& event) const;
  double dipOf(double h, std::size_t event);
  bool dips(double h);
  ContactStep motion(std::size_t body, double h) const;
  double value(const EventFunction& event) const;
  double marginOf(const EventFunction& event, double gap) const;
  double touching(std::size_t body) const;
  double longestStep();
  Step takeTimeStep(double most);
  void adopt();
  bool try5(double h);
  void restep(double h);
  void finish(double h);
  bool isClear() const;
  double load() const;
  bool hasTension() const;
  bool allButStands(std::size_t contact) const;
  bool creeps(std::size_t contact) const;
  bool stop();
  double timeToFall(const Body& body) const;
  double sizeOf(const State& difference, double h) const;
  double awayFromEquilibrium() const;
  double errorBetween(double h);
  bool isMovedByCorrection(double h) const;
  bool gainsEnergy() const;
  static Fall firstOf(std::span<const Fall> falls);
  double depthOf(const Fall& fall) const;
  double valueOf(const Fall& fall) const;
  FallingBracket bracketOf(const Fall& fall);
  Estimate estimateOf(const Fall& fall, FallingBracket bracket, std::span<const ContactStep> path);
  double rootWithin(const Fall& fall, double length);
  std::vector<ContactStep> motions(double h) const;
  State stateWithin(std::span<const ContactStep> path, double time) const;

  double tolerance_;
  double timeScale_;  // [s] see timeScaleOf
  const World& world_;
  ContactSystem system_;
  UndampedSprings springs_;
  std::vector<EventFunction> eventFunctions_;
  std::vector<double> atStart_;  // values of the event functions
  DormandPrince5 integrator_;
  State start_;
  State startRate_;
  State end_;
  State endRate_;
  State error_;
  double length_ = 0;  // of the last step
  double proposed_ = 0;
  double away_ = 1;            // awayFromEquilibrium() at the start of the step
  double lifetime_ = 0;        // [s] for which the current speeds matter
  bool known_ = false;         // endRate_ is the next startRate_
  bool smooth_ = true;         // forces were found
  bool tookTimeStep_ = false;  // the last step was a time step
  int timeStepsLeft_ = 0;
  int timeStepsTaken_ = 0;
  bool quiet_ = false;        // they end because hardly anything moves
  bool startTurned_ = false;  // of the forces at both ends of a step, see ContactForces::isTurned()
  bool endTurned_ = false;
  std::size_t moves_ = 0;                             // counts the motions tried
  std::vector<std::pair<std::size_t, double>> dips_;  // of an event function: of which motion, deepWithin()
  std::unique_ptr<TimeStepper> stepper_;
  double deepest_ = 0;
  double workBefore_ = 0;
  double mostWork_ = std::numeric_limits<double>::infinity();
};

}  // namespace careen
