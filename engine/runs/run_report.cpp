#include "runs/run_report.h"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <optional>
#include <variant>

#include "physics/world/method.h"

namespace careen {
namespace {

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

}  // namespace

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

}  // namespace careen
