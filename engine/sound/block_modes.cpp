#include "sound/block_modes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>

#include "core/math/elementary.h"

namespace careen {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr int kOrders = 6;            // of each kind
constexpr double kBodyDamping = 0.5;  // [1] a thud is no tone

// Roots of cosh β cos β = 1; from the fifth on (n + ½) π to 1e-7 and less.
double bendingRoot(int order) {
  constexpr std::array<double, 4> kRoots = {4.730040744862704, 7.853204624095838, 10.995607838001671,
                                            14.137165491257464};
  return order <= 4 ? kRoots.at(static_cast<std::size_t>(order) - 1) : (order + 0.5) * kPi;
}

double speedOfRod(const SoundMaterial& material) { return std::sqrt(material.modulus / material.density); }
double speedOfShear(const SoundMaterial& material) {
  return speedOfRod(material) / std::sqrt(2 * (1 + kPoisson));
}

double bendingFrequency(double length, double thickness, int order, const SoundMaterial& material) {
  const double root = bendingRoot(order);
  const double beam =
      root * root * thickness / (2 * kPi * length * length * std::sqrt(12.0)) * speedOfRod(material);
  const double shear = order / (2 * length) * std::sqrt(5.0 / 6) * speedOfShear(material);
  return beam * shear / std::sqrt(beam * beam + shear * shear);
}

double torsionFrequency(double length, double a, double b, int order, const SoundMaterial& material) {
  const double wide = std::max(a, b);
  const double thin = std::min(a, b);
  const double flat = thin / wide;
  // Saint-Venant's torsion constant of a rectangle, to 4 %, over its polar moment.
  const double stiffness =
      wide * thin * thin * thin * (1.0 / 3 - 0.21 * flat * (1 - flat * flat * flat * flat / 12));
  const double inertia = wide * thin * (wide * wide + thin * thin) / 12;
  return order / (2 * length) * speedOfShear(material) * std::sqrt(stiffness / inertia);
}

// The shape of a free-free beam at x, 0 … 1 along it: 2 at its ends, its square 1 in the mean.
double bendingShape(int order, double x) {
  const double root = bendingRoot(order);
  const auto cosh = [](double u) { return 0.5 * (elementary::exp(u) + elementary::exp(-u)); };
  const auto sinh = [](double u) { return 0.5 * (elementary::exp(u) - elementary::exp(-u)); };
  const auto end = elementary::sinCos(root);
  const auto here = elementary::sinCos(root * x);
  const double ratio = (cosh(root) - end.cos) / (sinh(root) - end.sin);
  return cosh(root * x) + here.cos - ratio * (sinh(root * x) + here.sin);
}

}  // namespace

std::vector<BlockMode> modesOf(const Vec3& half, const SoundMaterial& material, double highest,
                               std::size_t most) {
  const Vec3 side = 2 * half;
  std::vector<BlockMode> modes = {{.kind = BlockMode::Kind::kBody,
                                   .frequency = kSpeedOfSound / (2 * side.maxCoeff()),
                                   .damping = kBodyDamping}};
  const auto add = [&](BlockMode::Kind kind, int along, int across, int order, double frequency) {
    modes.push_back({.kind = kind,
                     .along = along,
                     .across = across,
                     .order = order,
                     .frequency = frequency,
                     .damping = material.damping});
  };
  for (int along = 0; along < 3; ++along) {
    const int b = (along + 1) % 3;
    const int c = (along + 2) % 3;
    for (int order = 1; order <= kOrders; ++order) {
      for (const int across : {b, c}) {
        // A block bends in its longer direction.
        if (side[along] > side[across] || (side[along] == side[across] && along < across)) {
          add(BlockMode::Kind::kBending, along, across, order,
              bendingFrequency(side[along], side[across], order, material));
        }
      }
      add(BlockMode::Kind::kTorsion, along, b, order,
          torsionFrequency(side[along], side[b], side[c], order, material));
      add(BlockMode::Kind::kLongitudinal, along, along, order,
          order * speedOfRod(material) / (2 * side[along]));
    }
  }
  std::stable_sort(modes.begin(), modes.end(),
                   [](const BlockMode& a, const BlockMode& b) { return a.frequency < b.frequency; });
  std::erase_if(modes, [&](const BlockMode& mode) { return mode.frequency > highest; });
  modes.resize(std::min(modes.size(), most));
  return modes;
}

double excitation(const BlockMode& mode, const Vec3& half, double mass, const Vec3& point,
                  const Vec3& impulse) {
  const auto along = mode.along;
  const double x = std::clamp(0.5 * (point[along] / half[along] + 1), 0.0, 1.0);
  const double wave = elementary::sinCos(mode.order * kPi * x).cos;
  switch (mode.kind) {
    case BlockMode::Kind::kBending:
      return impulse[mode.across] * bendingShape(mode.order, x) / mass;
    case BlockMode::Kind::kTorsion: {
      // The square of the angle is a half in the mean, that of the distance from the axis the radius of
      // gyration's.
      const Vec3 axis = Vec3::Unit(along);
      const double gyration = std::sqrt((half.squaredNorm() - half[along] * half[along]) / 3);
      return std::numbers::sqrt2 * axis.cross(point).dot(impulse) * wave / (gyration * mass);
    }
    case BlockMode::Kind::kLongitudinal:
      return std::numbers::sqrt2 * impulse[along] * wave / mass;
    case BlockMode::Kind::kBody:
      break;
  }
  return impulse.norm() / mass;
}

}  // namespace careen
