#pragma once

#include <memory>
#include <span>
#include <stop_token>
#include <string>
#include <vector>

#include "physics/world/body.h"
#include "physics/world/world.h"

namespace careen {

/// Whatever can move a world: one of careen's own methods, or another engine behind an adapter.
class Contestant {
 public:
  virtual ~Contestant() = default;

  /// One word, as tables and the command line spell it: "exact", "bullet", "bullet-best".
  virtual std::string name() const = 0;
  /// Its settings in words, for the reader who wants to repeat it.
  virtual std::string settings() const = 0;
  /// Whether it moves step by step, so that its error depends on dt. The others are asked for a tolerance.
  virtual bool steps() const = 0;
  /// Why it cannot be asked to move this world; empty if it can.
  virtual std::string refuses(const World& world) const = 0;

  /// Where every body is at each of the moments: result[moment][body], bodies in the world's order. `times`
  /// [s] ascend from 0 or later. `fineness` is a dt [s]: between two of the moments (and from 0 to the first)
  /// it takes equal steps no longer than that; or, of who takes no steps, a tolerance [m]. Throws an Error if
  /// it cannot go on, Interrupted if asked to stop.
  virtual std::vector<std::vector<BodyState>> run(const World& world, double fineness,
                                                  std::span<const double> times,
                                                  const std::stop_token& stop) const = 0;

 protected:
  Contestant() = default;
  Contestant(const Contestant&) = default;
  Contestant& operator=(const Contestant&) = default;
  Contestant(Contestant&&) = default;
  Contestant& operator=(Contestant&&) = default;
};

using Contestants = std::vector<std::unique_ptr<Contestant>>;

}  // namespace careen
