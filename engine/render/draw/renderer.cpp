#include <GL/glcorearb.h>

#include "render/draw/renderer.h"

#include <algorithm>
#include <chrono>
#include <limits>
#include <utility>

#include "core/error.h"
#include "core/system/resource.h"
#include "render/draw/box_batch.h"
#include "render/draw/contact_shade.h"
#include "render/draw/frame_block.h"
#include "render/draw/shadow_map.h"
#include "render/draw/surface_batch.h"
#include "render/gl/canvas.h"
#include "render/gl/gl.h"
#include "render/gl/shader.h"
#include "render/overlay/batch.h"
#include "view/camera.h"
#include "view/scene_extent.h"
#include "view/surfaces.h"

namespace careen {
namespace {

constexpr double kShadowReach = 4;  // [px] more than the radius of the shadow map filter

using Clock = std::chrono::steady_clock;

double secondsSince(Clock::time_point begun) {
  return std::chrono::duration<double>(Clock::now() - begun).count();
}

// Empty: the program's own shaders only.
std::filesystem::path shaderFolder(const RenderOptions& options) {
  if (!options.shaders.empty()) {
    return options.shaders;
  }
  const std::filesystem::path code = codeFolder();
  return code.empty() ? code : code / "shaders";
}

// The lighting shaders needed for this lighting.
std::vector<std::string> lightShaders(const Lighting& lighting, bool shadows) {
  if (!lighting.light) {
    return {"ambient.frag", "finish.frag"};
  }
  return {"light.frag", "finish.frag", shadows ? "shadow.frag" : "no_shadow.frag"};
}

// A room contains its boxes, so its shadow map is fixed; otherwise the map follows the boxes.
Extent castersOf(const Stage& stage, const Extent& extent, const std::vector<DrawnBox>& boxes) {
  if (stage.room) {
    return extent;
  }
  Extent casters{.min = boxes[0].pose.position, .max = boxes[0].pose.position};
  for (const DrawnBox& box : boxes) {
    const Vec3 reach = box.pose.worldFromBody.cwiseAbs() * box.halfExtents;
    casters.min = casters.min.cwiseMin(box.pose.position - reach);
    casters.max = casters.max.cwiseMax(box.pose.position + reach);
  }
  return casters;
}

// Bounds of the boxes in the shadow map; the shader need not sample it elsewhere.
Float4 shadowBounds(const Mat4& shadowFromWorld, const std::vector<DrawnBox>& boxes) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  Vec3 min = Vec3::Constant(kInfinity);
  Vec3 max = Vec3::Constant(-kInfinity);
  const Mat3 rotation = shadowFromWorld.topLeftCorner<3, 3>();
  const Vec3 shift = shadowFromWorld.topRightCorner<3, 1>();
  for (const DrawnBox& box : boxes) {
    const Vec3 centre = rotation * box.pose.position + shift;
    const Vec3 reach = (rotation * box.pose.worldFromBody).cwiseAbs() * box.halfExtents;
    min = min.cwiseMin(centre - reach);
    max = max.cwiseMax(centre + reach);
  }
  const double margin = kShadowReach / kShadowMapSize;
  const Vec3 least = min - Vec3::Constant(margin);
  const Vec3 greatest = max + Vec3::Constant(margin);
  return floats(Vec3(least.x(), least.y(), greatest.x()), greatest.y());
}

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

// Converts a matrix for world points to one for offsets from the eye.
Mat4 fromOffset(const Mat4& fromWorld, const Vec3& eye) {
  Mat4 result = fromWorld;
  result.topRightCorner<3, 1>() += fromWorld.topLeftCorner<3, 3>() * eye;
  return result;
}

}  // namespace

struct Renderer::Parts {
  Parts(const RunSetup& setup, const RenderOptions& options);
  void look(const Camera& from);
  void drawShadows(const std::vector<DrawnBox>& drawn);
  void drawPicture();
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
  bool shadows;
  std::unique_ptr<GlContext> context;
  Gl gl;
  Canvas canvas;
  std::filesystem::path shaders;
  std::optional<OverlayBatch> overlays;  // created for the first picture with overlays
  std::optional<ShadowMap> shadowMap;
  BoxBatch boxes;
  SurfaceBatch surfaces;
  std::optional<ContactShadeBatch> contactShades;
  unsigned backgroundArray;
  unsigned backgroundProgram;
  unsigned blockBuffer = 0;
  FrameBlock block;
  DrawFigures figures;
};

