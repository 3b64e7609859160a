#include "study/case.h"

#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>
#include <utility>

#include "core/error.h"
#include "core/system/file.h"
#include "core/system/resource.h"
#include "physics/simulate.h"
#include "physics/world/method.h"
#include "scene/plan.h"
#include "scene/scene_reader.h"
#include "scene/starts.h"
#include "runs/difference.h"
#include "runs/error_estimate.h"
#include "runs/sampled_states.h"
#include "trajectory/trajectory.h"

namespace careen {
namespace {

using Json = nlohmann::json;

constexpr int kMomentsOfAScene = 16;

const std::map<std::string, Measure> kMeasures = {{"poses", Measure::kPoses},
                                                  {"energy", Measure::kEnergy},
                                                  {"reversal", Measure::kReversal},
                                                  {"scaled", Measure::kScaled},
                                                  {"overlap", Measure::kOverlap}};

constexpr const char* kScenes = "assets/scenes";

// The scene file that a truth names by this key.
std::filesystem::path scenePath(const Json& truth, const char* key) {
  const std::string relative = truth.at(key).get<std::string>();
  std::filesystem::path path = findResource(kScenes) / relative;
  if (!std::filesystem::exists(path)) {
    throw InputError(std::string(key) + ": found \"" + relative + "\", expected a file of " + kScenes);
  }
  return path;
}

std::filesystem::path truthPath(const std::string& name) {
  std::filesystem::path path = findResource("assets/truths") / (name + ".json");
  if (!std::filesystem::exists(path)) {
    throw InputError(path.string() + ": found no file, expected the truth of the case " + name);
  }
  return path;
}

// The whole scene, as exact models it, so that every contestant gets all of it.
World worldOf(Scene scene) {
  scene.settings.method = Method::kExact;
  checkApart(scene);
  return assemble(scene, plan(scene));
}

Vec3 vectorFrom(const Json& value) {
  return {value.at(0).get<double>(), value.at(1).get<double>(), value.at(2).get<double>()};
}

Quat quaternionFrom(const Json& value) {
  return Quat(value.at(0).get<double>(), value.at(1).get<double>(), value.at(2).get<double>(),
              value.at(3).get<double>())
      .normalized();
}

void readPoses(const Json& boxes, Case& study) {
  std::vector<Pose> still;
  for (const Body& body : study.world.bodies) {
    still.push_back(boxPose(body, body.initial.pose));
  }
  study.poses.assign(study.times.size(), still);
  for (const Json& box : boxes) {
    const auto& bodies = study.world.bodies;
    const auto body = std::find_if(bodies.begin(), bodies.end(), [&](const Body& each) {
      return each.name == box.at("name").get<std::string>();
    });
    if (body == bodies.end()) {
      throw InputError("boxes: found \"" + box.at("name").get<std::string>() +
                       "\", expected boxes of its scene");
    }
    for (std::size_t k = 0; k < study.times.size(); ++k) {
      study.poses[k][static_cast<std::size_t>(body - bodies.begin())] = {
          .position = vectorFrom(box.at("positions").at(k)),
          .worldFromBody = quaternionFrom(box.at("orientations").at(k)).toRotationMatrix()};
    }
  }
}

void readTruth(const Json& truth, Case& study) {
  study.title = truth.at("title").get<std::string>();
  study.whyHard = truth.at("why_hard").get<std::string>();
  study.source = truth.at("source").get<std::string>();
  study.published = truth.value("published", "");
  study.measure = kMeasures.at(truth.at("measure").get<std::string>());
  study.scene = readScene(scenePath(truth, "scene"));
  study.world = worldOf(study.scene);
  if (study.measure == Measure::kScaled) {
    study.original = worldOf(readScene(scenePath(truth, "of")));
    study.lengths = truth.at("lengths").get<double>();
    study.durations = truth.at("times").get<double>();
    study.times = {study.scene.settings.duration};
    return;
  }
  study.times = truth.at("times").get<std::vector<double>>();
  if (study.times.empty() || !std::is_sorted(study.times.begin(), study.times.end())) {
    throw InputError("times: found a time before the one it follows, expected ascending times");
  }
  if (study.measure == Measure::kPoses) {
    readPoses(truth.at("boxes"), study);
  }
}

}  // namespace

double Case::simulated() const {
  switch (measure) {
    case Measure::kReversal:
      return 2 * duration();
    case Measure::kScaled:
      return duration() + duration() / durations;
    default:
      return duration();
  }
}

std::vector<std::string> caseNames() {
  return Json::parse(readFile(findResource("assets/study/cases.json"))).get<std::vector<std::string>>();
}

Case readCase(const std::string& name) {
  const std::filesystem::path path = truthPath(name);
  Case study;
  study.name = name;
  try {
    readTruth(Json::parse(readFile(path)), study);
  } catch (const Json::exception& error) {
    throw InputError(path.string() + ": " + error.what());
  } catch (const std::out_of_range& error) {
    throw InputError(path.string() + ": unknown measure");
  } catch (const InputError& error) {
    throw InputError(path.string() + ": " + error.what());
  }
  return study;
}

Case caseOfScene(const std::filesystem::path& scene, const std::stop_token& stop) {
  Case study;
  study.scene = readScene(scene);
  study.name = scene.stem().string();
  study.title = study.scene.name;
  study.world = worldOf(study.scene);
  const Trajectory run =
      record(study.world, {.method = Method::kExact, .duration = study.scene.settings.duration},
             study.scene.text, stop);
  const std::optional<ErrorEstimate> estimate = estimateError(run, stop);
  // One rounding error for exact is a larger error for others, and grows as fast: their runs diverge earlier.
  const double until = estimate ? estimate->until * (estimate->horizon ? 0.5 : 1) : 0;
  if (until <= 0) {
    throw InputError(scene.string() + ": chaos takes over before anything can be compared");
  }
  study.source = "method exact, which agrees with a run from a start one rounding error away";
  study.whyHard = "a scene of your own";
  for (int k = 1; k <= kMomentsOfAScene; ++k) {
    study.times.push_back(until * k / kMomentsOfAScene);
    study.poses.push_back(run.poses(study.times.back()));
  }
  SampledStates again(study.world, study.times);
  const World away = oneRoundingAway(study.world);
  simulate(away, run.settings, again, stop);
  const std::vector<std::vector<BodyState>> states = again.finish();
  for (std::size_t k = 0; k < study.times.size(); ++k) {
    study.uncertainty =
        std::max(study.uncertainty,
                 differenceOf(study.world, states[k], withPoses(study.world, study.poses[k])).relative);
  }
  return study;
}

}  // namespace careen
