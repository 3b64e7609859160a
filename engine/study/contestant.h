#pragma once

#include <memory>
#include <optional>
#include <span>
#include <stop_token>
#include <string>
#include <vector>

#include "audit/audit.h"
#include "physics/world/body.h"
#include "physics/world/world.h"
#include "study/deadline.h"

namespace careen {

/// Anything that can move a world: one of careen's own methods, or another engine behind an adapter.
class Contestant {
 public:
  virtual ~Contestant() = default;

  /// One word, as tables and the command line spell it: "exact", "bullet", "bullet-best".
  virtual std::string name() const = 0;
  /// Its settings as text, for readers who want to reproduce a result.
  virtual std::string settings() const = 0;
  /// Whether its error depends on a fixed time step dt. The others take a tolerance.
  virtual bool steps() const = 0;
  /// Why it cannot move this world; empty if it can.
  virtual std::string refuses(const World& world) const = 0;

  /// The state of every body at each of the times: result[time][body], bodies in the world's order. `times`
  /// [s] ascend from 0 or later. `fineness` is a dt [s], and between two of the times (and from 0 to the
  /// first) all time steps are equal and no longer than that; or a tolerance [m] for contestants without a
  /// fixed time step. Throws an Error if it cannot continue, Interrupted if stopped.
  virtual std::vector<std::vector<BodyState>> run(const World& world, double fineness,
                                                  std::span<const double> times,
                                                  const std::stop_token& stop) const = 0;

  /// [s] of cores that its runs have taken so far: of this program, unless they take place in another. May be
  /// called during a run.
  virtual double secondsTaken() const { return coreSeconds(); }

  /// Whether its answer is given once and for all: then it is asked for it once, and not timed.
  virtual bool isGiven() const { return false; }
  /// [s] of one core that a given answer took, if that is known.
  virtual std::optional<double> secondsGiven() const { return std::nullopt; }

  /// What the audit finds in such a run of `duration` [s]; none for engines that have no motions between
  /// times.
  virtual std::optional<Audit> audited(const World& /*world*/, double /*fineness*/, double /*duration*/,
                                       const std::stop_token& /*stop*/) const {
    return std::nullopt;
  }

 protected:
  Contestant() = default;
  Contestant(const Contestant&) = default;
  Contestant& operator=(const Contestant&) = default;
  Contestant(Contestant&&) = default;
  Contestant& operator=(Contestant&&) = default;
};

using Contestants = std::vector<std::unique_ptr<Contestant>>;

}  // namespace careen
