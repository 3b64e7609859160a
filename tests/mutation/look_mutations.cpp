#include <numbers>
#include <utility>

#include "mutation/subject.h"
#include "render/look/lighting.h"
#include "support/article_equations.h"
#include "view/materials.h"

namespace careen {
namespace {

Mutation lit(const std::string& name, const std::function<void(Lighting&)>& change) {
  return {name, stillLife, [change](Subject& it) {
            it.look.lighting = lightingOf(Look::kStudio, *it.scene.camera);
            change(*it.look.lighting);
          }};
}

Mutation made(const std::string& name, const std::function<void(Materials&)>& change) {
  return {name, stillLife, [change](Subject& it) {
            it.look.materials = materialsOf(Look::kStudio);
            change(*it.look.materials);
          }};
}

void roughen(Subject& it, double Materials::*roughness, double by) {
  it.look.materials = materialsOf(Look::kStudio);
  *it.look.materials.*roughness += by;
}

const std::vector<std::pair<const char*, Eigen::Index>> kChannels = {{"red", 0}, {"green", 1}, {"blue", 2}};

}  // namespace

Mutations lightMutations() {
  const double degree = std::numbers::pi / 180;
  Mutations list = {
      lit("light from 2 degrees farther round",
          [=](Lighting& it) {
            it.light->towards = axisAngle(Vec3::UnitZ(), 2 * degree) * it.light->towards;
          }),
      lit("light from 2 degrees farther down",
          [=](Lighting& it) {
            it.light->towards = axisAngle(Vec3::UnitX(), 2 * degree) * it.light->towards;
          }),
      lit("light from the other side", [](Lighting& it) { it.light->towards.x() *= -1; }),
      lit("light 5 % brighter", [](Lighting& it) { it.light->color *= 1.05; }),
      lit("light's red and blue exchanged",
          [](Lighting& it) { std::swap(it.light->color.x(), it.light->color.z()); }),
      lit("no shadows", [](Lighting& it) { it.light->castsShadow = false; }),
      lit("no light", [](Lighting& it) { it.light.reset(); }),
      lit("sky and ground exchanged", [](Lighting& it) { std::swap(it.sky, it.ground); }),
      lit("background exchanged", [](Lighting& it) { std::swap(it.backgroundTop, it.backgroundBottom); }),
      lit("all light 3 % brighter",
          [](Lighting& it) {
            it.light->color *= 1.03;
            it.sky *= 1.03;
            it.ground *= 1.03;
          }),
      {"crate: no shadow", thrownCrate,
       [](Subject& it) {
         it.look.lighting = lightingOf(Look::kStudio, *it.scene.camera);
         it.look.lighting->light->castsShadow = false;
       }},
      {"row: no shadows", row,
       [](Subject& it) {
         it.look.lighting = lightingOf(Look::kStudio, *it.scene.camera);
         it.look.lighting->light->castsShadow = false;
       }},
  };
  for (const auto& [name, i] : kChannels) {
    const Eigen::Index channel = i;
    const auto of = [channel](Vec3 Lighting::*color) {
      return [channel, color](Lighting& it) { (it.*color)[channel] *= 1.06; };
    };
    const std::string more = std::string("'s ") + name + " 6 % more";
    list.push_back(lit("light" + more, [channel](Lighting& it) { it.light->color[channel] *= 1.06; }));
    list.push_back(lit("sky" + more, of(&Lighting::sky)));
    list.push_back(lit("ground" + more, of(&Lighting::ground)));
    list.push_back(lit("background's top" + more, of(&Lighting::backgroundTop)));
    list.push_back(lit("background's bottom" + more, of(&Lighting::backgroundBottom)));
  }
  return list;
}

Mutations materialMutations() {
  Mutations list = {
      made("boxes rougher", [](Materials& it) { it.boxRoughness += 0.05; }),
      made("boxes half of one colour", [](Materials& it) { it.ownColor = 0.5; }),
      made("boxes 5 % of one colour", [](Materials& it) { it.ownColor = 0.95; }),
      made("no marks", [](Materials& it) { it.marks = false; }),
      made("lines along edges", [](Materials& it) { it.edgeLine = 0.05; }),
      made("joints of another colour",
           [](Materials& it) {
             it.ownJoints = true;
             it.lineColor = Vec3(0.2, 0.2, 0.3);
           }),
      {"tiles rougher, against the light", againstTheLight,
       [](Subject& it) { roughen(it, &Materials::tileRoughness, 0.05); }},
      made("tiles of 0.12 contrast", [](Materials& it) { it.tileContrast = 0.12; }),
      made("no tiles", [](Materials& it) { it.tileContrast = 0; }),
      made("fainter joints", [](Materials& it) { it.joints = 0.8; }),
      made("no joints", [](Materials& it) { it.joints = 0; }),
      made("no occlusion", [](Materials& it) { it.occlusion = false; }),
      made("no bounce", [](Materials& it) { it.bounce = 0; }),
      made("no shade in corners", [](Materials& it) { it.corners = 0; }),
      made("shoulder from 0.6", [](Materials& it) { it.shoulder = 0.6; }),
      {"walls smoother, against the light", againstTheLight,
       [](Subject& it) { roughen(it, &Materials::wallRoughness, -0.1); }},
      {"no smooth edges", stillLife, [](Subject& it) { it.scene.picture.antialiasing = Antialiasing::kOff; }},
      {"edges smooth by samples", stillLife,
       [](Subject& it) { it.scene.picture.antialiasing = Antialiasing::kMultisampled; }},
      {"drawn twice as large", stillLife,
       [](Subject& it) { it.scene.picture.antialiasing = Antialiasing::kSupersampled; }},
      {"as a blueprint", stillLife, [](Subject& it) { it.scene.picture.look = Look::kBlueprint; }},
      {"as clay", stillLife, [](Subject& it) { it.scene.picture.look = Look::kClay; }},
  };
  for (const auto& [name, i] : kChannels) {
    const Eigen::Index channel = i;
    const auto of = [channel](Vec3 Materials::*color) {
      return [channel, color](Materials& it) { (it.*color)[channel] *= 1.05; };
    };
    const std::string more = std::string("'s ") + name + " 5 % more";
    list.push_back(made("floor" + more, of(&Materials::floor)));
    list.push_back(made("walls" + more, of(&Materials::wall)));
    list.push_back(made("ramp" + more, of(&Materials::slab)));
  }
  return list;
}

// "No dither" is caught nevertheless, by a third of the limit; the others pass.
Mutations unseenMutations() {
  return {
      made("no dither", [](Materials& it) { it.dither = 0; }),
      lit("light 0.1 % brighter", [](Lighting& it) { it.light->color *= 1.001; }),
      made("floor's red 0.1 % more", [](Materials& it) { it.floor.x() *= 1.001; }),
      made("tiles rougher, the light from behind", [](Materials& it) { it.tileRoughness += 0.05; }),
      made("walls smoother, the light from behind", [](Materials& it) { it.wallRoughness -= 0.1; }),
      {"red a hundredth of a millimetre away", stillLife,
       [](Subject& it) { it.scene.boxes[0].pose.position.y() += 1e-5; }},
      {"a millionth of a degree wider", stillLife, [](Subject& it) { it.scene.camera->fovDegrees += 1e-6; }}};
}

}  // namespace careen
