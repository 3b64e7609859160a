#include <GL/glcorearb.h>

#include "render/draw/shadow_map.h"

#include <algorithm>
#include <array>

#include "core/error.h"
#include "render/gl/gl.h"
#include "render/gl/shader.h"
#include "view/camera.h"

namespace careen {
namespace {

Mat3 worldFromLight(const Vec3& towards) {
  const Vec3 up = std::abs(towards.normalized().z()) < 0.99 ? Vec3::UnitZ() : Vec3::UnitY();
  return lookAt(towards, Vec3::Zero(), up);
}

}  // namespace

Mat4 shadowFromWorld(const Extent& casters, const Vec3& towards) {
  const Mat3 lightFromWorld = worldFromLight(towards).transpose();
  Vec3 min = lightFromWorld * casters.corner(0);
  Vec3 max = min;
  for (int index = 1; index < 8; ++index) {
    const Vec3 corner = lightFromWorld * casters.corner(index);
    min = min.cwiseMin(corner);
    max = max.cwiseMax(corner);
  }
  // Depth increases away from the light, along −z; a margin keeps casters off the edge.
  const Vec3 margin = 0.01 * (max - min) + Vec3::Constant(1e-6 * casters.radius());
  const Vec3 scale = (max - min + 2 * margin).cwiseInverse();
  Mat4 shadow = Mat4::Identity();
  for (int axis = 0; axis < 3; ++axis) {
    const double sign = axis == 2 ? -1 : 1;
    const double start = axis == 2 ? -(max + margin)[axis] : (min - margin)[axis];
    shadow.block<1, 3>(axis, 0) = sign * scale[axis] * lightFromWorld.row(axis);
    shadow(axis, 3) = -start * scale[axis];
  }
  return shadow;
}

ShadowMap::ShadowMap(const Gl& gl, const std::filesystem::path& shaders)
    : gl_(gl), program_(linkProgram(gl, shaders, {"caster.vert", "caster.frag"})) {
  gl.GenTextures(1, &texture_);
  gl.BindTexture(GL_TEXTURE_2D, texture_);
  gl.TexImage2D(GL_TEXTURE_2D, 0, GL_DEPTH_COMPONENT32F, kShadowMapSize, kShadowMapSize, 0,
                GL_DEPTH_COMPONENT, GL_FLOAT, nullptr);
  gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
  gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
  gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_COMPARE_MODE, GL_COMPARE_REF_TO_TEXTURE);
  gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_COMPARE_FUNC, GL_LEQUAL);
  // Outside the map there is no shadow.
  gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_BORDER);
  gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_BORDER);
  const std::array<float, 4> farthest = {1, 1, 1, 1};
  gl.TexParameterfv(GL_TEXTURE_2D, GL_TEXTURE_BORDER_COLOR, farthest.data());

  gl.GenFramebuffers(1, &framebuffer_);
  gl.BindFramebuffer(GL_FRAMEBUFFER, framebuffer_);
  gl.FramebufferTexture2D(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_TEXTURE_2D, texture_, 0);
  gl.DrawBuffer(GL_NONE);
  gl.ReadBuffer(GL_NONE);
  checkGl(gl, "the shadow map");
  if (gl.CheckFramebufferStatus(GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE) {
    throw MachineError("GL makes no shadow map (" + gl.description + ")");
  }
}

void ShadowMap::begin() const {
  gl_.BindFramebuffer(GL_FRAMEBUFFER, framebuffer_);
  gl_.Viewport(0, 0, kShadowMapSize, kShadowMapSize);
  gl_.UseProgram(program_);
  gl_.Clear(GL_DEPTH_BUFFER_BIT);
  gl_.CullFace(GL_FRONT);
  gl_.Enable(GL_POLYGON_OFFSET_FILL);
  gl_.PolygonOffset(1, 1);
}

void ShadowMap::end() const {
  gl_.Disable(GL_POLYGON_OFFSET_FILL);
  gl_.CullFace(GL_BACK);
}

}  // namespace careen
