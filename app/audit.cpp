#include <algorithm>
#include <filesystem>
#include <iostream>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "audit/promises.h"
#include "command_line.h"
#include "commands.h"
#include "core/brief.h"
#include "core/characters.h"
#include "core/error.h"
#include "core/system/file.h"
#include "parsed.h"
#include "run_options.h"
#include "runs/run_report.h"
#include "summary.h"

namespace careen {
namespace {

struct AuditOptions {
  std::filesystem::path run;
  SceneOfTable scene;
  std::optional<double> tolerance;
  std::vector<std::string> allowed;  // KIND=SIZE
  AuditChoice choice;
  std::filesystem::path report;
};

AuditKind kindNamed(const std::string& name) {
  std::string known;
  for (const AuditKindTraits& traits : kAuditKinds) {
    if (traits.name == name) {
      return traits.kind;
    }
    known.append(known.empty() ? "" : ", ").append(traits.name);
  }
  throw InputError("--allow: found '" + name + "', expected one of: " + known);
}

AuditLimits limitsOf(const AuditOptions& options) {
  AuditLimits limits;
  if (options.tolerance) {
    if (!(*options.tolerance >= 0 && *options.tolerance <= 1)) {
      throw InputError("--tolerance: found " + brief(*options.tolerance) + ", expected a part from 0 to 1");
    }
    limits.table = *options.tolerance;
  }
  for (const std::string& each : options.allowed) {
    const std::size_t equals = std::min(each.find('='), each.size());
    const std::string size = each.substr(std::min(equals + 1, each.size()));
    limits.sizes[kindNamed(each.substr(0, equals))] =
        size == "any" ? std::nullopt
                      : std::optional(numberIn("--allow", size,
                                               "KIND=SIZE, such as box_overlap=0.001, or KIND=any", 0));
  }
  return limits;
}

void printFigures(const Run& run) {
  const Audit& audit = run.audit;
  for (const AuditKindTraits& traits : kAuditKinds) {
    const AuditFigure& figure = audit.figure(traits.kind);
    const auto breach = std::find_if(audit.breaches.begin(), audit.breaches.end(),
                                     [&](const AuditBreach& each) { return each.kind == traits.kind; });
    std::cout << traits.name << std::string(18 - traits.name.size(), ' ') << brief(figure.size, 3);
    if (traits.unit != "1" && traits.unit != "states") {
      std::cout << ' ' << traits.unit;
    }
    if (figure.size > 0) {
      std::cout << " at " << brief(figure.time) << " s";
      for (std::size_t i = 0; i < std::min<std::size_t>(figure.bodies.size(), 4); ++i) {
        std::cout << (i == 0 ? ", " : " ") << printableName(figure.bodies[i]);
      }
      std::cout << (breach != audit.breaches.end() ? ", BROKEN"
                    : figure.promised              ? ""
                                                   : ", not held to anything");
    }
    std::cout << '\n';
  }
  for (const AuditBreach& breach : audit.breaches) {
    std::cout << "BROKEN            " << printableName(describe(breach, run.trajectory)) << '\n';
  }
  if (audit.breaches.empty()) {
    std::cout << "verdict           "
              << (audit.depth == AuditDepth::kNone ? "none: not audited"
                  : run.trajectory.given           ? "sound"
                                                   : "keeps what its method promises")
              << '\n';
  }
}

ExitCode auditCommand(const AuditOptions& options, const std::stop_token& stop) {
  const Stopwatch stopwatch;
  const AuditLimits limits = limitsOf(options);
  if (!isRun(options.run) && options.scene.given() == nullptr) {
    static_cast<void>(readFile(options.run));  // tells if it is not there
    throw InputError(options.run.string() + ": found no run, expected a trajectory file or a table of poses");
  }
  Run run = loadRun(options.run, {}, options.scene, stop);
  if (options.tolerance && !run.trajectory.given) {
    throw InputError("--tolerance: found the run " + options.run.string() +
                     ", which is held to what its method promises; expected a table of poses, or --allow");
  }
  auditRun(run, options.choice.auditDepth(), stop, limits);
  if (!options.report.empty()) {
    writeFile(options.report, runReportText(run, stopwatch.seconds()));
  }
  const std::size_t boxes = run.trajectory.world.bodies.size();
  std::cout << "run               " << printableName(run.trajectory.stage.name) << ", " << boxes
            << (boxes == 1 ? " box, " : " boxes, ") << brief(run.trajectory.settings.duration) << " s by "
            << run.trajectory.methodName() << '\n';
  if (const std::optional<GivenPoses>& given = run.trajectory.given) {
    std::cout << "table             velocities " << (given->velocities ? "given" : "estimated")
              << ", angular velocities " << (given->angularVelocities ? "given" : "estimated")
              << ", lengths of quaternions off by " << brief(given->quaternionError, 2) << " at most\n";
  }
  printFigures(run);
  return run.audit.breaches.empty() ? ExitCode::kDone : ExitCode::kNumbersFailed;
}

}  // namespace

void addAudit(const CommandLine& commandLine) {
  const CommandLine command =
      commandLine.addCommand("audit", "What a run is worth, of this program or of any other");
  const auto options = std::make_shared<AuditOptions>();
  command.add("run", options->run, "Trajectory file, or table of poses (CSV, NPZ)").required();
  options->scene.addTo(command);
  command.add("--tolerance", options->tolerance,
              "What a table is held to: boxes may overlap and jump by this part of half the diagonal of the "
              "smallest, momenta and energies be off by this part (default: 0.01)");
  command
      .add("--allow", options->allowed,
           "Sizes that single kinds may have, KIND=SIZE in their units or KIND=any, with commas between")
      .delimiter(',');
  options->choice.addDepthTo(command);
  command.add("--report", options->report, "All of it as JSON");
  command.footer(
      "Exit codes: 0 nothing is beyond what is allowed, 2 the file is bad, 4 something is beyond it.");
  command.runs([options](const std::stop_token& stop) { return auditCommand(*options, stop); });
}

}  // namespace careen
