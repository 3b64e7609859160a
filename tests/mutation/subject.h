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

/// A piece of a shader, which occurs exactly once, and its replacement.
struct ShaderEdit {
  std::string file;
  std::string piece;
  std::string instead;
};

/// Everything that determines a picture.
struct Subject {
  std::string name;
  Scene scene;
  double moment = 0;  ///< [s] scene time drawn
  RenderOptions look;
  std::vector<ShaderEdit> edits;
};

/// A crate thrown into a room that hits the floor, the back wall and a side wall; drawn in flight.
Subject thrownCrate();
/// Two boxes that collide off-centre in free fall, with friction.
Subject strikingPair();
/// Two boxes on springs, with drag.
Subject sprungChain();
/// A crate that flies into a corner, by a stepping method.
Subject steppedCrate(Method method);
/// Every kind of thing that is drawn: boxes pale and dark, cubes, one standing, one hovering, floor, ramp,
/// walls, at time 0.
Subject stillLife();
/// The same with ambient light only.
Subject stillLifeWithoutLight();
/// The same from a low eye against the light, where reflections are strongest.
Subject againstTheLight();
/// A row of six on an unbounded floor.
Subject row();

/// A change to a subject.
struct Mutation {
  std::string name;
  std::function<Subject()> subject;
  std::function<void(Subject&)> change;
};
using Mutations = std::vector<Mutation>;

/// Changes of physics, most of them in the last bit, which the motion shows.
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

/// [px] Size of all pictures but those of films: 320 x 180, or for example CAREEN_MUTATION_HEIGHT=720, to
/// run everything by hand at film size.
int pictureHeight();
int pictureWidth();

/// [m] Width of a pixel at a place of the subject.
double pixelAt(const Subject& subject, const Vec3& place);

/// Draws the subject at its time. Pictures of unchanged subjects are cached by name.
DeepPicture pictureOf(const Subject& subject);
const DeepPicture& unchangedPicture(const Subject& subject);

/// Ratio of a difference to the tolerance's limit, for the criterion where it is largest. More than 1 is too
/// much.
struct Margin {
  double ratio = 0;
  std::string criterion;
};
Margin marginOf(const PictureDifference& difference, const Tolerance& tolerance);

}  // namespace careen
