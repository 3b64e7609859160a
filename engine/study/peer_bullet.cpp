#include <btBulletDynamicsCommon.h>

#include <cmath>
#include <cstddef>
#include <limits>
#include <memory>
#include <string>
#include <utility>

#include "study/peer.h"

namespace careen {
namespace {

btVector3 toBullet(const Vec3& v) { return {v.x(), v.y(), v.z()}; }
Vec3 fromBullet(const btVector3& v) { return {v.x(), v.y(), v.z()}; }

btTransform toBullet(const Pose& pose) {
  const Mat3& a = pose.worldFromBody;
  return btTransform(
      btMatrix3x3(a(0, 0), a(0, 1), a(0, 2), a(1, 0), a(1, 1), a(1, 2), a(2, 0), a(2, 1), a(2, 2)),
      toBullet(pose.position));
}

Pose fromBullet(const btTransform& transform) {
  Pose pose{.position = fromBullet(transform.getOrigin())};
  for (int row = 0; row < 3; ++row) {
    pose.worldFromBody.row(row) = fromBullet(transform.getBasis()[row]);
  }
  return pose;
}

// Gives pairs in contact the restitution and friction that they have in careen, after detection and before
// the solver reads them. Bullet's own way, its callbacks, is global to the process.
class BulletWorld : public btDiscreteDynamicsWorld {
 public:
  using btDiscreteDynamicsWorld::btDiscreteDynamicsWorld;

  // Objects are numbered (user index) in the order of their materials.
  std::vector<Material> materials;

  void performDiscreteCollisionDetection() override {
    btDiscreteDynamicsWorld::performDiscreteCollisionDetection();
    for (int i = 0; i < getDispatcher()->getNumManifolds(); ++i) {
      btPersistentManifold& manifold = *getDispatcher()->getManifoldByIndexInternal(i);
      const Material pair = touching(material(manifold.getBody0()), material(manifold.getBody1()));
      for (int k = 0; k < manifold.getNumContacts(); ++k) {
        manifold.getContactPoint(k).m_combinedRestitution = pair.restitution;
        manifold.getContactPoint(k).m_combinedFriction = pair.friction;
      }
    }
  }

 private:
  const Material& material(const btCollisionObject* object) const {
    return materials.at(static_cast<std::size_t>(object->getUserIndex()));
  }
};

// All settings stay as Bullet ships them, except what a world defines: its gravity, sizes, masses, poses,
// velocities.
class BulletEngine : public Peer::Engine {
 public:
  explicit BulletEngine(const World& world) {
    world_.setGravity(toBullet(world.gravity));
    for (const Body& body : world.bodies) {
      addBox(body);
    }
    for (const Wall& wall : world.walls) {
      add(std::make_unique<btStaticPlaneShape>(toBullet(wall.normal), wall.offset),
          {.name = wall.name, .mass = immovable(), .material = wall.material, .initial = {}});
    }
    for (const auto& [a, b] : world.apart) {
      objectOf(a).setIgnoreCollisionCheck(&objectOf(b), true);
      objectOf(b).setIgnoreCollisionCheck(&objectOf(a), true);
    }
    for (const Joint& joint : world.joints) {
      joints_.push_back(made(joint));
      world_.addConstraint(joints_.back().get());
    }
  }
  BulletEngine(const BulletEngine&) = delete;
  BulletEngine& operator=(const BulletEngine&) = delete;
  ~BulletEngine() override {
    for (const std::unique_ptr<btTypedConstraint>& joint : joints_) {
      world_.removeConstraint(joint.get());
    }
  }

  void useBestSettings();

  // Bullet takes no substeps: this is one time step of that length.
  void step(double h) override { world_.stepSimulation(h, 0); }

