#include "view/camera.h"

#include <algorithm>

#include "core/error.h"
#include "stage/turn.h"

namespace careen {
Vec4 View::clipFromWorld(const Vec3& point) const {
  const Vec3 offset = point - eye;
  return clipFromOffset * Vec4(offset.x(), offset.y(), offset.z(), 1);
}

Vec3 View::pixelFromWorld(const Vec3& point, int width, int height) const {
  const Vec4 clip = clipFromWorld(point);
  return {0.5 * width * (1 + clip.x() / clip.w()), 0.5 * height * (1 - clip.y() / clip.w()),
          clip.z() / clip.w()};
}

double slopeOfView(double fovDegrees) {
  const Turn half = turnFrom(0.5 * fovDegrees);
  return half.sine / half.cosine;
}

Mat3 lookAt(const Vec3& eye, const Vec3& target, const Vec3& up) {
  const Vec3 back = eye - target;
  Vec3 right = up.cross(back);
  if (!(back.norm() > 0)) {
    throw InputError("camera: eye and target are the same point");
  }
  if (!(right.norm() > 1e-9 * up.norm() * back.norm())) {
    throw InputError("camera: it looks along its up");
  }
  right.normalize();
  Mat3 worldFromCamera;
  worldFromCamera << right, back.cross(right).normalized(), back.normalized();
  return worldFromCamera;
}

Mat4 perspective(double fovDegrees, double aspect, double near, double far) {
  const double scale = 1 / slopeOfView(fovDegrees);
  Mat4 clipFromCamera = Mat4::Zero();
  clipFromCamera(0, 0) = scale / aspect;
  clipFromCamera(1, 1) = scale;
  clipFromCamera(2, 2) = (near + far) / (near - far);
  clipFromCamera(2, 3) = 2 * near * far / (near - far);
  clipFromCamera(3, 2) = -1;
  return clipFromCamera;
}

Camera cameraThatSees(const Extent& extent, double aspect) {
  constexpr double kMargin = 1.04;
  Camera camera;
  camera.target = extent.centre();
  const Mat3 worldFromCamera = lookAt(kDefaultDirection, Vec3::Zero(), camera.up);
  const double tangent = slopeOfView(camera.fovDegrees);
  double distance = 0;
  for (int index = 0; index < 8; ++index) {
    // A corner at (x, y, z) is in view from a distance of z + |y| / tan(fov/2) on; x likewise.
    const Vec3 corner = worldFromCamera.transpose() * (extent.corner(index) - camera.target);
    distance = std::max(distance, corner.z() + kMargin * std::max(std::abs(corner.x()) / (tangent * aspect),
                                                                  std::abs(corner.y()) / tangent));
  }
  camera.eye = camera.target + distance * kDefaultDirection;
  return camera;
}

Camera cameraOf(const RunSetup& setup, double aspect) {
  return setup.stage.camera ? *setup.stage.camera : cameraThatSees(extentOf(setup), aspect);
}

double pixelAngle(const Camera& camera, int height) { return 2 * slopeOfView(camera.fovDegrees) / height; }

View viewOf(const Camera& camera, const Extent& extent, double aspect) {
  View view;
  view.worldFromCamera = lookAt(camera.eye, camera.target, camera.up);
  view.eye = camera.eye + view.worldFromCamera.leftCols<2>() * camera.beside;
  // Near and far planes for a scene of this size, with a depth resolution of 1e-4 m in 10 m. The near plane
  // is closer for a near target in a large room.
  const double reach = (camera.eye - extent.centre()).norm() + extent.radius();
  const double near = std::min(0.004 * reach, 0.1 * (camera.eye - camera.target).norm());
  Mat4 cameraFromOffset = Mat4::Identity();
  cameraFromOffset.topLeftCorner<3, 3>() = view.worldFromCamera.transpose();
  view.clipFromOffset = perspective(camera.fovDegrees, aspect, near, 50 * reach) * cameraFromOffset;
  if (!camera.beside.isZero(0)) {
    Mat4 sheared = Mat4::Identity();
    sheared.block<2, 1>(0, 2) = -camera.beside / camera.sharpAt;
    view.clipFromOffset =
        perspective(camera.fovDegrees, aspect, near, 50 * reach) * sheared * cameraFromOffset;
  }
  return view;
}

}  // namespace careen
