#include "scene/scene_shape.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <functional>
#include <nlohmann/json.hpp>
#include <set>
#include <string>
#include <utility>
#include <valijson/adapters/nlohmann_json_adapter.hpp>
#include <valijson/schema.hpp>
#include <valijson/schema_parser.hpp>
#include <valijson/validator.hpp>
#include <vector>

#include "core/names.h"
#include "core/system/file.h"
#include "physics/world/method.h"
#include "support/input_error.h"
#include "support/scenes.h"

namespace careen {
namespace {

using nlohmann::json;
using Adapter = valijson::adapters::NlohmannJsonAdapter;

const std::filesystem::path kAssets = std::filesystem::path(CAREEN_SOURCE_DIR) / "assets";

json schemaFile() { return json::parse(readFile(kAssets / "scene.schema.json")); }

class Schema {
 public:
  Schema() : file_(schemaFile()) {
    valijson::SchemaParser(valijson::SchemaParser::kDraft7).populateSchema(Adapter(file_), schema_);
  }
  bool accepts(const json& scene) { return valijson::Validator().validate(schema_, Adapter(scene), nullptr); }

 private:
  json file_;
  valijson::Schema schema_;
};

// ---- The reader and the schema accept the same files.

// What a value may be replaced by: every type, and numbers and words on both sides of every bound.
const std::vector<json>& replacements() {
  static const std::vector<json> list = json::parse(R"([
    null, true, false, 0, -0.0, 1, -1, 2, 0.5, -0.5, 1.5, 1e-61, 1e-60, 1e60, 1.1e60, -1e60, -1.1e60, 1e300, -1e300,
    0.0009, 0.001, 100000, 100001, 16384, 16385, 9007199254740993, 179.99999999999997, 180, 180.5,
    "", "x", "a,b", "a\"b", "a\nb", "a\u0001b", "a\u0000b", "a\u001fb", "a\u007fb", "a b", "höhe", "room-x",
    "#123456", "#12345", "#1234567", "#12345g", "123456#", "#ABCDEF", "+z", "-x", "z", "listing1", "Listing1", "exact", "1",
    [], [0], [null], ["x"], ["time"], ["time", "time"], [1, 2], [1.5, 2], [0, 1], [16384, 1], [16385, 1], [0, 0, 0], [0, -0.0, 0], [1, 2, 3],
    [0, 0, 1e-300], [1, 2, "3"], [1, 2, null], [1, 2, 1e61], [1e-60, 1, 1], [1e-61, 1, 1], [0, 1, 1], [-1, 1, 1],
    [0, 0, 0, 0], [1, 0, 0, 0], [0, 0, 0, 0.5], [1, 0, 0, true], [1, 2, 3, 4, 5],
    ["+x"], ["+x", "-x"], ["+x", "+x"], ["x", "+x"], ["-x", "+x", "-y", "+y", "-z", "+z"],
    ["crate", [0, 0, 0]], ["crate", [0, 0]], [1, [0, 0, 0]], ["crate", 1], ["crate", [0, 0, 0], 1], [[0, 0, 0], "crate"],
    {}, {"x": 1}, {"axis": [0, 0, 1], "angle_deg": 3}, {"axis": [0, 0, 0], "angle_deg": 3}, {"axis": [0, 0, 1]},
    {"angle_deg": 3}, {"axis": [0, 0, 1], "angle_deg": 3, "x": 1}, ["crate", "world"], "hinge", "rope", "fixed", {"half_extents": [1, 1, 1], "mass": 1},
    {"half_extents": [1, 1, 1]}, {"half_extents": [1, 1, 1], "fixed": true}, {"half_extents": [1, 1, 1], "fixed": false},
    {"point": [0, 0, 0], "normal": [0, 0, 1]}, {"from": [0, 0, 0], "to": ["crate", [0, 0, 0]], "stiffness": 0},
    {"min": [0, 0, 0], "max": [1, 1, 1]}, {"eye": [0, 0, 0], "target": [1, 1, 1]}, {"deg_per_s": 5}, {"deg_per_s": "x"},
    {"keys": [{"time": 0, "eye": [0, 0, 0], "target": [1, 1, 1]}, {"time": 1, "eye": [0, 0, 0], "target": [1, 1, 1]}]},
    {"time": 0, "eye": [0, 0, 0], "target": [1, 1, 1]}, {"time": 0, "eye": [0, 0, 0]},
    [{"time": 0, "eye": [0, 0, 0], "target": [1, 1, 1]}], [[0, 0], [1, 1]], [[0, 0]], [[0, 0], [1, -1]], [[0], [1]],
    {"shutter_deg": 360}, {"shutter_samples": 8}, {"shutter_deg": 361}, 256, 257, 360
  ])");
  return list;
}

// Calls `look` with every scene that is one change away.
class Mutations {
 public:
  using Look = std::function<void(const json&)>;
  Mutations(json scene, Look look) : scene_(std::move(scene)), look_(std::move(look)) { visit(scene_); }

