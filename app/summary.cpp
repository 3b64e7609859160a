#include "summary.h"

#include <algorithm>
#include <iomanip>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "audit/promises.h"
#include "core/brief.h"
#include "core/characters.h"
#include "physics/world/method.h"
#include "physics/world/run_settings.h"
#include "runs/run_report.h"

namespace careen {
namespace {

void printSceneLine(std::ostream& out, const std::string& scene, std::size_t boxes,
                    const RunSettings& settings) {
  out << "scene        " << printableName(scene) << ", " << boxes << (boxes == 1 ? " box, " : " boxes, ")
      << settings.duration << " s by " << traitsOf(settings.method).name;
  if (traitsOf(settings.method).steps()) {
    out << ", dt " << settings.dt << " s";
  }
  out << '\n';
}

void printGivenLine(std::ostream& out, const Trajectory& run) {
  out << "scene        " << printableName(run.stage.name) << ", " << run.world.bodies.size()
      << (run.world.bodies.size() == 1 ? " box, " : " boxes, ") << run.settings.duration
      << " s of given poses; velocities " << (run.given->velocities ? "given" : "estimated") << '\n';
}

void printItems(std::ostream& out, const char* title, const Plan& plan, bool modelled) {
  const char* indent = title;
  for (const PlanItem& item : plan.items) {
    if (item.modelled == modelled) {
      out << indent << printableName(item.what) << ": " << printableName(item.reason) << '\n';
      indent = "             ";
    }
  }
}

void printEstimate(std::ostream& out, const Run& run, bool verbose) {
  if (!run.estimated) {
    return;
  }
  out << "estimate     ";
  if (!run.estimate) {
    out << "none: the run could not be repeated to its end\n";
    return;
  }
  const ErrorEstimate& estimate = *run.estimate;
  out << std::setprecision(2) << "wrong by " << (estimate.holds ? "at most " : "about ") << estimate.position
      << " m and " << estimate.angle << " rad" << std::setprecision(3);
  if (estimate.holds) {
    out << ", as in " << 100 * *estimate.holds << " % of scenes";
  }
  out << ", ";
  if (estimate.horizon) {
    out << "until " << estimate.until << " s; from " << *estimate.horizon << " s on chaos has taken over";
  } else {
    out << "to the end";
  }
  out << (verbose ? " (by " + estimate.by + ")\n" : "\n");
}

void printResiduals(std::ostream& out, const char* of, const ContactResiduals& residuals) {
  if (residuals.problems > 0) {
    out << of << "primal " << residuals.primal << ", dual " << residuals.dual << ", complementarity "
        << residuals.complementarity << " of " << residuals.problems << " contact problems\n";
  }
}

void printDisagreement(std::ostream& out, const char* what, double own, double stated) {
  if (stated != own) {
    out << "             " << what << ": the method says " << own << ", the audit found " << stated
        << ", which stands above\n";
  }
}

// By the audit; or what the run knows of itself, where no audit tells more.
void printBroken(std::ostream& out, const Run& run) {
  for (const AuditBreach& breach : run.audit.breaches) {
    out << "BROKEN       " << describe(breach, run.trajectory) << '\n';
  }
  if (run.trajectory.given || !run.audit.breaches.empty()) {
    return;
  }
  const RunFigures& own = run.trajectory.figures;
  const std::optional<double> promised = promisedDepth(run.trajectory.settings, own.boundedFrom.has_value());
  if (promised && own.deepestPenetration > *promised) {
    out << "BROKEN       by its own figure: boxes or walls went " << own.deepestPenetration
        << " m into each other, where its method promises at most " << *promised << " m\n";
  }
}

void printAudit(std::ostream& out, const Run& run) {
  const Audit& audit = run.audit;
  if (audit.depth == AuditDepth::kNone) {
    return;
  }
  out << "audit        " << inWords(audit) << "; " << audit.looks << " states\n";
  const RunFigures& own = run.trajectory.figures;
  const RunFigures stated = run.statedFigures();
  if (!run.trajectory.given) {
    printDisagreement(out, "energy", own.energyChange, stated.energyChange);
    printDisagreement(out, "momentum", own.momentumChange, stated.momentumChange);
    printDisagreement(out, "|AAᵀ-1|", own.orthogonality, stated.orthogonality);
    printDisagreement(out, "deepest penetration", own.deepestPenetration, stated.deepestPenetration);
  }
}

// What the method lacks though the scene needs it: the reason names the method.
void printLacks(std::ostream& out, const Trajectory& run) {
  for (const PlanItem& item : run.plan.items) {
    if (!item.modelled && item.reason.find("method " + run.methodName()) != std::string::npos) {
      out << "left out     " << printableName(item.what) << ": " << printableName(item.reason) << '\n';
    }
  }
}

void printMotion(std::ostream& out, const Trajectory& run) {
  const Life all = lifeOf(run);
  out << "motion       " << run.impacts.size() << (run.impacts.size() == 1 ? " impact" : " impacts");
  const char* between = "; ";
  for (const auto& [seconds, what] :
       {std::pair(all.flight, "flight "), std::pair(all.contact + all.crowd, "contact "),
        std::pair(all.rest, "rest ")}) {
    if (seconds > 0) {
      out << between << what << 100 * seconds / all.whole() << " %";
      between = ", ";
    }
  }
  out << (all.whole() > 0 ? " of the time\n" : "\n");
}

// Where it is chaos, or a crowd.
void printHorizon(std::ostream& out, const RunFigures& figures) {
  if (figures.horizon) {
    out << "places       mean something until " << *figures.horizon << " s\n";
  }
}

// What a new user needs.
void printInShort(std::ostream& out, const Run& run) {
  const Trajectory& trajectory = run.trajectory;
  if (trajectory.given) {
    printGivenLine(out, trajectory);
  } else {
    printSceneLine(out, trajectory.stage.name, trajectory.world.bodies.size(), trajectory.settings);
    printLacks(out, trajectory);
  }
  out << std::setprecision(3);
  if (!trajectory.given) {
    printMotion(out, trajectory);
  }
  const RunFigures figures = run.statedFigures();
  out << "error        energy " << figures.energyChange << ", momentum " << figures.momentumChange
      << ", deepest penetration " << figures.deepestPenetration << " m";
  if (run.audit.depth == AuditDepth::kNone) {
    out << "; not audited\n";
  } else {
    out << (!run.audit.breaches.empty() ? "\n"
            : trajectory.given          ? "; audit: sound\n"
                                        : "; audit: keeps what its method promises\n");
  }
  if (figures.boundedFrom) {
    out << "crowd        from " << *figures.boundedFrom << " s on, where many boxes touch: right to about "
        << trajectory.settings.crowds.tolerance << " m\n";
  }
  printHorizon(out, figures);
  printBroken(out, run);
}

void printUntil(std::ostream& out, const Run& run) {
  if (run.until) {
    out << "until        " << printableName(run.until->question) << ": "
        << (run.until->time ? "at " + brief(*run.until->time, 12) + " s, the end of the run"
                            : "never; the run has its whole duration")
        << '\n';
  }
}

void printSpeed(std::ostream& out, const Run& run, double wallSeconds) {
  out << std::setprecision(3) << "speed        " << wallSeconds << " s in all";
  if (run.simulateSeconds > 0) {
    out << "; simulated in " << run.simulateSeconds << " s, "
        << run.trajectory.settings.duration / run.simulateSeconds << " times real time";
  }
  if (run.audit.depth != AuditDepth::kNone) {
    out << "; audited in " << run.auditSeconds << " s";
  }
  out << '\n';
}

}  // namespace

void printPlan(std::ostream& out, const std::string& scene, std::size_t boxes, const RunSettings& settings,
               const Plan& plan) {
  printSceneLine(out, scene, boxes, settings);
  printItems(out, "modelled     ", plan, true);
  printItems(out, "left out     ", plan, false);
}

void printCrowds(std::ostream& out, const RunSettings& settings, const Plan& plan) {
  if (settings.method != Method::kExact || !(plan.models("box-wall") || plan.models("box-box"))) {
    return;
  }
  const CrowdSettings& crowds = settings.crowds;
  out << "crowd        ";
  if (crowds.when == CrowdSettings::When::kNever) {
    out << "never: all boxes are followed exactly, however long that takes\n";
    return;
  }
  out << "where ";
  if (crowds.when == CrowdSettings::When::kAbove) {
    out << "more than " << crowds.above << " boxes touch and move, or ";
  }
  out << "exact contact costs too much or has no solution, those boxes go on in time steps,\n"
         "             with an error of about "
      << crowds.tolerance << " m; all others are followed exactly\n";
}

void printPlan(std::ostream& out, const Trajectory& run) {
  if (run.given) {
    printGivenLine(out, run);
  } else {
    printPlan(out, run.stage.name, run.world.bodies.size(), run.settings, run.plan);
  }
}

void printError(std::ostream& out, const Run& run) {
  const Trajectory& trajectory = run.trajectory;
  const RunFigures figures = run.statedFigures();
  out << std::setprecision(3) << "error        energy " << figures.energyChange << ", momentum "
      << figures.momentumChange << ", |AAᵀ-1| " << figures.orthogonality << ", deepest penetration "
      << figures.deepestPenetration << " m\n";
  printAudit(out, run);
  printBroken(out, run);
  if (figures.boundedFrom) {
    out << "crowd        from " << *figures.boundedFrom
        << " s on, where exact contact costs too much or has no solution: only those bodies, with a bounded "
           "error of about "
        << trajectory.settings.crowds.tolerance << " m\n";
  }
  printHorizon(out, figures);
  printResiduals(out, "residuals    ", figures.contact);
  printResiduals(out, "  of crowds  ", figures.crowds);
  const Life all = lifeOf(trajectory);
  const double whole = all.whole();
  if (whole > 0 && !trajectory.given) {
    out << "life         flight " << 100 * all.flight / whole << " %, contact " << 100 * all.contact / whole;
    if (figures.boundedFrom) {
      out << " %, crowd " << 100 * all.crowd / whole;
    }
    out << " % in " << all.steps << " steps, rest " << 100 * all.rest / whole << " %\n";
  }
  out << "impacts      " << trajectory.impacts.size() << '\n';
  out << "state hash   " << trajectory.stateHash() << '\n';
}

void printSummary(std::ostream& out, const Run& run, double wallSeconds, bool verbose) {
  if (verbose) {
    printPlan(out, run.trajectory);
    printUntil(out, run);
    printSpeed(out, run, wallSeconds);
    printError(out, run);
    printEstimate(out, run, true);
  } else {
    printInShort(out, run);
    printUntil(out, run);
    printEstimate(out, run, false);
    printSpeed(out, run, wallSeconds);
  }
}

}  // namespace careen
