#include "study/force_plot.h"

#include <algorithm>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "core/brief.h"
#include "trajectory/force_samples.h"
#include "trajectory/pose_samples.h"

namespace careen {
namespace {

constexpr int kDigits = 9;

/// What one pushes the other with at a moment.
struct PushOfPair {
  double normal = 0;             // [N] along the normals, all together
  Vec3 friction = Vec3::Zero();  // [N]
};
using PushesOfPair = std::map<std::size_t, PushOfPair>;  // by moment

}  // namespace

Plot forcePlot(const Trajectory& run, double every) {
  const std::vector<double> times = sampleTimes(run, every);
  const ForceSamples samples(run);
  std::map<std::pair<int, Partner>, PushesOfPair> pairs;
  for (std::size_t k = 0; k < times.size(); ++k) {
    for (const ContactPush& push : samples.at(times[k])) {
      if (push.b) {
        const double along = dot(push.normal, push.force);
        PushOfPair& now = pairs[{push.a.value, *push.b}][k];
        now.normal += along;
        now.friction += push.force - along * push.normal;
      }
    }
  }
  std::vector<std::pair<double, std::pair<int, Partner>>> order;
  for (const auto& [pair, pushes] : pairs) {
    double sum = 0;
    for (const auto& [moment, push] : pushes) {
      sum += push.normal;
    }
    order.emplace_back(-sum, pair);
  }
  std::sort(order.begin(), order.end());
  order.resize(std::min(order.size(), kMostPlottedPairs));

  Plot plot{.script = "forces.gp", .texts = {"Forces of contact"}, .data = {}};
  for (std::size_t n = 0; n < order.size(); ++n) {
    const auto& [a, b] = order[n].second;
    plot.texts.push_back(run.world.bodies[static_cast<std::size_t>(a)].name + " on " +
                         partnerName(run, {.a = {a}, .b = b}));
    const PushesOfPair& pushes = pairs[order[n].second];
    for (std::size_t k = 0; k < times.size(); ++k) {
      const auto found = pushes.find(k);
      const PushOfPair push = found == pushes.end() ? PushOfPair{} : found->second;
      plot.data += std::to_string(n + 1) + '\t' + brief(times[k], kDigits) + '\t' +
                   brief(push.normal, kDigits) + '\t' + brief(push.friction.norm(), kDigits) + '\n';
    }
  }
  return plot;
}

}  // namespace careen
