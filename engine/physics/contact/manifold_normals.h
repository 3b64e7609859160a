#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "physics/contact/contact_feature.h"

namespace careen {

/// Points of one manifold lie on faces of either body, which are parallel only to within the tolerance. Given
/// one normal, the mean of theirs, their conditions agree exactly: else a problem asks which of them part by
/// a billionth of a speed, and only enormous forces solve it.
class ManifoldNormals {
 public:
  /// Aligns the normals of `contacts`, the states of `features` at one moment: of those that push, all if
  /// `pushing` is empty. One that opens says nothing of where the faces are.
  void align(std::span<const ContactFeature> features, std::span<const char> pushing,
             std::span<ContactState> contacts);

 private:
  struct OfPair {  // a contact of two bodies, by which of them they are
    int first = 0;
    int second = 0;
    std::size_t contact = 0;
    auto operator<=>(const OfPair&) const = default;
  };
  void alignPair(std::span<const OfPair> pair, std::span<const ContactFeature> features,
                 std::span<ContactState> contacts);

  /// A normal and its rate.
  using Turning = std::array<double, 6>;

  std::vector<Turning> before_;     // by contact
  std::vector<Turning> different_;  // of them, those parallel to one
  std::vector<OfPair> ofPairs_;     // sorted
};

}  // namespace careen
