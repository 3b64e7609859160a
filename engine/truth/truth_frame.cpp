#include "truth/truth_frame.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <span>
#include <utility>

#include "core/error.h"
#include "trajectory/numpy_array.h"
#include "trajectory/pose_samples.h"
#include "trajectory/zip_archive.h"
#include "view/scene_extent.h"

namespace careen {
namespace {

using Shape = std::vector<std::size_t>;

/// The pictures of single precision, made in one pass over the pixels.
class PixelLabels {
 public:
  PixelLabels(const ChannelSet& channels, const PixelRays& now, const PixelRays& next,
              std::span<const CastBox> boxesNow, std::span<const CastBox> boxesNext,
              std::span<const Surface> surfaces, std::span<const Surface> surfacesNext)
      : channels_(channels),
        now_(now),
        next_(next),
        boxesNow_(boxesNow),
        boxesNext_(boxesNext),
        surfaces_(surfaces),
        surfacesNext_(surfacesNext) {}

  void label(const CastPicture& cast, std::vector<ZipEntry>& entries) {
    const auto height = static_cast<std::size_t>(now_.height());
    const auto width = static_cast<std::size_t>(now_.width());
    const auto prepare = [&](TruthChannel channel, std::vector<float>& numbers, std::size_t components) {
      numbers.assign(channels_.has(channel) ? height * width * components : 0, 0.0F);
    };
    prepare(TruthChannel::kDepth, depth_, 1);
    prepare(TruthChannel::kDistance, distance_, 1);
    prepare(TruthChannel::kNormal, normal_, 3);
    prepare(TruthChannel::kCoordinates, coordinates_, 3);
    prepare(TruthChannel::kFlow, flow_, 2);
    std::size_t place = 0;
    for (int y = 0; y < now_.height(); ++y) {
      for (int x = 0; x < now_.width(); ++x, ++place) {
        if (cast.instance[place] != 0) {
          labelPixel(cast, x, y, place);
        }
      }
    }
    const auto add = [&](TruthChannel channel, const std::vector<float>& numbers, const Shape& shape) {
      if (channels_.has(channel)) {
        entries.emplace_back(std::string(kTruthChannels.at(static_cast<std::size_t>(channel))) + ".npy",
                             encodeNumpy(numbers, shape));
      }
    };
    add(TruthChannel::kDepth, depth_, {height, width});
    add(TruthChannel::kDistance, distance_, {height, width});
    add(TruthChannel::kNormal, normal_, {height, width, 3});
    add(TruthChannel::kCoordinates, coordinates_, {height, width, 3});
    add(TruthChannel::kFlow, flow_, {height, width, 2});
    if (channels_.has(TruthChannel::kInstance)) {
      entries.emplace_back("instance.npy", encodeNumpy(cast.instance, Shape{height, width}));
    }
    if (channels_.has(TruthChannel::kFace)) {
      entries.emplace_back("face.npy", encodeNumpy(cast.face, Shape{height, width}));
    }
  }

 private:
  static const CastBox& partOf(const CastBox& box, std::size_t part) {
    return box.parts.empty() ? box : box.parts[part];
  }

  static void put(std::vector<float>& numbers, std::size_t place, const Vec3& value) {
    for (std::size_t k = 0; k < 3; ++k) {
      numbers[3 * place + k] = static_cast<float>(value[static_cast<Eigen::Index>(k)]);
    }
  }

  // The same point of a wall that moves, later.
  static Vec3 movedWith(const Surface& from, const Surface& to, const Vec3& point) {
    const Vec3 arm = point - from.origin;
    return to.origin + from.across.dot(arm) * to.across + from.along.dot(arm) * to.along;
  }

