#pragma once

#include <functional>
#include <string>
#include <vector>

#include "compare/picture_difference.h"
#include "compare/tolerance.h"
#include "image/deep_picture.h"
#include "render/draw/renderer.h"
#include "scene/scene.h"
#include "trajectory/trajectory.h"

namespace careen {

/// A piece of a shader, which is there exactly once, and what stands in its place.
struct ShaderEdit {
  std::string file;
  std::string piece;
  std::string instead;
};

/// All that a picture comes from.
struct Subject {
  std::string name;
  Scene scene;
  double moment = 0;  ///< [s] that is drawn
  RenderOptions look;
  std::vector<ShaderEdit> edits;
};

/// A crate that is thrown into a room, strikes the floor, the back and a side; drawn in flight.
Subject thrownCrate();
/// Two boxes that strike each other in free fall, off their centres, with friction.
Subject strikingPair();
/// Two boxes on springs, with drag.
Subject sprungChain();
/// A crate that flies into a corner, by a method that steps.
Subject steppedCrate(Method method);
/// Every sort of thing that is drawn: boxes pale and dark, cubes, one that stands, one that hovers, floor,
/// ramp, walls, at the moment 0.
Subject stillLife();
/// The same with nothing but light from all around.
Subject stillLifeWithoutLight();
/// The same from low down, the light opposite: what shines does so most there.
Subject againstTheLight();
/// A row of six on a floor without end.
Subject row();

/// A change to a subject.
struct Mutation {
  std::string name;
  std::function<Subject()> subject;
  std::function<void(Subject&)> change;
};
using Mutations = std::vector<Mutation>;

/// Changes of physics, most of them of the last bit, which the motion shows.
Mutations motionMutations();
/// Changes that the picture shows: of scenes; of camera, light and materials; of shaders.
Mutations sceneMutations();
Mutations cameraMutations();
Mutations lightMutations();
Mutations materialMutations();
Mutations boxShaderMutations();
Mutations surfaceShaderMutations();
Mutations lightShaderMutations();
/// Changes that nobody sees: at 320 x 180 no channel is more than 2/255 off.
Mutations unseenMutations();

/// [px] Of all pictures but films': 320 x 180, or CAREEN_MUTATION_HEIGHT=720, say, to do the whole by hand in
/// the size of a film.
int pictureHeight();
int pictureWidth();

/// [m] What a pixel covers at a place of the subject's.
double pixelAt(const Subject& subject, const Vec3& place);

/// Draws the subject's moment. What was drawn of an unchanged subject is kept by its name.
DeepPicture pictureOf(const Subject& subject);
const DeepPicture& unchangedPicture(const Subject& subject);

/// How near a difference is to a tolerance's limits: what was found over what is allowed, of the criterion
/// where that is greatest. More than 1 is too much.
struct Margin {
  double ratio = 0;
  std::string criterion;
};
Margin marginOf(const PictureDifference& difference, const Tolerance& tolerance);

}  // namespace careen
