#pragma once

#include <array>
#include <cstddef>
#include <string>

#include "stage/stage.h"
#include "trajectory/archive.h"
#include "trajectory/motion_format.h"

namespace careen {

// The stage in a trajectory file, see trajectory_format.h.

template <class Archive>
void visit(Archive& archive, Visited<Archive, RoomShape> room) {
  visit(archive, room.min);
  visit(archive, room.max);
  for (std::size_t side = 0; side < room.open.size(); ++side) {
    visit(archive, room.open[side]);
  }
}

template <class Archive>
void visit(Archive& archive, Visited<Archive, Plane> plane) {
  visit(archive, plane.normal);
  archive.visit(plane.offset);
}

template <class Archive>
void visit(Archive& archive, Visited<Archive, Color> color) {
  archive.visit(color.red);
  archive.visit(color.green);
  archive.visit(color.blue);
}

template <class Archive>
void visit(Archive& archive, Visited<Archive, std::array<std::size_t, 3>> triangle) {
  for (std::size_t corner = 0; corner < 3; ++corner) {
    auto index = static_cast<int>(triangle[corner]);
    visitIndex(archive, index);
    if constexpr (Archive::kReads) {
      triangle[corner] = static_cast<std::size_t>(std::max(index, 0));
    }
  }
}

template <class Archive>
void visit(Archive& archive, Visited<Archive, DrawnPart> part) {
  auto body = static_cast<int>(part.body);
  visitIndex(archive, body);
  if constexpr (Archive::kReads) {
    part.body = static_cast<std::size_t>(std::max(body, 0));
  }
  visitAll(archive, part.mesh.points);
  visitAll(archive, part.mesh.triangles);
}

template <class Archive>
void visit(Archive& archive, Visited<Archive, Camera> camera) {
  visit(archive, camera.eye);
  visit(archive, camera.target);
  visit(archive, camera.up);
  archive.visit(camera.fovDegrees);
}

template <class Archive>
void visit(Archive& archive, Visited<Archive, CameraKey> key) {
  archive.visit(key.time);
  visit(archive, key.eye);
  visit(archive, key.target);
  archive.visit(key.fovDegrees);
}

template <class Archive>
void visit(Archive& archive, Visited<Archive, CameraMove> move) {
  archive.visit(move.orbitDegrees);
  visitOptional(archive, move.followed);
  visitAll(archive, move.keys);
}

template <class Archive>
void visit(Archive& archive, Visited<Archive, TimeKey> key) {
  archive.visit(key.film);
  archive.visit(key.scene);
}

template <class Archive>
void visit(Archive& archive, Visited<Archive, FrameRate> rate) {
  std::string text = rate.text();
  archive.visit(text);
  if constexpr (Archive::kReads) {
    rate = parseFrameRate(text);
  }
}

// A NameSet.
template <class Archive, class Set>
void visitNames(Archive& archive, Set& set) {
  std::string text = set.text();
  archive.visit(text);
  if constexpr (Archive::kReads) {
    set = Set::named(text);
  }
}

template <class Archive>
void visit(Archive& archive, Visited<Archive, PictureSettings> picture) {
  visitIndex(archive, picture.width);
  visitIndex(archive, picture.height);
  visit(archive, picture.rate);
  visitNamed(archive, picture.look, kLooks);
  visitNamed(archive, picture.antialiasing, kAntialiasings);
  archive.visit(picture.shutter.degrees);
  visitIndex(archive, picture.shutter.samples);
  visitNames(archive, picture.overlays);
}

template <class Archive>
void visit(Archive& archive, Visited<Archive, Stage> stage) {
  archive.visit(stage.name);
  visitOptional(archive, stage.room);
  visitAll(archive, stage.planes);
  visitAll(archive, stage.colors);
  visitOptional(archive, stage.camera);
  visit(archive, stage.cameraMove);
  visitAll(archive, stage.timeMap.keys);
  visit(archive, stage.picture);
}

}  // namespace careen
