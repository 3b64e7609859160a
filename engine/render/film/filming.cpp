#include "render/film/filming.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "core/brief.h"
#include "core/error.h"
#include "image/light_average.h"
#include "image/matte.h"
#include "render/draw/renderer.h"
#include "render/overlay/overlays.h"
#include "stage/turn.h"
#include "view/camera.h"

namespace careen {
namespace {

bool isSameCamera(const Camera& a, const Camera& b) {
  return a.eye == b.eye && a.target == b.target && a.up == b.up && a.fovDegrees == b.fovDegrees &&
         a.beside == b.beside && a.sharpAt == b.sharpAt;
}

}  // namespace

Filming::Filming(const Trajectory& run)
    : run_(run),
      clock_(run.stage.timeMap.within(run.settings.duration)),
      path_(run, clock_, run.stage.picture.aspect()),
      reaches_(wallReachesOf(run)) {}

Camera Filming::camera(double filmTime) const {
  return orbited(path_.at(std::clamp(filmTime, 0.0, duration())), orbit_);
}

// Points of a spiral that turns by the golden angle: evenly spread however many there are (H. Vogel, "A
// better way to construct the sunflower head", 1979). They are taken in another order, so that a moment of
// the exposure has no part of the lens for its own.
Camera Filming::camera(double filmTime, int index, int count) const {
  Camera seen = camera(filmTime);
  if (!run_.stage.focus) {
    return seen;
  }
  constexpr double kGoldenDegrees = 137.50776405003785;
  constexpr double kPictureHeight = 0.024;  // [m]
  constexpr int kStride = 421;              // a prime, so that no point is left out
  const Focus& focus = *run_.stage.focus;
  const Vec3 sight = (seen.target - seen.eye).normalized();
  seen.sharpAt = focus.body
                     ? dot(run_.state(*focus.body, sceneTime(filmTime)).pose.position - seen.eye, sight)
                     : focus.distance.value_or((seen.target - seen.eye).norm());
  if (!(seen.sharpAt > 0)) {
    throw InputError("camera.focus: found a box behind the camera, " + brief(filmTime) + " s into the film");
  }
  const double radius = 0.25 * kPictureHeight / (slopeOfView(seen.fovDegrees) * focus.fStop);
  const int point = kStride * index % count;
  const Turn turn = turnFrom(std::fmod(kGoldenDegrees * point, 360));
  seen.beside = radius * std::sqrt((point + 0.5) / count) * Vec2(turn.cosine, turn.sine);
  return seen;
}

void Filming::prepare(RenderOptions& options) const {
  options.camera = camera(0);
  options.reaches = reaches_;
}

void Filming::checkCamera(std::span<const std::int64_t> frames, const FrameRate& rate) const {
  if (!path_.hasKeys()) {
    return;  // without keys the eye keeps its distance and height above the target
  }
  for (const std::int64_t frame : frames) {
    const Camera there = camera(rate.frameTime(frame));
    try {
      lookAt(there.eye, there.target, there.up);
    } catch (const InputError& error) {
      throw InputError(std::string(error.what()) + ", " + brief(rate.frameTime(frame)) +
                       " s into the film, between its keys");
    }
  }
}

bool Filming::isSame(const Sample& a, const Sample& b) const {
  return (a.time == b.time || !run_.stage.hasMovingPlanes()) && isSameCamera(a.camera, b.camera) &&
         std::equal(a.poses.begin(), a.poses.end(), b.poses.begin(), [](const Pose& p, const Pose& q) {
           return p.position == q.position && p.worldFromBody == q.worldFromBody;
         });
}

std::vector<Filming::Sample> Filming::samplesAt(double filmTime, const Shutter& shutter,
                                                const FrameRate& rate) const {
  const double open = shutter.degrees / 360 * rate.frameTime(1);
  const int count =
      std::max(open > 0 ? shutter.samples : 1, run_.stage.focus ? run_.stage.focus->samples : 1);
  std::vector<Sample> samples;
  for (int i = 0; i < count; ++i) {
    const double time = filmTime + open * ((i + 0.5) / count - 0.5);
    Sample sample{
        .poses = run_.poses(sceneTime(time)), .camera = camera(time, i, count), .time = sceneTime(time)};
    if (!samples.empty() && isSame(samples.back(), sample)) {
      ++samples.back().weight;  // identical to the last sample: no need to draw it again
    } else {
      samples.push_back(std::move(sample));
    }
  }
  return samples;
}

Picture Filming::drawn(Renderer& renderer, const std::vector<Sample>& samples) const {
  const auto shotOf = [](const Sample& sample) {
    return Shot{.poses = sample.poses, .camera = sample.camera, .time = sample.time};
  };
  if (run_.stage.picture.alpha) {
    LightAverage boxes;
    LightAverage coverage;
    LightAverage stage;
    LightAverage emptyStage;
    for (const Sample& sample : samples) {
      const MatteParts parts = renderer.drawMatte(shotOf(sample));
      boxes.add(parts.boxes, sample.weight);
      coverage.add(parts.coverage, sample.weight);
      stage.add(parts.stage, sample.weight);
      emptyStage.add(parts.emptyStage, sample.weight);
    }
    return onNothing({.boxes = boxes.average(),
                      .coverage = coverage.average(),
                      .stage = stage.average(),
                      .emptyStage = emptyStage.average()});
  }
  if (samples.size() == 1) {
    return renderer.draw(shotOf(samples[0]));
  }
  LightAverage average;
  for (const Sample& sample : samples) {
    average.add(renderer.draw(shotOf(sample)), sample.weight);
  }
  return average.average();
}

Picture Filming::draw(Renderer& renderer, double filmTime, const Shutter& shutter,
                      const FrameRate& rate) const {
  return drawn(renderer, samplesAt(filmTime, shutter, rate));
}

void Filming::explain(Renderer& renderer, Picture& picture, double filmTime, Overlays& overlays) const {
  const auto momentAt = [&](double time) {
    return OverlayMoment{.sceneTime = sceneTime(time), .view = renderer.view(camera(time))};
  };
  renderer.drawOver(picture, overlays.shapesAt(filmTime, momentAt, picture.width, picture.height));
}

void Filming::explainStrobe(Renderer& renderer, Picture& picture, std::span<const double> filmTimes,
                            Overlays& overlays) const {
  const OverlayMoment moment{.sceneTime = sceneTime(filmTimes.back()),
                             .view = renderer.view(camera(filmTimes.front()))};
  const auto still = [&](double /*filmTime*/) { return moment; };
  renderer.drawOver(picture, overlays.shapesAt(filmTimes.back(), still, picture.width, picture.height));
}

Picture Filming::drawStrobe(Renderer& renderer, std::span<const double> filmTimes) const {
  std::vector<Pose> all;
  for (const double time : filmTimes) {
    const std::vector<Pose> poses = run_.poses(sceneTime(time));
    all.insert(all.end(), poses.begin(), poses.end());
  }
  return drawn(
      renderer,
      {{.poses = std::move(all), .camera = camera(filmTimes.front()), .time = sceneTime(filmTimes.back())}});
}

}  // namespace careen
