#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "physics/world.h"
#include "support/quad.h"
#include "support/taylor_oracle.h"

namespace careen::oracle {

/// One box among walls without friction, followed in quadruple precision from impact to impact: Taylor series
/// for the turning, samples and regula falsi for the contact, Fig. 4's impulse at the corner that touches.
/// Shares nothing with the engine but the numbers of the start, whose attitude is the identity.
class QuadRoom {
 public:
  /// Every number of the start is changed by this part of itself, up or down.
  explicit QuadRoom(const World& world, double nudge = 0)
      : walls_(world.walls), body_(world.bodies[0]), gravity_(world.gravity) {
    const Body& body = world.bodies[0];
    for (int i = 0; i < 3; ++i) {
      const auto at = static_cast<std::size_t>(i);
      const Quad factor = 1 + Quad(i == 1 ? -nudge : nudge);
      state_.position[i] = factor * body.initial.pose.position[i];
      state_.velocity[i] = factor * body.initial.velocity[i];
      state_.rotation.moments[at] = body.mass.inertiaBody[i];
      state_.rotation.momentum[at] = factor * body.initial.angularMomentum[i];
    }
    state_.rotation.attitude = {1, 0, 0, 0};
  }

  const Quad& time() const { return time_; }

  /// On to the next impact, and through it.
  void strike() {
    // Doubles tell between which two samples it is.
    const State<double> rough = state_.rounded();
    int sample = 1;
    while (lowest(after(rough, sample * kStep)).gap >= 0) {
      ++sample;
    }
    // It leaves first what it has just struck.
    const double from = sample == 1 ? kStep / 64 : (sample - 1) * kStep;
    state_ = after(state_, Quad(from));
    time_ += from;
    Quad low = 0;
    Quad high = sample * kStep - from;
    Quad gapLow = lowest(state_).gap;
    Quad gapHigh = lowest(after(state_, high)).gap;
    Quad root = 0;
    for (Quad gap = gapLow; gap > 1e-31 || gap < -1e-31;) {
      // Illinois: the end that stays twice counts half.
      root = high - gapHigh * (high - low) / (gapHigh - gapLow);
      gap = lowest(after(state_, root)).gap;
      if (gap < 0) {
        high = root;
        gapHigh = gap;
        gapLow /= 2;
      } else {
        low = root;
        gapLow = gap;
        gapHigh /= 2;
      }
      if (!(high - low > 1e-32)) {
        break;
      }
    }
    time_ += root;
    state_ = after(state_, root);
    reflect();
  }

  /// The corners `elapsed` after the last impact, which must be before the next; in the order of corner().
  std::array<Vector3<Quad>, 8> corners(const Quad& elapsed) const {
    return cornersOf(after(state_, elapsed));
  }

 private:
  static constexpr double kStep = 1.0 / 512;  // [s]

  template <class Real>
  struct State {
    Vector3<Real> position;
    Vector3<Real> velocity;
    FreeBody<Real> rotation;  // momentum in the body's frame

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
    std::size_t corner = 0;
  };

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
    std::array<Vector3<Real>, 8> corners;
    for (unsigned k = 0; k < 8; ++k) {
      const Vec3 inBody((k & 4U) == 0 ? body_.halfExtents[0] : -body_.halfExtents[0],
                        (k & 2U) == 0 ? body_.halfExtents[1] : -body_.halfExtents[1],
                        (k & 1U) == 0 ? body_.halfExtents[2] : -body_.halfExtents[2]);
      corners[k] = state.position + turn * inBody.cast<Real>();
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
        const Real gap = normal.dot(corners[k]) - Real(walls_[w].offset);
        if (gap < found.gap) {
          found = {.gap = gap, .wall = w, .corner = k};
        }
      }
    }
    return found;
  }

  // In the body's frame, where the inertia is constant.
  void reflect() {
    const Lowest<Quad> contact = lowest(state_);
    const Matrix3<Quad> turn = matrix(state_.rotation);
    const Vector3<Quad> normal = walls_[contact.wall].normal.cast<Quad>();
    const Vector3<Quad> n = turn.transpose() * normal;
    const Vector3<Quad> r = turn.transpose() * (cornersOf(state_)[contact.corner] - state_.position);
    FreeBody<Quad>& rotation = state_.rotation;
    Vector3<Quad> omega;
    Vector3<Quad> turning = r.cross(n);
    for (int i = 0; i < 3; ++i) {
      const auto at = static_cast<std::size_t>(i);
      omega[i] = rotation.momentum[at] / rotation.moments[at];
      turning[i] /= rotation.moments[at];
    }
    const Quad approach = normal.dot(state_.velocity) + n.dot(omega.cross(r));
    const Quad impulse = -2 * approach / (1 / Quad(body_.mass.mass) + n.dot(turning.cross(r)));
    state_.velocity += impulse / Quad(body_.mass.mass) * normal;
    const Vector3<Quad> kick = impulse * r.cross(n);
    for (int i = 0; i < 3; ++i) {
      rotation.momentum[static_cast<std::size_t>(i)] += kick[i];
    }
  }

  std::vector<Wall> walls_;
  Body body_;
  Vec3 gravity_;
  State<Quad> state_;
  Quad time_ = 0;
};

}  // namespace careen::oracle
