#include "scene/shown_as.h"

#include "core/hash.h"
#include "scene/film_check.h"
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
  static_cast<Showing&>(run.stage) = scene;
  Hash hash;
  hash.add(sceneText);
  run.stage.shownAs = hash.text();
}

}  // namespace careen
