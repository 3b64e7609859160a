#pragma once

#include <algorithm>
#include <cstddef>
#include <optional>
#include <vector>

#include "physics/world/run_settings.h"
#include "physics/world/world.h"

namespace careen {

/// Error figures of an event-driven run. Looks at a body only where its motion begins and ends, so its cost
/// is proportional to the number of events.
///
/// Energy dissipated by impacts with e < 1 or friction is accounted for. An energy increase never is, nor any
/// change in flight or in an impact that should conserve energy; but where surfaces move along themselves,
/// which give some wherever bodies touch, and where gravity slopes, flight alone is looked at.
class FlightAccount {
 public:
  explicit FlightAccount(const World& world);

  /// A body's motion begins in this state.
  void departs(std::size_t body, const BodyState& state);
  /// A body's motion passes through this state.
  void passes(std::size_t body, const BodyState& state);
  /// A body's motion ends in this state, `elapsed` [s] after it began; `more` [m/s²]: the mean of gravity in
  /// it beyond that of the world.
  void arrives(std::size_t body, const BodyState& state, double elapsed, const Vec3& more = Vec3::Zero());
  /// Between the arrivals and the departures of its bodies: what happens may dissipate energy.
  void mayLose() { mayLose_ = true; }
  /// Motors, or gravity beyond that of the world, did so much work [J].
  void gives(double work) { due_ += work; }
  /// All bodies of the impact have departed.
  void parted();
  void penetrates(double depth);
  /// From this time [s] on some bodies are a crowd, not exact.
  void bounds(double time) {
    boundedFrom_ = boundedFrom_.value_or(time);
    losesPlaces(time);
  }
  /// From this time [s] on the place of some body means nothing.
  void losesPlaces(double time) { horizon_ = std::min(time, horizon_.value_or(time)); }

  void solved(const ContactResiduals& residuals) { contact_.add(residuals); }
  void solvedCrowd(const ContactResiduals& residuals) { crowds_.add(residuals); }

  RunFigures figures() const;

 private:
  struct BodyAccount {
    double energy = 0;                    // [J] kinetic and gravitational, last seen
    double kinetic = 0;                   // [J] likewise
    Vec3 momentum = Vec3::Zero();         // when its motion began
    Vec3 angularMomentum = Vec3::Zero();  // likewise
  };
  void see(std::size_t body, const BodyState& state);
  double energy() const;
  void expect(const Vec3& momentum, const Vec3& due, double least);

  const World& world_;
  std::vector<BodyAccount> bodies_;
  std::vector<BodyState> states_;  // for springs and joints: last seen
  double energy_ = 0;              // [J] of all bodies, last seen, without springs
  double kinetic_ = 0;             // [J] likewise
  double largestKinetic_ = 0;      // [J]
  double due_ = 0;                 // [J] expected energy
  bool mayLose_ = false;
  bool mayGain_ = false;
  bool begun_ = false;
  double largestError_ = 0;   // [J]
  double momentumError_ = 0;  // [1]
  double orthogonality_ = 0;
  double deepest_ = 0;                 // [m]
  std::optional<double> boundedFrom_;  // [s]
  std::optional<double> horizon_;      // [s]
  ContactResiduals contact_;
  ContactResiduals crowds_;
};

}  // namespace careen
