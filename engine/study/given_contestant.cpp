#include "study/given_contestant.h"

#include <algorithm>
#include <cstddef>
#include <utility>

#include "core/brief.h"
#include "core/error.h"
#include "core/hash.h"
#include "core/system/file.h"
#include "physics/world/method.h"
#include "scene/plan.h"
#include "trajectory/given_run.h"
#include "trajectory/pose_table.h"
#include "trajectory/trajectory.h"

namespace careen {
namespace {

constexpr double kSameTime = 1e-9;  // [1] of the case's length: clocks that add up their steps

bool hasRowAt(const Track& track, double time, double allowed) {
  const auto next = std::lower_bound(track.segments.begin(), track.segments.end(), time - allowed,
                                     [](const Segment& segment, double t) { return segment.start < t; });
  return next != track.segments.end() && next->start <= time + allowed;
}

class GivenContestant : public Contestant {
 public:
  GivenContestant(GivenAnswer answer, Trajectory run, std::string settings)
      : answer_(std::move(answer)), run_(std::move(run)), settings_(std::move(settings)) {}

  std::string name() const override { return answer_.label; }
  std::string settings() const override { return settings_; }
  bool steps() const override { return false; }
  std::string refuses(const World& /*world*/) const override { return ""; }
  bool isGiven() const override { return true; }
  std::optional<double> secondsGiven() const override { return answer_.seconds; }

  std::vector<std::vector<BodyState>> run(const World& world, double /*fineness*/,
                                          std::span<const double> times,
                                          const std::stop_token& /*stop*/) const override {
    std::vector<std::vector<BodyState>> states;
    for (const double time : times) {
      std::vector<BodyState>& now = states.emplace_back();
      for (std::size_t body = 0; body < world.bodies.size(); ++body) {
        now.push_back(run_.state(body, std::min(time, run_.settings.duration)));
      }
    }
    return states;
  }

  std::optional<Audit> audited(const World& /*world*/, double /*fineness*/, double /*duration*/,
                               const std::stop_token& stop) const override {
    return audit(run_, AuditDepth::kUsual, stop);
  }

 private:
  GivenAnswer answer_;
  Trajectory run_;
  std::string settings_;
};

}  // namespace

std::unique_ptr<Contestant> givenContestant(const GivenAnswer& answer, const Case& study) {
  if (study.measure == Measure::kReversal || study.measure == Measure::kScaled) {
    throw InputError(answer.file + ": found the case " + study.name +
                     ", which takes two runs; expected a case of one");
  }
  const std::string bytes = readFile(answer.file);
  Scene scene = study.scene;
  scene.settings.method = Method::kExact;
  Trajectory run = givenRun(setupOf(scene), readPoseTable(bytes, answer.file));
  const double allowed = kSameTime * study.duration();
  if (run.settings.duration < study.duration() - allowed) {
    throw InputError(answer.file + ": ends at " + brief(run.settings.duration) + " s, expected " +
                     brief(study.duration()) + " s, which the case " + study.name + " lasts");
  }
  const auto between = std::count_if(study.times.begin(), study.times.end(), [&](double time) {
    return time < run.settings.duration - allowed &&
           std::any_of(run.tracks.begin(), run.tracks.end(), [&](const Track& track) {
             return track.segments.size() > 1 && !hasRowAt(track, time, allowed);
           });
  });
  Hash hash;
  hash.add(bytes);
  std::string settings = "a table of poses, " + hash.text();
  if (between > 0) {
    settings += "; interpolated at " + std::to_string(between) + " of " + std::to_string(study.times.size()) +
                " times";
  }
  if (answer.seconds) {
    settings += "; took " + brief(*answer.seconds) + " s";
  }
  return std::make_unique<GivenContestant>(answer, std::move(run), std::move(settings));
}

}  // namespace careen
