#pragma once

#include <filesystem>
#include <string>

#include "study/contestant.h"

namespace careen {

/// Engines that npm has as WebAssembly, run by node: those whose packages are installed in a folder.
struct NodePeers {
  Contestants all;      ///< each engine with its defaults and with the best settings found
  std::string leftOut;  ///< which are missing and how they are installed; empty if none is
};

/// Those of a folder with tests/peers, where `npm install` has been run or has not.
NodePeers nodePeersIn(const std::filesystem::path& folder);

/// Those of this build; without CAREEN_PEERS there are none, and none is missing.
NodePeers nodePeers();

}  // namespace careen
