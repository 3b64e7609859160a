#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "core/math/pose.h"
#include "render/gl/vertex_array.h"
#include "stage/run_setup.h"

namespace careen {

struct Gl;

/// One box to draw. Boxes of a run have marks on their faces; springs are boxes without marks.
struct DrawnBox {
  Pose pose;
  Vec3 halfExtents = Vec3::Zero();  ///< [m]
  Vec3 color = Vec3::Ones();        ///< linear
  bool marked = true;
};

/// The run's boxes, then its springs as thin rods of thickness `springThickness` [m] from end to end. With
/// poses of several consecutive moments: the same for each, without boxes that have not moved since the
/// previous one.
std::vector<DrawnBox> drawnBoxes(const World& world, const Stage& stage, std::span<const Pose> poses,
                                 double springThickness);

/// All boxes of a frame, drawn at once.
class BoxBatch {
 public:
  BoxBatch(const Gl& gl, const std::filesystem::path& shaders, const std::vector<std::string>& light);

  /// Sorts front to back, so that hidden pixels are not shaded.
  void place(std::vector<DrawnBox> boxes, const Vec3& eye);
  void draw() const;
  /// Draws with the program in use, for the shadow map.
  void drawDepth() const;

 private:
  const Gl& gl_;
  unsigned array_;
  VertexBuffer corners_;
  VertexBuffer instances_;
  unsigned program_ = 0;
};

}  // namespace careen
