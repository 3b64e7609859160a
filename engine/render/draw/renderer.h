#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>

#include "core/math/pose.h"
#include "image/picture.h"
#include "render/gl/rendering_backend.h"
#include "render/look/lighting.h"
#include "render/look/materials.h"
#include "render/overlay/shapes.h"
#include "render/view/camera.h"
#include "stage/camera.h"
#include "stage/run_setup.h"

namespace careen {

struct RenderOptions {
  ContextOptions context;
  std::optional<Lighting> lighting;    ///< absent: that of the picture's look
  std::optional<Materials> materials;  ///< absent: those of the picture's look
  std::optional<Camera> camera;        ///< by which the light is set up; absent: cameraOf(setup)
  std::filesystem::path shaders;       ///< folder; empty: the program's own
};

/// What drawing took so far.
struct DrawFigures {
  int frames = 0;
  int shadowPasses = 0;
  int overlayPasses = 0;
  double drawSeconds = 0;  ///< [s] by the clock, until the last pixel is done
  double readSeconds = 0;  ///< [s] reading back and flipping
};

/// Shapes to draw over a picture that is seen so.
using OverlaySource = std::function<OverlayShapes(const View&)>;

/// A picture to be drawn.
struct Shot {
  std::span<const Pose> poses;  ///< one for each body of the world, in its order; or so for several moments,
                                ///< one after the other, all of which are drawn
  Camera camera;
};

/// Draws a run's boxes where they are told to be, on its stage, as stage.picture says. The same shot gives
/// the same bytes, whatever was drawn before.
class Renderer {
 public:
  /// InputError for a size beyond what GL can do, MachineError where there is no GL to do it, or it has fewer
  /// samples a pixel than asked for.
  explicit Renderer(const RunSetup& setup, const RenderOptions& options = {});
  ~Renderer();
  Renderer(const Renderer&) = delete;
  Renderer& operator=(const Renderer&) = delete;
  Renderer(Renderer&&) = delete;
  Renderer& operator=(Renderer&&) = delete;

  /// MachineError if the frame comes out blank.
  Picture draw(const Shot& shot);
  /// Seen by the camera that the light is set up by.
  Picture draw(std::span<const Pose> poses);
  /// What `overlay` gives over a picture of this size, as seen by the camera.
  void drawOver(Picture& picture, const Camera& camera, const OverlaySource& overlay);

  /// GL's renderer and version, such as "llvmpipe (…), OpenGL … Mesa 22.3.6, libOSMesa.so.8".
  const std::string& rendererName() const;
  const DrawFigures& figures() const;

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace careen
