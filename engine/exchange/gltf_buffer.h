#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <span>
#include <string>
#include <vector>

#include "core/math/linear_algebra.h"

namespace careen {

/// In single precision; quaternions as x y z w, as glTF has them.
std::array<float, 3> floatsOf(const Vec3& value);
std::array<float, 4> floatsOf(const Quat& value);
template <class Value>
void appendFloats(std::vector<float>& numbers, const Value& value) {
  const auto floats = floatsOf(value);
  numbers.insert(numbers.end(), floats.begin(), floats.end());
}

/// The binary part of a glTF 2.0 file, with its views and accessors.
class GltfBuffer {
 public:
  enum class Kind { kScalar, kVec3, kVec4 };

  /// Numbers of single precision; returns the accessor's index. `bounded` states the smallest and largest
  /// components, as positions of vertices and times of keys must. `target`: 34962 for vertices, 0 for keys.
  std::size_t addFloats(Kind kind, const std::vector<float>& numbers, bool bounded, int target = 0);
  /// Indices of vertices.
  std::size_t addIndices(const std::vector<std::uint16_t>& indices);

  /// Adds bufferViews, accessors and buffers to the document and packs both (glTF 2.0, 4.4: GLB). InputError
  /// beyond 2 GiB, which readers do not take.
  std::string pack(nlohmann::ordered_json document) const;

 private:
  std::size_t addView(std::size_t offset, int target);

  struct Accessor {
    std::size_t view = 0;
    int componentType = 0;
    std::size_t count = 0;
    std::string type;
    std::vector<float> min;
    std::vector<float> max;
  };
  struct View {
    std::size_t offset = 0;
    std::size_t length = 0;
    int target = 0;
  };
  std::string bytes_;
  std::vector<View> views_;
  std::vector<Accessor> accessors_;
};

}  // namespace careen
