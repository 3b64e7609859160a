#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "physics/contact_pushes.h"
#include "physics/motion/momentum_rates.h"
#include "trajectory/trajectory.h"

namespace careen {

/// Forces of contact at moments of a run. Nothing of them is recorded: its motions tell what each body is
/// given beside gravity, springs, drag and motors, and contactPushes what of it comes from where. Impacts
/// give impulses and no forces, but for what is in a crowd: its forces are means over a while, in which its
/// impacts, too, are.
class ForceSamples {
 public:
  explicit ForceSamples(const Trajectory& run);

  /// At a time in [0, duration] [s]; InputError outside.
  std::vector<ContactPush> at(double time) const;

 private:
  struct Momentum {
    Vec3 linear = Vec3::Zero();   // [kg m/s]
    Vec3 angular = Vec3::Zero();  // [kg m²/s] about the centre of mass
  };
  Momentum momentumOf(std::size_t body, const BodyState& state) const;
  World worldAt(double time) const;
  bool isInCrowd(std::size_t body, double from, double to) const;
  bool isStruck(std::size_t body, double time) const;
  MomentumRates meanRates(std::size_t body, double from, double to) const;
  MomentumRates ratesInContact(std::size_t body, std::size_t place, double time, double load) const;
  PushedBody pushed(std::size_t body, double time, const BodyState& state, const Load& load) const;

  const Trajectory& run_;
  std::vector<double> crowdFrom_;  // [s] by body: since when it was first in one
  double while_;                   // [s]
};

/// Columns of a table of forces, after its time and the names of both.
struct ForceColumn {
  std::string_view name;
  std::string_view unit;
  double (*of)(const ContactPush& push);
};
inline constexpr std::array<ForceColumn, 12> kForceColumns = {
    {{"x", "m", [](const ContactPush& push) { return push.point.x(); }},
     {"y", "m", [](const ContactPush& push) { return push.point.y(); }},
     {"z", "m", [](const ContactPush& push) { return push.point.z(); }},
     {"nx", "1", [](const ContactPush& push) { return push.normal.x(); }},
     {"ny", "1", [](const ContactPush& push) { return push.normal.y(); }},
     {"nz", "1", [](const ContactPush& push) { return push.normal.z(); }},
     {"fx", "N", [](const ContactPush& push) { return push.force.x(); }},
     {"fy", "N", [](const ContactPush& push) { return push.force.y(); }},
     {"fz", "N", [](const ContactPush& push) { return push.force.z(); }},
     {"normal", "N", [](const ContactPush& push) { return dot(push.normal, push.force); }},
     {"friction", "N",
      [](const ContactPush& push) {
        return (push.force - dot(push.normal, push.force) * push.normal).norm();
      }},
     {"left", "N", [](const ContactPush& push) { return push.left; }}}};

/// Name of the box or wall that pushes body a; empty if none was found.
std::string partnerName(const Trajectory& run, const ContactPush& push);

}  // namespace careen
