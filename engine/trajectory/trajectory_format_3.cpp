#include "trajectory/trajectory_format_3.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "trajectory/run_check.h"
#include "trajectory/trajectory_format.h"

namespace careen {
namespace {

// An old file's bodies and walls must match its scene. Initial positions come from the tracks alone:
// overlapping boxes had been moved apart.
void takeSetup(const ArchiveReader& reader, RunSetup setup, const std::vector<std::string>& wallNames,
               const std::vector<Body>& bodies, Trajectory& run) {
  if (setup.world.bodies.size() != bodies.size()) {
    reader.fail("has " + std::to_string(bodies.size()) + " bodies, its scene " +
                std::to_string(setup.world.bodies.size()));
  }
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    Body& body = setup.world.bodies[i];
    if (body.name != bodies[i].name) {
      reader.fail("has a body '" + bodies[i].name + "' where its scene has '" + body.name + "'");
    }
    if (body.mass != bodies[i].mass) {
      reader.fail("has another mass or inertia of body '" + body.name + "' than its scene gives that box");
    }
  }
  const bool sameWalls =
      std::equal(wallNames.begin(), wallNames.end(), setup.world.walls.begin(), setup.world.walls.end(),
                 [](const std::string& name, const Wall& wall) { return name == wall.name; });
  if (!sameWalls) {
    reader.fail("has other walls than its scene");
  }
  run.world = std::move(setup.world);
  run.stage = std::move(setup.stage);
  run.plan = std::move(setup.plan);
}

}  // namespace

void readFormat3(ArchiveReader& reader, const SetupReader& setupOf, Trajectory& run) {
  visitBeginning(reader, run);
  std::vector<std::string> wallNames;
  visitAll(reader, wallNames);
  std::vector<Body> bodies;
  std::uint64_t count = 0;
  reader.visit(count);
  for (std::uint64_t i = 0; i < count; ++i) {
    Body& body = bodies.emplace_back();
    reader.visit(body.name);
    visit(reader, body.mass);
    visitAll(reader, run.tracks.emplace_back().segments);
  }
  visitAll(reader, run.impacts);
  if (!setupOf) {
    reader.fail("has format version 3, which is read only together with its scene; expected 4");
  }
  takeSetup(reader, setupOf(run.sceneText, run.settings), wallNames, bodies, run);
}

void startWhereTracksDo(Trajectory& run) {
  checkMotions(run);
  for (std::size_t body = 0; body < run.tracks.size(); ++body) {
    run.world.bodies[body].initial = run.state(body, 0);
  }
}

}  // namespace careen
