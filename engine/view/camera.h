#pragma once

#include "core/math/linear_algebra.h"
#include "stage/camera.h"
#include "stage/run_setup.h"
#include "view/scene_extent.h"

namespace careen {

/// Projection of the world onto the picture. Positions are made relative to the eye before conversion to
/// single precision: "offset" is a world point minus the eye, along the world's axes.
struct View {
  Vec3 eye = Vec3::Zero();                  ///< [m]
  Mat3 worldFromCamera = Mat3::Identity();  ///< camera looks along −z; x right, y up in the picture
  Mat4 clipFromOffset = Mat4::Identity();   ///< OpenGL's clip space

  /// In OpenGL's clip space.
  Vec4 clipFromWorld(const Vec3& point) const;
  /// Pixel coordinates of a world point [px], from the picture's upper left corner; z is depth, −1 … 1.
  Vec3 pixelFromWorld(const Vec3& point, int width, int height) const;
};

/// Tangent of half an angle given in degrees, 0 … 180: the slope of the edge of a picture with this field of
/// view. The same bits everywhere.
double slopeOfView(double fovDegrees);

/// Rotation of a camera that looks from eye to target with `up` upward. InputError if it is undefined.
Mat3 lookAt(const Vec3& eye, const Vec3& target, const Vec3& up);

/// OpenGL perspective matrix; `fovDegrees` is the vertical angle, `aspect` width over height, near < far [m].
Mat4 perspective(double fovDegrees, double aspect, double near, double far);

/// Direction of the default camera as seen from the scene: in front, to the right and above.
inline const Vec3 kDefaultDirection = Vec3(0.42, -1, 0.42).normalized();

/// A camera in that direction that sees all of `extent`.
Camera cameraThatSees(const Extent& extent, double aspect);

/// The stage's camera at its start, or one that sees the extent of the scene, independent of the run; for the
/// camera during the run see CameraPath.
Camera cameraOf(const RunSetup& setup, double aspect);

/// [rad] Angle covered by a pixel in the middle of a picture; `height` of the picture [px].
double pixelAngle(const Camera& camera, int height);

View viewOf(const Camera& camera, const Extent& extent, double aspect);

}  // namespace careen
