#include <numbers>
#include <utility>

#include "mutation/subject.h"
#include "render/look/lighting.h"
#include "support/article_equations.h"

namespace careen {
namespace {

using Change = std::function<void(Subject&)>;

SceneBox& box(Subject& it, std::size_t index) { return it.scene.boxes.at(index); }

Mutations ofPlaces() {
  Mutations list;
  const Scene still = stillLife().scene;
  for (std::size_t i = 0; i < still.boxes.size(); ++i) {
    const std::string& name = still.boxes[i].name;
    list.push_back({name + " a pixel to the right", stillLife, [i](Subject& it) {
                      box(it, i).pose.position.x() += pixelAt(it, box(it, i).pose.position);
                    }});
    list.push_back({name + " a pixel up", stillLife, [i](Subject& it) {
                      box(it, i).pose.position.z() += pixelAt(it, box(it, i).pose.position);
                    }});
    list.push_back({name + " turned by 3 degrees", stillLife, [i](Subject& it) {
                      Mat3& attitude = box(it, i).pose.worldFromBody;
                      attitude = axisAngle(Vec3::UnitZ(), 3 * std::numbers::pi / 180) * attitude;
                    }});
    list.push_back({name + " a pixel wider", stillLife, [i](Subject& it) {
                      box(it, i).halfExtents.x() += 0.5 * pixelAt(it, box(it, i).pose.position);
                    }});
    list.push_back({name + "'s red 3/255 off", stillLife, [i](Subject& it) {
                      box(it, i).color.red = static_cast<std::uint8_t>(box(it, i).color.red + 3);
                    }});
    list.push_back({name + "'s blue 3/255 off", stillLife, [i](Subject& it) {
                      box(it, i).color.blue = static_cast<std::uint8_t>(box(it, i).color.blue + 3);
                    }});
    list.push_back({name + " is not there", stillLife, [i](Subject& it) {
                      it.scene.boxes.erase(it.scene.boxes.begin() + static_cast<std::ptrdiff_t>(i));
                    }});
    list.push_back({name + " with another face to the front", stillLife, [i](Subject& it) {
                      Mat3& attitude = box(it, i).pose.worldFromBody;
                      const double side = box(it, i).halfExtents.x() == box(it, i).halfExtents.y() ? 0.5 : 1;
                      attitude = attitude * axisAngle(Vec3::UnitZ(), side * std::numbers::pi);
                    }});
  }
  return list;
}

Mutations ofSurroundings() {
  const auto still = [](const char* name, Change change) {
    return Mutation{name, stillLife, std::move(change)};
  };
  return {
      still("two boxes change places", [](Subject& it) { std::swap(box(it, 0).pose, box(it, 1).pose); }),
      still("two boxes change colours", [](Subject& it) { std::swap(box(it, 0).color, box(it, 5).color); }),
      still("a box more",
            [](Subject& it) {
              SceneBox more = box(it, 4);
              more.name = "more";
              more.pose.position = Vec3(-0.6, -1.5, 0.14);
              it.scene.boxes.push_back(more);
            }),
      still("room 3 cm wider", [](Subject& it) { it.scene.room->max.x() += 0.03; }),
      still("room 3 cm deeper", [](Subject& it) { it.scene.room->max.y() += 0.03; }),
      still("room 3 cm higher", [](Subject& it) { it.scene.room->max.z() += 0.03; }),
      still("floor 3 cm lower", [](Subject& it) { it.scene.room->min.z() -= 0.03; }),
      still("no wall on the left", [](Subject& it) { it.scene.room->open[0] = true; }),
      still("no back wall", [](Subject& it) { it.scene.room->open[3] = true; }),
      still("no ramp", [](Subject& it) { it.scene.walls.clear(); }),
      still("ramp 3 cm lower", [](Subject& it) { it.scene.walls[0].offset -= 0.03; }),
      still("ramp less steep",
            [](Subject& it) { it.scene.walls[0].normal = Vec3(-1, 0, 2.06).normalized(); }),
      {"row: a domino less", row, [](Subject& it) { it.scene.boxes.pop_back(); }},
      {"row: a domino leans by a degree", row,
       [](Subject& it) {
         Mat3& attitude = box(it, 5).pose.worldFromBody;
         attitude = axisAngle(Vec3::UnitX(), std::numbers::pi / 180) * attitude;
       }},
      {"row: floor 1 cm lower", row, [](Subject& it) { it.scene.walls[0].offset -= 0.01; }},
      {"crate: velocity 5 % greater", thrownCrate, [](Subject& it) { box(it, 0).velocity *= 1.05; }},
      {"crate: spin 10 % greater", thrownCrate, [](Subject& it) { box(it, 0).angularVelocity *= 1.1; }},
      {"crate: half the gravity", thrownCrate, [](Subject& it) { it.scene.gravity *= 0.5; }},
      {"crate: a frame later, of 60 a second", thrownCrate, [](Subject& it) { it.moment += 1.0 / 60; }},
      {"crate: a frame earlier, of 60 a second", thrownCrate, [](Subject& it) { it.moment -= 1.0 / 60; }},
      {"pair: restitution after the impact", strikingPair,
       [](Subject& it) { box(it, 0).material.restitution = box(it, 1).material.restitution = 0.3; }},
      {"pair: no friction", strikingPair, [](Subject& it) { box(it, 0).material.friction = 0; }},
      {"pair: twice the mass", strikingPair, [](Subject& it) { box(it, 1).mass *= 2; }},
      {"springs: stiffer by a tenth", sprungChain, [](Subject& it) { it.scene.springs[0].stiffness *= 1.1; }},
      {"springs: no drag", sprungChain, [](Subject& it) { it.scene.drag.reset(); }},
  };
}

}  // namespace

Mutations sceneMutations() {
  Mutations all = ofPlaces();
  Mutations rest = ofSurroundings();
  all.insert(all.end(), rest.begin(), rest.end());
  return all;
}

Mutations cameraMutations() {
  const auto seen = [](const char* name, const std::function<void(Camera&, double)>& change) {
    return Mutation{name, stillLife, [change](Subject& it) {
                      change(*it.scene.camera, pixelAt(it, it.scene.camera->target));
                      it.look.lighting = lightingOf(Look::kStudio, *stillLife().scene.camera);
                    }};
  };
  return {seen("eye a pixel to the right, and target",
               [](Camera& it, double pixel) {
                 it.eye.x() += pixel;
                 it.target.x() += pixel;
               }),
          seen("eye a pixel up, and target",
               [](Camera& it, double pixel) {
                 it.eye.z() += pixel;
                 it.target.z() += pixel;
               }),
          seen("eye half a pixel to the right, and target",
               [](Camera& it, double pixel) {
                 it.eye.x() += 0.5 * pixel;
                 it.target.x() += 0.5 * pixel;
               }),
          seen("eye 1 % nearer", [](Camera& it, double) { it.eye += 0.01 * (it.target - it.eye); }),
          seen("eye 10 cm to the left", [](Camera& it, double) { it.eye.x() -= 0.1; }),
          seen("eye 10 cm up", [](Camera& it, double) { it.eye.z() += 0.1; }),
          seen("target a pixel to the right", [](Camera& it, double pixel) { it.target.x() += pixel; }),
          seen("target a pixel up", [](Camera& it, double pixel) { it.target.z() += pixel; }),
          seen("target half a pixel up", [](Camera& it, double pixel) { it.target.z() += 0.5 * pixel; }),
          seen("half a degree wider", [](Camera& it, double) { it.fovDegrees += 0.5; }),
          seen("1 % narrower", [](Camera& it, double) { it.fovDegrees *= 0.99; }),
          seen("upward by half a degree",
               [](Camera& it, double) {
                 it.up = axisAngle((it.target - it.eye).normalized(), 0.5 * std::numbers::pi / 180) * it.up;
               }),
          seen("upside down", [](Camera& it, double) { it.up = -it.up; }),
          seen("in a mirror",
               [](Camera& it, double) {
                 it.eye.x() = -it.eye.x();
                 it.target.x() = -it.target.x();
               }),
          {"crate: eye a pixel up", thrownCrate,
           [](Subject& it) { it.scene.camera->eye.z() += pixelAt(it, it.scene.camera->target); }},
          {"row: target a pixel to the left", row,
           [](Subject& it) { it.scene.camera->target.x() -= pixelAt(it, it.scene.camera->target); }},
          {"light set up by another camera", stillLife, [](Subject& it) {
             it.look.camera = it.scene.camera;
             it.look.camera->eye.x() += 0.5;
           }}};
}

}  // namespace careen
