#include "scene/scene_shape.h"

#include <algorithm>
#include <array>
#include <cctype>

#include "physics/world/method.h"
#include "scene/color_shape.h"
#include "scene/control_shape.h"
#include "scene/film_shape.h"
#include "scene/joint_shape.h"
#include "scene/json_shape.h"
#include "scene/motion_shape.h"
#include "scene/parts_shape.h"
#include "scene/sound_shape.h"
#include "scene/union_moments.h"

namespace careen {
namespace {

using Kind = JsonNode::Kind;

constexpr int kFormatVersion = 1;

Material readMaterial(const JsonObject& object) {
  return {.restitution = object.number("restitution", kUnitRange, 0),
          .friction = object.number("friction", nonNegativeNumber(), 0)};
}

Room readRoom(const JsonValue& value) {
  const JsonObject object = value.object({"min", "max", "open", "restitution", "friction", "material"});
  Room room;
  room.min = object.require("min").vector(anyNumber("m"));
  room.max = object.require("max").vector(anyNumber("m"));
  room.material = readMaterial(object);
  room.sound = readSound(object);
  if (const std::optional<JsonValue> open = object.find("open")) {
    const std::vector<std::string_view> sides(kRoomSides.begin(), kRoomSides.end());
    for (const JsonValue& side : open->elements("an array of sides such as [\"+z\"]")) {
      bool& isOpen = room.open.at(side.word(sides, "side"));
      if (isOpen) {
        side.fail("each side once");
      }
      isOpen = true;
    }
  }
  return room;
}

// A belt, or a turntable about an axis through that point.
SurfaceMotion readSurface(const JsonObject& object, const Vec3& axis, const Vec3& point) {
  const Vec3 spin = object.number("surface_spin", anyNumber("rad/s"), 0) * axis;
  return {.velocity = object.vector("surface_velocity", anyNumber("m/s")) - spin.cross(point), .spin = spin};
}

Wall readWall(const JsonValue& value, std::size_t index, Scene& scene) {
  const JsonObject object = value.object({"name", "point", "normal", "restitution", "friction",
                                          "surface_velocity", "surface_spin", "material", "motion"});
  Wall wall{.name = object.name("wall-" + std::to_string(index)),
            .normal = object.require("normal").direction(),
            .material = readMaterial(object)};
  const std::optional<JsonValue> motion = object.find("motion");
  const std::optional<JsonValue> given = object.find("point");
  Pose home;
  if (given || !motion || !hasPath(*motion)) {
    home.position = object.require("point").vector(anyNumber("m"));
  }
  wall.offset = dot(wall.normal, home.position);
  if (motion) {
    wall.course = readMotion(*motion, given, home);
    wall.offset = planeAt(wall, 0).offset;
  }
  wall.material.surface = readSurface(object, wall.normal, home.position);
  scene.wallSounds.push_back(readSound(object));
  return wall;
}

double readMass(const JsonObject& object, double volume, bool fixed) {
  const std::optional<JsonValue> mass = object.find("mass");
  const std::optional<JsonValue> density = object.find("density");
  if (mass && density) {
    object.fail("both mass and density", "one of them");
  }
  if (!mass && !density && !fixed) {
    object.fail("neither mass nor density", "one of them");
  }
  if (density) {
    return density->number(positiveNumber("kg/m³")) * volume;
  }
  return mass ? mass->number(positiveNumber("kg")) : 0;
}

// Three principal moments, or a tensor.
Mat3 readInertia(const JsonValue& value) {
  const std::vector<JsonValue> rows = value.elements("[Ix, Iy, Iz] or a tensor of three rows [kg m²]", 3);
  if (!rows[0].is(Kind::kArray)) {
    return value.vector(positiveNumber("kg m²")).asDiagonal();
  }
  Mat3 tensor;
  for (Eigen::Index row = 0; row < 3; ++row) {
    tensor.row(row) = rows[static_cast<std::size_t>(row)].vector(anyNumber("kg m²"));
  }
  return tensor;
}

// Of boxes that are given none: those of the shipped scenes, in turn. What is fixed is grey.
constexpr std::array<Color, 6> kPalette{{{0xc8, 0x55, 0x3d},
                                         {0xd9, 0xa4, 0x41},
                                         {0x4a, 0x6f, 0xa5},
                                         {0x5b, 0x9a, 0x8b},
                                         {0x8d, 0x6a, 0x9f},
                                         {0xd9, 0x7b, 0x41}}};

SceneBox readBox(const JsonValue& value, std::size_t index) {
  const JsonObject object = value.object({"name",
                                          "half_extents",
                                          "parts",
                                          "mass",
                                          "density",
                                          "mass_from",
                                          "draw",
                                          "inertia",
                                          "center",
                                          "position",
                                          "orientation",
                                          "velocity",
                                          "angular_velocity",
                                          "restitution",
                                          "friction",
                                          "fixed",
                                          "color",
                                          "material",
                                          "surface_velocity",
                                          "surface_spin",
                                          "motion"});
  SceneBox box;
  box.name = object.name("box-" + std::to_string(index));
  SolidMoments solid;  // of the union of its parts
  if (const std::optional<JsonValue> parts = object.find("parts")) {
    if (object.find("half_extents")) {
      object.fail("both half_extents and parts", "one of them");
    }
    box.parts = readParts(*parts);
    box.halfExtents = reachOf(box.parts);
    solid = momentsOfUnion(box.parts);
  } else {
    box.halfExtents = object.require("half_extents").vector(positiveNumber("m"));
    solid.volume = 8 * box.halfExtents.prod();
  }
  if (const std::optional<JsonValue> fixed = object.find("fixed")) {
    box.fixed = fixed->boolean();
  }
  box.mass = readMass(object, solid.volume, box.fixed);
  if (!box.parts.empty() && !box.fixed) {
    box.inertia = box.mass / solid.volume * solid.inertia;
    box.center = solid.center;
  }
  if (const std::optional<JsonValue> inertia = object.find("inertia")) {
    box.inertia = readInertia(*inertia);
  }
  if (const std::optional<JsonValue> center = object.find("center")) {
    box.center = center->vector(anyNumber("m"));
  }
  if (const std::optional<JsonValue> mesh = object.find("mass_from")) {
    box.massFrom = mesh->string("the name of a mesh, .obj");
    if (box.massFrom.empty()) {
      mesh->fail("the name of a mesh, .obj");
    }
  }
  if (const std::optional<JsonValue> mesh = object.find("draw")) {
    box.drawFrom = mesh->string("the name of a mesh, .obj");
    if (box.drawFrom.empty()) {
      mesh->fail("the name of a mesh, .obj");
    }
  }
  box.pose.position = object.vector("position", anyNumber("m"));
  if (const std::optional<JsonValue> orientation = object.find("orientation")) {
    box.pose.worldFromBody = readOrientation(*orientation);
  }
  if (const std::optional<JsonValue> motion = object.find("motion")) {
    box.course = readMotion(*motion, object.find("position"), box.pose);
    box.pose = box.course.front().at(0).pose;
  }
  box.velocity = object.vector("velocity", anyNumber("m/s"));
  box.angularVelocity = object.vector("angular_velocity", anyNumber("rad/s"));
  box.material = readMaterial(object);
  box.material.surface = readSurface(object, box.pose.worldFromBody.col(2), box.pose.position);
  if (const std::optional<JsonValue> color = object.find("color")) {
    box.color = readColor(*color);
  } else if (!box.fixed) {
    box.color = kPalette[index % kPalette.size()];
  }
  box.sound = readSound(object);
  return box;
}

// [x, y, z] in the world, or [name, [x, y, z]] on a box.
SpringEnd readSpringEnd(const JsonValue& value) {
  const std::string expected = "a world point [x, y, z] or [name of a box, [x, y, z]]";
  const std::vector<JsonValue> parts = value.elements(expected);
  if (parts.size() == 3) {
    return {.body = std::nullopt, .point = value.vector(anyNumber("m"))};
  }
  if (parts.size() != 2) {
    value.fail(expected);
  }
  parts[0].string("the name of a box");
  return {.body = std::nullopt, .point = parts[1].vector(anyNumber("m"))};
}

Spring readSpring(const JsonValue& value) {
  const JsonObject object = value.object({"from", "to", "stiffness", "damping", "rest_length"});
  return {.from = readSpringEnd(object.require("from")),
          .to = readSpringEnd(object.require("to")),
          .stiffness = object.require("stiffness").number(nonNegativeNumber("N/m")),
          .damping = object.number("damping", nonNegativeNumber("N s/m"), 0),
          .restLength = object.number("rest_length", nonNegativeNumber("m"), 0)};
}

Drag readDrag(const JsonValue& value) {
  const JsonObject object = value.object({"linear", "angular"});
  return {.linear = object.number("linear", nonNegativeNumber("N s/m"), 0),
          .angular = object.number("angular", nonNegativeNumber("N m s"), 0)};
}

// Read first: another version may have other keys.
void readVersion(const JsonTree& tree, const JsonValue& root) {
  const JsonNode* const version = root.node().find("careen");
  if (version == nullptr) {
    tree.fail(root.node().offset, "no careen in the scene",
              "that key, which gives the version of the format");
  }
  if (version->kind != Kind::kNumber || version->number != kFormatVersion) {
    tree.fail(version->offset, describe(*version) + " for careen",
              "1, the version of the scene format that this program reads");
  }
}

template <class Item, class Read>
std::vector<Item> readList(const std::optional<JsonValue>& list, Read read) {
  std::vector<Item> items;
  if (list) {
    for (const JsonValue& value : list->elements("an array")) {
      items.push_back(read(value, items.size()));
    }
  }
  return items;
}

template <class Item, class Read>
std::optional<Item> readOptional(const std::optional<JsonValue>& value, Read read) {
  return value ? std::optional<Item>(read(*value)) : std::nullopt;
}

Method readMethod(const JsonValue& value) {
  return kMethods.at(value.word({kMethodNames.begin(), kMethodNames.end()}, "method")).method;
}

// "when" is a word, or a number of bodies.
CrowdSettings readCrowds(const JsonValue& value) {
  const JsonObject object = value.object({"when", "tolerance"});
  CrowdSettings crowds;
  if (const std::optional<JsonValue> when = object.find("when")) {
    if (when->is(Kind::kNumber)) {
      constexpr int kMost = 1'000'000'000;
      crowds.when = CrowdSettings::When::kAbove;
      crowds.above = when->integer(0, kMost, "boxes");
    } else {
      crowds.when = static_cast<CrowdSettings::When>(when->word({"auto", "never"}, "time of crowds"));
    }
  }
  crowds.tolerance = object.number("tolerance", positiveNumber("m"), crowds.tolerance);
  return crowds;
}

void readGravity(const JsonObject& scene, Scene& into) {
  const std::optional<JsonValue> value = scene.find("gravity");
  if (!value || !value->is(Kind::kObject)) {
    into.gravity = scene.vector("gravity", anyNumber("m/s²"));
    return;
  }
  const JsonObject object = value->object({"path", "linear"});
  const JsonValue path = object.require("path");
  const std::optional<JsonValue> linear = object.find("linear");
  into.gravityPath = linear && linear->boolean() ? GravityPath::kLinear : GravityPath::kSteps;
  for (const JsonValue& point : path.elements("[[time, x, y, z], …]")) {
    const std::vector<JsonValue> numbers = point.elements("[time, x, y, z]", 4);
    GravityChange& change = into.gravityChanges.emplace_back();
    change.time = numbers[0].number(nonNegativeNumber("s"));
    for (int axis = 0; axis < 3; ++axis) {
      change.gravity[axis] = numbers[static_cast<std::size_t>(axis) + 1].number(anyNumber("m/s²"));
    }
  }
  if (into.gravityChanges.empty()) {
    path.fail("one point or more");
  }
  if (into.gravityPath == GravityPath::kLinear && into.gravityChanges.size() == 1) {
    path.fail("two points or more, as it is linear");
  }
  into.gravity = into.gravityChanges.front().gravity;
}

JsonObject sceneObject(const JsonTree& tree) {
  const JsonValue root(tree, tree.root(), "");
  if (root.is(Kind::kObject)) {
    readVersion(tree, root);
  }
  return root.object({"careen",     "name",   "duration",     "gravity", "room",   "walls",  "boxes",
                      "springs",    "joints", "pass_through", "control", "drag",   "method", "dt",
                      "tolerance",  "crowds", "camera",       "film",    "look",   "light",  "overlays",
                      "background", "marks",  "gloss",        "titles",  "$schema"});
}

}  // namespace

Scene readShape(const JsonTree& tree) {
  const JsonObject object = sceneObject(tree);
  Scene scene;
  scene.text = tree.text();
  if (const std::optional<JsonValue> name = object.find("name")) {
    scene.name = name->string("a string");
  }
  if (const std::optional<JsonValue> schema = object.find("$schema")) {
    schema->string("a string");  // editors read it, for completion of keys
  }
  scene.settings.duration = object.require("duration").number(positiveNumber("s"));
  readGravity(object, scene);
  scene.room = readOptional<Room>(object.find("room"), readRoom);
  scene.walls = readList<Wall>(object.find("walls"), [&scene](const JsonValue& value, std::size_t index) {
    return readWall(value, index, scene);
  });
  scene.boxes = readList<SceneBox>(object.require("boxes"), readBox);
  if (scene.boxes.empty()) {
    object.require("boxes").fail("at least one box");
  }
  scene.springs = readList<Spring>(object.find("springs"),
                                   [](const JsonValue& value, std::size_t) { return readSpring(value); });
  scene.joints = readList<Joint>(object.find("joints"), readJoint);
  if (const std::optional<JsonValue> control = object.find("control")) {
    scene.control = readControl(*control);
  }
  if (const std::optional<JsonValue> lists = object.find("pass_through")) {
    for (const JsonValue& list : lists->elements("an array")) {
      readPassThrough(list);
    }
  }
  scene.drag = readOptional<Drag>(object.find("drag"), readDrag);
  if (const std::optional<JsonValue> method = object.find("method")) {
    scene.settings.method = readMethod(*method);
  }
  scene.settings.dt = object.number("dt", positiveNumber("s"), scene.settings.dt);
  scene.settings.tolerance = object.number("tolerance", positiveNumber(), scene.settings.tolerance);
  if (const std::optional<JsonValue> crowds = object.find("crowds")) {
    scene.settings.crowds = readCrowds(*crowds);
  }
  readShown(object, scene);
  return scene;
}

Scene readShownShape(const JsonTree& tree) {
  Scene scene;
  readShown(sceneObject(tree), scene);
  return scene;
}

}  // namespace careen
