#include "scene/sound_shape.h"

#include <algorithm>
#include <iterator>
#include <string_view>
#include <vector>

namespace careen {
namespace {

// So that no frequency of a box from a micrometre to a thousand kilometres is out of all bounds.
constexpr NumberRange kModulus = {.min = 1, .max = 1e15, .unit = "Pa", .plain = "a number from 1 to 1e15"};
constexpr NumberRange kDensity = {
    .min = 1e-3, .max = 1e6, .unit = "kg/m³", .plain = "a number from 0.001 to 1e6"};
constexpr NumberRange kDamping = {.min = 1e-6, .max = 1, .plain = "a number from 1e-6 to 1"};

}  // namespace

std::optional<SoundMaterial> readSound(const JsonObject& object) {
  const std::optional<JsonValue> value = object.find("material");
  if (!value) {
    return std::nullopt;
  }
  if (value->is(JsonNode::Kind::kObject)) {
    const JsonObject numbers = value->object({"modulus", "density", "damping"});
    return SoundMaterial{.modulus = numbers.require("modulus").number(kModulus),
                         .density = numbers.require("density").number(kDensity),
                         .damping = numbers.require("damping").number(kDamping)};
  }
  std::vector<std::string_view> names;
  std::transform(kSoundMaterials.begin(), kSoundMaterials.end(), std::back_inserter(names),
                 [](const NamedSoundMaterial& each) { return each.name; });
  return kSoundMaterials.at(value->word(names, "material")).material;
}

}  // namespace careen
