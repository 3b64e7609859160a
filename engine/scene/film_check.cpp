#include "scene/film_check.h"

#include <string>

#include "core/brief.h"

namespace careen {
namespace {

// With a smaller angle [rad] between line of sight and `up`, the sideways direction is undefined.
constexpr double kLeastTilt = 1e-9;

// `node` holds eye and target, `camera` may hold up.
void checkSight(const JsonTree& tree, const JsonNode& camera, const JsonNode& node, const Vec3& sight,
                const Vec3& up) {
  const double distance = sight.norm();
  if (distance == 0) {
    tree.fail(node.find("target")->offset, "the camera's target where its eye is",
              "another place to look at");
  }
  if (!((sight / distance).cross(up).norm() > kLeastTilt)) {
    const JsonNode* const upNode = camera.find("up");
    tree.fail(upNode == nullptr ? node.offset : upNode->offset, "a camera that looks along its up",
              "an up that points elsewhere");
  }
}

[[noreturn]] void failOrder(const JsonTree& tree, const JsonNode& node, const std::string& label,
                            const std::string& expected) {
  tree.fail(node.offset, describe(node) + " for " + label, expected);
}

void checkCamera(const JsonTree& tree, const Scene& scene) {
  if (!scene.camera) {
    return;
  }
  const JsonNode& camera = *tree.root().find("camera");
  const Vec3& up = scene.camera->up;
  const std::vector<CameraKey>& keys = scene.cameraMove.keys;
  if (keys.empty()) {
    checkSight(tree, camera, camera, scene.camera->target - scene.camera->eye, up);
  }
  for (std::size_t i = 0; i < keys.size(); ++i) {
    const JsonNode& node = camera.find("keys")->children[i];
    checkSight(tree, camera, node, keys[i].target - keys[i].eye, up);
    if (i > 0 && !(keys[i].time > keys[i - 1].time)) {
      failOrder(tree, *node.find("time"), "camera.keys[" + std::to_string(i) + "].time",
                "more than the key's before it, which is " + brief(keys[i - 1].time));
    }
  }
}

// The boxes that the camera follows and that it is sharp at.
void findBoxes(const JsonTree& tree, const BoxNames& boxes, Scene& scene) {
  const JsonNode* const camera = tree.root().find("camera");
  if (camera == nullptr) {
    return;
  }
  if (const JsonNode* const follow = camera->find("follow")) {
    scene.cameraMove.followed = static_cast<std::size_t>(boxes.named(tree, *follow));
  }
  const JsonNode* const focus = camera->find("focus");
  if (focus != nullptr && focus->kind == JsonNode::Kind::kString) {
    scene.focus->body = static_cast<std::size_t>(boxes.named(tree, *focus));
  }
}

void checkTitles(const JsonTree& tree, const Scene& scene) {
  for (std::size_t i = 0; i < scene.scenery.titles.size(); ++i) {
    const Title& title = scene.scenery.titles[i];
    if (!(title.to > title.from)) {
      failOrder(tree, tree.root().find("titles")->children[i].find("time")->children[1],
                "titles[" + std::to_string(i) + "].time[1]",
                "more than its begin, which is " + brief(title.from));
    }
  }
}

void checkTime(const JsonTree& tree, const Scene& scene) {
  const std::vector<TimeKey>& keys = scene.timeMap.keys;
  for (std::size_t i = 0; i < keys.size(); ++i) {
    const JsonNode& node = tree.root().find("film")->find("time")->children[i];
    const std::string label = "film.time[" + std::to_string(i) + "]";
    const auto fail = [&](std::size_t which, const std::string& expected) {
      failOrder(tree, node.children[which], label + "[" + std::to_string(which) + "]", expected);
    };
    if (i == 0 && keys[0].film != 0) {
      fail(0, "0, as the film begins there");
    }
    if (i > 0 && !(keys[i].film > keys[i - 1].film)) {
      fail(0, "a later film time than the one before it, which is " + brief(keys[i - 1].film));
    }
    if (i > 0 && !(keys[i].scene >= keys[i - 1].scene)) {
      fail(1, "no earlier scene time than the one before it, which is " + brief(keys[i - 1].scene));
    }
    if (!(keys[i].scene <= scene.settings.duration)) {
      fail(1, "a scene time within the duration, which is " + brief(scene.settings.duration));
    }
  }
}

}  // namespace

void checkShown(const JsonTree& tree, const BoxNames& boxes, Scene& scene) {
  findBoxes(tree, boxes, scene);
  checkCamera(tree, scene);
  checkTime(tree, scene);
  checkTitles(tree, scene);
}

}  // namespace careen
