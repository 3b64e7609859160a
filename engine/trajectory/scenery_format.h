#pragma once

#include "stage/stage.h"
#include "trajectory/archive.h"
#include "trajectory/stage_format.h"

namespace careen {

// What a trajectory file says of light, titles, focus and sound.

template <class Archive>
void visit(Archive& archive, Visited<Archive, ColorPair> pair) {
  visit(archive, pair.above);
  visit(archive, pair.below);
}

template <class Archive>
void visit(Archive& archive, Visited<Archive, Title> title) {
  archive.visit(title.from);
  archive.visit(title.to);
  archive.visit(title.text);
  visitNamed(archive, title.place, kTitlePlaces);
}

template <class Archive>
void visit(Archive& archive, Visited<Archive, Focus> focus) {
  archive.visit(focus.fStop);
  visitOptional(archive, focus.distance);
  visitOptional(archive, focus.body);
  visitIndex(archive, focus.samples);
}

template <class Archive>
void visit(Archive& archive, Visited<Archive, SoundMaterial> sound) {
  archive.visit(sound.modulus);
  archive.visit(sound.density);
  archive.visit(sound.damping);
}

template <class Archive>
void visitScenery(Archive& archive, Visited<Archive, Stage> stage) {
  visitNamed(archive, stage.cameraMove.easing, kEasings);
  visitOptional(archive, stage.focus);
  visitOptional(archive, stage.scenery.towardsLight);
  visitOptional(archive, stage.scenery.lightDegrees);
  visitOptional(archive, stage.scenery.lightColor);
  visitOptional(archive, stage.scenery.ambient);
  visitOptional(archive, stage.scenery.background);
  visitOptional(archive, stage.scenery.gloss);
  visitOptional(archive, stage.scenery.marks);
  visitAll(archive, stage.scenery.titles);
  visitAll(archive, stage.boxSounds);
  visitAll(archive, stage.wallSounds);
}

}  // namespace careen
