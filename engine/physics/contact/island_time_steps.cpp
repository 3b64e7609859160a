#include "physics/contact/island_time_steps.h"

#include <algorithm>

namespace careen {
namespace {

/// Time steps where no smooth motion was found, before it is tried again.
constexpr int kFewTimeSteps = 8;
/// Time steps before it is asked whether the bodies rest.
constexpr int kBeforeRest = 16;

}  // namespace

IslandTimeSteps::IslandTimeSteps(const World& world, const std::vector<TouchingBody>& bodies,
                                 double tolerance, int count, std::span<const ContactFeature> joints)
    : stepper_(world, bodies, tolerance, joints), left_(std::max(count, kFewTimeSteps)) {}

bool IslandTimeSteps::take(double most, double mostWork) {
  workBefore_ = stepper_.equations().work();
  stepper_.step(most, mostWork);
  --left_;
  ++taken_;
  quiet_ = taken_ >= kBeforeRest && stepper_.isQuiet();
  return left_ > 0 && !quiet_;
}

double IslandTimeSteps::work() const {
  return stepper_.equations().work() - workBefore_ +
         kWorkOfGeometry * static_cast<double>(stepper_.equations().group().boxes());
}

}  // namespace careen
