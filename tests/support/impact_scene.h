#pragma once

#include <cmath>
#include <cstdint>
#include <random>
#include <vector>

#include "physics/impact/impact_law.h"
#include "support/quad.h"

namespace careen::test {

using careen::Quad;
using Quad3 = Vector3<Quad>;

/// Bodies and contacts of one impact, and what a test measures of them in quadruple precision.
struct ImpactScene {
  std::vector<Vec3> halfExtents;
  std::vector<MassProperties> masses;
  std::vector<BodyState> states;
  std::vector<ImpactContact> contacts;
  std::vector<ImpactShare> shares;

  /// The walls: one more body, that cannot move.
  int wall() const { return static_cast<int>(states.size()); }
  int addBox(const Vec3& half, double mass, const BodyState& state) {
    halfExtents.push_back(half);
    masses.push_back(solidBox(half, mass));
    states.push_back(state);
    return static_cast<int>(states.size()) - 1;
  }
  void addCorner(int body, int cornerIndex, const Vec3& normal, const Material& material) {
    const auto k = static_cast<std::size_t>(body);
    contacts.push_back({.a = body,
                        .b = wall(),
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
    BodyState still;
    bodies.push_back({&bodyOfWalls().mass, &still});
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
    return c.b == wall() ? a : Quad3(a - pointVelocity(c.b, c.armB));
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

inline double relativeChange(const Quad& after, const Quad& before) {
  return static_cast<double>(Quad((after - before) / before));
}

/// A cube of half size `half` on a floor, standing on its four lower corners (odd indices), rotated about z.
inline ImpactScene flatCube(double angle, double restitution, double friction, const Vec3& velocity,
                            const Vec3& half = Vec3(0.5, 0.5, 0.5), double mass = 2) {
  ImpactScene scene;
  BodyState state;
  state.pose.worldFromBody = aboutZ(angle);
  state.velocity = velocity;
  scene.addBox(half, mass, state);
  for (const int k : {1, 3, 5, 7}) {
    scene.addCorner(0, k, Vec3::UnitZ(), {.restitution = restitution, .friction = friction});
  }
  return scene;
}

/// A rotating box driven with its corner 7 into the corner of a room: each of the four corners of the three
/// faces there touches its wall, as if the box stood in the corner.
inline ImpactScene roomCorner(Random& random, double restitution) {
  ImpactScene scene;
  BodyState state;
  state.velocity = random.inCube(3) - Vec3(2, 2, 2);
  const Vec3 half{random.between(.1, 1), random.between(.1, 1), random.between(.1, 1)};
  const int box = scene.addBox(half, random.between(.5, 5), state);
  scene.states[0].angularMomentum = scene.masses[0].inertiaBody.cwiseProduct(random.inCube(3));
  for (int axis = 0; axis < 3; ++axis) {
    for (int k = 0; k < kCorners; ++k) {
      if (((k >> (2 - axis)) & 1) != 0) {
        scene.addCorner(box, k, Vec3(Vec3::Unit(axis)), {.restitution = restitution, .friction = 0});
      }
    }
  }
  return scene;
}

/// One or two free boxes with up to `most` random contact points, normals in a common half-space.
inline ImpactScene randomImpact(Random& random, int most, bool friction) {
  ImpactScene scene;
  const int bodies = 1 + random.below(2);
  for (int k = 0; k < bodies; ++k) {
    BodyState state;
    state.pose.worldFromBody = random.rotation();
    state.velocity = random.inCube(4);
    const Vec3 half{random.between(.05, 1), random.between(.05, 1), random.between(.05, 1)};
    scene.addBox(half, random.between(.1, 10), state);
    const Vec3 spin = state.pose.worldFromBody.transpose() * random.inCube(6);
    scene.states.back().angularMomentum =
        state.pose.worldFromBody * scene.masses.back().inertiaBody.cwiseProduct(spin);
  }
  const int count = 1 + random.below(most);
  const Vec3 common = random.direction();
  for (int k = 0; k < count; ++k) {
    Vec3 normal = (common + 0.8 * random.direction()).normalized();
    const bool wall = bodies == 1 || random.below(3) == 0;
    const int a = wall ? random.below(bodies) : 0;
    const int index =
        random.below(kCorners);  // a variable, because compilers evaluate arguments in any order
    const Material material{.restitution = random.below(4) == 0 ? 1 : random.between(0, 1),
                            .friction = friction ? random.between(0, 1.5) : 0};
    scene.addCorner(a, index, normal, material);
    if (!wall) {
      scene.contacts.back().b = 1;
      scene.contacts.back().armB =
          scene.states[1].pose.worldFromBody * corner(scene.halfExtents[1], random.below(8));
    }
  }
  return scene;
}

inline bool sameBits(const BodyState& a, const BodyState& b) {
  return a.velocity == b.velocity && a.angularMomentum == b.angularMomentum;
}

}  // namespace careen::test