  void labelPixel(const CastPicture& cast, int x, int y, std::size_t place) {
    const Vec3 along = now_.offset(x, y);
    const double depth = cast.depth[place];
    if (!depth_.empty()) {
      depth_[place] = static_cast<float>(depth);
    }
    if (!distance_.empty()) {
      distance_[place] = static_cast<float>(depth * along.norm());
    }
    if (normal_.empty() && coordinates_.empty() && flow_.empty()) {
      return;
    }
    const auto instance = static_cast<std::size_t>(cast.instance[place]) - 1;
    const bool isBox = instance < boxesNow_.size();
    Vec3 point = now_.eye() + depth * along;
    Vec3 later = point;
    if (isBox) {
      const std::size_t part = (cast.face[place] - 1U) / 6;
      const int face = (cast.face[place] - 1) % 6;
      const CastBox& box = partOf(boxesNow_[instance], part);
      const Pose& pose = box.pose;
      Vec3 inBox = pose.worldFromBody.transpose() * (point - pose.position);
      inBox[face / 2] = box.halfExtents[face / 2] * (face % 2 == 0 ? -1 : 1);
      const Pose& whole = boxesNow_[instance].pose;
      point = boxesNow_[instance].parts.empty()
                  ? inBox
                  : Vec3(whole.worldFromBody.transpose() * (pose.worldPoint(inBox) - whole.position));
      later = partOf(boxesNext_[instance], part).pose.worldPoint(inBox);
      if (!normal_.empty()) {
        put(normal_, place, (face % 2 == 0 ? -1.0 : 1.0) * pose.worldFromBody.col(face / 2));
      }
    } else {
      const Surface& surface = surfaces_[instance - boxesNow_.size()];
      if (!normal_.empty()) {
        put(normal_, place, surface.normal);
      }
      if (surface.plane >= 0) {
        later = movedWith(surface, surfacesNext_[instance - boxesNow_.size()], point);
      }
    }
    if (!coordinates_.empty()) {
      put(coordinates_, place, point);
    }
    if (!flow_.empty()) {
      const Vec3 pixel = next_.pixelOf(later);
      constexpr float kNothing = std::numeric_limits<float>::quiet_NaN();
      const bool isSeen = pixel.z() > 0;
      flow_[2 * place] = isSeen ? static_cast<float>(pixel.x() - (x + 0.5)) : kNothing;
      flow_[2 * place + 1] = isSeen ? static_cast<float>(pixel.y() - (y + 0.5)) : kNothing;
    }
  }

