// Prints the state hash of a scene's run, as `careen simulate` does, from a program that contains only the
// physics and what it needs: careen_state_hash SCENE [--method METHOD] [--duration SECONDS].
#include <cstdlib>
#include <exception>
#include <iostream>
#include <stdexcept>
#include <string>

#include "core/math/arithmetic.h"
#include "core/system/file.h"
#include "physics/world/method.h"
#include "scene/plan.h"
#include "scene/scene_reader.h"
#include "trajectory/trajectory.h"

namespace careen {
namespace {

std::string stateHashOf(int argc, char** argv) {
  if (argc % 2 != 0) {
    throw std::invalid_argument("usage: careen_state_hash SCENE [--method METHOD] [--duration SECONDS]");
  }
  const std::string text = readFile(argv[1]);
  Scene scene = parseScene(text, argv[1], Starts::kApart);
  for (int i = 2; i < argc; i += 2) {
    const std::string option = argv[i];
    if (option == "--method") {
      scene.settings.method = methodNamed(argv[i + 1]).value();
    } else if (option == "--duration") {
      scene.settings.duration = std::stod(argv[i + 1]);
    } else {
      throw std::invalid_argument("found " + option + ", expected --method or --duration");
    }
  }
  const DefaultFloatEnvironment usual;
  return record(assemble(scene, plan(scene)), scene.settings, text).stateHash();
}

}  // namespace
}  // namespace careen

int main(int argc, char** argv) {
  try {
    std::cout << "state hash   " << careen::stateHashOf(argc, argv) << '\n';
  } catch (const std::exception& error) {
    std::cerr << error.what() << '\n';
    return 2;
  }
  return 0;
}
