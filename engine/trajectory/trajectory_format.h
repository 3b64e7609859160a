#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "physics/world/run_settings.h"
#include "trajectory/archive.h"
#include "trajectory/motion_format.h"
#include "trajectory/stage_format.h"
#include "trajectory/trajectory.h"
#include "trajectory/world_format.h"

namespace careen {

// The record of a trajectory file, type by type: visit(archive, value) reads and writes. A change here is
// another format version.

template <class Archive>
void visit(Archive& archive, Visited<Archive, Impact> impact) {
  archive.visit(impact.time);
  visit(archive, impact.a);
  visit(archive, impact.b);
  visit(archive, impact.point);
  visit(archive, impact.normal);
  archive.visit(impact.approach);
  archive.visit(impact.impulse);
  archive.visit(impact.tangential);
}

template <class Archive>
void visit(Archive& archive, Visited<Archive, PlanItem> item) {
  archive.visit(item.what);
  visit(archive, item.modelled);
  archive.visit(item.reason);
}

template <class Archive>
void visit(Archive& archive, Visited<Archive, Track> track) {
  if constexpr (Archive::kReads) {
    visitAll(archive, track.segments.open());
  } else {
    visitAll(archive, track.segments);
  }
}

/// [s] -1: never.
template <class Archive>
void visitTime(Archive& archive, Visited<Archive, std::optional<double>> time) {
  constexpr double kNever = -1;
  double stored = time.value_or(kNever);
  archive.visit(stored);
  if constexpr (Archive::kReads) {
    time = stored >= 0 ? std::optional(stored) : std::nullopt;
  }
}

template <class Archive>
void visit(Archive& archive, Visited<Archive, RunFigures> figures) {
  archive.visit(figures.energyChange);
  archive.visit(figures.momentumChange);
  archive.visit(figures.orthogonality);
  archive.visit(figures.deepestPenetration);
  visitTime(archive, figures.boundedFrom);
}

/// What figures have since format version 8, stored after the rest.
template <class Archive>
void visitResiduals(Archive& archive, Visited<Archive, RunFigures> figures) {
  for (auto* residuals : {&figures.contact, &figures.crowds}) {
    auto problems = static_cast<std::uint64_t>(residuals->problems);
    archive.visit(problems);
    if constexpr (Archive::kReads) {
      residuals->problems = static_cast<std::int64_t>(problems);
    }
    archive.visit(residuals->primal);
    archive.visit(residuals->dual);
    archive.visit(residuals->complementarity);
  }
}

template <class Archive>
void visit(Archive& archive, Visited<Archive, CrowdSettings> crowds) {
  int when = static_cast<int>(crowds.when);
  visitIndex(archive, when);
  visitIndex(archive, crowds.above);
  archive.visit(crowds.tolerance);
  if constexpr (Archive::kReads) {
    if (when < 0 || when > static_cast<int>(CrowdSettings::When::kAbove) || crowds.above < 0 ||
        !(crowds.tolerance > 0)) {
      archive.fail("has invalid settings of crowds");
    }
    crowds.when = static_cast<CrowdSettings::When>(when);
  }
}

template <class Archive>
void visit(Archive& archive, Visited<Archive, RunSettings> settings) {
  visit(archive, settings.method);
  archive.visit(settings.dt);
  archive.visit(settings.tolerance);
  archive.visit(settings.duration);
}

/// What a run starts from.
template <class Archive>
void visitStart(Archive& archive, Visited<Archive, Trajectory> run) {
  archive.visit(run.sceneText);
  std::string sceneHash = run.sceneHash();
  archive.visit(sceneHash);
  visit(archive, run.settings);
  visit(archive, run.figures);
  visit(archive, run.world);
  visit(archive, run.stage);
  visitAll(archive, run.plan.items);
}

template <class Archive>
void visit(Archive& archive, Visited<Archive, Trajectory> run) {
  visitStart(archive, run);
  visitAll(archive, run.tracks);
  visitAll(archive, run.impacts);
}

}  // namespace careen
