#include "physics/contact/manifold_normals.h"

#include <algorithm>
#include <functional>

#include "core/math/order_free_sum.h"

namespace careen {
namespace {

/// [1] Cosine of the angle of two normals that count as one: what the tolerance allows for a thin box.
constexpr double kParallel = 1 - 0x1p-27;

}  // namespace

void ManifoldNormals::align(std::span<const ContactFeature> features, std::span<const char> pushing,
                            std::span<ContactState> contacts) {
  ofPairs_.clear();
  for (std::size_t c = 0; c < features.size(); ++c) {
    if (features[c].kind != ContactFeature::Kind::kPointOnWall && !features[c].isOfJoint() &&
        (pushing.empty() || pushing[c] != 0)) {
      const auto [first, second] = std::minmax({features[c].a, features[c].b});
      ofPairs_.push_back({first, second, c});
    }
  }
  if (ofPairs_.size() < 2) {
    return;
  }
  before_.clear();
  for (const ContactState& at : contacts) {
    const Vec3& n = at.normal;
    const Vec3& rate = at.normalRate;
    before_.push_back({n[0], n[1], n[2], rate[0], rate[1], rate[2]});
  }
  std::sort(ofPairs_.begin(), ofPairs_.end());
  for (auto begin = ofPairs_.begin(); begin != ofPairs_.end();) {
    const auto end = std::find_if(begin, ofPairs_.end(), [&](const OfPair& each) {
      return each.first != begin->first || each.second != begin->second;
    });
    alignPair({&*begin, static_cast<std::size_t>(end - begin)}, features, contacts);
    begin = end;
  }
}

void ManifoldNormals::alignPair(std::span<const OfPair> pair, std::span<const ContactFeature> features,
                                std::span<ContactState> contacts) {
  for (const OfPair& of : pair) {
    const std::size_t c = of.contact;
    different_.clear();
    for (const OfPair& other : pair) {
      const std::size_t k = other.contact;
      Turning turning = before_[k];
      if (features[k].a != features[c].a) {
        std::transform(turning.begin(), turning.end(), turning.begin(), std::negate());
      }
      if (dot(Vec3(turning[0], turning[1], turning[2]), contacts[c].normal) >= kParallel &&
          std::find(different_.begin(), different_.end(), turning) == different_.end()) {
        different_.push_back(turning);
      }
    }
    if (different_.size() > 1) {
      const Turning sum = orderFreeSums<6>(different_);
      const double part = 1 / static_cast<double>(different_.size());
      contacts[c].setNormal(Vec3(sum[0], sum[1], sum[2]).normalized(), part * Vec3(sum[3], sum[4], sum[5]));
    }
  }
}

}  // namespace careen
