#include <algorithm>
#include <cmath>
#include <cstddef>
#include <filesystem>
#include <iostream>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "commands.h"
#include "core/brief.h"
#include "core/characters.h"
#include "core/system/file.h"
#include "physics/joint_freedom.h"
#include "physics/world/method.h"
#include "run_options.h"
#include "scene/plan.h"
#include "scene/scene_reader.h"
#include "summary.h"
#include "sweep/family.h"
#include "trajectory/impact_moment.h"

namespace careen {
namespace {

// ", spring 20 N m/rad, damping 0.5 N m s/rad, friction 1.5 N m, motor up to 40 N m"
void printLoads(const Joint& joint, const Motor* motor) {
  const bool turns = joint.kind == Joint::Kind::kHinge;
  const std::string effort = turns ? " N m" : " N";
  if (joint.stiffness > 0) {
    std::cout << ", spring " << brief(joint.stiffness) << (turns ? " N m/rad" : " N/m");
  }
  if (joint.damping > 0) {
    std::cout << ", damping " << brief(joint.damping) << (turns ? " N m s/rad" : " N s/m");
  }
  if (joint.grip > 0 && joint.keptRate == 0) {
    std::cout << ", friction " << brief(joint.grip) << effort;
  } else if (joint.grip > 0) {
    std::cout << ", driven at " << brief(joint.keptRate) << (turns ? " rad/s" : " m/s") << " by up to "
              << brief(joint.grip) << effort;
  }
  if (motor != nullptr) {
    std::cout << ", motor";
    if (std::isfinite(motor->largest)) {
      std::cout << " up to " << brief(motor->largest) << effort;
    }
  }
}

// "freedom      7 degrees of freedom of 2 boxes with joints; 3 of 20 conditions of joints are redundant"
void printFreedom(const World& world) {
  const JointFreedom freedom = jointFreedom(world);
  if (freedom.bodies == 0) {
    return;
  }
  const auto counted = [](int count, const std::string& one, const std::string& more) {
    return std::to_string(count) + (count == 1 ? one : more);
  };
  std::cout << "freedom      " << counted(freedom.degrees, " degree", " degrees") << " of freedom of "
            << counted(freedom.bodies, " box", " boxes") << " with joints at the start; "
            << (freedom.redundant == 0
                    ? "no"
                    : std::to_string(freedom.redundant) + " of " + std::to_string(freedom.rows))
            << " conditions of joints " << (freedom.redundant == 1 ? "is" : "are") << " redundant\n";
}

// "joint        knee: hinge between lid and crate, from -0.5 to 2.25 rad"
template <class Named>
void printJoints(const std::vector<Joint>& joints, const std::vector<Named>& boxes,
                 const std::optional<Control>& control) {
  constexpr std::size_t kMost = 32;
  const auto motorOf = [&](int index) -> const Motor* {
    if (!control) {
      return nullptr;
    }
    const auto motor = std::find_if(control->motors.begin(), control->motors.end(),
                                    [&](const Motor& each) { return each.joint == index; });
    return motor == control->motors.end() ? nullptr : &*motor;
  };
  const auto nameOf = [&](const JointEnd& end) {
    return end.body ? printableName(boxes[static_cast<std::size_t>(*end.body)].name) : "the world";
  };
  for (std::size_t i = 0; i < joints.size() && i < kMost; ++i) {
    const Joint& joint = joints[i];
    std::cout << "joint        " << printableName(joint.name) << ": "
              << kJointKindNames.at(static_cast<std::size_t>(joint.kind)) << " between " << nameOf(joint.from)
              << " and " << nameOf(joint.to);
    if (joint.lowest > -Joint::kFree || joint.highest < Joint::kFree) {
      std::cout << ", from " << brief(joint.lowest) << " to " << brief(joint.highest)
                << (joint.kind == Joint::Kind::kHinge ? " rad" : " m");
    }
    if (joint.length > 0) {
      std::cout << ", " << brief(joint.length) << " m long";
    }
    printLoads(joint, motorOf(static_cast<int>(i)));
    if (joint.until < Joint::kFree) {
      std::cout << ", until " << brief(joint.until) << " s";
    }
    std::cout << '\n';
  }
  if (joints.size() > kMost) {
    std::cout << "             and " << joints.size() - kMost << " more\n";
  }
}

void printScene(const Scene& scene) {
  const Plan items = plan(scene);
  printPlan(std::cout, scene.name, scene.boxes.size(), scene.settings, items);
  printJoints(scene.joints, scene.boxes, scene.control);
  if (!scene.joints.empty() && traitsOf(scene.settings.method).joints) {
    printFreedom(assemble(scene, items));
  }
  printCrowds(std::cout, scene.settings, items);
}

void printFamily(const Family& family) {
  const Scene first = family.member(0).scene;
  std::cout << "family       " << printableName(first.name) << ", seed " << family.seed() << ", up to "
            << family.tries() << " tries for a start without overlap; run 0 has " << first.boxes.size()
            << (first.boxes.size() == 1 ? " box\n" : " boxes\n");
  for (const Varying& each : family.varying()) {
    std::cout << "varies       " << printableName(each.path) << ": " << each.range << '\n';
  }
  printScene(first);
}

constexpr int kDigits = 9;  // of an impact

std::string vectorInWords(const Vec3& v) {
  const auto part = [](double x) { return brief(x + 0.0, kDigits); };  // no -0
  return "(" + part(v.x()) + ", " + part(v.y()) + ", " + part(v.z()) + ")";
}

// " 4, 5"
std::string othersOf(const std::vector<std::size_t>& indices, std::size_t but) {
  std::string list;
  for (const std::size_t each : indices) {
    list += each == but ? "" : (list.empty() ? " " : ", ") + std::to_string(each);
  }
  return list;
}

std::string frictionInWords(FrictionOutcome outcome) {
  switch (outcome) {
    case FrictionOutcome::kNone:
      return "without friction";
    case FrictionOutcome::kIdle:
      return "friction had nothing to do";
    case FrictionOutcome::kSticks:
      return "it stuck: less than the limit ended the slip";
    case FrictionOutcome::kSlides:
      break;
  }
  return "it slid: friction at its limit";
}

std::string lawInWords(const ImpactMoment& moment, const World& world) {
  std::string joints;
  for (const std::size_t joint : moment.joints) {
    joints += (joints.empty() ? ", through " : ", ") + printableName(world.joints[joint].name);
  }
  switch (moment.law) {
    case ImpactLaw::kOneContact:
      return "one contact of boxes that flew: it parts with the restitution times its normal speed, in "
             "closed "
             "form";
    case ImpactLaw::kSeveralContacts:
      return "several contacts of boxes that flew, resolved at once because they share boxes" + joints;
    case ImpactLaw::kInSteps:
      return "boxes that moved in steps (in contact, joined, or under springs or drag): with all contacts "
             "that "
             "they share" +
             joints;
    case ImpactLaw::kInCrowd:
      return "a step of a crowd, which ends then, with all contacts of the crowd, to its tolerance" + joints;
    case ImpactLaw::kLoop1997:
      return "Listing 1 of 1997: one corner after another, without friction";
    case ImpactLaw::kStepped:
      break;
  }
  return "one box at walls, between two steps";
}

// Its impulses act within steps, so that no velocity jumps.
bool isInCrowd(const ImpactMoment& moment) { return moment.law == ImpactLaw::kInCrowd; }

std::string beforeAndAfter(double before, double after) {
  return brief(before, kDigits) + " m/s before, " + brief(after, kDigits) + " m/s after";
}

// One contact of it.
void printContact(const Trajectory& run, const ImpactMoment& moment, std::size_t index) {
  const Impact& impact = run.impacts[index];
  const Material pair = pairOf(impact, run.world);
  const PointVelocities at = pointVelocities(impact, moment.bodies, run.world);
  const auto along = [&](const Vec3& velocity) { return dot(velocity, impact.normal); };
  const auto across = [&](const Vec3& velocity) {
    return Vec3(velocity - along(velocity) * impact.normal).norm();
  };
  const std::string b = printableName(run.partnerName(impact));
  std::cout << "impact       " << index << " of " << run.impacts.size() << ", counted from 0: "
            << printableName(run.world.bodies[static_cast<std::size_t>(impact.a.value)].name) << " struck "
            << b << '\n'
            << "where        " << vectorInWords(impact.point) << " m, normal " << vectorInWords(impact.normal)
            << " from " << b << '\n'
            << "pair         restitution " << brief(pair.restitution, kDigits) << ", friction "
            << brief(pair.friction, kDigits) << '\n'
            << "normal       "
            << (isInCrowd(moment) ? "approached at " + brief(impact.approach, kDigits) + " m/s"
                                  : beforeAndAfter(along(at.before), along(at.after)))
            << ", impulse " << brief(impact.impulse, kDigits) << " N s\n"
            << "tangential   "
            << (isInCrowd(moment) ? "" : beforeAndAfter(across(at.before), across(at.after)) + ", ")
            << "impulse " << brief(impact.tangential, kDigits) << " N s of at most "
            << brief(pair.friction * impact.impulse, kDigits) << "; "
            << frictionInWords(frictionOutcome(impact, run.world)) << '\n';
}

void printImpact(const Trajectory& run, int asked) {
  const ImpactMoment moment = impactMoment(run, asked);
  const auto index = static_cast<std::size_t>(asked);
  std::cout << "time         " << brief(moment.time, 12) << " s\n";
  if (moment.impacts.size() > 1) {
    std::cout << "together     with" << othersOf(moment.impacts, index) << ", parts of one\n";
  }
  if (!moment.atTheSameTime.empty()) {
    std::cout << "meanwhile   " << othersOf(moment.atTheSameTime, index) << ", of other boxes\n";
  }
  printContact(run, moment, index);
  for (const std::size_t each : moment.impacts) {
    if (each != index) {
      printContact(run, moment, each);
    }
  }
  double before = 0;
  double after = 0;
  for (const StruckBody& struck : moment.bodies) {
    const Body& body = run.world.bodies[struck.body];
    const auto print = [&](const char* when, const BodyState& state) {
      const double energy = kineticEnergy(body.mass, state);
      std::cout << when << vectorInWords(state.velocity) << " m/s, "
                << vectorInWords(angularVelocity(body.mass, state)) << " rad/s, " << brief(energy, kDigits)
                << " J\n";
      return energy;
    };
    std::cout << "box          " << printableName(body.name) << '\n';
    before += print("  before     ", struck.before);
    after += print("  after      ", struck.after);
  }
  std::cout << "energy       " << brief(before, kDigits) << " J before, " << brief(after, kDigits)
            << " J after, kinetic; "
            << (isInCrowd(moment) ? "what was lost in the step is not told apart"
                                  : "lost " + brief(before - after, kDigits) + " J")
            << '\n'
            << "law          " << lawInWords(moment, run.world) << '\n';
}

struct InfoOptions {
  std::filesystem::path path;
  SceneOfTable scene;
  std::optional<int> impact;
};

// Of a run as it lies there: nothing is simulated or audited.
ExitCode impactCommand(const InfoOptions& options, const std::stop_token& stop) {
  if (options.scene.given() == nullptr && (options.path.empty() || !isRun(options.path))) {
    throw InputError("--impact: found no run, expected a trajectory file");
  }
  const Run run = loadRun(options.path, {}, options.scene, stop);
  try {
    printImpact(run.trajectory, *options.impact);
  } catch (const InputError& error) {
    throw InputError("--impact: " + std::string(error.what()));
  }
  return ExitCode::kDone;
}

ExitCode infoCommand(std::filesystem::path path, const SceneOfTable& ofTable, const std::stop_token& stop) {
  if (path.empty()) {
    path = defaultScene();
  }
  const std::string bytes = readFile(path);
  if (ofTable.given() == nullptr && !isRun(path)) {
    if (!isMujocoModel(path) && looksLikeFamily(bytes)) {
      printFamily(Family(bytes, path.string()));
      return ExitCode::kDone;
    }
    const auto [text, name] = sceneTextOf(path, bytes, tellNotice);
    const Scene scene = parseScene(text, name);
    printScene(scene);
    return ExitCode::kDone;
  }
  Run run = loadRun(path, {}, ofTable, stop);
  auditRun(run, {.keepGoing = true}, stop);  // what is broken is told below
  printPlan(std::cout, run.trajectory);
  printJoints(run.trajectory.world.joints, run.trajectory.world.bodies, run.trajectory.world.control);
  printFreedom(run.trajectory.world);
  printError(std::cout, run);
  std::size_t segments = 0;
  for (const Track& track : run.trajectory.tracks) {
    segments += track.segments.size();
  }
  std::cout << (run.trajectory.given ? "table        " : "trajectory   ") << bytes.size() << " bytes, "
            << segments << " segments\n"
            << "scene hash   " << run.trajectory.sceneHash() << '\n';
  return run.audit.breaches.empty() || run.trajectory.given ? ExitCode::kDone : ExitCode::kNumbersFailed;
}

}  // namespace

void addInfo(const CommandLine& commandLine) {
  const CommandLine command =
      commandLine.addCommand("info", "What a scene's run models, what it leaves out, and why");
  const auto options = std::make_shared<InfoOptions>();
  command.add("file", options->path,
              "Scene (or model of MuJoCo, .xml), trajectory file or table of poses; the default scene if "
              "none is named");
  command.add("--impact", options->impact,
              "All that a run knows of one impact: its row in the table of impacts, counted from 0");
  options->scene.addTo(command);
  command.runs([options](const std::stop_token& stop) {
    return options->impact ? impactCommand(*options, stop) : infoCommand(options->path, options->scene, stop);
  });
}

}  // namespace careen
