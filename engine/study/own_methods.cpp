#include "study/own_methods.h"

#include "physics/simulate.h"
#include "physics/world/method.h"
#include "physics/world/run_settings.h"
#include "runs/sampled_states.h"
#include "trajectory/trajectory.h"

namespace careen {
namespace {

// [1] Of its penetration to that of exact contact, as both are unless a scene says otherwise.
constexpr double kToleranceOfCrowds = CrowdSettings{}.tolerance / RunSettings{}.tolerance;

class OwnMethod : public Contestant {
 public:
  enum class Groups : unsigned char { kAsUsual, kCrowds };

  OwnMethod(const MethodTraits& traits, Groups groups) : traits_(traits), groups_(groups) {}

  std::string name() const override {
    return groups_ == Groups::kCrowds ? "crowd" : std::string(traits_.name);
  }
  std::string settings() const override {
    if (groups_ == Groups::kCrowds) {
      return "careen: exact, but all that touches or is jointed is a crowd, of 300 times the tolerance";
    }
    if (!traits_.steps()) {
      return "careen: closed forms from impact to impact; contact in adaptive time steps that hold the "
             "tolerance";
    }
    return "careen: order " + std::to_string(traits_.order) +
           (traits_.forces ? ", the time loop of the 1997 sample" : ", impacts at roots of the gap function");
  }
  bool steps() const override { return traits_.steps(); }

  std::string refuses(const World& world) const override {
    if (groups_ == Groups::kCrowds && world.joints.empty()) {
      return "asked for joints only";
    }
    if (!traits_.forces && (!world.springs.empty() || world.drag)) {
      return "no springs, no drag";
    }
    if (!traits_.gravityChanges && !world.gravityChanges.empty()) {
      return "no gravity that changes";
    }
    if (!traits_.belts && hasCourses(world)) {
      return "no " + whatHasCourses(world) + " that move";
    }
    if (!traits_.belts && hasBelts(world)) {
      return "no surfaces that move";
    }
    if (!traits_.joints && !world.joints.empty()) {
      return "no joints";
    }
    if (!traits_.boxBox && world.bodies.size() > 1) {
      return "no collisions between boxes";
    }
    return "";
  }

  std::vector<std::vector<BodyState>> run(const World& world, double fineness, std::span<const double> times,
                                          const std::stop_token& stop) const override {
    SampledStates states(world, times);
    simulate(world, settingsOf(fineness, times.back()), states, stop);
    return states.finish();
  }

  std::optional<Audit> audited(const World& world, double fineness, double duration,
                               const std::stop_token& stop) const override {
    return audit(record(world, settingsOf(fineness, duration), "", stop), AuditDepth::kUsual, stop);
  }

 private:
  RunSettings settingsOf(double fineness, double duration) const {
    RunSettings settings{.method = traits_.method, .duration = duration};
    (traits_.steps() ? settings.dt : settings.tolerance) = fineness;
    if (groups_ == Groups::kCrowds) {
      settings.crowds = {.when = CrowdSettings::When::kAbove, .tolerance = kToleranceOfCrowds * fineness};
    }
    return settings;
  }

  const MethodTraits& traits_;
  Groups groups_;
};

}  // namespace

Contestants ownMethods() {
  Contestants all;
  for (const MethodTraits& traits : kMethods) {
    all.push_back(std::make_unique<OwnMethod>(traits, OwnMethod::Groups::kAsUsual));
  }
  all.push_back(std::make_unique<OwnMethod>(traitsOf(Method::kExact), OwnMethod::Groups::kCrowds));
  return all;
}

}  // namespace careen
