#include <GL/glcorearb.h>

#include "render/draw/renderer.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <utility>

#include "core/error.h"
#include "core/system/clock.h"
#include "core/system/resource.h"
#include "render/draw/box_batch.h"
#include "render/draw/cell_inputs.h"
#include "render/draw/frame_block.h"
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

// [1] Width of the curve of shadow.frag that has the variance of a disc, of that disc: sqrt(5) / 2.
constexpr double kCurveOfDisc = 1.118033988749895;

// Floors and walls are behind by this part of what their depth changes in a pixel, and by so many steps of
// its precision: a box that has sunk into one by less hides it, and what it has drawn is not taken for
// shadow.
constexpr float kSunkSlopes = 0.5F;
constexpr float kSunkSteps = 8;

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

// [1] The more boxes there are, the more they hide each other, and the less each has to be drawn far away.
double leastOcclusion(std::size_t boxes) {
  return std::clamp(0.004 * std::sqrt(static_cast<double>(boxes) / 100), 0.004, 0.022);
}

// [1] Likewise, of what keeps light from a box.
double leastOnBoxes(std::size_t boxes) { return std::min(leastOcclusion(boxes), 0.008); }

// [px] Thinner springs would be drawn with gaps.
constexpr double kThinnest = 1.5;
void widenSprings(std::vector<DrawnBox>& boxes, const Vec3& eye, double pixelAngle) {
  for (DrawnBox& box : boxes) {
    if (!box.marked) {
      const double least = 0.5 * kThinnest * pixelAngle * (box.pose.position - eye).norm();
      box.halfExtents.y() = std::max(box.halfExtents.y(), least);
      box.halfExtents.z() = std::max(box.halfExtents.z(), least);
    }
  }
}

}  // namespace

