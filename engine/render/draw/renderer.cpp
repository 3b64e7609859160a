#include <GL/glcorearb.h>

#include "render/draw/renderer.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "core/error.h"
#include "core/system/clock.h"
#include "core/system/resource.h"
#include "render/draw/background.h"
#include "render/draw/box_batch.h"
#include "render/draw/changed_cells.h"
#include "render/draw/frame_block.h"
#include "render/draw/kept_lists.h"
#include "render/draw/light_plane.h"
#include "render/draw/neighbors.h"
#include "render/draw/occlusion_map.h"
#include "render/draw/picture_cells.h"
#include "render/draw/shadow_batch.h"
#include "render/draw/shadow_pairs.h"
#include "render/draw/surface_batch.h"
#include "render/draw/visible_faces.h"
#include "render/gl/canvas.h"
#include "render/gl/gl.h"
#include "render/gl/shader.h"
#include "render/overlay/batch.h"
#include "view/camera.h"
#include "view/scene_extent.h"
#include "view/surfaces.h"

namespace careen {
namespace {

constexpr double kShrunk = 3;  // [px] boxes in the map of occlusion, whose pixels reach so far

constexpr double kSnapped = 0.02;       // [px] GL rounds corners by less
constexpr std::size_t kManyBoxes = 20;  // which hide so many faces that finding them pays

// Empty: the program's own shaders only.
std::filesystem::path shaderFolder(const RenderOptions& options) {
  if (!options.shaders.empty()) {
    return options.shaders;
  }
  const std::filesystem::path code = codeFolder();
  return code.empty() ? code : code / "shaders";
}

std::vector<std::string> lightShaders(const Lighting& lighting) {
  return {lighting.light ? "light.frag" : "ambient.frag", "finish.frag"};
}

// Walls that are no room's may hide each other.
bool mayOverlap(const Stage& stage) { return stage.planes.size() + (stage.room ? 1 : 0) > 1; }

// Several moments are drawn in layers; llvmpipe draws samples at the border of a scissor's rectangle twice;
// and a mesh is not where its box is.
bool mayBeCompared(const Stage& stage, std::span<const DrawnBox> drawn) {
  return stage.parts.empty() && stage.picture.antialiasing != Antialiasing::kMultisampled &&
         (drawn.empty() || drawn.front().moment == 0);
}

// What is drawn: a picture, or several of the same shot, none of which stays.
enum class Sheet { kPicture, kMatte };

// Where boxes cast their shadows.
enum class Cast { kEverywhere, kOnBoxes };

}  // namespace

struct Renderer::Parts {
  Parts(const RunSetup& setup, const RenderOptions& options);
  void look(const Shot& shot);
  void place(std::span<const Pose> poses, const Camera& from, Sheet sheet);
  void fill();
  void drawOcclusion();
  void gatherShadows() const;
  void takeByShadows() const;
  void drawShaded(std::size_t layer, Cast cast);
  void drawBoxes(Cast cast);
  void drawStage(const PictureCells& shaded, const PictureCells& occluded);
  void drawBlack();
  std::vector<PixelRectangle> bareParts() const;
  void prepare(const Shot& shot, Sheet sheet);
  template <class Draw>
  Picture drawn(const Draw& draw);
  void upload() const;