  const ChannelSet& channels_;
  const PixelRays& now_;
  const PixelRays& next_;
  std::span<const CastBox> boxesNow_;
  std::span<const CastBox> boxesNext_;
  std::span<const Surface> surfaces_;
  std::span<const Surface> surfacesNext_;
  std::vector<float> depth_;
  std::vector<float> distance_;
  std::vector<float> normal_;
  std::vector<float> coordinates_;
  std::vector<float> flow_;
};

void addVisibility(const CastPicture& cast, std::vector<ZipEntry>& entries) {
  const std::size_t boxes = cast.visible.size();
  std::vector<double> visible;
  std::vector<double> alone;
  std::vector<double> share;
  std::vector<double> bounds;
  for (std::size_t box = 0; box < boxes; ++box) {
    visible.push_back(static_cast<double>(cast.visible[box]));
    alone.push_back(static_cast<double>(cast.alone[box]));
    share.push_back(cast.alone[box] > 0 ? visible.back() / alone.back() : 0);
    const PixelBox& found = cast.bounds[box];
    for (const int side : {found.left, found.top, found.right, found.bottom}) {
      bounds.push_back(cast.visible[box] > 0 ? side : -1);
    }
  }
  const auto add = [&](const char* name, std::vector<double> numbers, Shape shape) {
    entries.emplace_back(name, encodeNumpy(NumpyArray::of(std::move(numbers), std::move(shape))));
  };
  add("visible_pixels.npy", std::move(visible), {boxes});
  add("alone_pixels.npy", std::move(alone), {boxes});
  add("visibility.npy", std::move(share), {boxes});
  add("box2d.npy", std::move(bounds), {boxes, 4});
}

void addStates(const Trajectory& run, double filmTime, double sceneTime, std::vector<ZipEntry>& entries) {
  const std::size_t boxes = run.tracks.size();
  std::vector<double> position;
  std::vector<double> quaternion;
  std::vector<double> velocity;
  std::vector<double> angularVelocity;
  const auto append = [](std::vector<double>& numbers, const Vec3& value) {
    numbers.insert(numbers.end(), {value.x(), value.y(), value.z()});
  };
  for (std::size_t box = 0; box < boxes; ++box) {
    const PoseRow row = poseRow(run, box, sceneTime);
    append(position, row.position);
    quaternion.push_back(row.worldFromBody.w());
    append(quaternion, row.worldFromBody.vec());
    append(velocity, row.velocity);
    append(angularVelocity, row.angularVelocity);
  }
  const auto add = [&](const char* name, std::vector<double> numbers, Shape shape) {
    entries.emplace_back(name, encodeNumpy(NumpyArray::of(std::move(numbers), std::move(shape))));
  };
  add("time.npy", {filmTime}, {});
  add("scene_time.npy", {sceneTime}, {});
  add("position.npy", std::move(position), {boxes, 3});
  add("quaternion.npy", std::move(quaternion), {boxes, 4});
  add("velocity.npy", std::move(velocity), {boxes, 3});
  add("angular_velocity.npy", std::move(angularVelocity), {boxes, 3});
}

}  // namespace

void checkLabels(const RunSetup& setup) {
  if (!setup.stage.parts.empty()) {
    throw InputError("found box " + setup.world.bodies[setup.stage.parts[0].body].name +
                     " drawn as a mesh, expected boxes: rays for labels meet boxes only");
  }
  constexpr int kMostParts = 42;  // their faces have numbers of one byte
  for (const Body& body : setup.world.bodies) {
    if (body.partCount() > kMostParts) {
      throw InputError("found box " + body.name + " of " + std::to_string(body.partCount()) +
                       " boxes, expected at most " + std::to_string(kMostParts) +
                       ": labels number their faces");
    }
  }
}

TruthFrames::TruthFrames(const Trajectory& run)
    : run_(run),
      clock_(run.stage.timeMap.within(run.settings.duration)),
      path_(run, clock_, run.stage.picture.aspect()),
      extent_(extentOf(run)),
      reaches_(wallReachesOf(run)) {
  checkLabels(run);
}

std::vector<Surface> TruthFrames::surfaces(double filmTime) const {
  return surfacesOf(run_.stage, extent_, {}, reaches_, clock_.sceneTime(filmTime));
}

PixelRays TruthFrames::rays(double filmTime) const {
  const PictureSettings& picture = run_.stage.picture;
  return {path_.at(std::clamp(filmTime, 0.0, duration())), picture.width, picture.height};
}

std::vector<CastBox> TruthFrames::boxesAt(double filmTime) const {
  const std::vector<Pose> poses = run_.poses(clock_.sceneTime(filmTime));
  std::vector<CastBox> boxes;
  for (std::size_t i = 0; i < poses.size(); ++i) {
    const Body& body = run_.world.bodies[i];
    CastBox& box = boxes.emplace_back(CastBox{.pose = poses[i], .halfExtents = body.halfExtents});
    for (int part = 0; part < static_cast<int>(body.parts.size()); ++part) {
      box.parts.push_back(
          {.pose = partPose(body, part, poses[i]), .halfExtents = body.part(part).halfExtents});
    }
  }
  return boxes;
}

CastPicture TruthFrames::cast(double filmTime) const {
  return castRays(rays(filmTime), boxesAt(filmTime), surfaces(filmTime));
}

std::string TruthFrames::encode(std::int64_t frame, const ChannelSet& channels) const {
  const FrameRate& rate = run_.stage.picture.rate;
  const double time = rate.frameTime(frame);
  const double next = rate.frameTime(frame + 1);
  const PixelRays raysNow = rays(time);
  const std::vector<CastBox> boxes = boxesAt(time);
  const std::vector<Surface> surfacesNow = surfaces(time);
  const CastPicture cast = castRays(raysNow, boxes, surfacesNow);
  std::vector<ZipEntry> entries;
  PixelLabels(channels, raysNow, rays(next), boxes, boxesAt(next), surfacesNow, surfaces(next)).label(cast, entries);
  if (channels.has(TruthChannel::kVisibility)) {
    addVisibility(cast, entries);
  }
  addStates(run_, time, clock_.sceneTime(time), entries);
  return zipOf(entries);
}

}  // namespace careen