  // Bullet's body frame lies at the centre of mass along the principal axes; the shape may lie elsewhere in
  // it.
  BodyState state(std::size_t body) const override {
    const btRigidBody& object = *objects_[body];
    // Bullet leaves a body without a finite bounding box where it was.
    if (object.getActivationState() == DISABLE_SIMULATION) {
      return {.pose = {.position = Vec3::Constant(std::numeric_limits<double>::quiet_NaN())}};
    }
    Pose pose = fromBullet(object.getWorldTransform());
    if (masses_[body].turned) {
      pose.worldFromBody = pose.worldFromBody * masses_[body].bodyFromPrincipal.transpose();
    }
    BodyState state{.pose = pose, .velocity = fromBullet(object.getLinearVelocity())};
    state.angularMomentum =
        angularMomentum(masses_[body], state.pose.worldFromBody, fromBullet(object.getAngularVelocity()));
    return state;
  }

 private:
  void addBox(const Body& body) {
    if (body.parts.empty() && body.boxCenter.isZero(0) && !body.mass.turned) {
      add(std::make_unique<btBoxShape>(toBullet(body.halfExtents)), body);
      return;
    }
    auto placed = std::make_unique<btCompoundShape>();
    const Mat3 principalFromBody = body.mass.bodyFromPrincipal.transpose();
    for (int part = 0; part < body.partCount(); ++part) {
      auto box = std::make_unique<btBoxShape>(toBullet(partHalfExtents(body, part)));
      const Pose inBody = partPose(body, part, boxPose(body, Pose{}));
      placed->addChildShape(
          toBullet(Pose{principalFromBody * inBody.position, principalFromBody * inBody.worldFromBody}),
          box.get());
      shapes_.push_back(std::move(box));
    }
    add(std::move(placed), body);
  }

  void add(std::unique_ptr<btCollisionShape> shape, const Body& body) {
    btRigidBody::btRigidBodyConstructionInfo info(body.mass.mass, nullptr, shape.get(),
                                                  toBullet(body.mass.inertiaBody));
    info.m_startWorldTransform = toBullet(
        Pose{body.initial.pose.position, body.mass.worldFromPrincipal(body.initial.pose.worldFromBody)});
    auto object = std::make_unique<btRigidBody>(info);
    object->setUserIndex(static_cast<int>(objects_.size()));
    if (!isImmovable(body.mass)) {
      object->setLinearVelocity(toBullet(body.initial.velocity));
      object->setAngularVelocity(toBullet(angularVelocity(body.mass, body.initial)));
    }
    world_.materials.push_back(body.material);
    world_.addRigidBody(object.get());
    masses_.push_back(body.mass);
    shapes_.push_back(std::move(shape));
    objects_.push_back(std::move(object));
  }

  btRigidBody& objectOf(int body) const { return *objects_[static_cast<std::size_t>(body)]; }

  // In the frame of the object, which is the principal one.
  btTransform frameOf(const JointEnd& end, bool alongX) const {
    Pose frame{.position = end.point, .worldFromBody = end.axes};
    if (alongX) {  // Bullet's sliders are
      frame.worldFromBody << end.axes.col(2), end.axes.col(0), end.axes.col(1);
    }
    if (end.body && masses_[static_cast<std::size_t>(*end.body)].turned) {
      const Mat3 back = masses_[static_cast<std::size_t>(*end.body)].bodyFromPrincipal.transpose();
      frame = {back * frame.position, back * frame.worldFromBody};
    }
    return toBullet(frame);
  }

  std::unique_ptr<btTypedConstraint> made(const Joint& joint) const {
    btRigidBody& from = objectOf(*joint.from.body);
    btRigidBody& to = joint.to.body ? objectOf(*joint.to.body) : btTypedConstraint::getFixedBody();
    const bool isSlider = joint.kind == Joint::Kind::kSlider;
    const btTransform one = frameOf(joint.from, isSlider);
    const btTransform other = frameOf(joint.to, isSlider);
    if (joint.kind == Joint::Kind::kBall) {
      return std::make_unique<btPoint2PointConstraint>(from, to, one.getOrigin(), other.getOrigin());
    }
    if (joint.kind == Joint::Kind::kFixed) {
      return std::make_unique<btFixedConstraint>(from, to, one, other);
    }
    const bool isLimited = std::isfinite(joint.lowest) && std::isfinite(joint.highest);
    if (isSlider) {
      auto slider = std::make_unique<btSliderConstraint>(to, from, other, one, true);
      slider->setLowerLinLimit(isLimited ? joint.lowest : 1);  // none where it is above the other
      slider->setUpperLinLimit(isLimited ? joint.highest : -1);
      slider->setDampingLimLin(1 - joint.restitution);
      slider->setLowerAngLimit(0);
      slider->setUpperAngLimit(0);
      return slider;
    }
    auto hinge = std::make_unique<btHingeConstraint>(from, to, one, other);
    if (isLimited) {
      constexpr double kSoftness = 0.9;  // as shipped
      constexpr double kBias = 0.3;
      hinge->setLimit(joint.lowest, joint.highest, kSoftness, kBias,
                      joint.restitution / kBias);  // it takes that part of a bounce too
    }
    return hinge;
  }