Renderer::Parts::Parts(const RunSetup& setup, const RenderOptions& options)
    : world(setup.world),
      stage(setup.stage),
      extent(extentOf(setup)),
      aspect(stage.picture.aspect()),
      camera(options.camera ? *options.camera : cameraOf(setup, aspect)),
      lighting(options.lighting ? *options.lighting : lightingOf(stage.picture.look, camera)),
      materials(options.materials ? *options.materials : materialsOf(stage.picture.look)),
      shadows(lighting.light && lighting.light->castsShadow && !world.bodies.empty()),
      context(openContext(options.context)),
      gl(*context),
      canvas(gl, stage.picture.width, stage.picture.height, stage.picture.antialiasing),
      shaders(shaderFolder(options)),
      boxes(gl, shaders, lightShaders(lighting, shadows)),
      surfaces(gl, shaders, lightShaders(lighting, shadows), surfacesOf(stage, extent, materials),
               tileSize(extent)),
      backgroundArray(makeVertexArray(gl)),
      backgroundProgram(linkProgram(gl, shaders, {"background.vert", "background.frag", "finish.frag"})) {
  if (shadows) {
    shadowMap.emplace(gl, shaders);
  }
  if (materials.contactShade > 0 && !surfaces.surfaces().empty()) {
    contactShades.emplace(gl, shaders);
  }
  gl.GenBuffers(1, &blockBuffer);
  gl.BindBufferBase(GL_UNIFORM_BUFFER, 0, blockBuffer);  // all programs use binding 0
  gl.Enable(GL_DEPTH_TEST);
  gl.DepthFunc(GL_LEQUAL);
  gl.Enable(GL_CULL_FACE);

  block.up = floats(camera.up.normalized());
  block.sky = floats(lighting.sky);
  block.ground = floats(lighting.ground);
  block.backgroundTop = floats(lighting.backgroundTop);
  block.backgroundBottom = floats(lighting.backgroundBottom);
  block.finish = floats(Vec3(materials.shoulder, canvas.wantsEdges() ? 1 : 0, materials.dither));
  block.boxLook =
      floats(Vec3(materials.boxRoughness, materials.marks ? 1 : 0, materials.ownColor), materials.edgeLine);
  block.material = floats(materials.boxColor);
  block.lines = floats(materials.lineColor, materials.ownJoints ? 1 : 0);
  block.surfaceLook = floats(Vec3(materials.tileRoughness, materials.wallRoughness, materials.tileContrast),
                             materials.joints);
  if (lighting.light) {
    block.towardsLight = floats(lighting.light->towards.normalized());
    block.lightColor = floats(lighting.light->color);
  }
  checkGl(gl, "preparing to draw");
}

void Renderer::Parts::upload() const {
  gl.BindBuffer(GL_UNIFORM_BUFFER, blockBuffer);
  gl.BufferData(GL_UNIFORM_BUFFER, sizeof(block), &block, GL_STREAM_DRAW);
}

void Renderer::Parts::look(const Camera& from) {
  view = viewOf(from, extent, aspect);
  block.clipFromOffset = floats(view.clipFromOffset);
  surfaces.place(view.eye);
}

void Renderer::Parts::drawShadows(const std::vector<DrawnBox>& drawn) {
  const Mat4 fromWorld = shadowFromWorld(castersOf(stage, extent, drawn), lighting.light->towards);
  block.shadowFromOffset = floats(fromOffset(fromWorld, view.eye));
  block.shadowBounds = shadowBounds(fromWorld, drawn);
  upload();
  shadowMap->begin();
  boxes.drawDepth();
  shadowMap->end();
  ++figures.shadowPasses;
}

void Renderer::Parts::drawPicture() {
  canvas.begin();
  boxes.draw();
  surfaces.draw();
  if (contactShades) {
    contactShades->draw();
  }
  gl.UseProgram(backgroundProgram);
  gl.BindVertexArray(backgroundArray);
  gl.DrawArrays(GL_TRIANGLES, 0, 3);
  canvas.finish();
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
  parts.look(shot.camera);
  std::vector<DrawnBox> drawn =
      drawnBoxes(parts.world, parts.stage, shot.poses, 0.004 * parts.extent.radius());
  widenSprings(drawn, parts.view.eye, pixelAngle(shot.camera, parts.stage.picture.height));
  parts.boxes.place(drawn, parts.view.eye);
  if (parts.contactShades) {
    parts.contactShades->place(contactShades(drawn, parts.surfaces.surfaces(), parts.materials.contactShade),
                               parts.view.eye);
  }
  if (parts.shadows) {
    parts.drawShadows(drawn);
  } else {
    parts.upload();
  }
  parts.drawPicture();
  parts.figures.drawSeconds += secondsSince(begun);

  const Clock::time_point drawnAt = Clock::now();
  Picture picture = parts.canvas.read();
  parts.figures.readSeconds += secondsSince(drawnAt);
  ++parts.figures.frames;
  return picture;
}

void Renderer::drawOver(Picture& picture, const Camera& camera, const OverlaySource& overlay) {
  const Clock::time_point begun = Clock::now();
  parts_->context->makeCurrent();
  parts_->drawOver(picture, overlay(viewOf(camera, parts_->extent, parts_->aspect)));
  parts_->figures.drawSeconds += secondsSince(begun);
}

const std::string& Renderer::rendererName() const { return parts_->gl.description; }

const DrawFigures& Renderer::figures() const { return parts_->figures; }

}  // namespace careen
