#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/math/pose.h"
#include "image/matte.h"
#include "image/picture.h"
#include "render/gl/rendering_backend.h"
#include "render/look/lighting.h"
#include "render/overlay/shapes.h"
#include "stage/camera.h"
#include "stage/run_setup.h"
#include "view/camera.h"
#include "view/materials.h"
#include "view/wall_reach.h"

namespace careen {

struct RenderOptions {
  ContextOptions context;
  std::optional<Lighting> lighting;    ///< absent: from the picture's look
  std::optional<Materials> materials;  ///< absent: from the picture's look
  std::optional<Camera> camera;        ///< that the light is placed relative to; absent: cameraOf(setup)
  std::vector<WallReach> reaches;      ///< how far boxes go along walls; absent: not far
  std::filesystem::path shaders;       ///< folder; empty: $CAREEN_DATA, else built in
};

/// Timings and counts of drawing so far.
struct DrawFigures {
  int frames = 0;
  int shadowPasses = 0;
  int occlusionPasses = 0;
  int overlayPasses = 0;
  double drawSeconds = 0;  ///< [s] wall time until drawing is complete
  double readSeconds = 0;  ///< [s] reading back and flipping
};

/// A picture to be drawn.
struct Shot {
  std::span<const Pose> poses;  ///< one for each body of the world, in its order; or the same for several
                                ///< moments, one after the other, all drawn
  Camera camera;
  double time = 0;  ///< [s] of the run: where walls are that move by themselves
};

/// Draws a run's boxes at given poses on its stage, with the settings of stage.picture. The same shot gives
/// the same bytes, whatever was drawn before.
class Renderer {
 public:
  /// InputError if GL does not support the size, MachineError if there is no GL or it supports fewer samples
  /// a pixel than requested.
  explicit Renderer(const RunSetup& setup, const RenderOptions& options = {});
  ~Renderer();
  Renderer(const Renderer&) = delete;
  Renderer& operator=(const Renderer&) = delete;
  Renderer(Renderer&&) = delete;
  Renderer& operator=(Renderer&&) = delete;

  /// MachineError if the frame is black or has blank pixels.
  Picture draw(const Shot& shot);
  /// What of the shot goes over other pictures: draws four pictures.
  MatteParts drawMatte(const Shot& shot);
  /// Draws with the camera that the light is placed relative to.
  Picture draw(std::span<const Pose> poses);
  /// What the pictures show from there.
  View view(const Camera& camera) const;
  /// Draws these shapes over the picture, of whatever size.
  void drawOver(Picture& picture, const OverlayShapes& shapes);

  /// GL's renderer and version, such as "llvmpipe (…), OpenGL … Mesa 22.3.6, libOSMesa.so.8".
  const std::string& rendererName() const;
  const DrawFigures& figures() const;

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace careen
