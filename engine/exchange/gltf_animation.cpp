#include "exchange/gltf_animation.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>
#include <utility>
#include <variant>

namespace careen {
namespace {

using AnimationJson = nlohmann::ordered_json;

}  // namespace

GltfAnimation::GltfAnimation(const Trajectory& run, double within, GltfBuffer& buffer)
    : run_(run),
      within_(within),
      buffer_(buffer),
      clock_(run.stage.timeMap.within(run.settings.duration)),
      impactsOf_(run.tracks.size()) {
  for (const Impact& impact : run_.impacts) {
    impactsOf_[static_cast<std::size_t>(impact.a.value)].push_back(impact.time);
    if (!impact.b.isWall()) {
      impactsOf_[static_cast<std::size_t>(impact.b.body())].push_back(impact.time);
    }
  }
}

// ---- Times

// The film times at which these scene times are shown.
std::vector<double> GltfAnimation::filmTimes(const std::vector<double>& sceneTimes) const {
  std::vector<double> times;
  for (std::size_t i = 0; i + 1 < clock_.keys.size(); ++i) {
    const TimeKey& from = clock_.keys[i];
    const TimeKey& to = clock_.keys[i + 1];
    if (to.scene > from.scene) {
      const auto first = std::lower_bound(sceneTimes.begin(), sceneTimes.end(), from.scene);
      const auto last = std::upper_bound(first, sceneTimes.end(), to.scene);
      for (auto time = first; time != last; ++time) {
        times.push_back(from.film + (*time - from.scene) / (to.scene - from.scene) * (to.film - from.film));
      }
    }
  }
  return times;
}

AnimatedSpan GltfAnimation::span(std::vector<double> sceneKinks,
                                 const std::vector<double>& sceneSeams) const {
  std::sort(sceneKinks.begin(), sceneKinks.end());
  AnimatedSpan span{
      .duration = clock_.duration(), .kinks = filmTimes(sceneKinks), .seams = filmTimes(sceneSeams)};
  for (const TimeKey& key : clock_.keys) {
    span.kinks.push_back(key.film);
  }
  std::sort(span.kinks.begin(), span.kinks.end());
  return span;
}

void GltfAnimation::addKinks(std::size_t body, std::vector<double>& kinks, std::vector<double>& seams) const {
  kinks.insert(kinks.end(), impactsOf_[body].begin(), impactsOf_[body].end());
  const Segments& segments = run_.tracks[body].segments;
  for (std::size_t i = 1; i < segments.size(); ++i) {
    const bool jumps = std::holds_alternative<Rest>(segments[i].motion) ||
                       std::holds_alternative<Rest>(segments[i - 1].motion) ||
                       std::holds_alternative<Driven>(segments[i].motion);
    (jumps ? kinks : seams).push_back(segments[i].start);
  }
  addTurns(body, seams);
}

// Keys are looked for at eighths of the time between two: of a body that turns as often there, it would not
// be seen that it turns. Seams at golden angles are nowhere in step with that.
void GltfAnimation::addTurns(double spin, double from, double end, std::vector<double>& seams) {
  constexpr double kMostTurns = 7;
  constexpr double kGoldenAngle = 2.399963229728653;  // [rad]
  constexpr double kMostSeams = 1e5;
  const double angle = spin * (end - from);
  if (angle > 2 * std::numbers::pi * kMostTurns) {
    const double step = std::max(kGoldenAngle, angle / kMostSeams) / spin;
    for (double time = from + step; time < end; time += step) {
      seams.push_back(time);
    }
  }
}

void GltfAnimation::addTurns(std::size_t body, std::vector<double>& seams) const {
  const Segments& segments = run_.tracks[body].segments;
  for (std::size_t i = 0; i < segments.size(); ++i) {
    const double end = i + 1 < segments.size() ? segments[i + 1].start : run_.settings.duration;
    const MassProperties& mass = run_.world.bodies[body].mass;
    addTurns(angularVelocity(mass, stateAt(segments[i].motion, mass, 0)).norm(), segments[i].start, end,
             seams);
  }
  std::sort(seams.begin(), seams.end());
}

// ---- Channels

std::size_t GltfAnimation::timesAccessor(const std::vector<float>& times) {
  return buffer_.addFloats(GltfBuffer::Kind::kScalar, times, true);
}

void GltfAnimation::animate(std::size_t index, AnimationJson& node, const AnimationKeys<Vec3>& keys) {
  node["translation"] = floatsOf(keys.values.front());
  positionError_ = std::max(positionError_, keys.error);
  if (keys.isConstant()) {
    return;
  }
  std::vector<float> numbers;
  for (const Vec3& value : keys.values) {
    appendFloats(numbers, value);
  }
  channels_.push_back({index, "translation", timesAccessor(keys.times),
                       buffer_.addFloats(GltfBuffer::Kind::kVec3, numbers, false)});
  keys_ += keys.times.size();
}

void GltfAnimation::animate(std::size_t index, AnimationJson& node, const AnimationKeys<Quat>& keys) {
  node["rotation"] = floatsOf(keys.values.front());
  attitudeError_ = std::max(attitudeError_, keys.error);
  if (keys.isConstant()) {
    return;
  }
  std::vector<float> numbers;
  for (const Quat& value : keys.values) {
    appendFloats(numbers, value);
  }
  channels_.push_back({index, "rotation", timesAccessor(keys.times),
                       buffer_.addFloats(GltfBuffer::Kind::kVec4, numbers, false)});
  keys_ += keys.times.size();
}

void GltfAnimation::animate(std::size_t index, AnimationJson& node,
                            const AnimationKeys<LinePlacement>& keys) {
  const LinePlacement& first = keys.values.front();
  node["translation"] = floatsOf(first.from);
  node["rotation"] = floatsOf(first.worldFromLine);
  node["scale"] = floatsOf(Vec3(1, 1, first.length));
  positionError_ = std::max(positionError_, keys.error);
  if (keys.isConstant()) {
    return;
  }
  std::vector<float> places;
  std::vector<float> turns;
  std::vector<float> scales;
  for (const LinePlacement& line : keys.values) {
    appendFloats(places, line.from);
    appendFloats(turns, line.worldFromLine);
    appendFloats(scales, Vec3(1, 1, line.length));
  }
  const std::size_t times = timesAccessor(keys.times);
  channels_.push_back(
      {index, "translation", times, buffer_.addFloats(GltfBuffer::Kind::kVec3, places, false)});
  channels_.push_back({index, "rotation", times, buffer_.addFloats(GltfBuffer::Kind::kVec4, turns, false)});
  channels_.push_back({index, "scale", times, buffer_.addFloats(GltfBuffer::Kind::kVec3, scales, false)});
  keys_ += keys.times.size();
}

// ---- What moves

void GltfAnimation::moveWithBody(std::size_t index, AnimationJson& node, std::size_t body) {
  std::vector<double> kinks;
  std::vector<double> seams;
  addKinks(body, kinks, seams);
  const AnimatedSpan times = span(std::move(kinks), seams);
  const auto pose = [this, body](double time) { return run_.boxPoseAt(body, sceneTime(time)); };
  animate(index, node, positionKeys(times, within_, [&](double time) { return pose(time).position; }));
  animate(index, node, rotationKeys(times, within_, [&](double time) {
            return Quat(pose(time).worldFromBody).normalized();
          }));
}

void GltfAnimation::moveWithCourse(std::size_t index, AnimationJson& node, const Course& course) {
  std::vector<double> kinks;
  std::vector<double> seams;
  for (std::size_t k = 0; k < course.size(); ++k) {
    const double end = k + 1 < course.size() ? course[k + 1].from : run_.settings.duration;
    const Driven& motion = course[k].motion;
    if (k > 0) {
      kinks.push_back(course[k].from);
    }
    addTurns(std::max(motion.spin.norm(), motion.swings() ? motion.rate : 0.0), course[k].from, end, seams);
  }
  const AnimatedSpan times = span(std::move(kinks), seams);
  const auto pose = [&](double filmTime) {
    const double time = sceneTime(filmTime);
    return partAt(course, time).at(time).pose;
  };
  animate(index, node, positionKeys(times, within_, [&](double time) { return pose(time).position; }));
  animate(index, node, rotationKeys(times, within_, [&](double time) {
            return Quat(pose(time).worldFromBody).normalized();
          }));
}

void GltfAnimation::moveWithLine(std::size_t index, AnimationJson& node, const SpringEnd& from,
                                 const SpringEnd& to) {
  std::vector<double> kinks;
  std::vector<double> seams;
  for (const SpringEnd& end : {from, to}) {
    if (end.body) {
      addKinks(static_cast<std::size_t>(*end.body), kinks, seams);
    }
  }
  std::sort(seams.begin(), seams.end());
  const auto end = [this](const SpringEnd& of, double time) {
    return of.body ? run_.state(static_cast<std::size_t>(*of.body), time).pose.worldPoint(of.point)
                   : of.point;
  };
  animate(index, node, lineKeys(span(std::move(kinks), seams), within_, [&](double time) {
            const double moment = sceneTime(time);
            return linePlacement(end(from, moment), end(to, moment));
          }));
}

void GltfAnimation::moveBy(std::size_t index, AnimationJson& node,
                           const std::function<Vec3(double)>& position,
                           const std::function<Quat(double)>& attitude) {
  const AnimatedSpan times = span({}, {});
  animate(index, node, positionKeys(times, within_, position));
  animate(index, node, rotationKeys(times, within_, attitude));
}

AnimationJson GltfAnimation::json() const {
  if (channels_.empty()) {
    return nullptr;
  }
  AnimationJson samplers = AnimationJson::array();
  AnimationJson channels = AnimationJson::array();
  for (const Channel& each : channels_) {
    channels.push_back(
        {{"sampler", samplers.size()}, {"target", {{"node", each.node}, {"path", each.path}}}});
    samplers.push_back({{"input", each.times}, {"output", each.values}, {"interpolation", "LINEAR"}});
  }
  return {{{"name", "film"}, {"samplers", samplers}, {"channels", channels}}};
}

}  // namespace careen
