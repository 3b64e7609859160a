#include "report.h"

#include <algorithm>
#include <iomanip>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "audit/promises.h"
#include "core/brief.h"
#include "core/characters.h"
#include "physics/world/method.h"
#include "physics/world/run_settings.h"

namespace careen {
namespace {

/// Time [s] that a body spent in flight, in contact and at rest.
struct Life {
  double flight = 0;
  double contact = 0;
  double crowd = 0;
  double rest = 0;
  std::size_t steps = 0;  // of Contact and of crowds

  double whole() const { return flight + contact + crowd + rest; }
};

Life lifeOf(const Track& track, double duration) {
  Life life;
  for (std::size_t k = 0; k < track.segments.size(); ++k) {
    const double end = k + 1 < track.segments.size() ? track.segments[k + 1].start : duration;
    const double seconds = std::max(0.0, std::min(end, duration) - track.segments[k].start);
    const Motion& motion = track.segments[k].motion;
    if (std::holds_alternative<Rest>(motion)) {
      life.rest += seconds;
    } else if (std::holds_alternative<ContactStep>(motion)) {
      life.contact += seconds;
      ++life.steps;
    } else if (std::holds_alternative<CrowdStep>(motion)) {
      life.crowd += seconds;
      ++life.steps;
    } else {
      life.flight += seconds;
    }
  }
  return life;
}

// Of all boxes that can move.
Life lifeOf(const Trajectory& trajectory) {
  Life all;
  for (std::size_t body = 0; body < trajectory.tracks.size(); ++body) {
    if (isImmovable(trajectory.world.bodies[body].mass)) {
      continue;
    }
    const Life life = lifeOf(trajectory.tracks[body], trajectory.settings.duration);
    all.flight += life.flight;
    all.contact += life.contact;
    all.crowd += life.crowd;
    all.rest += life.rest;
    all.steps += life.steps;
  }
  return all;
}

nlohmann::ordered_json lifeReport(const Trajectory& trajectory) {
  nlohmann::ordered_json lives = nlohmann::ordered_json::array();
  for (std::size_t body = 0; body < trajectory.tracks.size(); ++body) {
    const Life life = lifeOf(trajectory.tracks[body], trajectory.settings.duration);
    lives.push_back({{"box", trajectory.world.bodies[body].name},
                     {"flight", life.flight},
                     {"contact", life.contact},
                     {"crowd", life.crowd},
                     {"rest", life.rest},
                     {"steps", life.steps}});
  }
  return lives;
}

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

// null if the second run could not be finished.
nlohmann::ordered_json estimateReport(const std::optional<ErrorEstimate>& estimate) {
  if (!estimate) {
    return nullptr;
  }
  nlohmann::ordered_json report = {{"by", estimate->by},       {"position", estimate->position},
                                   {"angle", estimate->angle}, {"holds", nullptr},
                                   {"until", estimate->until}, {"horizon", nullptr}};
  if (estimate->holds) {
    report["holds"] = *estimate->holds;
  }
  if (estimate->horizon) {
    report["horizon"] = *estimate->horizon;
  }
  return report;
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

nlohmann::ordered_json auditReport(const Audit& audit) {
  nlohmann::ordered_json report;
  for (const AuditKindTraits& traits : kAuditKinds) {
    const AuditFigure& figure = audit.figure(traits.kind);
    report[std::string(traits.name)] = {{"size", figure.size},
                                        {"unit", traits.unit},
                                        {"time", figure.time},
                                        {"bodies", figure.bodies},
                                        {"promised", figure.promised}};
  }
  return report;
}

nlohmann::ordered_json breachReport(const Run& run) {
  nlohmann::ordered_json breaches = nlohmann::ordered_json::array();
  for (const AuditBreach& breach : run.audit.breaches) {
    breaches.push_back({{"kind", traitsOf(breach.kind).name},
                        {"time", breach.time},
                        {"bodies", breach.bodies},
                        {"size", breach.size},
                        {"allowed", breach.allowed},
                        {"largest", breach.largest},
                        {"unit", traitsOf(breach.kind).unit}});
  }
  return breaches;
}

nlohmann::ordered_json residualReport(const ContactResiduals& residuals) {
  return {{"problems", residuals.problems},
          {"primal", residuals.primal},
          {"dual", residuals.dual},
          {"complementarity", residuals.complementarity}};
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

nlohmann::ordered_json runReport(const Run& run, double wallSeconds) {
  const Trajectory& trajectory = run.trajectory;
  const RunFigures figures = run.statedFigures();
  const bool steps = traitsOf(trajectory.settings.method).steps();
  nlohmann::ordered_json report = {
      {"program", "careen " CAREEN_VERSION},
      {"scene", trajectory.stage.name},
      {"scene_hash", trajectory.sceneHash()},
      {"method", trajectory.methodName()},
      {steps ? "dt" : "tolerance", steps ? trajectory.settings.dt : trajectory.settings.tolerance},
      {"simulated_seconds", trajectory.settings.duration},
      {"wall_seconds", wallSeconds},
      {"impacts", trajectory.impacts.size()},
      {"state_hash", trajectory.stateHash()},
      {"energy_change", figures.energyChange},
      {"momentum_change", figures.momentumChange},
      {"orthogonality", figures.orthogonality},
      {"deepest_penetration", figures.deepestPenetration},
      {"life", lifeReport(trajectory)},
      {"modelled", trajectory.plan.modelled()},
      {"left_out", trajectory.plan.leftOut()},
      {"seconds", {{"simulate", run.simulateSeconds}}},
  };
  if (trajectory.given) {
    for (const char* const key : {"tolerance", "life"}) {
      report.erase(key);
    }
    report["given"] = {{"velocities", trajectory.given->velocities},
                       {"angular_velocities", trajectory.given->angularVelocities},
                       {"quaternion_error", trajectory.given->quaternionError}};
  }
  if (!trajectory.given) {
    report["contact_residuals"] = {{"exact", residualReport(figures.contact)},
                                   {"crowds", residualReport(figures.crowds)}};
  }
  if (run.until) {
    report["until"] = {{"question", run.until->question}, {"time", nullptr}};
    if (run.until->time) {
      report["until"]["time"] = *run.until->time;
    }
  }
  if (figures.boundedFrom) {
    report["bounded_from"] = *figures.boundedFrom;
  }
  if (figures.horizon) {
    report["places_until"] = *figures.horizon;
  }
  if (run.audit.depth != AuditDepth::kNone) {
    report["audit"] = auditReport(run.audit);
    report["audit_seconds"] = run.auditSeconds;
    report["breaches"] = breachReport(run);
  }
  if (run.estimated) {
    report["error_estimate"] = estimateReport(run.estimate);
  }
  return report;
}

std::string runReportText(const Run& run, double wallSeconds) {
  return runReport(run, wallSeconds).dump(2) + "\n";
}

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
