#pragma once

#include <optional>

#include "physics/world/contact_residuals.h"

namespace careen {

enum class Method : int;  // see world/method.h

/// Error figures of a run.
struct RunFigures {
  double energyChange = 0;  ///< [1] largest change not accounted for by impacts, springs, drag and friction,
                            ///< relative to the largest kinetic plus spring energy the run should have had
  double momentumChange =
      0;  ///< [1] largest relative change in flight, linear and angular, beyond what forces give
  double orthogonality = 0;                ///< [1] largest ‖AAᵀ−1‖
  double deepestPenetration = 0;           ///< [m]
  std::optional<double> boundedFrom = {};  ///< [s] when the first bodies went on as a crowd, if any did
  std::optional<double> horizon = {};      ///< [s] until then places mean something, if not to the end
  ContactResiduals contact = {};           ///< of impacts of several contacts, contact forces and time steps
  ContactResiduals crowds = {};            ///< of the steps of crowds
};

/// When bodies in contact go on as a crowd (physics/pile/crowd.h).
struct CrowdSettings {
  enum class When {
    kAuto,   ///< where exact contact costs too much, or has no solution
    kNever,  ///< the run then takes as long as it takes, or fails
    kAbove,  ///< groups of more bodies than `above`, and where kAuto would
  };
  When when = When::kAuto;
  int above = 0;
  double tolerance = 3e-4;  ///< [m] of penetration; steps are its root

  bool areAllowed() const { return when != When::kNever; }
};

inline constexpr int kMostThreadsOfCrowds = 64;

struct RunSettings {
  Method method{};          ///< kExact unless said otherwise
  double duration = 0;      ///< [s]
  double dt = 1.0 / 240;    ///< [s] time step of stepping methods
  double tolerance = 1e-6;  ///< [m] of positions and corners, for methods with step size control
  CrowdSettings crowds = {};
  int threads = 1;  ///< for large crowds, kMostThreadsOfCrowds at most; nothing but the time depends on it
};

}  // namespace careen