struct Renderer::Parts {
  Parts(const RunSetup& setup, const RenderOptions& options);
  void look(const Shot& shot);
  void place(std::span<const Pose> poses, const Camera& from);
  bool mayKeepCells(std::span<const DrawnBox> drawn) const;
  void findCells();
  void fill();
  void drawOcclusion();
  void drawShaded(std::size_t layer);
  void drawPicture();
  std::vector<PixelRectangle> pixelsOf(const PictureCells::Set& of) const;
  void drawOver(Picture& picture, const OverlayShapes& shapes);
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
  std::optional<OverlayBatch> overlays;  // created for the first picture with overlays
  BoxBatch boxes;
  SurfaceBatch surfaces;
  std::optional<ShadowBatch> shadowBatch;
  std::optional<OcclusionMap> occlusionMap;
  unsigned backgroundArray;
  unsigned backgroundProgram;
  unsigned blockBuffer = 0;
  FrameBlock block;
  FrameBlock blockBefore;  // of the shot before
  Vec3 eyeBefore = Vec3::Zero();
  std::optional<CellInputs> inputs;  // if all but boxes may be as in the shot before
  std::optional<CellInputs> kept;    // of the picture that the canvas has, if known
  PictureCells::Set cells;           // that differ from it, and are drawn
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
      backgroundArray(makeVertexArray(gl)),
      backgroundProgram(
          linkProgram(gl, shaders, {"background.vert", "background.frag", "write_lit.frag", "finish.frag"})) {
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

  block.sky = floats(lighting.sky);
  block.ground = floats(lighting.ground);
  block.backgroundTop = floats(lighting.backgroundTop);
  block.backgroundBottom = floats(lighting.backgroundBottom);
  block.finish = floats(Vec3(materials.shoulder, canvas.wantsEdges() ? 1 : 0, materials.dither),
                        leastOnBoxes(world.bodies.size()));
  block.boxLook =
      floats(Vec3(materials.boxRoughness, materials.marks ? 1 : 0, materials.ownColor), materials.edgeLine);
  block.material = floats(materials.boxColor);
  block.lines = floats(materials.lineColor, materials.ownJoints ? 1 : 0);
  block.surfaceLook = floats(Vec3(materials.tileRoughness, materials.wallRoughness, materials.tileContrast),
                             materials.joints);
  block.occlusion = floats(Vec3(stage.picture.light.has(LightPart::kOcclusion) ? materials.corners : 0,
                                leastOcclusion(world.bodies.size()), 1.0 / canvas.drawnWidth()),
                           1.0 / canvas.drawnHeight());
  if (lighting.light) {
    block.towardsLight = floats(lighting.light->towards.normalized(), kCurveOfDisc * lighting.light->spread);
    block.lightColor = floats(lighting.light->color);
  }
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

void Renderer::Parts::place(std::span<const Pose> poses, const Camera& from) {
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
  double returned = 0;  // the mean of all boxes
  if (occlusion && stage.picture.light.has(LightPart::kBounce)) {
    for (DrawnBox& box : drawn) {
      const Vec3 albedo = (1 - materials.ownColor) * materials.boxColor + materials.ownColor * box.color;
      box.returned = materials.bounce * albedo;
      returned += kReturnedToBoxes * box.returned.mean() / static_cast<double>(drawn.size());
    }
  }
  block.up = floats(camera.up.normalized(), returned);
  inputs.reset();
  if (mayKeepCells(drawn)) {
    inputs.emplace(view, canvas.drawnWidth(), canvas.drawnHeight());
    surfaces.add(*inputs);
  }
  CellInputs* const into = inputs ? &*inputs : nullptr;
  FaceShadows cast{.pairs = {}, .isDark = std::vector<bool>(faces.size())};
  const Vec3 towards = lighting.light ? Vec3(lighting.light->towards.normalized()) : Vec3(Vec3::UnitZ());
  if (shadows) {
    const ShadowLight light{.towards = towards, .spread = kCurveOfDisc * lighting.light->spread};
    LightPlane plane(light.towards, drawn);
    cast = shadowsOnFaces(plane, drawn, faces, view.eye, light.spread, pixel);
    shadowBatch->place(drawn, surfaces.surfaces(), light, view.eye, pixel, hidden, shadedCells, into);
  } else if (lighting.light) {
    std::transform(faces.begin(), faces.end(), cast.isDark.begin(),
                   [&](const DrawnFace& face) { return face.normal.dot(towards) <= 0; });
  }
  FaceNeighbors neighbors;
  if (occlusion) {
    const double least = leastOcclusion(world.bodies.size());
    if (world.bodies.size() > 1) {
      neighbors = neighborsOf(drawn, faces, leastOnBoxes(world.bodies.size()));
    }
    if (occlusionMap) {
      occlusionMap->place(drawn, surfaces.surfaces(), {.eye = view.eye, .pixelAngle = pixel, .least = least},
                          hidden, occludedCells, into);
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
               .inputs = into,
               .reach = occlusionMap ? OcclusionMap::kReach : 0,
               .shrunk = occlusionMap ? kShrunk * pixel : 0});
  findCells();
}

// Not worth it while the camera moves. Several moments are drawn in layers; llvmpipe draws samples at the
// border of a scissor's rectangle twice; and a mesh is not where its box is.
bool Renderer::Parts::mayKeepCells(std::span<const DrawnBox> drawn) const {
  static_assert(sizeof(FrameBlock) % sizeof(float) == 0);
  return std::memcmp(&block, &blockBefore, sizeof(block)) == 0 && view.eye == eyeBefore &&
         stage.parts.empty() && stage.picture.antialiasing != Antialiasing::kMultisampled &&
         (drawn.empty() || drawn.front().moment == 0);
}

// The programs that draw surfaces in a cell belong to what it is drawn from, too.
void Renderer::Parts::findCells() {
  cells.set();
  if (inputs) {
    for (int row = 0; row < PictureCells::kRows; ++row) {
      for (int column = 0; column < PictureCells::kColumns; ++column) {
        inputs->addTo(
            column, row,
            (shadedCells.isMarked(column, row) ? 1 : 0) + (occludedCells.isMarked(column, row) ? 2 : 0));
      }
    }
    if (kept) {
      cells = inputs->changedSince(*kept);
    }
  }
  blockBefore = block;
  eyeBefore = view.eye;
}

void Renderer::Parts::fill() {
  const CellInputs* const from = inputs ? &*inputs : nullptr;
  boxes.fill(from, cells);
  if (shadows) {
    shadowBatch->fill(from, cells);
  }
  if (occlusionMap) {
    occlusionMap->fill(from, cells);
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
void Renderer::Parts::drawShaded(std::size_t layer) {
  const bool isLast = layer + 1 == boxes.layers();
  if (boxes.hasShaded()) {
    boxes.drawShadedDepth(layer);
  }
  if (isLast && mayOverlap(stage)) {
    surfaces.drawDepth();
  }
  gl.Enable(GL_BLEND);
  gl.BlendFuncSeparate(GL_ONE_MINUS_DST_COLOR, GL_ONE, GL_ONE, GL_ONE);
  gl.DepthMask(GL_FALSE);
  boxes.drawShadows(layer);
  if (isLast) {
    gl.Disable(GL_CULL_FACE);
    gl.Enable(GL_POLYGON_OFFSET_FILL);
    gl.PolygonOffset(kSunkSlopes, kSunkSteps);
    shadowBatch->draw();
    gl.Disable(GL_POLYGON_OFFSET_FILL);
    gl.Enable(GL_CULL_FACE);
  }
  gl.DepthMask(GL_TRUE);
  gl.BlendFuncSeparate(GL_ONE_MINUS_DST_COLOR, GL_SRC1_COLOR, GL_ONE, GL_ZERO);
  boxes.drawShaded(layer);
  gl.Disable(GL_BLEND);
  ++figures.shadowPasses;
}

void Renderer::Parts::drawPicture() {
  canvas.begin();
  if (occlusionMap) {
    occlusionMap->bind();
  }
  for (std::size_t layer = 0; layer < boxes.layers(); ++layer) {
    boxes.drawUnshaded(layer);
    if (shadows) {
      drawShaded(layer);
    }
    if (layer + 1 < boxes.layers()) {
      boxes.drawDepth(layer);
    }
  }
  gl.Enable(GL_POLYGON_OFFSET_FILL);
  gl.PolygonOffset(kSunkSlopes, kSunkSteps);
  surfaces.draw(shadedCells, occludedCells, cells, canvas.drawnWidth(), canvas.drawnHeight());
  gl.Disable(GL_POLYGON_OFFSET_FILL);
  gl.UseProgram(backgroundProgram);
  gl.BindVertexArray(backgroundArray);
  gl.Enable(GL_SCISSOR_TEST);
  const PictureCells::Set filled = surfaces.filled(view, canvas.drawnWidth(), canvas.drawnHeight());
  for (const PixelRectangle& at : pixelsOf(cells & ~filled)) {
    gl.Scissor(at.left, at.bottom, at.right - at.left, at.top - at.bottom);
    gl.DrawArrays(GL_TRIANGLES, 0, 3);
  }
  gl.Disable(GL_SCISSOR_TEST);
  surfaces.drawGlass();
  canvas.finish();
}

std::vector<PixelRectangle> Renderer::Parts::pixelsOf(const PictureCells::Set& of) const {
  std::vector<PixelRectangle> parts;
  forRectangles([&](int column, int row) { return of[PictureCells::indexOf(column, row)] ? 1 : 0; },
                [&](int isIn, int column, int endColumn, int row, int endRow) {
                  if (isIn != 0) {
                    parts.push_back(PictureCells::pixelsOf(column, endColumn, row, endRow,
                                                           canvas.drawnWidth(), canvas.drawnHeight()));
                  }
                });
  return parts;
}

void Renderer::Parts::drawOver(Picture& picture, const OverlayShapes& shapes) {
  if (!overlays) {
    overlays.emplace(gl, shaders, picture.width, picture.height);
  }
  overlays->drawOver(picture, shapes);
  ++figures.overlayPasses;
}

Renderer::Renderer(const RunSetup& setup, const RenderOptions& options)
    : parts_(std::make_unique<Parts>(setup, options)) {}

Renderer::~Renderer() = default;

Picture Renderer::draw(std::span<const Pose> poses) {
  return draw({.poses = poses, .camera = parts_->camera});
}

Picture Renderer::draw(const Shot& shot) {
  Parts& parts = *parts_;
  const std::size_t poses = shot.poses.size();
  const std::size_t boxes = parts.world.bodies.size();
  if (boxes == 0 ? poses != 0 : poses == 0 || poses % boxes != 0) {
    throw InputError("drawing: found " + std::to_string(poses) + " poses, expected one for each of " +
                     std::to_string(boxes) + " boxes, or so many for each of several moments");
  }
  const Clock::time_point begun = Clock::now();
  parts.context->makeCurrent();
  parts.look(shot);
  parts.place(shot.poses, shot.camera);
  parts.kept.reset();
  if (parts.cells.any()) {
    parts.fill();
    parts.upload();
    if (parts.occlusionMap) {
      parts.drawOcclusion();
    }
    parts.drawPicture();
  }
  parts.figures.drawSeconds += secondsSince(begun);

  const Clock::time_point drawnAt = Clock::now();
  Picture picture = parts.canvas.read(parts.pixelsOf(parts.cells));
  parts.kept = std::move(parts.inputs);
  parts.figures.readSeconds += secondsSince(drawnAt);
  ++parts.figures.frames;
  return picture;
}

View Renderer::view(const Camera& camera) const { return viewOf(camera, parts_->extent, parts_->aspect); }

void Renderer::drawOver(Picture& picture, const OverlayShapes& shapes) {
  const Clock::time_point begun = Clock::now();
  parts_->context->makeCurrent();
  parts_->drawOver(picture, shapes);
  parts_->figures.drawSeconds += secondsSince(begun);
}

const std::string& Renderer::rendererName() const { return parts_->gl.description; }

const DrawFigures& Renderer::figures() const { return parts_->figures; }

}  // namespace careen
