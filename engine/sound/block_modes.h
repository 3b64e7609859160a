#pragma once

#include <cstddef>
#include <vector>

#include "core/math/linear_algebra.h"
#include "stage/sound_material.h"

namespace careen {

/// One way in which a free block vibrates by itself.
struct BlockMode {
  enum class Kind {
    kBending,       ///< of its length `along`, in the direction `across`
    kTorsion,       ///< about `along`
    kLongitudinal,  ///< along `along`
    kBody           ///< the block as a whole moves air to and fro
  };
  Kind kind = Kind::kBending;
  int along = 0;  ///< axis of the block
  int across = 0;
  int order = 1;         ///< from 1
  double frequency = 0;  ///< [Hz]
  double damping = 0;    ///< [1] loss factor
};

/// Poisson's ratio of everything.
inline constexpr double kPoisson = 0.3;
/// [m/s], [kg/m³] in air.
inline constexpr double kSpeedOfSound = 343;
inline constexpr double kAirDensity = 1.2;

/// The lowest modes of a free rectangular block, by ascending frequency, not above `highest` [Hz], at most
/// `most`. Bending: Euler and Bernoulli's free-free beam, βₙ² h / (2 π L² √12) √(E/ρ), whose compliance and
/// that of shear, n/(2 L) √(5/6 G/ρ), are added (Dunkerley's estimate: a lower bound, as stubby blocks need);
/// torsion n/(2 L) √(G K/(ρ I)), Saint-Venant's; longitudinal n/(2 L) √(E/ρ) (N. H. Fletcher, T. D. Rossing,
/// The Physics of Musical Instruments, ch. 2). `half` [m].
std::vector<BlockMode> modesOf(const Vec3& half, const SoundMaterial& material, double highest,
                               std::size_t most);

/// How fast [m/s], as a mean over its surface, a mode moves just after an impulse [N s] at a point [m], both
/// in the block's frame. Of either sign. `mass` [kg].
double excitation(const BlockMode& mode, const Vec3& half, double mass, const Vec3& point,
                  const Vec3& impulse);

}  // namespace careen
