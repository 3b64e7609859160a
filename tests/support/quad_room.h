#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "physics/world/world.h"
#include "support/quad.h"
#include "support/quad_scene.h"
#include "support/taylor_oracle.h"

namespace careen::oracle {

/// One box among frictionless walls, in quadruple precision from impact to impact: Taylor series for
/// rotation, samples and regula falsi for the contact, Fig. 4's impulse at the corner that touches. Shares
/// only the initial values with the engine.
///
/// If several corners touch one wall at once, the impulse acts at their centre: correct by symmetry for an
/// edge or face that lands without rolling along it, and for nothing else.
class QuadRoom {
 public:
  /// The scene's first box; `step` [s] between the samples in the search for contact, shorter than any
  /// penetration of a wall.
  explicit QuadRoom(const QuadScene& scene, double step = 1.0 / 512)
      : walls_(scene.walls), body_(scene.boxes.at(0)), gravity_(scene.gravity), step_(step) {
    state_ = {body_.position, body_.velocity, body_.freeBody()};
  }

  /// The attitude must be the identity. Every initial value is changed by this relative amount, up or down.
  explicit QuadRoom(const World& world, double nudge = 0) : QuadRoom(sceneOf(world, nudge)) {}

  const Quad& time() const { return time_; }

  /// Advances to and through the next impact; returns false, unchanged, if there is none up to the time
  /// `until`.
  bool strike(double until = 1e300) {
    // Doubles find the two samples between which it lies.
    const State<double> rough = state_.rounded();
    const double left = until - static_cast<double>(time_);
    int sample = 1;
    while (lowest(after(rough, sample * step_)).gap >= 0) {
      if (sample * step_ > left) {
        return false;
      }
      ++sample;
    }
    // It must first leave the wall it has just hit.
    const double from = sample == 1 ? step_ / 64 : (sample - 1) * step_;
    const State<Quad> before = after(state_, Quad(from));
    const Quad root = firstTouch(before, sample * step_ - from);
    if (time_ + from + root > until) {
      return false;
    }
    time_ += from + root;
    state_ = after(before, root);
    reflect();
    return true;
  }

  /// The corners at `elapsed` after the last impact, before the next one; in the order of corner().
  std::array<Vector3<Quad>, 8> corners(const Quad& elapsed) const {
    return cornersOf(after(state_, elapsed));
  }
  QuadPose pose(const Quad& elapsed) const {
    const State<Quad> state = after(state_, elapsed);
    return {state.position, normalized(state.rotation.attitude)};
  }

 private:
  template <class Real>
  struct State {
    Vector3<Real> position;
    Vector3<Real> velocity;
    FreeBody<Real> rotation;  // momentum in the body frame

    State<double> rounded() const {
      State<double> state{position.template cast<double>(), velocity.template cast<double>(), {}};
      for (std::size_t i = 0; i < 4; ++i) {
        state.rotation.attitude[i] = static_cast<double>(rotation.attitude[i]);
      }
      for (std::size_t i = 0; i < 3; ++i) {
        state.rotation.moments[i] = static_cast<double>(rotation.moments[i]);
        state.rotation.momentum[i] = static_cast<double>(rotation.momentum[i]);
      }
      return state;
    }
  };
  template <class Real>
  struct Lowest {
    Real gap = 1e30;
    std::size_t wall = 0;
  };

  static QuadScene sceneOf(const World& world, double nudge) {
    const Body& body = world.bodies[0];
    QuadScene scene;
    QuadBox box;
    for (int i = 0; i < 3; ++i) {
      const auto at = static_cast<std::size_t>(i);
      const Quad factor = 1 + Quad(i == 1 ? -nudge : nudge);
      box.position[i] = factor * body.initial.pose.position[i];
      box.velocity[i] = factor * body.initial.velocity[i];
      box.moments.at(at) = body.mass.inertiaBody[i];
      box.momentum.at(at) = factor * body.initial.angularMomentum[i];
    }
    box.halfExtents = body.halfExtents.cast<Quad>();
    box.mass = body.mass.mass;
    box.restitution = body.material.restitution;
    scene.boxes = {box};
    scene.gravity = world.gravity.cast<Quad>();
    for (const Wall& wall : world.walls) {
      scene.walls.push_back(
          {wall.normal.cast<Quad>(), wall.offset, wall.material.restitution, wall.material.friction});
    }
    return scene;
  }

  // The time within `high` [s] at which the lowest corner touches, by the Illinois method (the value at an
  // end kept twice is halved), to the rounding of the lengths whose difference is the gap.
  Quad firstTouch(const State<Quad>& before, Quad high) const {
    const Quad small = Quad(1e-31) * (body_.halfExtents.norm() + Quad(before.position.norm()) / 100);
    Quad low = 0;
    Quad gapLow = lowest(before).gap;
    Quad gapHigh = lowest(after(before, high)).gap;
    Quad root = 0;
    Quad gap = gapLow;
    for (int i = 0; i < 100 && (gap > small || gap < -small); ++i) {
      root = high - gapHigh * (high - low) / (gapHigh - gapLow);
      gap = lowest(after(before, root)).gap;
      if (gap < 0) {
        high = root;
        gapHigh = gap;
        gapLow /= 2;
      } else {
        low = root;
        gapLow = gap;
        gapHigh /= 2;
      }
    }
    return root;
  }

