#include "exchange/mjcf_mass.h"

#include <string>
#include <vector>

#include "core/brief.h"
#include "physics/world/given_inertia.h"
#include "scene/json_shape.h"

namespace careen {
namespace {

// In the box's axes, from what <inertial> says in its own, or, if full, in the body's.
Mat3 inertiaOf(const MjcfDocument& document, const MjcfGeom& box, const XmlElement& inertial) {
  const std::vector<double> diagonal = document.numbers(inertial, "diaginertia", 3, 3);
  const std::vector<double> full = document.numbers(inertial, "fullinertia", 6, 6);
  if (diagonal.empty() == full.empty()) {
    document.fail(inertial, full.empty() ? "no inertia" : "two inertias",
                  "diaginertia or fullinertia [kg m²]");
  }
  const Quat bodyFromInertial = document.orientation(inertial, Quat::Identity());
  Mat3 inertia = Mat3::Zero();
  Quat boxFromIt = box.turn.conjugate();
  if (full.empty()) {
    inertia.diagonal() = Vec3(diagonal[0], diagonal[1], diagonal[2]);
    boxFromIt = boxFromIt * bodyFromInertial;
  } else {
    for (const std::string_view word : MjcfDocument::kOrientations) {
      if (inertial.find(word) != nullptr) {
        document.fail(inertial, *inertial.find(word), "none with fullinertia");
      }
    }
    inertia << full[0], full[3], full[4], full[3], full[1], full[5], full[4], full[5], full[2];
  }
  const Mat3 turn = boxFromIt.normalized().toRotationMatrix();
  Mat3 found = turn * inertia * turn.transpose();
  found = (0.5 * (found + found.transpose())).eval();  // the product is symmetric but for rounding
  const Mat3 along = found.diagonal().asDiagonal();
  if ((found - along).cwiseAbs().maxCoeff() <= kMjcfCentered * found.trace()) {
    found = along;
  }
  if (const std::string why = whyNoTensor(found); !why.empty()) {
    document.fail(
        inertial,
        "moments " + brief(found(0, 0)) + ", " + brief(found(1, 1)) + ", " + brief(found(2, 2)) + " kg m²",
        why);
  }
  return found;
}

}  // namespace

MjcfMass massOf(MjcfDocument& document, const MjcfGeom& box, const XmlElement* inertial) {
  const Vec3 size(box.size[0], box.size[1], box.size[2]);
  const std::string& fromGeom = document.inertiaFromGeom();
  MjcfMass result;
  if (inertial != nullptr && fromGeom != "true") {
    document.check(*inertial, {"pos", "mass", "diaginertia", "fullinertia", "quat", "axisangle", "euler",
                               "xyaxes", "zaxis"});
    const Vec3 center = document.vector(*inertial, "pos", Vec3::Zero());
    if (inertial->find("pos") == nullptr || inertial->find("mass") == nullptr) {
      document.fail(*inertial, "<inertial> without pos or without mass", "both");
    }
    if ((center - box.position).norm() > kMjcfCentered * size.norm()) {
      result.center = box.turn.conjugate() * (center - box.position);
      if (!(result.center.cwiseAbs().array() < size.array()).all()) {
        document.fail(*inertial, *inertial->find("pos"), "a place inside the box");
      }
    }
    result.mass = document.number(*inertial, "mass", 0);
    if (result.mass < kSmallestPositive) {
      document.fail(*inertial, *inertial->find("mass"), "a number above 0 [kg]");
    }
    result.inertia = inertiaOf(document, box, *inertial);
    return result;
  }
  if (fromGeom == "false") {
    document.fail(*box.element, "a box in a body that moves, without <inertial>",
                  "one, as inertiafromgeom is \"false\"");
  }
  if (inertial != nullptr) {
    document.ignore("inertial");
  }
  result.mass = box.mass.value_or(box.density * 8 * size.prod());
  if (!(result.mass >= kSmallestPositive && result.mass <= kLargestNumber)) {
    document.fail(*box.element, "a box that moves with a mass of " + brief(result.mass) + " kg",
                  "a mass from 1e-60 to 1e60 kg");
  }
  return result;
}

}  // namespace careen
