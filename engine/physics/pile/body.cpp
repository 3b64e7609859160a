#include "physics/pile/body.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "physics/attitude/free_splitting.h"

namespace careen {
namespace {

constexpr double kLongTurn = 0.5;        // [rad] in one substep
constexpr double kTurnPerStrang = 0.25;  // [rad]
constexpr double kMostStrang = 1024;     // steps: beyond, the rotation is inaccurate but finite

// (cos θ/2, θ/|θ| sin θ/2), |θ| ≤ 1: the omitted terms are below 1e-12.
Quat turnOf(const Vec3& theta) {
  const double z = 0.25 * theta.squaredNorm();
  const double cos = 1 - z * (1.0 / 2 - z * (1.0 / 24 - z * (1.0 / 720 - z * (1.0 / 40320))));
  const double sin = 1 - z * (1.0 / 6 - z * (1.0 / 120 - z * (1.0 / 5040 - z * (1.0 / 362880))));
  const Vec3 v = (0.5 * sin) * theta;
  return {cos, v.x(), v.y(), v.z()};
}

}  // namespace

const CoursePart kStillPart;

void setAttitude(PileBody& body, const Quat& attitude) {
  body.attitude = unit<double>(attitude);
  body.axes = body.attitude.toRotationMatrix();
  deriveOmega(body);
}

PileBody pileBody(const Body& body, const BodyState& state) {
  PileBody result;
  result.halfExtents = body.halfExtents;
  result.center = body.boxCenter.isZero(0) ? nullptr : &body.boxCenter;
  result.parts = body.parts.empty() ? nullptr : &body.parts;
  result.radius = radiusOf(body);
  result.length = 2 * body.thinnest();
  result.inverseMass = body.mass.inverseMass;
  result.inertiaBody = body.mass.inertiaBody;
  result.inverseInertiaBody = body.mass.inverseInertiaBody;
  result.bodyFromPrincipal = body.mass.turned ? &body.mass.bodyFromPrincipal : nullptr;
  result.material = body.material;
  result.position = state.pose.position;
  result.attitude = Quat(state.pose.worldFromBody).normalized();
  result.axes = state.pose.worldFromBody;
  result.velocity = state.velocity;
  result.angularMomentum = state.angularMomentum;
  result.drivenBy = isImmovable(body.mass) ? &kStillPart : nullptr;
  if (result.held()) {
    result.velocity = Vec3::Zero();
    result.angularMomentum = Vec3::Zero();
  }
  deriveOmega(result);
  return result;
}

void putDriven(PileBody& body, double time) {
  const Kinematics now = body.drivenBy->at(time);
  body.position = now.pose.position;
  body.attitude = unit<double>(Quat(now.pose.worldFromBody));
  body.axes = body.attitude.toRotationMatrix();
}

PileBody pileBody(const Wall& wall, double time) {
  PileBody result;
  result.halfSpace = &wall;
  result.length = std::numeric_limits<double>::infinity();
  result.material = wall.material;
  result.drivenBy = &kStillPart;
  if (!wall.course.empty()) {
    const CoursePart& part = partAt(wall.course, time);
    result.drivenBy = &part;
    putDriven(result, time);
    result.drivenBy = part.motion.moves() ? &part : &kStillPart;
  }
  return result;
}

PileBox boxOf(const PileBody& body, int box, const Pose& pose) {
  PileBox result{.halfSpace = body.halfSpace,
                 .halfExtents = body.halfExtents,
                 .center = body.center,
                 .position = pose.position,
                 .axes = pose.worldFromBody};
  if (body.parts != nullptr) {
    const BodyPart& part = (*body.parts)[static_cast<std::size_t>(box)];
    result.halfExtents = part.halfExtents;
    result.center = part.center.isZero(0) ? nullptr : &part.center;
    result.axes = part.ownAxes(pose.worldFromBody);
  }
  return result;
}

PileBox boxOf(const PileBody& body, int box) { return boxOf(body, box, {body.position, body.axes}); }

BodyState stateOf(const PileBody& body) {
  return {.pose = {.position = body.position, .worldFromBody = body.axes},
          .velocity = body.velocity,
          .angularMomentum = body.angularMomentum};
}

void deriveOmega(PileBody& body) {
  const Mat3 axes = body.principalAxes();
  const Vec3 momentum = axes.transpose() * body.angularMomentum;
  body.omega = axes * body.inverseInertiaBody.cwiseProduct(momentum);
}

void turnFree(PileBody& body, double h) {
  const Vec3 m = body.principalAxes().transpose() * body.angularMomentum;
  const Vec3 omega = body.inverseInertiaBody.cwiseProduct(m);
  const double angle = omega.norm() * h;
  if (angle > kLongTurn) {
    const bool turned = body.bodyFromPrincipal != nullptr;
    const Quat principal = turned ? Quat(*body.bodyFromPrincipal) : Quat::Identity();
    FreeState<double> state{turned ? body.attitude * principal : body.attitude, m};
    const double steps = std::min(1 + angle / kTurnPerStrang, kMostStrang);
    const auto count = static_cast<std::int64_t>(steps);
    strangSteps<double>(body.inertiaBody, state, h / static_cast<double>(count), count);
    setAttitude(body, turned ? state.worldFromBody * principal.conjugate() : state.worldFromBody);
    return;
  }
  const Vec3 mRate = m.cross(omega);
  const Vec3 rate = body.inverseInertiaBody.cwiseProduct(mRate);
  const Vec3 rateOfRate = body.inverseInertiaBody.cwiseProduct(mRate.cross(omega) + m.cross(rate));
  const Vec3 theta =
      h * (omega + h * (0.5 * rate + h * (rateOfRate * (1.0 / 6) + omega.cross(rate) * (1.0 / 12))));
  setAttitude(body,
              body.attitude *
                  turnOf(body.bodyFromPrincipal == nullptr ? theta : Vec3(*body.bodyFromPrincipal * theta)));
}

Vec3 freeSpinRate(const PileBody& body, const Vec3& omega) {
  const Mat3 axes = body.principalAxes();
  const Vec3 spin = axes.transpose() * omega;
  return axes * body.inverseInertiaBody.cwiseProduct(body.inertiaBody.cwiseProduct(spin).cross(spin));
}

Vec3 spinBetween(const Quat& from, const Quat& to, double length) {
  const Quat turn = from.conjugate() * to;
  const double z = turn.vec().squaredNorm();
  const double angle = 2 * (1 + z * (1.0 / 6 + z * (3.0 / 40 + z * (15.0 / 336))));
  return (turn.w() < 0 ? -angle : angle) / length * turn.vec();
}

void turnBy(PileBody& body, const Vec3& rotation) { setAttitude(body, turnOf(rotation) * body.attitude); }

}  // namespace careen
