#include "mutation/subject.h"

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <limits>
#include <map>
#include <memory>
#include <stdexcept>
#include <utility>

#include "compare/pictures_to_compare.h"
#include "physics/world/method.h"
#include "render/stage.h"
#include "support/article_equations.h"
#include "support/process.h"
#include "view/camera.h"

namespace careen {
namespace {

const std::filesystem::path kShaders = std::filesystem::path(CAREEN_SOURCE_DIR) / "shaders";

Mat3 turned(const Vec3& axis, double degrees) {
  return axisAngle(axis.normalized(), degrees * std::numbers::pi / 180);
}

SceneBox named(const std::string& name, SceneBox box) {
  box.name = name;
  return box;
}

SceneBox turnedBox(const std::string& name, const Vec3& position, const Vec3& halfExtents, const Color& color,
                   const Mat3& worldFromBody) {
  SceneBox box = named(name, boxAt(position, halfExtents, color));
  box.pose.worldFromBody = worldFromBody;
  return box;
}

std::string edited(std::string text, const ShaderEdit& edit) {
  const std::size_t at = text.find(edit.piece);
  if (at == std::string::npos || text.find(edit.piece, at + 1) != std::string::npos) {
    throw std::logic_error(edit.file + ": not there exactly once: " + edit.piece);
  }
  return text.replace(at, edit.piece.size(), edit.instead);
}

void writeShaders(const std::vector<ShaderEdit>& edits, const TemporaryFolder& folder) {
  for (const auto& entry : std::filesystem::directory_iterator(kShaders)) {
    const std::string name = entry.path().filename().string();
    std::string text = textOf(entry.path());
    for (const ShaderEdit& edit : edits) {
      if (edit.file == name) {
        text = edited(std::move(text), edit);
      }
    }
    folder.write(name, text);
  }
}

}  // namespace

Subject thrownCrate() {
  Subject subject{.name = "crate", .scene = crateInRoom(), .moment = 0.2, .look = {}, .edits = {}};
  Scene& scene = subject.scene;
  scene.settings.duration = 1.4;
  scene.room->material = {.restitution = 0.8, .friction = 0.3};
  SceneBox& crate = scene.boxes[0];
  crate.velocity = Vec3(3, 2.5, 2);
  crate.angularVelocity = Vec3(1, 2, -1.5);
  crate.material = {.restitution = 0.7, .friction = 0.4};
  return subject;
}

Subject strikingPair() {
  Subject subject{.name = "pair", .scene = {}, .moment = 0.5, .look = {}, .edits = {}};
  Scene& scene = subject.scene;
  scene.name = "pair";
  scene.settings.duration = 1;
  scene.gravity = Vec3(0, 0, -1);
  scene.camera = cameraAt(Vec3(0.5, -6, 1), Vec3(0.2, 0, 0), 36);
  const Mat3 askew = turned(Vec3(1, 2, 3), 40);
  SceneBox one = turnedBox("one", Vec3(-1, 0.05, 0.1), Vec3(0.4, 0.3, 0.2), {200, 85, 61}, askew);
  one.velocity = Vec3(2.5, 0.1, 0.3);
  one.angularVelocity = Vec3(1, -2, 0.5);
  one.material = {.restitution = 0.6, .friction = 0.1};
  SceneBox other =
      turnedBox("other", Vec3(1, 0, 0), Vec3(0.3, 0.35, 0.25), {74, 111, 165}, askew.transpose());
  other.mass = 2;
  other.velocity = Vec3(-1, 0, 0.2);
  other.angularVelocity = Vec3(-0.5, 1, 1);
  other.material = {.restitution = 0.4, .friction = 0.1};
  scene.boxes = {one, other};
  return subject;
}

Subject sprungChain() {
  Subject subject{.name = "springs", .scene = {}, .moment = 0.5, .look = {}, .edits = {}};
  Scene& scene = subject.scene;
  scene.name = "springs";
  scene.settings.duration = 0.5;
  scene.gravity = Vec3(0, 0, -5);
  scene.camera = cameraAt(Vec3(0, -6, 0), Vec3(0, 0, 0), 40);
  scene.boxes = {
      turnedBox("one", Vec3(-0.6, 0, 0), Vec3(0.3, 0.2, 0.15), {200, 85, 61}, turned(Vec3(1, 0, 1), 20)),
      turnedBox("other", Vec3(0.7, 0.1, 0), Vec3(0.2, 0.25, 0.2), {74, 111, 165}, Mat3::Identity())};
  scene.boxes[0].angularVelocity = Vec3(0.5, 1, 0);
  scene.drag = Drag{.linear = 0.2, .angular = 0.05};
  scene.springs = {{.from = {.body = std::nullopt, .point = Vec3(-1, 0, 1)},
                    .to = {.body = 0, .point = Vec3(-0.3, -0.2, 0.15)},
                    .stiffness = 8,
                    .damping = 0.3,
                    .restLength = 0.5},
                   {.from = {.body = 0, .point = Vec3(0.3, 0.2, 0.15)},
                    .to = {.body = 1, .point = Vec3(-0.2, 0, 0.2)},
                    .stiffness = 6,
                    .damping = 0.2,
                    .restLength = 0.3}};
  return subject;
}

Subject steppedCrate(Method method) {
  Subject subject = thrownCrate();
  subject.name = "stepped by " + std::string(traitsOf(method).name);
  subject.scene.settings.method = method;
  subject.scene.settings.dt = 1.0 / 240;
  return subject;
}

Subject stillLife() {
  Subject subject{.name = "still life", .scene = crateInRoom(), .moment = 0, .look = {}, .edits = {}};
  Scene& scene = subject.scene;
  scene.name = "still life";
  scene.settings.duration = 0.001;
  scene.walls = {wallAt(Vec3(-1, 0, 2).normalized(), -0.9)};
  scene.camera = cameraAt(Vec3(-1.2, -7.2, 3.2), Vec3(0.05, 0, 1.1), 36);
  scene.boxes = {
      turnedBox("red", Vec3(-1.9, -0.8, 0.4), Vec3(0.5, 0.4, 0.4), {200, 85, 61}, turned(Vec3::UnitZ(), 25)),
      turnedBox("pale", Vec3(-0.4, 0.3, 0.5), Vec3(0.5, 0.5, 0.5), {232, 220, 196},
                turned(Vec3::UnitZ(), -20)),
      turnedBox("blue", Vec3(-1.5, 0.6, 1.9), Vec3(0.55, 0.35, 0.3), {74, 111, 165},
                turned(Vec3(1, 2, -1), 50)),
      turnedBox("dark", Vec3(0.5, -0.9, 1.3), Vec3(0.35, 0.35, 0.35), {60, 60, 70},
                turned(Vec3(1, -1, 2), 140)),
      turnedBox("small", Vec3(0.9, -1.4, 0.14), Vec3(0.14, 0.14, 0.14), {106, 153, 78},
                turned(Vec3::UnitZ(), 10)),
      turnedBox("ochre", Vec3(1.6, 0.4, 2.1), Vec3(0.5, 0.3, 0.25), {217, 164, 65},
                turned(Vec3(-2, 1, 1), 75))};
  return subject;
}

Subject stillLifeWithoutLight() {
  Subject subject = stillLife();
  subject.name = "still life without light";
  Lighting lighting = lightingOf(Look::kStudio, *subject.scene.camera);
  lighting.light.reset();
  subject.look.lighting = lighting;
  return subject;
}

Subject againstTheLight() {
  Subject subject = stillLife();
  subject.name = "against the light";
  subject.scene.camera = cameraAt(Vec3(-1.2, -7.2, 0.7), Vec3(0.05, 0, 0.9), 36);
  subject.look.lighting = lightingOf(Look::kStudio, *stillLife().scene.camera);
  subject.look.lighting->light->towards = Vec3(0.2, 1, 0.35);
  subject.scene.room->open[3] = true;
  return subject;
}

Subject row() {
  Subject subject{.name = "row", .scene = {}, .moment = 0, .look = {}, .edits = {}};
  Scene& scene = subject.scene;
  scene.name = "row";
  scene.settings.duration = 0.001;
  scene.gravity = Vec3(0, 0, -9.81);
  scene.walls = {wallAt(Vec3::UnitZ(), 0)};
  scene.camera = cameraAt(Vec3(1, -5, 2), Vec3(1, 0, 0.4), 40);
  for (int i = 0; i < 6; ++i) {
    scene.boxes.push_back(turnedBox("domino-" + std::to_string(i), Vec3(0.4 * i, 0.05 * i * i, 0.4),
                                    Vec3(0.05, 0.2, 0.4), {200, 85, 61}, turned(Vec3::UnitZ(), 7.5 * i)));
  }
  return subject;
}

int pictureHeight() {
  const char* const given = std::getenv("CAREEN_MUTATION_HEIGHT");
  return given == nullptr ? 180 : std::stoi(given);
}

int pictureWidth() { return pictureHeight() * 16 / 9; }

double pixelAt(const Subject& subject, const Vec3& place) {
  const Camera& camera = *subject.scene.camera;
  return pixelAngle(camera, pictureHeight()) * (place - camera.eye).norm();
}

DeepPicture pictureOf(const Subject& subject) {
  RenderOptions options = subject.look;
  options.context.threads = 0;
  std::unique_ptr<TemporaryFolder> folder;
  if (!subject.edits.empty()) {
    folder = std::make_unique<TemporaryFolder>();
    writeShaders(subject.edits, *folder);
    options.shaders = folder->path();
  }
  const std::vector<Pose> poses =
      subject.moment > 0 ? runOf(subject.scene).poses(subject.moment) : posesOf(subject.scene);
  return deepPicture(Renderer(setupOf(subject.scene, pictureWidth(), pictureHeight()), options).draw(poses));
}

const DeepPicture& unchangedPicture(const Subject& subject) {
  static std::map<std::string, DeepPicture> drawn;
  const auto found = drawn.find(subject.name);
  return found != drawn.end() ? found->second : drawn.emplace(subject.name, pictureOf(subject)).first->second;
}

Margin marginOf(const PictureDifference& difference, const Tolerance& tolerance) {
  const auto percent = [&difference](std::size_t count) {
    return 100 * static_cast<double>(count) / static_cast<double>(difference.pixels);
  };
  const auto over = [](double found, double allowed) {
    return found == 0 ? 0 : allowed == 0 ? std::numeric_limits<double>::infinity() : found / allowed;
  };
  const double each = tolerance.fail * (1 + 1e-12);
  const std::size_t inside = difference.changed - difference.changedByEdges;
  const std::vector<Margin> all = {
      {over(percent(difference.pixelsOver(each, !tolerance.excuseEdges)), tolerance.failPercent),
       "pixels off"},
      {over(difference.largest, tolerance.hardFail), "largest"},
      {inside > 1 || tolerance.changedPercent == 0 ? over(percent(inside), tolerance.changedPercent) : 0,
       "colour changed"},
      {over(percent(difference.changedByEdges), tolerance.edgePercent), "edges"},
      {over(1 - difference.ssim, 1 - tolerance.leastSsim), "SSIM"},
      {over(1 - difference.worstSsim, 1 - tolerance.leastWindowSsim), "SSIM of a window"}};
  return *std::max_element(all.begin(), all.end(),
                           [](const Margin& a, const Margin& b) { return a.ratio < b.ratio; });
}

}  // namespace careen
