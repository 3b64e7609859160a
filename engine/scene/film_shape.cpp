#include "scene/film_shape.h"

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

}  // namespace

void readCamera(const JsonValue& value, Scene& scene) {
  const JsonObject object = value.object({"eye", "target", "up", "fov_deg", "orbit", "follow", "keys"});
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

}  // namespace careen