  // Bodies, then walls; the world releases them before they are destroyed.
  std::vector<MassProperties> masses_;
  std::vector<std::unique_ptr<btCollisionShape>> shapes_;
  std::vector<std::unique_ptr<btRigidBody>> objects_;
  btDefaultCollisionConfiguration configuration_;
  btCollisionDispatcher dispatcher_{&configuration_};
  btDbvtBroadphase broadphase_;
  btSequentialImpulseConstraintSolver solver_;
  BulletWorld world_{&dispatcher_, &broadphase_, &solver_, &configuration_};
  std::vector<std::unique_ptr<btTypedConstraint>> joints_;
};

// These settings gave the smallest errors in two free tumbles, impacts of a corner with e = 1, a minute in an
// elastic room, a flat drop with e = 0.5, a slope with friction and a stack of ten, at time steps of 1/60 to
// 1/3840 s. Measured, all else as below:
// - contacts solved before they overlap, as shipped: all energy is lost in the room;
// - penetration corrected by velocity, as shipped below 0.04 m: energy times 31 in the room;
// - one contact point with a plane, as shipped: the flat drop rises to 0.18 m, not 0.5, and tilts;
// - 10 iterations, as shipped: the flat drop tilts by 0.06 rad; 50 do as well as 1000;
// - friction after all normals, as shipped: 0.05 m short of 1.3 m down the slope, not 0.004;
// - explicit gyroscopic term: tumbles no better from 1/240 s on, and energy times 3.8 in the room;
//   implicit in the world: worse in the room; none: energy is kept, and the tumble is wrong at any step;
// - Dantzig's and projected Gauss-Seidel MLCP, warm starting, CCD, margins: no better.
void BulletEngine::useBestSettings() {
  constexpr int kPoints = 4;  // the capacity of a manifold
  configuration_.setPlaneConvexMultipointIterations(kPoints, kPoints);
  for (const std::unique_ptr<btRigidBody>& object : objects_) {
    object->setActivationState(DISABLE_DEACTIVATION);
    object->setContactProcessingThreshold(0);
  }
  btContactSolverInfo& solver = world_.getSolverInfo();
  solver.m_numIterations = 50;
  solver.m_solverMode |= SOLVER_INTERLEAVE_CONTACT_AND_FRICTION_CONSTRAINTS;
  solver.m_splitImpulsePenetrationThreshold = 0;
  solver.m_restitutionVelocityThreshold = 0;
}

class Bullet : public Peer {
 public:
  explicit Bullet(bool best) : best_(best) {}

  std::string name() const override { return best_ ? "bullet-best" : "bullet"; }

  std::string settings() const override {
    const std::string version =
        std::to_string(BT_BULLET_VERSION / 100) + "." + std::to_string(BT_BULLET_VERSION % 100);
    return "Bullet " + version + " in doubles, " +
           (best_ ? "no sleeping, contacts only where boxes overlap, four contact points with a plane, "
                    "restitution at "
                    "any speed, penetration corrected by split impulse, 50 iterations, interleaved friction"
                  : "default settings");
  }

 protected:
  std::unique_ptr<Engine> feed(const World& world) const override {
    auto engine = std::make_unique<BulletEngine>(world);
    if (best_) {
      engine->useBestSettings();
    }
    return engine;
  }

 private:
  bool best_;
};

}  // namespace

Contestants peerBullet() {
  Contestants all;
  all.push_back(std::make_unique<Bullet>(false));
  all.push_back(std::make_unique<Bullet>(true));
  return all;
}

}  // namespace careen
