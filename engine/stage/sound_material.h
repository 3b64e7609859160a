#pragma once

#include <array>
#include <string_view>

namespace careen {

/// What a body sounds like when it is struck.
struct SoundMaterial {
  double modulus = 11e9;   ///< [Pa] Young's
  double density = 600;    ///< [kg/m³] for the sound alone; masses are the scene's
  double damping = 0.025;  ///< [1] loss factor: part of its energy, over 2π, that a mode loses in a period
  bool operator==(const SoundMaterial&) const = default;
};

struct NamedSoundMaterial {
  std::string_view name;
  SoundMaterial material;
};
/// Round values: beech, marble, steel, acrylic glass.
inline constexpr std::array<NamedSoundMaterial, 4> kSoundMaterials = {{{"wood", {}},
                                                                       {"stone", {50e9, 2700, 0.008}},
                                                                       {"metal", {200e9, 7850, 0.001}},
                                                                       {"plastic", {3e9, 1200, 0.04}}}};
/// Of walls and floors that say nothing; of boxes it is wood.
inline constexpr SoundMaterial kSoundOfWalls = kSoundMaterials[1].material;

}  // namespace careen
