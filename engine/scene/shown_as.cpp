#include "scene/shown_as.h"

#include "core/hash.h"
#include "scene/film_check.h"
#include "scene/plan.h"
#include "scene/scene_shape.h"

namespace careen {

void showAs(RunSetup& run, const std::string& sceneText, const std::string& name) {
  const JsonTree tree(sceneText, name);
  Scene scene = readShownShape(tree);
  scene.settings.duration = run.settings.duration;
  for (const Body& body : run.world.bodies) {
    scene.boxes.emplace_back().name = body.name;
  }
  checkShown(tree, BoxNames(scene), scene);
  Stage asked = stageOf(scene);
  Stage& stage = run.stage;
  stage.camera = asked.camera;
  stage.cameraMove = asked.cameraMove;
  stage.focus = asked.focus;
  stage.timeMap = asked.timeMap;
  stage.picture = asked.picture;
  stage.scenery = asked.scenery;
  Hash hash;
  hash.add(sceneText);
  stage.shownAs = hash.text();
}

}  // namespace careen
