#pragma once

#include "study/contestant.h"

namespace careen {

/// Why no other engine is asked to move this world; empty if they are. They model walls, boxes, gravity,
/// restitution and friction, some of them joints too.
std::string refusalOfPeers(const World& world);

/// Another engine, which moves a world by time steps. An adapter defines how the engine is set up, stepped
/// and read; this class does the rest.
class Peer : public Contestant {
 public:
  /// An engine that holds a copy of a world.
  class Engine {
   public:
    Engine() = default;
    Engine(const Engine&) = delete;
    Engine& operator=(const Engine&) = delete;
    virtual ~Engine() = default;

    /// Takes one time step of h > 0 [s].
    virtual void step(double h) = 0;
    /// State of a movable body, by its index in the world.
    virtual BodyState state(std::size_t body) const = 0;
  };

  bool steps() const override { return true; }
  std::string refuses(const World& world) const override;
  std::vector<std::vector<BodyState>> run(const World& world, double dt, std::span<const double> times,
                                          const std::stop_token& stop) const override;

 protected:
  /// Why it cannot have such a joint; empty if it can. None is asked for motors, or for a joint that lets go;
  /// most have balls, hinges, sliders and fixed ones, all without springs.
  virtual std::string refusesJoint(const Joint& joint) const;
  /// Sets up an engine; `world` outlives it.
  virtual std::unique_ptr<Engine> feed(const World& world) const = 0;
};

}  // namespace careen
