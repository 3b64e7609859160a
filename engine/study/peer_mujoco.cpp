#include <mujoco/mujoco.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstring>
#include <initializer_list>
#include <limits>
#include <memory>
#include <string>
#include <vector>

#include "core/brief.h"
#include "core/error.h"
#include "exchange/export_mjcf.h"
#include "study/peer.h"

namespace careen {
namespace {

struct Delete {
  void operator()(mjModel* model) const { mj_deleteModel(model); }
  void operator()(mjData* data) const { mj_deleteData(data); }
};

std::string numbers(std::initializer_list<double> values) {
  std::string text;
  for (const double value : values) {
    text += inFull(value) + " ";
  }
  return text;
}
std::string numbers(const Vec3& v) { return numbers({v.x(), v.y(), v.z()}); }
std::string numbers(const Quat& q) { return numbers({q.w(), q.x(), q.y(), q.z()}); }

// MuJoCo has no coefficient of restitution, but springs in contacts whose damping can be chosen. This is the
// damping ratio of one that pushes but never pulls and gives back the part e of the approach: ln e =
// -2 ζ acos ζ / sqrt(1 - ζ²), and its continuation above ζ = 1 (Schwager and Poschel 2007).
double dampingRatio(double restitution) {
  const auto lost = [](double z) {
    const double root = std::sqrt(std::abs(1 - z * z));
    return root < 1e-9 ? 2 : 2 * z * (z < 1 ? std::acos(z) : std::acosh(z)) / root;
  };
  double low = 0;
  double high = 1;
  while (std::exp(-lost(high)) > restitution && high < 1e6) {
    high *= 2;
  }
  for (int k = 0; k < 100; ++k) {
    const double middle = (low + high) / 2;
    (std::exp(-lost(middle)) > restitution ? low : high) = middle;
  }
  return low;
}

std::string attribute(const char* name, const std::string& value) {
  return std::string(" ") + name + "=\"" + value + "\"";
}

std::string boxText(const Body& body, const std::string& name) {
  std::string text = "<body" + attribute("pos", numbers(body.initial.pose.position)) +
                     attribute("quat", numbers(Quat(body.initial.pose.worldFromBody).normalized())) + ">";
  if (!isImmovable(body.mass)) {
    text += "<freejoint/><inertial pos=\"0 0 0\"" + attribute("mass", inFull(body.mass.mass)) +
            attribute("diaginertia", numbers(body.mass.inertiaBody)) +
            attribute("quat", numbers(Quat(body.mass.bodyFromPrincipal).normalized())) + "/>";
  }
  for (int part = 0; part < body.partCount(); ++part) {
    const Pose inBody = partPose(body, part, boxPose(body, Pose{}));
    text += "<geom type=\"box\"" + (part == 0 ? attribute("name", name) : std::string()) +
            attribute("pos", numbers(inBody.position)) +
            (body.parts.empty() ? std::string()
                                : attribute("quat", numbers(Quat(inBody.worldFromBody).normalized()))) +
            attribute("size", numbers(partHalfExtents(body, part))) + "/>";
  }
  return text + "</body>";
}

// A world with joints, as careen exports it: a tree, and equalities where joints close loops.
std::string exported(const World& world) {
  RunSetup setup;
  setup.world = world;
  setup.stage.colors.resize(world.bodies.size());
  return encodeMjcf(setup, "careen").text;
}

// The scene as MJCF. The frame of a body is the one that it has here: its origin is the centre of mass.
// Geometries are named by their numbers, walls first. Pairs are named if `areNamed`. With `contacts` there is
// room for so many, else for as many as MuJoCo guesses.
std::string textOf(const World& world, bool areNamed, int contacts) {
  std::string text =
      "<mujoco><compiler angle=\"radian\"/><option" + attribute("gravity", numbers(world.gravity)) + "/>";
  if (contacts > 0) {
    constexpr int kMostRows = 4;  // of a contact
    text += "<size" + attribute("nconmax", std::to_string(contacts)) +
            attribute("njmax", std::to_string(kMostRows * contacts)) + "/>";
  }
  text += "<worldbody>";
  std::size_t geometries = 0;
  for (const Wall& wall : world.walls) {
    text += R"(<geom type="plane" size="0 0 1")" + attribute("name", std::to_string(geometries++)) +
            attribute("pos", numbers(Vec3(wall.offset * wall.normal))) +
            attribute("zaxis", numbers(wall.normal)) + "/>";
  }
  for (const Body& body : world.bodies) {
    text += boxText(body, std::to_string(geometries++));
  }
  text += "</worldbody><contact>";
  const auto isFixed = [&](std::size_t geometry) {
    return geometry < world.walls.size() || isImmovable(world.bodies[geometry - world.walls.size()].mass);
  };
  for (std::size_t a = 0; areNamed && a < geometries; ++a) {
    for (std::size_t b = 0; b < a; ++b) {
      if (!isFixed(a) || !isFixed(b)) {
        text +=
            "<pair" + attribute("geom1", std::to_string(a)) + attribute("geom2", std::to_string(b)) + "/>";
      }
    }
  }
  return text + "</contact></mujoco>";
}

std::unique_ptr<mjModel, Delete> compiled(const std::string& text) {
  const auto files = std::make_unique<mjVFS>();
  mj_defaultVFS(files.get());
  if (mj_makeEmptyFileVFS(files.get(), "scene.xml", static_cast<int>(text.size())) != 0) {
    throw NumericalError("mujoco: the scene is too large");
  }
  std::memcpy(files->filedata[0], text.data(), text.size());
  std::array<char, 500> error{};
  std::unique_ptr<mjModel, Delete> model(
      mj_loadXML("scene.xml", files.get(), error.data(), static_cast<int>(error.size())));
  mj_deleteVFS(files.get());
  if (!model) {
    throw NumericalError(std::string("mujoco: ") + error.data());
  }
  return model;
}

// All settings stay as MuJoCo ships them, except what a world defines. Contacts that bounce have the
// stiffness that MuJoCo gives those that do not.
class MujocoEngine : public Peer::Engine {
 public:
  MujocoEngine(const World& world, bool isBest) : world_(world), isBest_(isBest) {
    mju_user_warning = [](const char*) {};  // as shipped, it writes a file; step() looks at the counts
    for (const Wall& wall : world.walls) {
      materials_.push_back(wall.material);
    }
    for (const Body& body : world.bodies) {
      materials_.push_back(body.material);
    }
    build(0);
    for (const Body& body : world.bodies) {
      masses_.push_back(body.mass);
    }
    if (isJointed()) {
      for (const Body& body : world.bodies) {
        bodies_.push_back(mj_name2id(model_.get(), mjOBJ_BODY, body.name.c_str()));
      }
      mj_resetDataKeyframe(model_.get(), data_.get(), 0);
      return;
    }
    int place = 0;
    for (const Body& body : world.bodies) {
      bodies_.push_back(place);
      if (isImmovable(body.mass)) {
        continue;
      }
      Vec3::Map(data_->qvel + kSpeeds * place) = body.initial.velocity;
      Vec3::Map(data_->qvel + kSpeeds * place + 3) =
          body.initial.pose.worldFromBody.transpose() * angularVelocity(body.mass, body.initial);
      ++place;
    }
  }

