#pragma once

#include <array>
#include <cstddef>
#include <limits>
#include <vector>

#include "physics/contact/contact_feature.h"
#include "physics/contact/implicit_step.h"
#include "physics/geometry/separation.h"
#include "physics/impact/impact_law.h"
#include "physics/motion/motion.h"
#include "physics/world/world.h"

namespace careen {

/// An impact of a group of bodies: one of its contacts.
struct GroupImpact {
  ImpactContact contact;  ///< its bodies are indices into the group
  ImpactShare share;
  double cause = 0;  ///< [m/s] the fastest approach in the impact
};

/// Time steps of bodies that touch, where no smooth motion exists (Painlevé's paradox, jams) or contacts
/// change more often than it pays to follow each. It needs no list of contacts: every step finds those of its
/// bodies with each other and with the walls.
///
/// A step is an ImplicitStep. Its length follows from the tolerance: the difference between one step and two
/// of half the length, and ends where a gap closes (regula falsi on the length); there all points of the
/// manifold strike together, by the impact law. Gaps up to `closed()` count as none. No step is shorter than
/// the time in which nothing moves that far: so chattering ends, at first order, and steps exist where forces
/// do not: the impulse without approach of a jam.
class TimeStepper {
 public:
  /// `tolerance` [m]: of positions, corners included.
  TimeStepper(const World& world, const std::vector<TouchingBody>& bodies, double tolerance);

  /// Takes one step, at most so long [s], and returns its length. Throws NumericalError if no impulses were
  /// found however short the step, or not for so much of ImplicitStep::work(); it is of no use then.
  double step(double most, double mostWork = std::numeric_limits<double>::infinity());
  /// Cuts the last step to `length` [s] from its start.
  void cutTo(double length);
  /// [s] of the last step.
  double length() const { return length_; }
  /// Contacts that are closed at the end of the last step; those of them that had a force in it.
  std::vector<ContactFeature> touching() const;
  std::vector<ContactFeature> pressed() const;

  /// At the end of the last step, contacts moved apart where drift has made them deep: in the motion during
  /// it they are not, as that way, far smaller than the tolerance, would be a speed in a short step.
  const GroupState& state() const { return end_; }
  /// Motion of a body in the last step.
  ContactStep motion(std::size_t body) const { return motion(body, reached_); }
  /// Impacts at the start of the last step, also those without approach. What gravity alone gives in the step
  /// is none but a force.
  const std::vector<GroupImpact>& impacts() const { return impacts_; }
  /// Whether nothing moves faster than what falling through a small part of the tolerance gives, or being
  /// pulled through it by springs.
  bool isQuiet();
  /// [m] deepest gap of a contact seen at the end of a step.
  double deepest() const { return deepest_; }
  /// [m] Gaps up to this count as none.
  double closed() const { return 0.25 * tolerance_; }
  const ImplicitStep& equations() const { return equations_; }
  /// Of the contact problems solved since it was last asked.
  ContactResiduals takeResiduals();

 private:
  struct Moment {                   // of an event function
    double time = 0;                // [s] from the start of the step
    double value = 0;               // [m]
    std::array<double, 6> faces{};  // [m] of a pair: separation along the faces' normals
    bool onEdges = false;           // of a pair: its gap is along the normal of two edges
  };
  struct Watch {  // an event function: a gap that may close, or a contact's way to the end of its face
    enum class Kind { kFeature, kPair, kBeyond };
    Kind kind = Kind::kFeature;
    ContactFeature feature;  // or a pair, as its a and b
    double margin = 0;       // [m]
    Moment start = {};
  };
  struct Bounds {          // on an event function in the step
    double curvature = 0;  // [m/s²] second derivative
    double rate = 0;       // [m/s] of the gap of a pair
    double fixed = 0;      // [m/s²] second derivative of its separation along a direction fixed in space
  };
  struct Found {  // a contact feature near closing
    ContactFeature feature;
    double gap = 0;      // [m]
    double rate = 0;     // [m/s] of it
    double passing = 0;  // [m/s] see ContactState
  };

  static bool isSame(const ContactFeature& x, const ContactFeature& y);
  void findContacts(const GroupState& at);
  void addWallContacts(std::size_t body);
  void addPairContacts(const GroupState& at, std::size_t a, std::size_t b);
  void lookAgain(const GroupState& at);
  void collide();
  bool collideOnce();
  ImpactContact impactAt(std::size_t found) const;
  void keepImpacts();
  bool obeys(const Found& found, double h) const;
  void choose(double h);
  void listWatches(double h);
  void watchWalls(std::size_t body, double reach);
  void watch(const Watch& watch);
  ContactStep motion(std::size_t body, const GroupState& to) const;
  void setMotions(const GroupState& to);
  GroupBody bodyWithin(std::size_t body, double time) const;
  void setWithin(const Watch& watch, double time);
  double valueWithin(const Watch& watch, double time);
  Bounds boundsOn(const Watch& watch) const;
  Pose poseWithin(std::size_t body, double time) const;
  Moment momentOf(const Watch& watch, double time, const GroupState& at) const;
  bool staysOpenOnEdges(const Watch& watch, double below, const Moment& from, const Moment& to) const;
  bool staysOpen(const Watch& watch, const Bounds& bounds, const Moment& from, const Moment& to) const;
  double dipWithin(const Watch& watch, const Bounds& bounds, const Moment& from, const Moment& to, int depth);
  double firstDip();
  BoxAxes axesOf(const Watch& pair, const GroupState& at) const;
  double value(const Watch& watch, const GroupState& at) const;
  enum class Attempt { kDone, kShorter, kUnsolved };
  Attempt attempt(double& h, double shortest);
  bool tryStep(double h, ImplicitStep::Order order = ImplicitStep::Order::kSecond);
  bool tryHalves(double h);
  bool locate(double& h);
  double rootOf(const Watch& watch, double h, double atEnd);
  void shortenJolt(double& h);
  void addJolt(double h, double change);
  void strikeAtStart(double h);
  double fastestOf(const GroupState& state) const;
  double changeTo(const GroupState& end) const;
  double errorOf(const GroupState& coarse, const GroupState& fine, double h) const;
  double shortestStep();
  double longestStep() const;
  void correct();
  double wayOf(std::size_t body, const GroupBody& from, const GroupBody& to) const;
  bool near(const GroupState& at, std::size_t a, std::size_t b, double within) const;
  BoxAt boxOf(std::size_t body) const;
  Material materialOf(const ContactFeature& feature) const;

  const World& world_;
  const std::vector<TouchingBody>& bodies_;
  double tolerance_;
  ImplicitStep equations_;
  GroupState start_;
  GroupState end_;
  GroupState reached_;  // the end before correct()
  GroupState middle_;
  GroupState coarse_;
  std::vector<Found> found_;              // contacts at the start
  std::vector<ContactFeature> features_;  // of them
  std::vector<ContactState> states_;      // of them, as last seen
  std::vector<ClosedContact> law_;        // those whose law holds in the step
  std::vector<Watch> watches_;
  std::vector<ClosedContact> known_;  // of the last step: forces to start from
  std::vector<GroupImpact> impacts_;
  std::vector<Pose> poses_;
  std::vector<ContactStep> motions_;
  GroupState within_;
  double length_ = 0;
  double proposed_ = 0;
  ContactResiduals residuals_;  // of impacts
  double acceleration_ = 0;     // [m/s²] largest of the last step
  double deepest_ = 0;
  bool halved_ = false;  // the last step is two of half its length, joined at middle_
  bool jolted_ = false;  // the last step is a moment, see shortenJolt()
};

}  // namespace careen
