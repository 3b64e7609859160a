#pragma once

#include <cstddef>
#include <numeric>
#include <span>
#include <vector>

#include "core/names.h"
#include "physics/pile/crowd.h"

namespace careen::test {

/// All bodies of a world as one crowd, frame by frame; states in the world's order.
class CrowdRun {
 public:
  static constexpr double kFrame = 1.0 / 60;

  explicit CrowdRun(const World& world, double tolerance = Crowd::kUsualTolerance, double frame = kFrame,
                    int threads = 1)
      : crowd_(world, tolerance, std::make_shared<Team>(threads)),
        frame_(frame),
        places_(world.bodies.size()),
        states_(world.bodies.size()) {
    for (const std::size_t listed : orderByName(world.bodies)) {
      const BodyState& state = world.bodies[listed].initial;
      places_[listed] = crowd_.admit(listed, state, Quat(state.pose.worldFromBody).normalized());
    }
    look();
  }

  void step() {
    for (double left = frame_; left > 0 && !crowd_.atRest();) {
      const double taken = crowd_.step(left);
      left = taken < left ? left - taken : 0;
    }
    look();
  }
  std::span<const BodyState> states() const { return states_; }
  /// Of moments at which velocities and places go together.
  std::vector<BodyState> statesAtVelocities() const {
    std::vector<BodyState> states;
    for (const std::size_t place : places_) {
      states.push_back(crowd_.stateAtVelocity(place));
    }
    return states;
  }
  bool sleeps(std::size_t body) const { return crowd_.sleeps(places_[body]); }
  bool atRest() const { return crowd_.atRest(); }
  double deepest() const { return crowd_.penetration(); }
  Crowd::Figures figures() const { return crowd_.figures(); }
  Crowd& crowd() { return crowd_; }

 private:
  void look() {
    for (std::size_t body = 0; body < places_.size(); ++body) {
      states_[body] = crowd_.state(places_[body]);
    }
  }

  Crowd crowd_;
  double frame_;
  std::vector<std::size_t> places_;
  std::vector<BodyState> states_;
};

}  // namespace careen::test