  void step(double h) override {
    if (h != step_) {
      step_ = h;
      setStep();
    }
    const Moment before = moment();
    mj_step(model_.get(), data_.get());
    while (isFull()) {
      build(2 * model_->nconmax);
      setStep();
      set(before);
      mj_step(model_.get(), data_.get());
    }
  }

  BodyState state(std::size_t body) const override {
    // MuJoCo puts everything back to its start where a number becomes too large.
    for (const int lost : {mjWARN_BADQPOS, mjWARN_BADQVEL, mjWARN_BADQACC}) {
      if (data_->warning[lost].number > 0) {
        return {.pose = {.position = Vec3::Constant(std::numeric_limits<double>::quiet_NaN())}};
      }
    }
    return isJointed() ? stateInTree(body) : stateOfFree(body);
  }

 private:
  static constexpr std::ptrdiff_t kPlaces = 7;  // of a free body: position, quaternion
  static constexpr std::ptrdiff_t kSpeeds = 6;  // velocity; angular velocity in the body's frame

  bool isJointed() const { return !world_.joints.empty(); }

  BodyState stateInTree(std::size_t body) const {
    mj_fwdPosition(model_.get(), data_.get());
    mj_fwdVelocity(model_.get(), data_.get());
    const std::ptrdiff_t place = bodies_[body];
    Mat3 turn;
    for (int row = 0; row < 3; ++row) {
      turn.row(row) = Vec3::Map(data_->xmat + 9 * place + std::ptrdiff_t{3} * row);
    }
    std::array<mjtNum, 6> moves{};  // turning, then the centre of mass
    mj_objectVelocity(model_.get(), data_.get(), mjOBJ_BODY, bodies_[body], moves.data(), 0);
    BodyState state{.pose = bodyPose(world_.bodies[body],
                                     {.position = Vec3::Map(data_->xpos + 3 * place), .worldFromBody = turn}),
                    .velocity = Vec3::Map(moves.data() + 3)};
    state.angularMomentum = angularMomentum(masses_[body], state.pose.worldFromBody, Vec3::Map(moves.data()));
    return state;
  }

