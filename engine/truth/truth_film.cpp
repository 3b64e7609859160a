#include "truth/truth_film.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <system_error>

#include "core/error.h"
#include "core/system/file.h"
#include "core/system/shared_work.h"
#include "film/folder.h"
#include "truth/truth_frame.h"

namespace careen {
namespace {

using Json = nlohmann::ordered_json;

Json jsonOf(const Vec3& value) { return {value.x(), value.y(), value.z()}; }
Json jsonOf(const Mat3& value) {
  return {jsonOf(Vec3(value.row(0))), jsonOf(Vec3(value.row(1))), jsonOf(Vec3(value.row(2)))};
}

Json boxesJson(const Trajectory& run) {
  Json boxes = Json::array();
  for (std::size_t i = 0; i < run.world.bodies.size(); ++i) {
    const Body& body = run.world.bodies[i];
    const Color& color = run.stage.colors[i];
    boxes.push_back(
        {{"id", i + 1},
         {"name", body.name},
         {"half_extents", jsonOf(body.halfExtents)},
         {"fixed", isImmovable(body.mass)},
         {"mass", body.mass.mass},
         {"inertia", body.mass.turned ? jsonOf(body.mass.inertiaTensor()) : jsonOf(body.mass.inertiaBody)},
         {"center", jsonOf(Vec3(Vec3::Zero() - body.boxCenter))},
         {"restitution", body.material.restitution},
         {"friction", body.material.friction},
         {"color", {color.red, color.green, color.blue}}});
    for (int part = 0; part < static_cast<int>(body.parts.size()); ++part) {
      const Pose inBox = partPose(body, part, Pose{});
      boxes.back()["parts"].push_back({{"half_extents", jsonOf(body.part(part).halfExtents)},
                                       {"position", jsonOf(inBox.position)},
                                       {"axes", jsonOf(inBox.worldFromBody)}});
    }
  }
  return boxes;
}

// A surface that is drawn, and the wall that acts there, if one does.
Json surfacesJson(const Trajectory& run, const std::vector<Surface>& surfaces) {
  Json walls = Json::array();
  for (std::size_t i = 0; i < surfaces.size(); ++i) {
    const Surface& surface = surfaces[i];
    const double offset =
        surface.normal.dot(surface.outline.empty() ? surface.origin : surface.outline.front());
    Json wall = {
        {"id", run.world.bodies.size() + i + 1}, {"normal", jsonOf(surface.normal)}, {"offset", offset}};
    for (const Wall& each : run.world.walls) {
      const WallPlane plane = planeAt(each, 0);
      if (plane.normal.dot(surface.normal) > 1 - 1e-12 &&
          std::abs(plane.offset - offset) <= 1e-9 * std::max(1.0, std::abs(offset)) &&
          each.course.empty() == (surface.plane < 0)) {
        wall["name"] = each.name;
        wall["restitution"] = each.material.restitution;
        wall["friction"] = each.material.friction;
        break;
      }
    }
    Json& outline = wall["outline"] = Json::array();
    for (const Vec3& corner : surface.outline) {
      outline.push_back(jsonOf(corner));
    }
    walls.push_back(std::move(wall));
  }
  return walls;
}

// [s] of the film when it first shows this scene time; none if it does not.
std::optional<double> filmTimeOf(const TimeMap& clock, double sceneTime) {
  for (std::size_t i = 0; i + 1 < clock.keys.size(); ++i) {
    const TimeKey& from = clock.keys[i];
    const TimeKey& to = clock.keys[i + 1];
    if (sceneTime >= from.scene && sceneTime <= to.scene) {
      const double length = to.scene - from.scene;
      return length > 0 ? from.film + (sceneTime - from.scene) / length * (to.film - from.film) : from.film;
    }
  }
  return std::nullopt;
}

Json impactsJson(const Trajectory& run, const TruthFrames& truth) {
  const FrameRate& rate = run.stage.picture.rate;
  Json impacts = Json::array();
  for (const Impact& impact : run.impacts) {
    const std::optional<double> film = filmTimeOf(truth.clock(), impact.time);
    Json one = {{"time", impact.time},
                {"a", run.world.bodies[static_cast<std::size_t>(impact.a.value)].name},
                {"b", run.partnerName(impact)},
                {"point", jsonOf(impact.point)},
                {"normal", jsonOf(impact.normal)},
                {"approach", impact.approach},
                {"impulse", impact.impulse},
                {"tangential", impact.tangential},
                {"frame", nullptr},
                {"pixel", nullptr}};
    if (film) {
      // The last frame that is not after it, and where its point is there.
      auto frame = static_cast<std::int64_t>(*film / rate.frameTime(1));
      while (frame > 0 && rate.frameTime(frame) > *film) {
        --frame;
      }
      while (rate.frameTime(frame + 1) <= *film) {
        ++frame;
      }
      one["frame"] = frame;
      const Vec3 pixel = truth.rays(rate.frameTime(frame)).pixelOf(impact.point);
      if (pixel.z() > 0) {
        one["pixel"] = {pixel.x(), pixel.y()};
      }
    }
    impacts.push_back(std::move(one));
  }
  return impacts;
}

// Where those are that move by themselves.
void addMovedWalls(const Trajectory& run, const TruthFrames& truth, double filmTime, Json& frame) {
  if (!run.stage.hasMovingPlanes()) {
    return;
  }
  Json moved = Json::array();
  const std::vector<Surface> surfaces = truth.surfaces(filmTime);
  for (std::size_t i = 0; i < surfaces.size(); ++i) {
    if (surfaces[i].plane >= 0) {
      moved.push_back({{"id", run.world.bodies.size() + i + 1},
                       {"normal", jsonOf(surfaces[i].normal)},
                       {"offset", surfaces[i].normal.dot(surfaces[i].origin)}});
    }
  }
  frame["walls"] = std::move(moved);
}

std::string truthJson(const Trajectory& run, const TruthFrames& truth, const TruthSettings& settings,
                      const std::vector<std::int64_t>& frames) {
  const PictureSettings& picture = run.stage.picture;
  Json poses = Json::array();
  for (const std::int64_t frame : frames) {
    const double time = picture.rate.frameTime(frame);
    const PixelRays rays = truth.rays(time);
    const double focal = rays.focalLength();
    poses.push_back(
        {{"frame", frame},
         {"time", time},
         {"scene_time", truth.clock().sceneTime(time)},
         {"eye", jsonOf(rays.eye())},
         {"world_from_camera", jsonOf(rays.worldFromCamera())},
         {"matrix", {{focal, 0, 0.5 * picture.width}, {0, focal, 0.5 * picture.height}, {0, 0, 1}}}});
    addMovedWalls(run, truth, time, poses.back());
  }
  const Json whole = {{"program", settings.program},
                      {"scene", run.stage.name},
                      {"scene_hash", run.sceneHash()},
                      {"state_hash", run.stateHash()},
                      {"size", {picture.width, picture.height}},
                      {"fps", picture.rate.text()},
                      {"channels", settings.channels.text()},
                      {"gravity", jsonOf(run.world.gravity)},
                      {"boxes", boxesJson(run)},
                      {"walls", surfacesJson(run, truth.surfaces(0))},
                      {"frames", std::move(poses)},
                      {"impacts", impactsJson(run, truth)}};
  return whole.dump(1, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace

std::int64_t writeTruth(const Trajectory& run, const TruthSettings& settings,
                        const std::function<void(std::int64_t done, std::int64_t total)>& progress,
                        const std::stop_token& stop) {
  const TruthFrames truth(run);
  const std::vector<std::int64_t> frames =
      framesOf(settings.frames, run.stage.picture.rate.frameCount(truth.duration()));
  for (const std::int64_t frame : frames) {
    static_cast<void>(truth.rays(run.stage.picture.rate.frameTime(frame)));  // the camera is defined there
  }
  std::error_code error;
  std::filesystem::create_directories(settings.folder, error);
  if (error) {
    throw MachineError(settings.folder.string() + ": cannot be created: " + error.message());
  }
  // A truth.json of other frames must not stand beside these.
  std::filesystem::remove(settings.folder / "truth.json", error);
  const auto total = std::ssize(frames);
  std::int64_t done = 0;
  shareWork(
      total, settings.jobs,
      [&](std::int64_t index) {
        const std::int64_t frame = frames[static_cast<std::size_t>(index)];
        const std::filesystem::path name =
            std::filesystem::path(frameFileName(frame)).replace_extension(".npz");
        writeFile(settings.folder / name, truth.encode(frame, settings.channels));
      },
      [&](std::int64_t) {
        if (progress) {
          progress(++done, total);
        }
      },
      stop);
  writeFile(settings.folder / "truth.json", truthJson(run, truth, settings, frames));
  return total;
}

}  // namespace careen
