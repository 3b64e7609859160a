#include "study/study.h"

#include <sys/utsname.h>

#include <algorithm>
#include <fstream>
#include <iterator>
#include <map>
#include <set>
#include <sstream>
#include <thread>
#include <utility>

#include "core/error.h"
#include "core/hash.h"
#include "core/system/file.h"
#include "study/case.h"
#include "study/node_peers.h"
#include "study/own_methods.h"
#include "study/peers.h"

namespace careen {
namespace {

namespace fs = std::filesystem;

bool isScene(const std::string& name) { return fs::path(name).extension() == ".json"; }

// Cases give their names to cases/NAME.json and to plots. InputError if two files would be the same.
void checkNames(const std::vector<std::string>& cases) {
  std::set<std::string> names;
  std::map<std::string, std::string> taken = {{kMatrixPlot, "the plot of all cases"}};
  for (const std::string& each : cases) {
    const std::string name = isScene(each) ? fs::path(each).stem().string() : each;
    if (!names.insert(name).second) {
      throw InputError("found two cases named " + name + ", expected different names");
    }
    // Scenes of one's own have no plot of energy.
    if (!isScene(each) && readCase(each).measure == Measure::kEnergy) {
      taken.emplace(name + kEnergyPlot, "the energy of case " + name);
    }
  }
  for (const auto& [name, owner] : taken) {
    if (names.contains(name)) {
      throw InputError("found a case named " + name + ", expected another name: plots/" + name +
                       ".svg shows " + owner);
    }
  }
}

// A hash of everything that a result depends on.
std::string stampOf(const Case& study, const Contestants& contestants, const StudySettings& settings) {
  Hash hash;
  hash.add(study.scene.text);
  hash.add(settings.version);
  hash.add(study.published);
  for (const auto& contestant : contestants) {
    hash.add(contestant->name() + contestant->settings());
  }
  const Effort& effort = settings.effort;
  for (const double number : {effort.longestRun, effort.longestStep, effort.timing,
                              static_cast<double>(effort.rounds), effort.shortest}) {
    hash.add(number);
  }
  for (const std::vector<double>& numbers : {effort.steps, effort.tolerances, study.times}) {
    for (const double number : numbers) {
      hash.add(number);
    }
  }
  for (const std::vector<Pose>& poses : study.poses) {
    for (const Pose& pose : poses) {
      for (const double number : pose.position) {
        hash.add(number);
      }
      for (const double number : pose.worldFromBody.reshaped()) {
        hash.add(number);
      }
    }
  }
  return hash.text();
}

std::optional<CaseResult> finished(const fs::path& path, const std::string& stamp) {
  std::error_code ignored;
  if (!fs::exists(path, ignored)) {
    return std::nullopt;
  }
  std::optional<CaseResult> result = decodeResult(readFile(path));
  return result && result->stamp == stamp ? result : std::nullopt;
}

// The "model name" of the first processor in /proc/cpuinfo.
std::string processor() {
  std::ifstream file("/proc/cpuinfo");
  for (std::string line; std::getline(file, line);) {
    if (line.starts_with("model name")) {
      return line.substr(std::min(line.size(), line.find(':') + 2));
    }
  }
  return "an unknown processor";
}

}  // namespace

Case caseNamed(const std::string& name, const std::stop_token& stop) {
  return isScene(name) ? caseOfScene(name, stop) : readCase(name);
}

void makeFolder(const fs::path& folder) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (error) {
    throw MachineError(folder.string() + ": cannot be made: " + error.message());
  }
}

std::vector<CaseResult> runStudy(const StudySettings& settings, const Contestants& contestants,
                                 const CaseDone& done, const std::stop_token& stop) {
  checkNames(settings.cases);
  const fs::path folder = settings.folder / "cases";
  makeFolder(folder);
  std::vector<CaseResult> results;
  for (const std::string& name : settings.cases) {
    const Case study = caseNamed(name, stop);
    const fs::path path = folder / (study.name + ".json");
    const std::string stamp = stampOf(study, contestants, settings);
    std::optional<CaseResult> result = settings.resume ? finished(path, stamp) : std::nullopt;
    const bool takenOver = result.has_value();
    if (!result) {
      result = resultOf(study, attemptAll(study, contestants, settings.effort, stop), stamp);
      writeFile(path, encodeResult(*result));
    }
    done(*result, takenOver);
    results.push_back(std::move(*result));
  }
  return results;
}

Contestants allContestants() {
  Contestants all = ownMethods();
  const auto add = [&all](Contestants some) { std::move(some.begin(), some.end(), std::back_inserter(all)); };
  add(peers());
  add(nodePeers().all);
  return all;
}

std::string machineLine() {
  utsname system{};
  uname(&system);
  std::ostringstream line;
  line << processor() << ", " << std::thread::hardware_concurrency() << " cores, " << system.sysname << ' '
       << system.release << ' ' << system.machine << ", ";
#if defined(__clang__)
  line << "Clang " << __clang_major__ << '.' << __clang_minor__;
#else
  line << "GCC " << __GNUC__ << '.' << __GNUC_MINOR__;
#endif
#ifndef __OPTIMIZE__
  line << ", not optimised";
#endif
  return line.str();
}

}  // namespace careen