 private:
  // `value` is part of scene_: changed, looked at and put back.
  void visit(json& value) {
    const json before = value;
    for (const json& other : replacements()) {
      value = other;
      look_(scene_);
    }
    value = before;
    if (value.is_object()) {
      changeMembers(value, before);
    }
    if (value.is_array()) {
      changeElements(value, before);
    }
    if (value.is_structured()) {
      for (json& child : value) {
        visit(child);
      }
    }
  }
  void changeMembers(json& value, const json& before) {
    for (const auto& [key, member] : before.items()) {
      value.erase(key);
      look_(scene_);
      value[key + "_"] = member;  // misspelt
      look_(scene_);
      value = before;
      value[key + "_"] = member;  // too much
      look_(scene_);
      value = before;
    }
    for (const char* key : {"mass", "density", "fixed", "friction", "collide", "comment", "fov_deg",
                            "shutter_deg", "shutter_samples"}) {
      value[key] = 1;
      look_(scene_);
      value[key] = true;
      look_(scene_);
      value = before;
    }
  }
  void changeElements(json& value, const json& before) {
    for (std::size_t i = 0; i < before.size(); ++i) {
      value.erase(i);
      look_(scene_);
      value = before;
    }
    if (!before.empty()) {
      value.push_back(before.back());
      look_(scene_);
      value = before;
    }
  }

