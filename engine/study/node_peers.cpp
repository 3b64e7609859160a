#include "study/node_peers.h"

#include <array>
#include <memory>
#include <nlohmann/json.hpp>
#include <system_error>
#include <vector>

#include "core/error.h"
#include "core/system/file.h"
#include "core/system/process.h"
#include "study/program_peer.h"

namespace careen {
namespace {

namespace fs = std::filesystem;

/// An engine, its package and what is set at its best.
struct NodeEngine {
  const char* name;
  const char* package;
  const char* title;
  const char* always;
  const char* best;
};

constexpr std::array kNodeEngines = {
    NodeEngine{.name = "mujoco-3",
               .package = "@mujoco/mujoco",
               .title = "MuJoCo",
               .always = "restitution by the damping of contacts",
               .best = "contacts as stiff as the time step allows, RK4, elliptic cones"},
    NodeEngine{
        .name = "jolt",
        .package = "jolt-physics",
        .title = "Jolt, package",
        .always = "no damping",
        .best = "gyroscopic force, no sleeping, no limit of velocities, no convex radius, contacts only "
                "where boxes overlap, no slop, restitution at any speed, 50 velocity and 10 position steps"},
    NodeEngine{.name = "rapier",
               .package = "@dimforge/rapier3d-compat",
               .title = "Rapier",
               .always = "",
               .best = "no sleeping, 20 solver iterations, no allowed error, contacts of 120 Hz"},
};

// The version of an installed package; empty if it is not installed.
std::string versionOf(const fs::path& folder, const NodeEngine& engine) {
  const fs::path file = folder / "node_modules" / engine.package / "package.json";
  std::error_code ignored;
  if (!fs::exists(file, ignored)) {
    return "";
  }
  const auto package = nlohmann::json::parse(readFile(file), nullptr, false);
  return package.is_object() ? package.value("version", "") : "";
}

std::string whyNotStarted() {
  try {
    runProgram({"node", "--version"});
  } catch (const MachineError& error) {
    return error.what();
  }
  return "";
}

}  // namespace

NodePeers nodePeersIn(const fs::path& folder) {
  NodePeers peers;
  const std::string fault = whyNotStarted();
  std::string missing;
  for (const NodeEngine& engine : kNodeEngines) {
    const std::string version = versionOf(folder, engine);
    if (version.empty() || !fault.empty()) {
      missing += (missing.empty() ? "" : ", ") + std::string(engine.name);
      continue;
    }
    const std::string always = *engine.always != '\0' ? std::string(", ") + engine.always : "";
    for (const bool isBest : {false, true}) {
      peers.all.push_back(
          std::make_unique<ProgramPeer>(std::string(engine.name) + (isBest ? "-best" : ""),
                                        std::string(engine.title) + " " + version + " as WebAssembly" +
                                            always + ", " + (isBest ? engine.best : "default settings"),
                                        std::vector<std::string>{"node", (folder / "runner.mjs").string(),
                                                                 engine.name, isBest ? "best" : "default"}));
    }
  }
  if (!missing.empty()) {
    peers.leftOut = missing + ": left out, " +
                    (fault.empty() ? "found no packages of theirs; 'npm install --prefix " + folder.string() +
                                         "' fetches them"
                                   : fault);
  }
  return peers;
}

NodePeers nodePeers() {
#ifdef CAREEN_NODE_PEERS
  return nodePeersIn(CAREEN_NODE_PEERS);
#else
  return {};
#endif
}

}  // namespace careen
