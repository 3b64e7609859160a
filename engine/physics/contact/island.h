#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "physics/contact/contact_system.h"
#include "physics/contact/dormand_prince5.h"
#include "physics/motion/motion.h"

namespace careen {

/// [s] The step of first order that follows where no smooth motion is to be had: it errs about the tolerance.
double timeStepOf(const World& world, double tolerance);

/// The motion Contact: bodies that slide, roll, rock, lean or stand on walls and on each other, from one
/// change of their contacts to the next. While the same contacts push, and each sticks or slips as it does,
/// the motion is smooth: it is integrated by Dormand–Prince 5, its steps chosen by `tolerance`. What ends
/// that is looked for at the end of every step and located by shorter steps from its start: a contact that no
/// longer pushes, begins or ceases to slip, leaves its face, and a gap that closes. Gaps and rates of pushing
/// contacts are kept at zero by projection: nothing sinks, and nothing is pushed back by a speed.
class Island {
 public:
  /// `tolerance` [m]: of every body's place, and of its corners'.
  Island(const World& world, std::vector<TouchingBody> bodies, std::vector<ContactFeature> features,
         double tolerance);

  /// Finds which contacts push, and how. Where no forces do what is asked (Painlevé's paradox, or a jam of
  /// contacts on the brink) the next step is a short one of first order, by impulses.
  enum class Stepping { kSmooth, kTimeSteps };
  void begin(Stepping stepping);
  bool isSmooth() const { return smooth_; }
  /// Some contact pushes.
  bool pushes() const;
  /// Nothing moves, and nothing begins to. Ask after begin().
  bool rests() const;

  enum class End {
    kGoesOn,   ///< nothing happened
    kChanges,  ///< a contact closes, parts, sticks or slips: what touches must be looked at anew
  };
  struct Step {
    double length = 0;  ///< [s]
    End end = End::kGoesOn;
  };
  /// One step of at most `most` [s]: afterwards bodies() are where it ends and motion() is how they came
  /// there.
  Step step(double most);
  /// Back to somewhere in the last step, `length` [s] after its start; the contacts stay as they were.
  void cutTo(double length);

  const ContactSystem& system() const { return system_; }
  const std::vector<TouchingBody>& bodies() const { return system_.bodies(); }
  /// Two bodies are watched by steps themselves, because they pushed or touched where this one began.
  bool handlesPair(std::size_t a, std::size_t b) const;
  /// How a body that can move did so in the last step.
  ContactStep motion(std::size_t body) const { return motion(body, length_); }
  /// [m] deepest overlap seen at the end of a step.
  double deepest() const { return deepest_; }
  /// The last step may have taken out energy: by friction, or because it was a time step.
  bool mayLose() const;

 private:
  using State = DormandPrince5::State;
  /// Gaps within so many touching tolerances are watched for sinking, the others for closing.
  static constexpr double kTouching = 8;

  struct EventFunction {  // a number that is positive until something happens
    enum class Kind { kPush, kStick, kGap, kWithin, kOverlap, kCorner };
    static bool isOfPlaces(Kind kind) { return kind == Kind::kOverlap || kind == Kind::kCorner; }
    Kind kind;
    std::size_t contact = 0;  // or the pair, or the body
    int wall = 0;
    int corner = 0;
    double margin = 0;  // [m]
    double rate = 0;    // [m/s] of a corner, at the start of the step
  };

  void listEventFunctions();
  void noteStart();
  void locate(Step& step);
  bool locate(std::size_t event, double shortest, Step& step);
  double rateOf(const EventFunction& corner) const;
  double lowestWithin(double h, std::size_t event, double atEnd) const;
  double lowestOfCorner(double h, std::size_t event, double atEnd) const;
  double deepWithin(double h, const EventFunction& event) const;
  ContactStep motion(std::size_t body, double h) const;
  double value(const EventFunction& event) const;
  double marginOf(const EventFunction& event, double gap) const;
  double touching(std::size_t body) const;
  double longestStep();
  Step takeTimeStep(double most);
  void endTimeStep(double length);
  bool try5(double h);
  void restep(double h);
  void finish();
  bool isClear() const;
  bool hasTension() const;
  bool allButStands(std::size_t contact) const;
  bool stop();
  double sizeOf(const State& difference, double h) const;
  double rootWithin(double h, std::size_t event, double atEnd);

  double tolerance_;
  const World& world_;
  ContactSystem system_;
  std::vector<EventFunction> eventFunctions_;
  std::vector<double> atStart_;  // of the event functions
  DormandPrince5 integrator_;
  State start_;
  State startRate_;
  State end_;
  State timeStepEnd_;
  State endRate_;
  State error_;
  double length_ = 0;  // of the last step
  double proposed_ = 0;
  double lifetime_ = 0;        // [s] of the speeds there are
  bool known_ = false;         // startRate_ is that of end_
  bool smooth_ = true;         // forces were found
  bool tookTimeStep_ = false;  // the last step was a time step
  double deepest_ = 0;
};

}  // namespace careen
