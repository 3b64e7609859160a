#include <ode/ode.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <memory>
#include <string>

#include "study/peer.h"

namespace careen {
namespace {

// Initialises ODE once for the process.
struct Library {
  Library() { dInitODE(); }
  Library(const Library&) = delete;
  Library& operator=(const Library&) = delete;
  ~Library() { dCloseODE(); }
};

template <auto kDestroy>
struct Destroy {
  void operator()(auto* owned) const { kDestroy(owned); }
};

// All settings stay as ODE ships them, except what a world defines. Of its two solvers, this uses QuickStep,
// but for joints at its best the other one.
class OdeEngine : public Peer::Engine {
 public:
  explicit OdeEngine(const World& world) : scene_(world) {
    // QuickStep shuffles its rows with one seed for the process: runs are reproducible if no two overlap in
    // time.
    dRandSetSeed(0);
    dWorldSetGravity(world_.get(), world.gravity.x(), world.gravity.y(), world.gravity.z());
    materials_.reserve(world.bodies.size() + world.walls.size());
    for (const Body& body : world.bodies) {
      add(body);
    }
    for (const Wall& wall : world.walls) {
      const Vec3& n = wall.normal;
      name(dCreatePlane(space_.get(), n.x(), n.y(), n.z(), wall.offset), wall.material);
    }
    for (const Joint& joint : world.joints) {
      add(joint);
    }
  }

  void useBestSettings();

  void step(double h) override {
    dSpaceCollide(space_.get(), this,
                  [](void* self, dGeomID a, dGeomID b) { static_cast<OdeEngine*>(self)->touch(a, b); });
    (isDirect_ ? dWorldStep : dWorldQuickStep)(world_.get(), h);
    dJointGroupEmpty(contacts_.get());
  }

  BodyState state(std::size_t body) const override {
    dxBody* const id = bodies_[body];
    BodyState state;
    state.pose.position = Vec3::Map(dBodyGetPosition(id));
    const dReal* rotation = dBodyGetRotation(id);
    for (int row = 0; row < 3; ++row) {
      state.pose.worldFromBody.row(row) = Vec3::Map(rotation + kRowOfOde * row);
    }
    state.velocity = Vec3::Map(dBodyGetLinearVel(id));
    state.angularMomentum =
        angularMomentum(masses_[body], state.pose.worldFromBody, Vec3::Map(dBodyGetAngularVel(id)));
    return state;
  }

 private:
  static constexpr std::ptrdiff_t kRowOfOde = 4;  // rows of three, padded
  static constexpr int kMostContacts = 16;

  void add(const Body& body) {
    const BodyState& initial = body.initial;
    dBodyID id = nullptr;
    if (!isImmovable(body.mass)) {
      dMass mass;
      const Mat3 inertia = body.mass.inertiaTensor();
      dMassSetParameters(&mass, body.mass.mass, 0, 0, 0, inertia(0, 0), inertia(1, 1), inertia(2, 2),
                         inertia(0, 1), inertia(0, 2), inertia(1, 2));
      id = dBodyCreate(world_.get());
      dBodySetMass(id, &mass);
      const Vec3 spin = angularVelocity(body.mass, initial);
      dBodySetLinearVel(id, initial.velocity.x(), initial.velocity.y(), initial.velocity.z());
      dBodySetAngularVel(id, spin.x(), spin.y(), spin.z());
    }
    for (int part = 0; part < body.partCount(); ++part) {
      addGeom(body, part, id);
    }
    bodies_.push_back(id);
    masses_.push_back(body.mass);
  }

  // The first places the body.
  void addGeom(const Body& body, int part, dBodyID id) {
    const Vec3& half = partHalfExtents(body, part);
    dxGeom* const box = dCreateBox(space_.get(), 2 * half.x(), 2 * half.y(), 2 * half.z());
    name(box, body.material);
    const Pose& pose = body.initial.pose;
    const Pose inBody = partPose(body, part, boxPose(body, Pose{}));
    const Pose placed = id != nullptr ? pose : partPose(body, part, boxPose(body, pose));
    dMatrix3 rotation = {};
    const auto fill = [&](const Mat3& axes) {
      for (int row = 0; row < 3; ++row) {
        Vec3::Map(rotation + kRowOfOde * row) = axes.row(row);
      }
    };
    if (id != nullptr) {
      dGeomSetBody(box, id);
    }
    fill(placed.worldFromBody);
    dGeomSetPosition(box, placed.position.x(), placed.position.y(), placed.position.z());
    dGeomSetRotation(box, rotation);
    if (id == nullptr) {
      return;
    }
    if (!inBody.position.isZero(0)) {
      dGeomSetOffsetPosition(box, inBody.position.x(), inBody.position.y(), inBody.position.z());
    }
    if (inBody.worldFromBody != Mat3::Identity()) {
      fill(inBody.worldFromBody);
      dGeomSetOffsetRotation(box, rotation);
    }
  }

