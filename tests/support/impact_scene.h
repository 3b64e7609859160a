#pragma once

#include <cmath>
#include <cstdint>
#include <random>
#include <vector>

#include "physics/impact_law.h"
#include "support/quad.h"

namespace careen::testing {

using careen::Quad;
using Quad3 = Vector3<Quad>;

/// Bodies and contacts of one impact, with what a test measures of them in quadruple precision.
struct ImpactScene {
  std::vector<Vec3> halfExtents;
  std::vector<MassProperties> masses;
  std::vector<BodyState> states;
  std::vector<ImpactContact> contacts;
  std::vector<ImpactShare> shares;

  int addBox(const Vec3& half, double mass, const BodyState& state) {
    halfExtents.push_back(half);
    masses.push_back(solidBox(half, mass));
    states.push_back(state);
    return static_cast<int>(states.size()) - 1;
  }
  void addCorner(int body, int cornerIndex, const Vec3& normal, const Material& material) {
    const auto k = static_cast<std::size_t>(body);
    contacts.push_back({.a = body,
                        .b = ImpactContact::kWall,
                        .armA = states[k].pose.worldFromBody * corner(halfExtents[k], cornerIndex),
                        .armB = Vec3::Zero(),
                        .normal = normal,
                        .material = material});
  }
  void resolve() {
    std::vector<ImpactBody> bodies;
    for (std::size_t k = 0; k < states.size(); ++k) {
      bodies.push_back({&masses[k], &states[k]});
    }
    shares.assign(contacts.size(), {});
    resolveImpact(bodies, contacts, shares);
  }

  static Quad3 spin(const MassProperties& mass, const BodyState& state) {
    const Matrix3<Quad> a = state.pose.worldFromBody.cast<Quad>();
    const Quad3 body = a.transpose() * state.angularMomentum.cast<Quad>();
    return a * mass.inverseInertiaBody.cast<Quad>().cwiseProduct(body);
  }
  Quad3 pointVelocity(int body, const Vec3& arm) const {
    const auto k = static_cast<std::size_t>(body);
    return states[k].velocity.cast<Quad>() + spin(masses[k], states[k]).cross(arm.cast<Quad>());
  }
  Quad3 relativeVelocity(const ImpactContact& c) const {
    const Quad3 a = pointVelocity(c.a, c.armA);
    return c.b == ImpactContact::kWall ? a : Quad3(a - pointVelocity(c.b, c.armB));
  }
  double partingSpeed(const ImpactContact& c) const {
    return static_cast<double>(Quad(relativeVelocity(c).dot(c.normal.cast<Quad>())));
  }
  Quad energy() const {
    Quad twice = 0;
    for (std::size_t k = 0; k < states.size(); ++k) {
      const Quad3 v = states[k].velocity.cast<Quad>();
      const Quad3 l = states[k].angularMomentum.cast<Quad>();
      twice += v.dot(v) / Quad(masses[k].inverseMass) + l.dot(spin(masses[k], states[k]));
    }
    return twice / 2;
  }
};

/// Numbers that are the same with every standard library.
class Random {
 public:
  explicit Random(std::uint64_t seed) : engine_(seed) {}
  double between(double low, double high) {
    return low + (high - low) * (static_cast<double>(engine_() >> 11) * 0x1p-53);
  }
  Vec3 inCube(double size) { return {between(-size, size), between(-size, size), between(-size, size)}; }
  Vec3 direction() {
    while (true) {
      const Vec3 v = inCube(1);
      if (v.squaredNorm() < 1 && v.squaredNorm() > 0.01) {
        return v.normalized();
      }
    }
  }
  Mat3 rotation() {
    Mat3 a;
    const Vec3 x = direction();
    const Vec3 y = x.cross(direction()).normalized();
    a << x, y, x.cross(y);
    return a;
  }
  int below(int n) { return static_cast<int>(engine_() % static_cast<std::uint64_t>(n)); }

 private:
  std::mt19937_64 engine_;
};

inline Mat3 aboutZ(double angle) {
  const double c = std::cos(angle);
  const double s = std::sin(angle);
  Mat3 a;
  a << c, -s, 0, s, c, 0, 0, 0, 1;
  return a;
}

}  // namespace careen::testing
