#pragma once

#include "study/contestant.h"

namespace careen {

/// Another engine, which moves a world step by step. An adapter says how its engine is fed, stepped and read;
/// the rest is here. Engines know walls, boxes, gravity, restitution and friction.
class Peer : public Contestant {
 public:
  /// An engine fed with a world.
  class Engine {
   public:
    Engine() = default;
    Engine(const Engine&) = delete;
    Engine& operator=(const Engine&) = delete;
    virtual ~Engine() = default;

    /// One step of h > 0 [s].
    virtual void step(double h) = 0;
    /// Of a body that can move, by its place in the world.
    virtual BodyState state(std::size_t body) const = 0;
  };

  bool steps() const override { return true; }
  std::string refuses(const World& world) const override;
  std::vector<std::vector<BodyState>> run(const World& world, double dt, std::span<const double> times,
                                          const std::stop_token& stop) const override;

 protected:
  /// `world` outlives the engine.
  virtual std::unique_ptr<Engine> feed(const World& world) const = 0;
};

}  // namespace careen
