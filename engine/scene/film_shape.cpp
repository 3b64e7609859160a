#include "scene/film_shape.h"

#include "scene/color_shape.h"

namespace careen {
namespace {

constexpr NumberRange kFieldOfView = {.min = kSmallestPositive,
                                      .max = 179.99999999999997,  // the last double below 180
                                      .unit = "deg",
                                      .plain = "a number between 0 and 180"};
constexpr NumberRange kFramesPerSecond = {.min = kSlowestFrameRate,
                                          .max = kFastestFrameRate,
                                          .unit = "1/s",
                                          .plain = "a number from 0.001 to 100000"};
constexpr NumberRange kLightSize = {
    .min = 0, .max = kWidestLight, .unit = "deg", .plain = "a number from 0 to 60"};
constexpr NumberRange kShutterAngle = {
    .min = 0, .max = kWidestShutter, .unit = "deg", .plain = "a number from 0 to 360"};

CameraKey readKey(const JsonValue& value, double fovDegrees) {
  const JsonObject object = value.object({"time", "eye", "target", "fov_deg"});
  return {.time = object.require("time").number(nonNegativeNumber("s")),
          .eye = object.require("eye").vector(anyNumber("m")),
          .target = object.require("target").vector(anyNumber("m")),
          .fovDegrees = object.number("fov_deg", kFieldOfView, fovDegrees)};
}

std::vector<CameraKey> readKeys(const JsonValue& list, double fovDegrees) {
  const std::string expected = "an array of two keys or more";
  std::vector<CameraKey> keys;
  for (const JsonValue& key : list.elements(expected)) {
    keys.push_back(readKey(key, fovDegrees));
  }
  if (keys.size() < 2) {
    list.fail(expected);
  }
  return keys;
}

// With keys, a place of its own for each.
Focus readFocus(const JsonObject& camera) {
  Focus focus{.fStop = camera.require("f_stop").number(positiveNumber())};
  if (const std::optional<JsonValue> at = camera.find("focus")) {
    if (at->is(JsonNode::Kind::kString)) {
      at->string("the name of a box");  // which checkFilm finds
    } else {
      focus.distance = at->number(
          {.min = kSmallestPositive, .unit = "m", .plain = "a distance above 0, or the name of a box"});
    }
  }
  if (const std::optional<JsonValue> samples = camera.find("focus_samples")) {
    focus.samples = samples->integer(1, kMostShutterSamples, "");
  }
  return focus;
}

TimeMap readTime(const JsonValue& list) {
  const std::string expected = "an array of two or more [film time, scene time]";
  TimeMap map;
  for (const JsonValue& key : list.elements(expected)) {
    const std::vector<JsonValue> times = key.elements("[film time, scene time] [s]", 2);
    map.keys.push_back(
        {.film = times[0].number(nonNegativeNumber("s")), .scene = times[1].number(nonNegativeNumber("s"))});
  }
  if (map.keys.size() < 2) {
    list.fail(expected);
  }
  return map;
}

Title readTitle(const JsonValue& value) {
  const JsonObject object = value.object({"time", "text", "place"});
  const std::vector<JsonValue> times = object.require("time").elements("[from, to] [s]", 2);
  Title title{.from = times[0].number(nonNegativeNumber("s")),
              .to = times[1].number(nonNegativeNumber("s")),
              .text = object.require("text").string("a text")};
  if (const std::optional<JsonValue> place = object.find("place")) {
    title.place = static_cast<TitlePlace>(place->word({kTitlePlaces.begin(), kTitlePlaces.end()}, "place"));
  }
  return title;
}

// `one`: what a name stands for; `example`: a name.
template <class Enum, const auto& kNames>
NameSet<Enum, kNames> readNames(const JsonValue& value, const std::string& one, const std::string& example) {
  NameSet<Enum, kNames> set;
  const std::vector<std::string_view> names(kNames.begin(), kNames.end());
  for (const JsonValue& each : value.elements("an array of " + one + "s such as [\"" + example + "\"]")) {
    const auto named = static_cast<Enum>(each.word(names, one));
    if (set.has(named)) {
      each.fail("each " + one + " once");
    }
    set.add(named);
  }
  return set;
}

// The parts that are drawn, or where it comes from as well.
void readLight(const JsonValue& value, Scene& scene) {
  const auto readParts = [&](const JsonValue& parts) {
    scene.picture.light = readNames<LightPart, kLightPartNames>(parts, "light part", "shadows");
  };
  if (!value.is(JsonNode::Kind::kObject)) {
    return readParts(value);
  }
  const JsonObject object = value.object({"parts", "direction", "size_deg", "color", "ambient"});
  if (const std::optional<JsonValue> parts = object.find("parts")) {
    readParts(*parts);
  }
  Scenery& scenery = scene.scenery;
  if (const std::optional<JsonValue> direction = object.find("direction")) {
    scenery.towardsLight = -direction->direction();
  }
  if (const std::optional<JsonValue> size = object.find("size_deg")) {
    scenery.lightDegrees = size->number(kLightSize);
  }
  if (const std::optional<JsonValue> color = object.find("color")) {
    scenery.lightColor = readColor(*color);
  }
  if (const std::optional<JsonValue> ambient = object.find("ambient")) {
    scenery.ambient = readColorPair(*ambient);
  }
}

void readCamera(const JsonValue& value, Scene& scene) {
  const JsonObject object = value.object({"eye", "target", "up", "fov_deg", "orbit", "follow", "keys",
                                          "easing", "f_stop", "focus", "focus_samples"});
  Camera camera;
  if (const std::optional<JsonValue> up = object.find("up")) {
    camera.up = up->direction();
  }
  camera.fovDegrees = object.number("fov_deg", kFieldOfView, camera.fovDegrees);
  CameraMove& move = scene.cameraMove;
  if (const std::optional<JsonValue> keys = object.find("keys")) {
    for (const char* key : {"eye", "target", "orbit"}) {
      if (object.has(key)) {
        object.fail("both keys and " + std::string(key), "one of them: keys say where the camera is");
      }
    }
    move.keys = readKeys(*keys, camera.fovDegrees);
    camera.eye = move.keys[0].eye;
    camera.target = move.keys[0].target;
    camera.fovDegrees = move.keys[0].fovDegrees;
  } else {
    camera.eye = object.require("eye").vector(anyNumber("m"));
    camera.target = object.require("target").vector(anyNumber("m"));
  }
  if (const std::optional<JsonValue> orbit = object.find("orbit")) {
    move.orbitDegrees = orbit->object({"deg_per_s"}).require("deg_per_s").number(anyNumber("deg/s"));
  }
  if (const std::optional<JsonValue> follow = object.find("follow")) {
    follow->string("the name of a box");
  }
  if (const std::optional<JsonValue> easing = object.find("easing")) {
    if (move.keys.empty()) {
      object.fail("easing without keys", "both, or neither");
    }
    move.easing = static_cast<Easing>(easing->word({kEasings.begin(), kEasings.end()}, "easing"));
  }
  if (object.has("f_stop") || object.has("focus") || object.has("focus_samples")) {
    scene.focus = readFocus(object);
  }
  scene.camera = camera;
}

void readFilm(const JsonValue& value, Scene& scene) {
  const JsonObject object =
      value.object({"size", "fps", "antialiasing", "time", "shutter_deg", "shutter_samples"});
  PictureSettings& picture = scene.picture;
  if (const std::optional<JsonValue> size = object.find("size")) {
    const std::vector<JsonValue> sides = size->elements("[width, height] [px]", 2);
    picture.width = sides[0].integer(1, kLargestFilm, "px");
    picture.height = sides[1].integer(1, kLargestFilm, "px");
  }
  if (const std::optional<JsonValue> fps = object.find("fps")) {
    picture.rate = frameRateFrom(fps->number(kFramesPerSecond));
  }
  if (const std::optional<JsonValue> how = object.find("antialiasing")) {
    picture.antialiasing =
        static_cast<Antialiasing>(how->word({kAntialiasings.begin(), kAntialiasings.end()}, "antialiasing"));
  }
  if (const std::optional<JsonValue> time = object.find("time")) {
    scene.timeMap = readTime(*time);
  }
  picture.shutter.degrees = object.number("shutter_deg", kShutterAngle, picture.shutter.degrees);
  if (const std::optional<JsonValue> samples = object.find("shutter_samples")) {
    if (!object.has("shutter_deg")) {
      object.fail("shutter_samples without shutter_deg", "both, or neither");
    }
    picture.shutter.samples = samples->integer(1, kMostShutterSamples, "");
  }
}

}  // namespace

void readShown(const JsonObject& object, Scene& scene) {
  if (const std::optional<JsonValue> camera = object.find("camera")) {
    readCamera(*camera, scene);
  }
  if (const std::optional<JsonValue> film = object.find("film")) {
    readFilm(*film, scene);
  }
  if (const std::optional<JsonValue> look = object.find("look")) {
    scene.picture.look = static_cast<Look>(look->word({kLooks.begin(), kLooks.end()}, "look"));
  }
  if (const std::optional<JsonValue> overlays = object.find("overlays")) {
    scene.picture.overlays = readNames<Overlay, kOverlayNames>(*overlays, "overlay", "energy");
  }
  if (const std::optional<JsonValue> light = object.find("light")) {
    readLight(*light, scene);
  }
  Scenery& scenery = scene.scenery;
  if (const std::optional<JsonValue> background = object.find("background")) {
    scenery.background = readColorPair(*background);
  }
  if (const std::optional<JsonValue> marks = object.find("marks")) {
    scenery.marks = marks->boolean();
  }
  if (const std::optional<JsonValue> gloss = object.find("gloss")) {
    scenery.gloss = gloss->number(kUnitRange);
  }
  if (const std::optional<JsonValue> titles = object.find("titles")) {
    for (const JsonValue& title : titles->elements("an array of titles")) {
      scenery.titles.push_back(readTitle(title));
    }
  }
}

}  // namespace careen