  BodyState stateOfFree(std::size_t body) const {
    const mjtNum* const at = data_->qpos + kPlaces * bodies_[body];
    const mjtNum* const moves = data_->qvel + kSpeeds * bodies_[body];
    BodyState state;
    state.pose.position = Vec3::Map(at);
    state.pose.worldFromBody = Quat(at[3], at[4], at[5], at[6]).normalized().toRotationMatrix();
    state.velocity = Vec3::Map(moves);
    state.angularMomentum = angularMomentum(masses_[body], state.pose.worldFromBody,
                                            state.pose.worldFromBody * Vec3::Map(moves + 3));
    return state;
  }

  // What a step begins from.
  struct Moment {
    std::vector<mjtNum> places;
    std::vector<mjtNum> speeds;
    std::vector<mjtNum> warmStart;
  };
  Moment moment() const {
    const auto part = [](const mjtNum* from, int count) { return std::vector<mjtNum>(from, from + count); };
    return {part(data_->qpos, model_->nq), part(data_->qvel, model_->nv),
            part(data_->qacc_warmstart, model_->nv)};
  }
  void set(const Moment& moment) {
    std::copy(moment.places.begin(), moment.places.end(), data_->qpos);
    std::copy(moment.speeds.begin(), moment.speeds.end(), data_->qvel);
    std::copy(moment.warmStart.begin(), moment.warmStart.end(), data_->qacc_warmstart);
  }

  void build(int contacts) {
    // MuJoCo has its own ways to mix two materials: where they differ, each pair is named and told its own.
    const bool areNamed = std::any_of(materials_.begin(), materials_.end(), [&](const Material& each) {
      return each.friction != materials_[0].friction || each.restitution != materials_[0].restitution;
    });
    model_ = compiled(isJointed() ? exported(world_) : textOf(world_, areNamed, contacts));
    data_.reset(mj_makeData(model_.get()));
    model_->opt.integrator = isBest_ ? mjINT_RK4 : mjINT_EULER;
    model_->opt.cone = isBest_ ? mjCONE_ELLIPTIC : mjCONE_PYRAMIDAL;
    if (!isJointed()) {  // the export says it
      setFriction();
    }
  }

  // Whether the last step had more contacts than there is room for.
  bool isFull() const {
    return data_->warning[mjWARN_CONTACTFULL].number > 0 || data_->warning[mjWARN_CNSTRFULL].number > 0;
  }

  Material ofPair(int pair) const {
    return touching(materials_[static_cast<std::size_t>(model_->pair_geom1[pair])],
                    materials_[static_cast<std::size_t>(model_->pair_geom2[pair])]);
  }

