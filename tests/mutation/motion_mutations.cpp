#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "mutation/subject.h"
#include "physics/world/method.h"
#include "support/article_equations.h"

namespace careen {
namespace {

void nextUp(double& value) { value = std::nextafter(value, std::numeric_limits<double>::infinity()); }
// The next double; for 0, 1e-12 in its unit.
void slightlyMore(double& value) {
  if (value == 0) {
    value = 1e-12;
  } else {
    nextUp(value);
  }
}
const std::array<const char*, 3> kAxes = {"x", "y", "z"};

/// The number of a subject that is changed in its last bit.
using Number = std::function<double&(Subject&)>;

void add(Mutations& list, const std::function<Subject()>& subject, const std::string& name,
         const Number& number) {
  list.push_back(
      {subject().name + ": " + name, subject, [number](Subject& it) { slightlyMore(number(it)); }});
}

using VectorOf = std::function<Vec3&(Subject&)>;
void addEach(Mutations& list, const std::function<Subject()>& subject, const std::string& name,
             const VectorOf& vector) {
  for (Eigen::Index i = 0; i < 3; ++i) {
    add(list, subject, name + ' ' + kAxes.at(static_cast<std::size_t>(i)),
        [vector, i](Subject& it) -> double& { return vector(it)[i]; });
  }
}

void addBox(Mutations& list, const std::function<Subject()>& subject, std::size_t box) {
  const std::string whose = subject().scene.boxes.at(box).name + "'s ";
  const auto of = [box](Subject& it) -> SceneBox& { return it.scene.boxes.at(box); };
  addEach(list, subject, whose + "place", [of](Subject& it) -> Vec3& { return of(it).pose.position; });
  addEach(list, subject, whose + "velocity", [of](Subject& it) -> Vec3& { return of(it).velocity; });
  addEach(list, subject, whose + "spin", [of](Subject& it) -> Vec3& { return of(it).angularVelocity; });
  addEach(list, subject, whose + "size", [of](Subject& it) -> Vec3& { return of(it).halfExtents; });
  add(list, subject, whose + "mass", [of](Subject& it) -> double& { return of(it).mass; });
  list.push_back({subject().name + ": " + whose + "attitude", subject, [of](Subject& it) {
                    Mat3& attitude = of(it).pose.worldFromBody;
                    attitude = axisAngle(Vec3::UnitX(), 1e-12) * attitude;
                  }});
}

Mutations ofTheCrate() {
  Mutations list;
  addBox(list, thrownCrate, 0);
  addEach(list, thrownCrate, "gravity", [](Subject& it) -> Vec3& { return it.scene.gravity; });
  add(list, thrownCrate, "right wall", [](Subject& it) -> double& { return it.scene.room->max.x(); });
  add(list, thrownCrate, "back wall", [](Subject& it) -> double& { return it.scene.room->max.y(); });
  add(list, thrownCrate, "floor", [](Subject& it) -> double& { return it.scene.room->min.z(); });
  add(list, thrownCrate, "room's friction",
      [](Subject& it) -> double& { return it.scene.room->material.friction; });
  add(list, thrownCrate, "friction",
      [](Subject& it) -> double& { return it.scene.boxes[0].material.friction; });
  list.push_back({"crate: restitution 1e-12 off", thrownCrate,
                  [](Subject& it) { it.scene.room->material.restitution += 1e-12; }});
  list.push_back({"crate: restitution of the other, which is greater then", thrownCrate,
                  [](Subject& it) { it.scene.boxes[0].material.restitution = 0.8000000001; }});
  list.push_back({"crate: a side is open", thrownCrate, [](Subject& it) { it.scene.room->open[1] = true; }});
  list.push_back(
      {"crate: a ramp more", thrownCrate, [](Subject& it) {
         it.scene.walls.push_back(
             {.name = "ramp", .normal = Vec3(-1, 0, 1).normalized(), .offset = -1.5, .material = {}});
       }});
  list.push_back(
      {"crate: no friction", thrownCrate, [](Subject& it) { it.scene.room->material.friction = 0; }});
  return list;
}

Mutations ofThePair() {
  Mutations list;
  addBox(list, strikingPair, 1);
  add(list, strikingPair, "one's restitution",
      [](Subject& it) -> double& { return it.scene.boxes[0].material.restitution; });
  list.push_back({"pair: one's friction 1e-12 off", strikingPair,
                  [](Subject& it) { it.scene.boxes[0].material.friction += 1e-12; }});
  list.push_back({"pair: one is held", strikingPair, [](Subject& it) {
                    it.scene.boxes[1].fixed = true;
                    it.scene.boxes[1].velocity = it.scene.boxes[1].angularVelocity = Vec3::Zero();
                  }});
  list.push_back({"pair: a box less", strikingPair, [](Subject& it) { it.scene.boxes.pop_back(); }});
  list.push_back({"pair: a box more", strikingPair, [](Subject& it) {
                    SceneBox third = it.scene.boxes[0];
                    third.name = "third";
                    third.pose.position = Vec3(0, 3, 0);
                    it.scene.boxes.push_back(third);
                  }});
  list.push_back({"pair: another name", strikingPair, [](Subject& it) { it.scene.boxes[1].name = "else"; }});
  return list;
}

Mutations ofTheSprings() {
  Mutations list;
  const auto spring = [](std::size_t index, double Spring::*number) {
    return [index, number](Subject& it) -> double& { return it.scene.springs.at(index).*number; };
  };
  for (std::size_t i = 0; i < 2; ++i) {
    const std::string whose = "spring " + std::to_string(i) + "'s ";
    add(list, sprungChain, whose + "stiffness", spring(i, &Spring::stiffness));
    add(list, sprungChain, whose + "damping", spring(i, &Spring::damping));
    add(list, sprungChain, whose + "rest length", spring(i, &Spring::restLength));
    addEach(list, sprungChain, whose + "end",
            [i](Subject& it) -> Vec3& { return it.scene.springs.at(i).to.point; });
  }
  add(list, sprungChain, "drag", [](Subject& it) -> double& { return it.scene.drag->linear; });
  add(list, sprungChain, "drag of turning", [](Subject& it) -> double& { return it.scene.drag->angular; });
  list.push_back(
      {"springs: tolerance", sprungChain, [](Subject& it) { it.scene.settings.tolerance *= 0.5; }});
  list.push_back({"springs: one less", sprungChain, [](Subject& it) { it.scene.springs.pop_back(); }});
  return list;
}

Mutations ofTheSteppers() {
  Mutations list;
  for (const MethodTraits& traits : kMethods) {
    if (!traits.steps()) {
      continue;
    }
    const Method method = traits.method;
    const auto subject = [method] { return steppedCrate(method); };
    add(list, subject, "dt", [](Subject& it) -> double& { return it.scene.settings.dt; });
    add(list, subject, "g", [](Subject& it) -> double& { return it.scene.gravity.z(); });
    list.push_back({"crate: by " + std::string(traits.name) + " instead", thrownCrate,
                    [method](Subject& it) { it.scene.settings.method = method; }});
  }
  return list;
}

}  // namespace

Mutations motionMutations() {
  Mutations all;
  for (Mutations (*const part)() : {ofTheCrate, ofThePair, ofTheSprings, ofTheSteppers}) {
    Mutations list = part();
    all.insert(all.end(), list.begin(), list.end());
  }
  return all;
}

}  // namespace careen