  json scene_;
  Look look_;
};

std::string shapeErrorOf(const std::string& text) {
  return inputErrorOf([&text] { readShape(JsonTree(text, "f")); });
}

TEST(SceneShape, allScenesKeepToTheSchema) {
  Schema schema;
  for (const char* const folder : {"scenes", "scenes/hard"}) {
    for (const auto& entry : std::filesystem::directory_iterator(kAssets / folder)) {
      if (entry.is_regular_file()) {
        const std::string text = readFile(entry.path());
        EXPECT_TRUE(schema.accepts(json::parse(text, nullptr, true, true))) << entry.path();
        EXPECT_EQ(shapeErrorOf(text), "no error") << entry.path();
      }
    }
  }
}

// Together they have every key, which another test sees to.
const std::vector<const std::string*> kChanged = {&kEveryKey, &kJoints, &kShown, &kMoved};

TEST(SceneShape, schemaAndReaderAcceptAndRejectTheSameFiles) {
  Schema schema;
  int accepted = 0;
  int rejected = 0;
  for (const std::string* const scene : kChanged) {
    EXPECT_EQ(shapeErrorOf(*scene), "no error");
    EXPECT_TRUE(schema.accepts(json::parse(*scene)));
    Mutations(json::parse(*scene), [&](const json& mutation) {
      const std::string text = mutation.dump();
      const std::string error = shapeErrorOf(text);
      const bool bySchema = schema.accepts(mutation);
      EXPECT_EQ(error == "no error", bySchema) << error << "\n" << text;
      (bySchema ? accepted : rejected) += 1;
    });
  }
  RecordProperty("accepted", accepted);
  RecordProperty("rejected", rejected);
  EXPECT_GT(accepted, 5'000);   // measured KACC
  EXPECT_GT(rejected, 20'000);  // measured KREJ
}

// ---- What the schema tells an editor.

// Every property's schema, with its path.
void collectProperties(const json& schema, const std::string& path,
                       std::vector<std::pair<std::string, json>>& found) {
  for (const auto& [key, value] : schema.items()) {
    if (key == "properties") {
      for (const auto& [name, property] : value.items()) {
        found.emplace_back(std::string(path).append("/").append(name), property);
      }
    }
    if (value.is_structured()) {
      collectProperties(value, std::string(path).append("/").append(key), found);
    }
  }
}

TEST(SceneShape, schemaDescribesEveryKey) {
  const json schema = schemaFile();
  std::vector<std::pair<std::string, json>> properties;
  collectProperties(schema, "", properties);
  EXPECT_GT(properties.size(), 50U);
  for (const auto& [path, property] : properties) {
    json resolved = property;
    if (property.contains("$ref")) {
      resolved = schema.at(json::json_pointer(property["$ref"].get<std::string>().substr(1)));
    }
    // "fixed" where it excuses a missing mass, "type" where other keys depend on it.
    const bool isCondition =
        property.size() == 1 && (property.contains("const") || property.contains("enum"));
    EXPECT_TRUE(isCondition || (resolved.contains("title") && resolved.contains("description"))) << path;
  }
}

void collectKeys(const json& scene, std::set<std::string>& keys) {
  for (const auto& [key, value] : scene.items()) {
    if (scene.is_object()) {
      keys.insert(key);
    }
    if (value.is_structured()) {
      collectKeys(value, keys);
    }
  }
}

TEST(SceneShape, theScenesThatAreChangedHaveEveryKeyOfTheSchema) {
  std::set<std::string> used;
  for (const std::string* const scene : kChanged) {
    collectKeys(json::parse(*scene), used);
  }
  std::vector<std::pair<std::string, json>> properties;
  collectProperties(schemaFile(), "", properties);
  for (const auto& [path, property] : properties) {
    EXPECT_TRUE(used.contains(path.substr(path.rfind('/') + 1))) << path;
  }
}

TEST(SceneShape, schemaTellsTheDefaultsOfTheReader) {
  const json schema = schemaFile();
  const json& keys = schema["properties"];
  const json& box = schema["definitions"]["box"]["properties"];
  const json camera = {{"eye", {1, 2, 3}}, {"target", {0, 0, 0}}};
  const json bare = {{"careen", 1},
                     {"duration", 1},
                     {"boxes", {{{"half_extents", {1, 1, 1}}, {"mass", 1}}}},
                     {"camera", camera},
                     {"film", json::object()}};
  json filled = bare;
  for (const char* key : {"name", "gravity", "walls", "springs", "joints", "pass_through", "method", "dt",
                          "tolerance", "look", "light", "overlays"}) {
    filled[key] = keys[key]["default"];
  }
  for (const char* key : {"up", "fov_deg"}) {
    filled["camera"][key] = keys["camera"]["properties"][key]["default"];
  }
  for (const char* key : {"size", "fps", "antialiasing", "shutter_deg", "shutter_samples"}) {
    filled["film"][key] = keys["film"]["properties"][key]["default"];
  }
  for (const char* key : {"position", "velocity", "angular_velocity", "fixed"}) {
    filled["boxes"][0][key] = box[key]["default"];
  }
  const Scene without = readShape(JsonTree(bare.dump(), "f"));
  const Scene with = readShape(JsonTree(filled.dump(), "f"));
  EXPECT_EQ(with.name, without.name);
  EXPECT_EQ(with.gravity, without.gravity);
  EXPECT_EQ(with.settings.method, without.settings.method);
  EXPECT_EQ(with.settings.dt, without.settings.dt);
  EXPECT_EQ(with.settings.tolerance, without.settings.tolerance);
  EXPECT_EQ(with.camera->up, without.camera->up);
  EXPECT_EQ(with.camera->fovDegrees, without.camera->fovDegrees);
  EXPECT_EQ(with.picture.overlays, without.picture.overlays);
  EXPECT_EQ(with.picture.light, without.picture.light);
  EXPECT_EQ(with.picture.width, without.picture.width);
  EXPECT_EQ(with.picture.height, without.picture.height);
  EXPECT_EQ(with.picture.rate, without.picture.rate);
  EXPECT_EQ(with.picture.antialiasing, without.picture.antialiasing);
  EXPECT_EQ(with.picture.look, without.picture.look);
  EXPECT_EQ(with.picture.shutter.degrees, without.picture.shutter.degrees);
  EXPECT_EQ(with.picture.shutter.samples, without.picture.shutter.samples);
  const SceneBox& withBox = with.boxes[0];
  const SceneBox& withoutBox = without.boxes[0];
  EXPECT_EQ(withBox.pose.position, withoutBox.pose.position);
  EXPECT_EQ(withBox.velocity, withoutBox.velocity);
  EXPECT_EQ(withBox.angularVelocity, withoutBox.angularVelocity);
  EXPECT_EQ(withBox.fixed, withoutBox.fixed);
}

TEST(SceneShape, schemaListsTheMethodsThereAre) {
  std::vector<std::string> names;
  names.reserve(kMethods.size());
  for (const MethodTraits& known : kMethods) {
    names.emplace_back(known.name);
  }
  EXPECT_EQ(schemaFile()["properties"]["method"]["enum"], json(names));
}

TEST(SceneShape, schemaListsTheTypesOfJointsThereAre) {
  EXPECT_EQ(schemaFile()["definitions"]["joint"]["properties"]["type"]["enum"], json(kJointKindNames));
}

TEST(SceneShape, schemaListsThePartsOfTheLightThereAre) {
  EXPECT_EQ(schemaFile()["definitions"]["lightParts"]["items"]["enum"], json(kLightPartNames));
}

TEST(SceneShape, schemaListsTheOverlaysThereAre) {
  EXPECT_EQ(schemaFile()["properties"]["overlays"]["items"]["enum"], json(kOverlayNames));
}

// ---- What each bad value is told.

const std::vector<BadPiece> kBadValues = {
    {R"("careen": 1)", R"("careen": @2, "new_key": 3)",
     "found 2 for careen, expected 1, the version of the scene format that this program reads"},
    {R"("careen": 1)", R"("careen": @"1")",
     R"(found "1" for careen, expected 1, the version of the scene format that this program reads)"},
    {R"("every key")", "@7", "found 7 for name, expected a string"},
    {R"("../scene.schema.json")", "@null", "found null for $schema, expected a string"},
    {"2.5", "@0", "found 0 for duration, expected a number above 0 [s]"},
    {"2.5", "@-1", "found -1 for duration, expected a number above 0 [s]"},
    {"2.5", "@NaN", R"(found "NaN", expected a finite number)"},
    {"2.5", "@Infinity", R"(found "Infinity", expected a finite number)"},
    {"2.5", "@1e400", R"(found "1e400", expected a number no larger than 1.8e308)"},
    {"2.5", R"(@"2.5")", R"(found "2.5" for duration, expected a number above 0 [s])"},
    {R"("gravity")", R"(@"gravitiy")",
     R"(found the unknown key "gravitiy" in the scene, expected "gravity")"},
    {R"("gravity")", R"(@"wind")",
     R"(found the unknown key "wind" in the scene, expected one of careen, name, duration, gravity, room, )"
     "walls, boxes, springs, joints, pass_through, control, drag, method, dt, tolerance, crowds, camera, "
     "film, look, "
     "light, overlays, background, marks, gloss, titles, "
     "$schema"},
    {"[0, 0, -9.81]", "@-9.81", "found -9.81 for gravity, expected [x, y, z] [m/s²]"},
    {"[0, 0, -9.81]", "@[0, -9.81]", "found an array of 2 for gravity, expected [x, y, z] [m/s²]"},
    {"[0, 0, -9.81]", R"({ "path": [[0, 0, 0, -1]], @"smooth": true })",
     R"(found the unknown key "smooth" in gravity, expected one of path, linear)"},
    {"[0, 0, -9.81]", R"({ "path": [[0, 0, 0, -1]], "linear": @1 })",
     "found 1 for gravity.linear, expected true or false"},
    {"[0, 0, -9.81]", R"({ "path": @[[0, 0, 0, -1]], "linear": true })",
     "found an array of 1 for gravity.path, expected two points or more, as it is linear"},
    {"[0, 0, -9.81]", R"({ "path": @[] })",
     "found an array of 0 for gravity.path, expected one point or more"},
    {"[0, 0, -9.81]", R"({ "path": [@[0, 0, -1]] })",
     "found an array of 3 for gravity.path[0], expected [time, x, y, z]"},
    {"[0, 0, -9.81]", R"({ "path": [[@-1, 0, 0, 1]] })",
     "found -1 for gravity.path[0][0], expected a number not below 0 [s]"},
    {R"({ "min": [-3, -2, 0], )", "@{ ", "found no min in room, expected that key"},
    {R"(["-y", "+z"])", R"(["-y", @"top"])",
     R"(found the unknown side "top", expected one of -x, +x, -y, +y, -z, +z)"},
    {R"(["-y", "+z"])", R"(["-y", @"-y"])", R"(found "-y" for room.open[1], expected each side once)"},
    {R"(["-y", "+z"])", R"(@"-y")", R"(found "-y" for room.open, expected an array of sides such as ["+z"])"},
    {R"("restitution": 0.5)", R"("restitution": @1.01)",
     "found 1.01 for room.restitution, expected a number from 0 to 1"},
    {R"("restitution": 0.5)", R"("restitution": @-0.1)",
     "found -0.1 for room.restitution, expected a number from 0 to 1"},
    {R"("friction": 0.25)", R"("friction": @-0.25)",
     "found -0.25 for room.friction, expected a number not below 0"},
    {R"("normal": [1, 0, 2])", R"("normal": @[0, 0, 0])",
     "found a zero vector for walls[0].normal, expected a direction"},
    {R"({ "point": [0, 0, 4], )", "@{ ", "found no point in walls[1], expected that key"},
    {R"("normal": [0, 0, -0.5])", R"(@"normals": [0, 0, -0.5])",
     R"(found the unknown key "normals" in walls[1], expected "normal")"},
    {R"("crate", "half)", R"(@"", "half)",
     R"(found "" for boxes[0].name, expected a name without comma, quote or control character)"},
    {R"("crate", "half)", R"(@"a,b", "half)",
     R"(found "a,b" for boxes[0].name, expected a name without comma, quote or control character)"},
    {R"("crate", "half)", R"(@"a\"b", "half)",
     R"(found "a"b" for boxes[0].name, expected a name without comma, quote or control character)"},
    {R"("crate", "half)", R"(@"a\nb", "half)",
     R"(found "a?b" for boxes[0].name, expected a name without comma, quote or control character)"},
    {R"("crate", "half)", R"(@17, "half)",
     "found 17 for boxes[0].name, expected a name without comma, quote or control character"},
    {R"([0.5, 0.25, 0.125], "mass")", R"([0.5, @0, 0.125], "mass")",
     "found 0 for boxes[0].half_extents[1], expected a number above 0 [m]"},
    {R"([0.5, 0.25, 0.125], "mass")", R"([0.5, 0.25, @-1], "mass")",
     "found -1 for boxes[0].half_extents[2], expected a number above 0 [m]"},
    {R"("mass": 2)", R"("mass": @0)", "found 0 for boxes[0].mass, expected a number above 0 [kg]"},
    {R"("mass": 2)", R"("mass": @-2)", "found -2 for boxes[0].mass, expected a number above 0 [kg]"},
    {R"("mass": 2)", R"(@"mas": 2)", R"(found the unknown key "mas" in boxes[0], expected "mass")"},
    {R"({ "half_extents": [0.5, 0.5, 0.5], "density": 8)", R"(@{ "half_extents": [0.5, 0.5, 0.5])",
     "found neither mass nor density in boxes[1], expected one of them"},
    {R"({ "half_extents": [0.5, 0.5, 0.5], )", R"(@{ "half_extents": [0.5, 0.5, 0.5], "mass": 3, )",
     "found both mass and density in boxes[1], expected one of them"},
    {R"("density": 8)", R"("density": @0)",
     "found 0 for boxes[1].density, expected a number above 0 [kg/m³]"},
    {"[1, 0.5, 2]", "[1, @1e151, 2]",
     "found 1e151 for boxes[0].position[1], expected a number of at most 1e60 [m]"},
    {R"("axis": [0, 0, 2])", R"("axis": @[0, 0, 0])",
     "found a zero vector for boxes[0].orientation.axis, expected a direction"},
    {R"({ "axis": [0, 0, 2], "angle_deg": 90)", R"(@{ "axis": [0, 0, 2])",
     "found no angle_deg in boxes[0].orientation, expected that key"},
    {"[2, 0, 0, 0]", "@[0, 0, 0, 0]",
     "found a zero quaternion for boxes[1].orientation, expected a rotation"},
    {"[2, 0, 0, 0]", "@[2, 0, 0]",
     "found an array of 3 for boxes[1].orientation, expected [w, x, y, z] or an axis and an angle_deg"},
    {"[2, 0, 0, 0]", "@45",
     "found 45 for boxes[1].orientation, expected [w, x, y, z] or an axis and an angle_deg"},
    {"[6, 1.5, 0]", "[6, 1.5, @true]", "found true for boxes[0].velocity[2], expected a number [m/s]"},
    {"[3, 7, -2]", "@{}", "found an object for boxes[0].angular_velocity, expected [x, y, z] [rad/s]"},
    {R"("fixed": false)", R"("fixed": @0)", "found 0 for boxes[0].fixed, expected true or false"},
    {R"("#C8553d")", R"(@"#C8553")", R"(found "#C8553" for boxes[0].color, expected a colour "#rrggbb")"},
    {R"("#C8553d")", R"(@"#C8553g")", R"(found "#C8553g" for boxes[0].color, expected a colour "#rrggbb")"},
    {R"("#C8553d")", "@[200, 85, 61]",
     R"(found an array of 3 for boxes[0].color, expected a colour "#rrggbb" or its name)"},
    {R"(["crate", [0.5, 0.25, 0.125]])", R"(@["crate"])",
     "found an array of 1 for springs[0].from, expected a world point [x, y, z] or [name of a box, [x, y, "
     "z]]"},
    {R"(["crate", [0.5, 0.25, 0.125]])", "[@0, [0.5, 0.25, 0.125]]",
     "found 0 for springs[0].from[0], expected the name of a box"},
    {R"(["crate", [0.5, 0.25, 0.125]])", R"(["crate", @"corner"])",
     R"(found "corner" for springs[0].from[1], expected [x, y, z] [m])"},
    {"[-1.5, 0, 3]", R"([-1.5, 0, @"3"])", R"(found "3" for springs[0].to[2], expected a number [m])"},
    {R"("stiffness": 0.75)", R"("stiffness": @-0.75)",
     "found -0.75 for springs[0].stiffness, expected a number not below 0 [N/m]"},
    {R"("damping": 0.5)", R"("damping": @-0.5)",
     "found -0.5 for springs[0].damping, expected a number not below 0 [N s/m]"},
    {R"("rest_length": 1)", R"("rest_length": @-1)",
     "found -1 for springs[0].rest_length, expected a number not below 0 [m]"},
    {R"({ "from": ["box-1", [0, 0, 0]], )", "@{ ", "found no from in springs[1], expected that key"},
    {R"("linear": 0.5)", R"("linear": @-0.5)",
     "found -0.5 for drag.linear, expected a number not below 0 [N s/m]"},
    {R"("angular": 0.25)", R"("angular": @-1)",
     "found -1 for drag.angular, expected a number not below 0 [N m s]"},
    {R"("listing1")", R"(@"guess")",
     R"(found the unknown method "guess", expected one of )" + listed(kMethodNames)},
    {R"("listing1")", "@1", "found 1 for method, expected the name of a method"},
    {"0.001", "@0", "found 0 for dt, expected a number above 0 [s]"},
    {"0.001", "@-0.001", "found -0.001 for dt, expected a number above 0 [s]"},
    {"1e-9", "@0", "found 0 for tolerance, expected a number above 0"},
    {R"(["time", "energy"])", R"(["time", @"enrgy"])",
     R"(found the unknown overlay "enrgy", expected one of contacts, impulses, angular-momentum, spin-axis, trail, velocity, names, time, energy, joints, efforts, forces)"},
    {R"(["time", "energy"])", R"(["time", @"time"])",
     R"(found "time" for overlays[1], expected each overlay once)"},
    {R"(["time", "energy"])", R"(@"time")",
     R"(found "time" for overlays, expected an array of overlays such as ["energy"])"},
    {R"("clay")", R"(@"mud")", R"(found the unknown look "mud", expected one of studio, blueprint, clay)"},
};

TEST(SceneShape, badValuesAreToldWhereAndWhy) {
  for (const BadPiece& bad : kBadValues) {
    const MarkedText marked(everyKeyBut(bad.piece, bad.instead));
    EXPECT_EQ(shapeErrorOf(marked.text), "f:" + marked.place + ": " + bad.message);
  }
}

TEST(SceneShape, keysThatMustBeThereAreNamed) {
  EXPECT_EQ(shapeErrorOf("{}"),
            "f:1:1: found no careen in the scene, expected that key, which gives the version of the format");
  EXPECT_EQ(shapeErrorOf("\n  {\"careen\": 1}"), "f:2:3: found no duration in the scene, expected that key");
}

TEST(SceneShape, sceneIsAnObjectWithBoxes) {
  EXPECT_EQ(shapeErrorOf("[]"), "f:1:1: found an array of 0 for the scene, expected an object");
  EXPECT_EQ(shapeErrorOf(R"({"careen": 1, "duration": 1})"),
            "f:1:1: found no boxes in the scene, expected that key");
  EXPECT_EQ(shapeErrorOf(R"({"careen": 1, "duration": 1, "boxes": []})"),
            "f:1:39: found an array of 0 for boxes, expected at least one box");
  EXPECT_EQ(shapeErrorOf(R"({"careen": 1, "duration": 1, "boxes": [3]})"),
            "f:1:40: found 3 for boxes[0], expected an object");
  EXPECT_EQ(shapeErrorOf(R"({"careen": 1, "duration": 1, "boxes": [{"mass": 1}]})"),
            "f:1:40: found no half_extents in boxes[0], expected that key");
}

}  // namespace
}  // namespace careen