  // As both ends are at the start, from where its angle or way counts.
  void add(const Joint& joint) {
    const auto attached = [&](dJointID made) {
      dJointAttach(made, bodies_[static_cast<std::size_t>(*joint.from.body)],
                   joint.to.body ? bodies_[static_cast<std::size_t>(*joint.to.body)] : nullptr);
      return made;
    };
    const Pose pose = startOf(joint.from);
    const Vec3 at = joint.from.pointAt(pose);
    const Vec3 axis = joint.from.axesAt(pose).col(2);
    if (joint.kind == Joint::Kind::kBall) {
      dJointSetBallAnchor(attached(dJointCreateBall(world_.get(), nullptr)), at.x(), at.y(), at.z());
    } else if (joint.kind == Joint::Kind::kFixed) {
      dJointSetFixed(attached(dJointCreateFixed(world_.get(), nullptr)));
    } else if (joint.kind == Joint::Kind::kHinge) {
      dxJoint* const hinge = attached(dJointCreateHinge(world_.get(), nullptr));
      dJointSetHingeAnchor(hinge, at.x(), at.y(), at.z());
      dJointSetHingeAxis(hinge, axis.x(), axis.y(), axis.z());
      limit(joint, [&](int name, double value) { dJointSetHingeParam(hinge, name, value); });
    } else {
      dxJoint* const slider = attached(dJointCreateSlider(world_.get(), nullptr));
      dJointSetSliderAxis(slider, axis.x(), axis.y(), axis.z());
      limit(joint, [&](int name, double value) { dJointSetSliderParam(slider, name, value); });
    }
  }

  template <class Set>
  void limit(const Joint& joint, const Set& set) const {
    if (std::isfinite(joint.lowest) || std::isfinite(joint.highest)) {
      const double start = jointCoordinate(joint, startOf(joint.from), startOf(joint.to));
      set(dParamLoStop, joint.lowest - start);
      set(dParamHiStop, joint.highest - start);
      set(dParamBounce, joint.restitution);
    }
  }

  Pose startOf(const JointEnd& end) const {
    return end.body ? scene_.bodies[static_cast<std::size_t>(*end.body)].initial.pose : Pose{};
  }

  // Its place among bodies, then walls.
  int placeOf(dGeomID geom) const {
    return static_cast<int>(static_cast<const Material*>(dGeomGetData(geom)) - materials_.data());
  }

  void name(dGeomID geom, const Material& material) {
    dGeomSetData(geom, &materials_.emplace_back(material));
  }

  void touch(dGeomID a, dGeomID b) {
    if ((dGeomGetBody(a) == nullptr && dGeomGetBody(b) == nullptr) ||
        !mayTouch(scene_, placeOf(a), placeOf(b))) {
      return;
    }
    const Material pair = touching(*static_cast<const Material*>(dGeomGetData(a)),
                                   *static_cast<const Material*>(dGeomGetData(b)));
    std::array<dContactGeom, kMostContacts> points;
    const int count = dCollide(a, b, kMostContacts, points.data(), sizeof(dContactGeom));
    for (std::size_t k = 0; k < static_cast<std::size_t>(count); ++k) {
      dContact contact = {};
      // Without Approx1, ODE interprets mu as a force.
      contact.surface.mode = dContactBounce | dContactApprox1;
      contact.surface.mu = pair.friction;
      contact.surface.bounce = pair.restitution;
      contact.geom = points[k];
      dJointAttach(dJointCreateContact(world_.get(), contacts_.get(), &contact), dGeomGetBody(a),
                   dGeomGetBody(b));
    }
  }

  const World& scene_;
  bool isDirect_ = false;
  std::unique_ptr<dxWorld, Destroy<dWorldDestroy>> world_{dWorldCreate()};
  std::unique_ptr<dxSpace, Destroy<dSpaceDestroy>> space_{dHashSpaceCreate(nullptr)};
  std::unique_ptr<dxJointGroup, Destroy<dJointGroupDestroy>> contacts_{dJointGroupCreate(0)};
  std::vector<dBodyID> bodies_;  // none for fixed bodies
  std::vector<MassProperties> masses_;
  std::vector<Material> materials_;  // bodies, then walls; never grows, because the geometries point into it
};

// Measured in the cases that peer_bullet.cpp names, all else as below:
// - dWorldStep, the direct solver: no better in any, and the stack falls ("LCP internal error");
// - 20 iterations, as shipped: the flat drop at 1/60 s tilts by 0.003 rad, and from 100 on not at all;
// - no finite rotation, as shipped: the same to two digits; with it, a steady spin has no error;
// - error reduction 0.01 to 0.2, its speed limited, CFM 0 to 1e-10, over-relaxation 1 to 1.3: no better;
//   without error reduction the stack sinks by 27 mm in 10 s;
// - a surface layer: the stack sinks by ten layers;
// - no gyroscopic term: energy is kept, and the tumble is wrong at any step.
// With a chain whose end is 100 times as heavy, dWorldStep holds the joints, QuickStep does not.
void OdeEngine::useBestSettings() {
  isDirect_ = !scene_.joints.empty();
  dWorldSetQuickStepNumIterations(world_.get(), 100);
  for (dxBody* const body : bodies_) {
    if (body != nullptr) {
      dBodySetFiniteRotationMode(body, 1);
    }
  }
}

class Ode : public Peer {
 public:
  explicit Ode(bool best) : best_(best) {}

  std::string name() const override { return best_ ? "ode-best" : "ode"; }

  std::string settings() const override {
    return std::string("ODE " dODE_VERSION " in doubles, QuickStep, ") +
           (best_ ? "100 iterations, finite rotation; with joints, dWorldStep" : "default settings");
  }

 protected:
  std::unique_ptr<Engine> feed(const World& world) const override {
    static const Library library;
    dAllocateODEDataForThread(static_cast<unsigned int>(dAllocateMaskAll));
    auto engine = std::make_unique<OdeEngine>(world);
    if (best_) {
      engine->useBestSettings();
    }
    return engine;
  }

 private:
  bool best_;
};

}  // namespace

Contestants peerOde() {
  Contestants all;
  all.push_back(std::make_unique<Ode>(false));
  all.push_back(std::make_unique<Ode>(true));
  return all;
}

}  // namespace careen
