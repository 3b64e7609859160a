#pragma once

#include <string>

#include "stage/run_setup.h"

namespace careen {

/// Lets a run be shown as a scene says: with its camera, film, look, light, background, titles and overlays,
/// each as it is where the scene is silent. Of the scene nothing else is read, and it need not have it.
/// InputError says where what is wrong, such as a camera that follows none of the run's boxes.
void showAs(RunSetup& run, const std::string& sceneText, const std::string& name);

}  // namespace careen