  template <class Real>
  State<Real> after(State<Real> state, const Real& elapsed) const {
    const Vector3<Real> gravity = gravity_.template cast<Real>();
    state.position += elapsed * (state.velocity + elapsed / 2 * gravity);
    state.velocity += elapsed * gravity;
    advance(state.rotation, elapsed);
    return state;
  }

  template <class Real>
  static Matrix3<Real> matrix(const FreeBody<Real>& rotation) {
    const auto& [w, x, y, z] = rotation.attitude;
    Matrix3<Real> m;
    m << w * w + x * x - y * y - z * z, 2 * (x * y - w * z), 2 * (x * z + w * y), 2 * (x * y + w * z),
        w * w - x * x + y * y - z * z, 2 * (y * z - w * x), 2 * (x * z - w * y), 2 * (y * z + w * x),
        w * w - x * x - y * y + z * z;
    return m;
  }

  template <class Real>
  std::array<Vector3<Real>, 8> cornersOf(const State<Real>& state) const {
    const Matrix3<Real> turn = matrix(state.rotation);
    const Vector3<Real> half = body_.halfExtents.template cast<Real>();
    std::array<Vector3<Real>, 8> corners;
    for (unsigned k = 0; k < 8; ++k) {
      const Vector3<Real> inBody((k & 4U) == 0 ? half[0] : -half[0], (k & 2U) == 0 ? half[1] : -half[1],
                                 (k & 1U) == 0 ? half[2] : -half[2]);
      corners[k] = state.position + turn * inBody;
    }
    return corners;
  }

  template <class Real>
  Lowest<Real> lowest(const State<Real>& state) const {
    const std::array<Vector3<Real>, 8> corners = cornersOf(state);
    Lowest<Real> found;
    for (std::size_t w = 0; w < walls_.size(); ++w) {
      const Vector3<Real> normal = walls_[w].normal.template cast<Real>();
      for (std::size_t k = 0; k < corners.size(); ++k) {
        const Real gap = normal.dot(corners[k]) - static_cast<Real>(walls_[w].offset);
        if (gap < found.gap) {
          found = {.gap = gap, .wall = w};
        }
      }
    }
    return found;
  }

  // Centre of the corners that are as low as the lowest.
  Vector3<Quad> middleOfTouch(const Lowest<Quad>& contact) const {
    const QuadWall& wall = walls_[contact.wall];
    const Quad as = Quad(1e-26) * body_.halfExtents.norm();
    Vector3<Quad> sum(Quad(0), Quad(0), Quad(0));
    int count = 0;
    for (const Vector3<Quad>& corner : cornersOf(state_)) {
      if (wall.normal.dot(corner) - wall.offset < contact.gap + as) {
        sum += corner;
        ++count;
      }
    }
    return sum / Quad(count);
  }

  // Computed in the body frame, where the inertia is constant.
  void reflect() {
    const Lowest<Quad> contact = lowest(state_);
    const Matrix3<Quad> turn = matrix(state_.rotation);
    const QuadWall& wall = walls_[contact.wall];
    const Vector3<Quad>& normal = wall.normal;
    const Vector3<Quad> n = turn.transpose() * normal;
    const Vector3<Quad> r = turn.transpose() * (middleOfTouch(contact) - state_.position);
    FreeBody<Quad>& rotation = state_.rotation;
    Vector3<Quad> omega;
    Vector3<Quad> turning = r.cross(n);
    for (int i = 0; i < 3; ++i) {
      const auto at = static_cast<std::size_t>(i);
      omega[i] = rotation.momentum[at] / rotation.moments[at];
      turning[i] /= rotation.moments[at];
    }
    const Quad approach = normal.dot(state_.velocity) + n.dot(omega.cross(r));
    const Quad restitution = wall.restitution > body_.restitution ? wall.restitution : body_.restitution;
    const Quad impulse = -(1 + restitution) * approach / (1 / body_.mass + n.dot(turning.cross(r)));
    state_.velocity += impulse / body_.mass * normal;
    const Vector3<Quad> kick = impulse * r.cross(n);
    for (int i = 0; i < 3; ++i) {
      rotation.momentum[static_cast<std::size_t>(i)] += kick[i];
    }
  }

  std::vector<QuadWall> walls_;
  QuadBox body_;
  Vector3<Quad> gravity_;
  double step_;
  State<Quad> state_;
  Quad time_ = 0;
};

}  // namespace careen::oracle