  World world;
  Stage stage;
  Extent extent;
  double aspect;
  Camera camera;
  View view;
  Lighting lighting;
  Materials materials;
  std::vector<WallReach> reaches;
  bool shadows;
  bool occlusion;
  double pixel = 0;  // [rad] as drawn
  PictureCells shadedCells{View()};
  PictureCells occludedCells{View()};
  std::unique_ptr<GlContext> context;
  Gl gl;
  Canvas canvas;
  std::filesystem::path shaders;
  std::map<std::pair<int, int>, OverlayBatch> overlays;  // by size, created for the first picture of it
  BoxBatch boxes;
  SurfaceBatch surfaces;
  std::optional<ShadowBatch> shadowBatch;
  std::optional<OcclusionMap> occlusionMap;
  Background background;
  unsigned blockBuffer = 0;
  FrameBlock block;
  KeptLists lists;
  ChangedCells changed;
  DrawFigures figures;
};

Renderer::Parts::Parts(const RunSetup& setup, const RenderOptions& options)
    : world(setup.world),
      stage(setup.stage),
      extent(extentOf(setup)),
      aspect(stage.picture.aspect()),
      camera(options.camera ? *options.camera : cameraOf(setup, aspect)),
      lighting(options.lighting ? *options.lighting : lightingOf(stage, camera)),
      materials(options.materials ? *options.materials : materialsOf(stage)),
      reaches(options.reaches),
      shadows(lighting.light && lighting.light->castsShadow && stage.picture.light.has(LightPart::kShadows) &&
              !world.bodies.empty()),
      occlusion(materials.occlusion && stage.picture.light.has(LightPart::kOcclusion) &&
                !world.bodies.empty()),
      context(openContext(options.context)),
      gl(*context),
      canvas(gl, stage.picture.width, stage.picture.height, stage.picture.antialiasing),
      shaders(shaderFolder(options)),
      boxes(gl, shaders,
            {.common = lightShaders(lighting),
             .light = lighting.light.has_value(),
             .shadows = shadows,
             .occlusion = occlusion,
             .neighbors = occlusion && world.bodies.size() > 1}),
      surfaces(gl, shaders, lightShaders(lighting), surfacesOf(stage, extent, materials, options.reaches),
               tileSize(extent)),
      background(gl, shaders) {
  if (shadows) {
    shadowBatch.emplace(gl, shaders);
  }
  if (occlusion && (!surfaces.surfaces().empty() || stage.hasMovingPlanes())) {
    occlusionMap.emplace(gl, shaders, canvas.drawnWidth(), canvas.drawnHeight());
  }
  gl.GenBuffers(1, &blockBuffer);
  gl.BindBufferBase(GL_UNIFORM_BUFFER, 0, blockBuffer);  // all programs use binding 0
  gl.Enable(GL_DEPTH_TEST);
  gl.DepthFunc(GL_LEQUAL);
  gl.Enable(GL_CULL_FACE);

  block = blockOf({.lighting = lighting,
                   .materials = materials,
                   .parts = stage.picture.light,
                   .boxes = world.bodies.size(),
                   .width = canvas.drawnWidth(),
                   .height = canvas.drawnHeight(),
                   .wantsEdges = canvas.wantsEdges()});
  checkGl(gl, "preparing to draw");
}

void Renderer::Parts::upload() const {
  gl.BindBuffer(GL_UNIFORM_BUFFER, blockBuffer);
  gl.BufferData(GL_UNIFORM_BUFFER, sizeof(block), &block, GL_STREAM_DRAW);
}

void Renderer::Parts::look(const Shot& shot) {
  view = viewOf(shot.camera, extent, aspect);
  block.clipFromOffset = floats(view.clipFromOffset);
  if (stage.hasMovingPlanes()) {
    surfaces.replace(surfacesOf(stage, extent, materials, reaches, shot.time));
  }
  surfaces.place(view.eye);
}

void Renderer::Parts::place(std::span<const Pose> poses, const Camera& from, Sheet sheet) {
  std::vector<DrawnBox> drawn = drawnBoxes(world, stage, poses, 0.004 * extent.radius());
  widenSprings(drawn, view.eye, pixelAngle(from, stage.picture.height));
  sortFromEye(drawn, view.eye);
  pixel = pixelAngle(from, canvas.drawnHeight());
  std::vector<DrawnFace> faces = facesTowards(drawn, view.eye, pixel);
  HiddenTiles hidden;
  if (drawn.size() >= kManyBoxes && stage.parts.empty()) {  // a mesh does not hide what its box would
    const bool isMultisampled = stage.picture.antialiasing == Antialiasing::kMultisampled;
    Visible visible = visibleFaces(faces, view,
                                   {.width = canvas.drawnWidth(),
                                    .height = canvas.drawnHeight(),
                                    .within = kSnapped + (isMultisampled ? 0.5 : 0)});
    faces = std::move(visible.faces);
    hidden = std::move(visible.hidden);
  }
  shadedCells = PictureCells(view);
  occludedCells = PictureCells(view);
  const bool bounces = occlusion && stage.picture.light.has(LightPart::kBounce);
  block.up = floats(camera.up.normalized(), bounces ? returnLight(drawn, materials) : 0);
  changed.begin(view, block, canvas.drawnWidth(), canvas.drawnHeight(),
                sheet == Sheet::kPicture && mayBeCompared(stage, drawn));
  CellInputs* const inputs = changed.inputs();
  if (inputs != nullptr) {
    surfaces.add(*inputs);
  }
  lists.begin(drawn, faces, view.eye, pixel);
  FaceShadows cast{.pairs = {}, .isDark = std::vector<bool>(faces.size())};
  const Vec3 towards = lighting.light ? Vec3(lighting.light->towards.normalized()) : Vec3(Vec3::UnitZ());
  if (shadows) {
    const ShadowLight light{.towards = towards, .spread = kCurveOfDisc * lighting.light->spread};
    LightPlane plane(light.towards, drawn);
    cast = shadowsOnFaces(plane, drawn, faces, view.eye, light.spread, pixel, &lists);
    shadowBatch->place(drawn, surfaces.surfaces(), light, view.eye, pixel, hidden, shadedCells, inputs);
  } else if (lighting.light) {
    std::transform(faces.begin(), faces.end(), cast.isDark.begin(),
                   [&](const DrawnFace& face) { return face.normal.dot(towards) <= 0; });
  }
  FaceNeighbors neighbors;
  if (occlusion) {
    const double least = leastOcclusion(world.bodies.size());
    if (world.bodies.size() > 1) {
      neighbors = neighborsOf(drawn, faces, leastOnBoxes(world.bodies.size()), &lists);
    }
    if (occlusionMap) {
      occlusionMap->place(drawn, surfaces.surfaces(), {.eye = view.eye, .pixelAngle = pixel, .least = least},
                          hidden, occludedCells, inputs);
    }
  }
  if (stage.picture.antialiasing == Antialiasing::kMultisampled) {
    // llvmpipe draws samples at the border of a scissor's rectangle twice.
    if (shadows) {
      shadedCells.markAll();
    }
    if (occlusionMap) {
      occludedCells.markAll();
    }
  }
  boxes.place({.boxes = drawn,
               .faces = faces,
               .shadows = cast,
               .neighbors = &neighbors,
               .texels = {},
               .towardsLight = towards,
               .eye = view.eye,
               .inputs = inputs,
               .reach = occlusionMap ? OcclusionMap::kReach : 0,
               .shrunk = occlusionMap ? kShrunk * pixel : 0});
  lists.keep(std::move(cast), std::move(neighbors));
  changed.find(shadedCells, occludedCells);
}

void Renderer::Parts::fill() {
  boxes.fill(changed.inputs(), changed.cells());
  if (shadows) {
    shadowBatch->fill(changed.inputs(), changed.cells());
  }
  if (occlusionMap) {
    occlusionMap->fill(changed.inputs(), changed.cells());
  }
}

void Renderer::Parts::drawOcclusion() {
  occlusionMap->beginFar();
  if (mayOverlap(stage)) {
    surfaces.drawDepth();
  }
  occlusionMap->drawFar();
  occlusionMap->beginNear();
  boxes.drawShrunk(kShrunk * pixel);
  if (mayOverlap(stage)) {
    surfaces.drawDepth();
  }
  occlusionMap->drawNear();
  ++figures.occlusionPasses;
}

// The part of the light that shadows keep off is gathered in the picture itself, which is black before, for
// every sample of a pixel, each of what the others leave; then it takes the colours in full light and in full
// shadow by that part.
void Renderer::Parts::gatherShadows() const {
  gl.Enable(GL_BLEND);
  gl.BlendFuncSeparate(GL_ONE_MINUS_DST_COLOR, GL_ONE, GL_ONE, GL_ONE);
  gl.DepthMask(GL_FALSE);
}

void Renderer::Parts::takeByShadows() const {
  gl.DepthMask(GL_TRUE);
  gl.BlendFuncSeparate(GL_ONE_MINUS_DST_COLOR, GL_SRC1_COLOR, GL_ONE, GL_ZERO);
}

void Renderer::Parts::drawShaded(std::size_t layer, Cast cast) {
  const bool castsOnSurfaces = layer + 1 == boxes.layers() && cast == Cast::kEverywhere;
  if (boxes.hasShaded()) {
    boxes.drawShadedDepth(layer);
  }
  if (castsOnSurfaces && mayOverlap(stage)) {
    surfaces.drawDepth();
  }
  gatherShadows();
  boxes.drawShadows(layer);
  if (castsOnSurfaces) {
    shadowBatch->draw();
  }
  takeByShadows();
  boxes.drawShaded(layer);
  gl.Disable(GL_BLEND);
  ++figures.shadowPasses;
}

void Renderer::Parts::drawBoxes(Cast cast) {
  for (std::size_t layer = 0; layer < boxes.layers(); ++layer) {
    boxes.drawUnshaded(layer);
    if (shadows) {
      drawShaded(layer, cast);
    }
    if (layer + 1 < boxes.layers()) {
      boxes.drawDepth(layer);
    }
  }
}

// Of the picture, where no surface fills them.
std::vector<PixelRectangle> Renderer::Parts::bareParts() const {
  const int width = canvas.drawnWidth();
  const int height = canvas.drawnHeight();
  return pixelsOf(changed.cells() & ~surfaces.filled(view, width, height), width, height);
}

void Renderer::Parts::drawStage(const PictureCells& shaded, const PictureCells& occluded) {
  surfaces.draw(shaded, occluded, changed.cells(), canvas.drawnWidth(), canvas.drawnHeight());
  background.draw(bareParts());
  surfaces.drawGlass();
}

// Surfaces that hide boxes, and all that is behind.
void Renderer::Parts::drawBlack() {
  surfaces.drawBlack();
  background.drawBlack(bareParts());
}

// All but the drawing of the picture itself.
void Renderer::Parts::prepare(const Shot& shot, Sheet sheet) {
  const std::size_t poses = shot.poses.size();
  const std::size_t bodies = world.bodies.size();
  if (bodies == 0 ? poses != 0 : poses == 0 || poses % bodies != 0) {
    throw InputError("drawing: found " + std::to_string(poses) + " poses, expected one for each of " +
                     std::to_string(bodies) + " boxes, or so many for each of several moments");
  }
  const Clock::time_point begun = Clock::now();
  context->makeCurrent();
  look(shot);
  place(shot.poses, shot.camera, sheet);
  changed.beginDrawing();
  if (changed.cells().any()) {
    fill();
    upload();
    if (occlusionMap) {
      drawOcclusion();
    }
  }
  figures.drawSeconds += secondsSince(begun);
}

template <class Draw>
Picture Renderer::Parts::drawn(const Draw& draw) {
  const Clock::time_point begun = Clock::now();
  if (changed.cells().any()) {
    canvas.begin();
    if (occlusionMap) {
      occlusionMap->bind();
    }
    draw();
    canvas.finish();
  }
  figures.drawSeconds += secondsSince(begun);
  const Clock::time_point drawnAt = Clock::now();
  Picture picture = canvas.read(pixelsOf(changed.cells(), canvas.drawnWidth(), canvas.drawnHeight()));
  figures.readSeconds += secondsSince(drawnAt);
  return picture;
}

Renderer::Renderer(const RunSetup& setup, const RenderOptions& options)
    : parts_(std::make_unique<Parts>(setup, options)) {}

Renderer::~Renderer() = default;

Picture Renderer::draw(std::span<const Pose> poses) {
  return draw({.poses = poses, .camera = parts_->camera});
}

Picture Renderer::draw(const Shot& shot) {
  Parts& parts = *parts_;
  parts.prepare(shot, Sheet::kPicture);
  Picture picture = parts.drawn([&] {
    parts.drawBoxes(Cast::kEverywhere);
    parts.drawStage(parts.shadedCells, parts.occludedCells);
  });
  parts.changed.endDrawing();
  refuseBlack(picture, parts.gl.description);
  ++parts.figures.frames;
  return picture;
}

MatteParts Renderer::drawMatte(const Shot& shot) {
  Parts& parts = *parts_;
  parts.prepare(shot, Sheet::kMatte);
  MatteParts matte;
  matte.boxes = parts.drawn([&] {
    parts.drawBoxes(Cast::kOnBoxes);
    parts.drawBlack();
  });
  matte.coverage = parts.drawn([&] {
    for (std::size_t layer = 0; layer < parts.boxes.layers(); ++layer) {
      parts.boxes.drawCoverage(layer);
    }
    parts.drawBlack();
  });
  matte.stage = parts.drawn([&] {
    if (parts.shadows) {
      if (mayOverlap(parts.stage)) {
        parts.surfaces.drawDepth();
      }
      parts.gatherShadows();
      parts.shadowBatch->draw();
      parts.takeByShadows();
    }
    parts.drawStage(parts.shadedCells, parts.occludedCells);
  });
  const PictureCells nowhere(parts.view);
  matte.emptyStage = parts.drawn([&] { parts.drawStage(nowhere, nowhere); });
  ++parts.figures.frames;
  return matte;
}

View Renderer::view(const Camera& camera) const { return viewOf(camera, parts_->extent, parts_->aspect); }

void Renderer::drawOver(Picture& picture, const OverlayShapes& shapes) {
  Parts& parts = *parts_;
  const Clock::time_point begun = Clock::now();
  parts.context->makeCurrent();
  const std::pair size(picture.width, picture.height);
  parts.overlays.try_emplace(size, parts.gl, parts.shaders, picture.width, picture.height)
      .first->second.drawOver(picture, shapes);
  ++parts.figures.overlayPasses;
  parts.figures.drawSeconds += secondsSince(begun);
}

const std::string& Renderer::rendererName() const { return parts_->gl.description; }

const DrawFigures& Renderer::figures() const { return parts_->figures; }

}  // namespace careen
