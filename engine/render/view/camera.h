#pragma once

#include "core/math/linear_algebra.h"
#include "render/view/scene_extent.h"
#include "stage/camera.h"
#include "stage/run_setup.h"

namespace careen {

/// How the world comes onto the picture. Positions are taken relative to the eye before they lose digits to
/// single precision: "offset" is a point of the world less the eye, along the world's axes.
struct View {
  Vec3 eye = Vec3::Zero();                  ///< [m]
  Mat3 worldFromCamera = Mat3::Identity();  ///< camera looks along its −z; x right, y up on the picture
  Mat4 clipFromOffset = Mat4::Identity();   ///< OpenGL's clip space

  /// In OpenGL's clip space.
  Vec4 clipFromWorld(const Vec3& point) const;
  /// Where a point of the world appears [px], from the picture's upper left corner; z is depth, −1 … 1.
  Vec3 pixelFromWorld(const Vec3& point, int width, int height) const;
};

/// Rotation of a camera that looks from eye to target with `up` upward. InputError if they leave it
/// undefined.
Mat3 lookAt(const Vec3& eye, const Vec3& target, const Vec3& up);

/// Perspective of OpenGL; `fov` [rad] is the vertical angle, `aspect` width over height, near < far [m].
Mat4 perspective(double fov, double aspect, double near, double far);

/// Where a camera that nobody placed stands, as seen from what it films: in front, to the right and above.
inline const Vec3 kDefaultDirection = Vec3(0.42, -1, 0.42).normalized();

/// A camera that sees the whole of `extent`, from there.
Camera cameraThatSees(const Extent& extent, double aspect);

/// The stage's camera where it starts, or one that sees where the run takes place, whatever happens in it;
/// see CameraPath for that.
Camera cameraOf(const RunSetup& setup, double aspect);

/// [rad] that a pixel in the middle of a picture so many pixels high covers.
double pixelAngle(const Camera& camera, int height);

View viewOf(const Camera& camera, const Extent& extent, double aspect);

}  // namespace careen