  // Of the coefficients the first, or the first two, are sliding's; without any, a contact has one dimension.
  void setFriction() {
    for (int i = 0; i < model_->ngeom; ++i) {
      const double friction = materials_[static_cast<std::size_t>(i)].friction;
      model_->geom_condim[i] = friction > 0 ? 3 : 1;
      Vec3::Map(model_->geom_friction + std::ptrdiff_t{3} * i) = Vec3(friction, 0, 0);
    }
    for (int i = 0; i < model_->npair; ++i) {
      const double friction = ofPair(i).friction;
      model_->pair_dim[i] = friction > 0 ? 3 : 1;
      mjtNum* const all = model_->pair_friction + std::ptrdiff_t{5} * i;
      std::fill(all, all + 5, 0);
      all[0] = all[1] = friction;
    }
  }

  // The step, and the springs of contacts, which depend on it.
  void setStep() {
    model_->opt.timestep = step_;
    const double constant = isBest_ ? 2 * step_ : std::max(0.02, 2 * step_);
    const auto spring = [&](mjtNum* solref, double restitution) {
      // Stiffness and damping, or time constant and damping ratio, of which MuJoCo makes the same stiffness.
      if (restitution > 0) {
        solref[0] = -1 / (constant * constant);
        solref[1] = -2 * dampingRatio(restitution) / constant;
      } else {
        solref[0] = constant;
        solref[1] = 1;
      }
    };
    for (int i = 0; i < model_->neq; ++i) {
      spring(model_->eq_solref + std::ptrdiff_t{mjNREF} * i, 0);
    }
    for (const Joint& joint : world_.joints) {
      const int limit = mj_name2id(model_.get(), mjOBJ_JOINT, joint.name.c_str());
      const int rope = mj_name2id(model_.get(), mjOBJ_TENDON, joint.name.c_str());
      if (limit >= 0) {
        spring(model_->jnt_solref + std::ptrdiff_t{mjNREF} * limit, joint.restitution);
      } else if (rope >= 0) {
        spring(model_->tendon_solref_lim + std::ptrdiff_t{mjNREF} * rope, joint.restitution);
      }
    }
    for (int i = 0; i < model_->ngeom && !isJointed(); ++i) {
      spring(model_->geom_solref + std::ptrdiff_t{mjNREF} * i,
             materials_[static_cast<std::size_t>(i)].restitution);
    }
    for (int i = 0; i < model_->npair && !isJointed(); ++i) {
      spring(model_->pair_solref + std::ptrdiff_t{mjNREF} * i, ofPair(i).restitution);
    }
  }

  const World& world_;
  std::unique_ptr<mjModel, Delete> model_;
  std::unique_ptr<mjData, Delete> data_;
  std::vector<Material> materials_;  // of the geometries: walls, then bodies
  std::vector<int> bodies_;          // the place of each among those that move
  std::vector<MassProperties> masses_;
  bool isBest_;
  double step_ = 0;  // [s] of the last step
};

class Mujoco : public Peer {
 public:
  explicit Mujoco(bool best) : best_(best) {}

  std::string name() const override { return best_ ? "mujoco-best" : "mujoco"; }

  std::string settings() const override {
    return "MuJoCo " + std::string(mj_versionString()) + ", restitution by the damping of contacts, " +
           (best_ ? "contacts as stiff as the time step allows, RK4, elliptic cones" : "default settings");
  }

 protected:
  std::string refusesJoint(const Joint& joint) const override {
    return joint.grip != 0 ? "no friction, no drives of joints" : "";  // its export has none
  }
  std::unique_ptr<Engine> feed(const World& world) const override {
    return std::make_unique<MujocoEngine>(world, best_);
  }

 private:
  bool best_;
};

}  // namespace

Contestants peerMujoco() {
  Contestants all;
  all.push_back(std::make_unique<Mujoco>(false));
  all.push_back(std::make_unique<Mujoco>(true));
  return all;
}

}  // namespace careen
