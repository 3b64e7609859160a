#include "physics/contact/manifold_normals.h"

#include <algorithm>
#include <array>

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
    if (!features[c].b.isWall() && (pushing.empty() || pushing[c] != 0)) {
      const auto [first, second] = std::minmax({features[c].a, features[c].b.body()});
      ofPairs_.push_back({first, second, c});
    }
  }
  if (ofPairs_.size() < 2) {
    return;
  }
  before_.assign(contacts.begin(), contacts.end());
  std::sort(ofPairs_.begin(), ofPairs_.end());
  for (auto begin = ofPairs_.begin(); begin != ofPairs_.end();) {
    const auto end = std::find_if(begin, ofPairs_.end(), [&](const OfPair& each) {
      return each.first != begin->first || each.second != begin->second;
    });
    alignPair(std::span(begin, end), features, contacts);
    begin = end;
  }
}

void ManifoldNormals::alignPair(std::span<const OfPair> pair, std::span<const ContactFeature> features,
                                std::span<ContactState> contacts) const {
  std::vector<std::array<double, 6>> different;  // normals and their rates
  for (const OfPair& of : pair) {
    const std::size_t c = of.contact;
    different.clear();
    for (const OfPair& other : pair) {
      const std::size_t k = other.contact;
      const double sign = features[k].a == features[c].a ? 1 : -1;
      const Vec3 normal = sign * before_[k].normal;
      const Vec3 rate = sign * before_[k].normalRate;
      const std::array<double, 6> parts{normal[0], normal[1], normal[2], rate[0], rate[1], rate[2]};
      if (dot(normal, before_[c].normal) >= kParallel &&
          std::find(different.begin(), different.end(), parts) == different.end()) {
        different.push_back(parts);
      }
    }
    if (different.size() > 1) {
      const std::array<double, 6> sum = orderFreeSums<6>(different);
      const double part = 1 / static_cast<double>(different.size());
      contacts[c].setNormal(Vec3(sum[0], sum[1], sum[2]).normalized(), part * Vec3(sum[3], sum[4], sum[5]));
    }
  }
}

}  // namespace careen
