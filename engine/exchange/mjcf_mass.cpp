#include "exchange/mjcf_mass.h"

#include <algorithm>
#include <string>

#include "core/brief.h"
#include "exchange/mjcf_solid.h"
#include "physics/world/given_inertia.h"
#include "physics/world/principal_axes.h"
#include "scene/json_shape.h"

namespace careen {
namespace {

Vec3 halfExtentsOf(const MjcfGeom& box) { return {box.size[0], box.size[1], box.size[2]}; }

bool inertialCounts(const MjcfDocument& document, const XmlElement* inertial) {
  return inertial != nullptr && document.compiler().inertiaFromGeom != "true";
}

// Diagonal if it is, but for rounding.
Mat3 tensorTurnedBy(const Mat3& inertia, const Mat3& turn) {
  Mat3 found = turn * inertia * turn.transpose();
  found = (0.5 * (found + found.transpose())).eval();  // the product is symmetric but for rounding
  const Mat3 along = found.diagonal().asDiagonal();
  return (found - along).cwiseAbs().maxCoeff() <= kMjcfCentered * found.trace() ? along : found;
}

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
  return tensorTurnedBy(inertia, boxFromIt.normalized().toRotationMatrix());
}

MjcfMass fromInertial(MjcfDocument& document, const MjcfGeom& box, const XmlElement& inertial) {
  document.check(inertial, {"pos", "mass", "diaginertia", "fullinertia", "quat", "axisangle", "euler",
                            "xyaxes", "zaxis"});
  const Vec3 center = document.vector(inertial, "pos", Vec3::Zero());
  if (inertial.find("pos") == nullptr || inertial.find("mass") == nullptr) {
    document.fail(inertial, "<inertial> without pos or without mass", "both");
  }
  MjcfMass result;
  result.center = box.turn.conjugate() * (center - box.position);
  result.mass = document.number(inertial, "mass", 0);
  result.inertia = inertiaOf(document, box, inertial);
  return result;
}

/// A geom that counts for the mass of its body.
struct MassPart {
  const MjcfGeom* geom = nullptr;
  MjcfSolid solid;
};

std::vector<MassPart> partsOf(const MjcfDocument& document, const std::vector<MjcfGeom>& geoms) {
  const MjcfCompiler& compiler = document.compiler();
  std::vector<MassPart> parts;
  for (const MjcfGeom& geom : geoms) {
    if (geom.group < compiler.firstMassGroup || geom.group > compiler.lastMassGroup) {
      continue;
    }
    const MjcfSolid solid = solidOf(document, geom);
    if (solid.mass > 0 && geom.isVisual() && compiler.discardVisual) {
      document.fail(*geom.element,
                    "a <geom> that collides with nothing, whose mass counts or not, by the version of "
                    "MuJoCo (discardvisual)",
                    R"(mass="0" for it, or discardvisual="false")");
    }
    if (solid.mass > 0) {
      parts.push_back({.geom = &geom, .solid = solid});
    }
  }
  return parts;
}

MjcfMass fromGeoms(const std::vector<MassPart>& parts, const MjcfShape& shape) {
  const MjcfGeom& box = shape.geom;
  MjcfMass result;
  Vec3 weighted = Vec3::Zero();
  for (const MassPart& part : parts) {
    result.mass += part.solid.mass;
    weighted += part.solid.mass * part.geom->position;
  }
  if (parts.empty() || (parts.size() == 1 && shape.parts.empty() && parts[0].geom->element == box.element)) {
    return result;
  }
  const Vec3 center = weighted / result.mass;
  Mat3 inertia = Mat3::Zero();  // in the body's axes
  for (const MassPart& part : parts) {
    const Vec3 arm = part.geom->position - center;
    const Mat3 turn = part.geom->turn.toRotationMatrix();
    inertia += turn * part.solid.moments.asDiagonal() * turn.transpose();
    inertia += part.solid.mass * (arm.squaredNorm() * Mat3::Identity() - arm * arm.transpose());
  }
  result.center = box.turn.conjugate() * (center - box.position);
  result.inertia = tensorTurnedBy(inertia, box.turn.conjugate().toRotationMatrix());
  return result;
}

// As <compiler> says: no less than its bounds, and possible moments in the place of impossible ones.
void keepWithinBounds(const MjcfCompiler& compiler, const Vec3& size, MjcfMass& mass) {
  const Mat3 inertia = mass.inertia.value_or(
      Mat3((mass.mass / 3 *
            Vec3(size.y() * size.y() + size.z() * size.z(), size.x() * size.x() + size.z() * size.z(),
                 size.x() * size.x() + size.y() * size.y()))
               .asDiagonal()));
  const PrincipalAxes principal = principalAxes(inertia);
  Vec3 moments = principal.moments.cwiseMax(compiler.leastInertia);
  const double most = moments.maxCoeff();
  if (compiler.balanceInertia && moments.sum() - most < most) {
    moments.setConstant(moments.mean());
  }
  if (mass.mass < compiler.leastMass || moments != principal.moments) {
    mass.inertia =
        moments == principal.moments ? inertia : tensorTurnedBy(Mat3(moments.asDiagonal()), principal.axes);
    mass.mass = std::max(mass.mass, compiler.leastMass);
  }
}

}  // namespace

MjcfMass massOf(MjcfDocument& document, const std::vector<MjcfGeom>& geoms, const MjcfShape& shape,
                const XmlElement* inertial) {
  const MjcfGeom& box = shape.geom;
  const Vec3 size = halfExtentsOf(box);
  const bool isGiven = inertialCounts(document, inertial);
  if (!isGiven && document.compiler().inertiaFromGeom == "false") {
    document.fail(*box.element, "a box in a body that moves, without <inertial>",
                  "one, as inertiafromgeom is \"false\"");
  }
  if (!isGiven && inertial != nullptr) {
    document.ignore("inertial");
  }
  MjcfMass result =
      isGiven ? fromInertial(document, box, *inertial) : fromGeoms(partsOf(document, geoms), shape);
  const XmlElement& said = isGiven ? *inertial : *box.element;
  // Of <inertial> an attribute is wrong, of geoms what they amount to.
  const auto fail = [&](const char* attribute, const std::string& found, const std::string& expected) {
    if (isGiven) {
      document.fail(said, *said.find(attribute), expected);
    }
    document.fail(said, found, expected);
  };
  if (result.center.norm() <= kMjcfCentered * size.norm()) {
    result.center.setZero();
  }
  if (!(result.center.cwiseAbs().array() < size.array()).all()) {
    fail("pos", "a centre of mass outside of the box", "a place inside the box");
  }
  keepWithinBounds(document.compiler(), size, result);
  if (!(result.mass >= kSmallestPositive && result.mass <= kLargestNumber)) {
    fail("mass", "a box that moves with a mass of " + brief(result.mass) + " kg",
         "a mass from 1e-60 to 1e60 kg");
  }
  const std::string why = result.inertia ? whyNoTensor(*result.inertia) : "";
  if (!why.empty()) {
    const Vec3 moments = result.inertia->diagonal();
    document.fail(
        said,
        "moments " + brief(moments.x()) + ", " + brief(moments.y()) + ", " + brief(moments.z()) + " kg m²",
        why);
  }
  return result;
}

double fixedMassOf(const MjcfDocument& document, const std::vector<MjcfGeom>& geoms,
                   const XmlElement* inertial) {
  double mass = 0;
  if (inertialCounts(document, inertial)) {
    mass = document.number(*inertial, "mass", 0);
  } else if (document.compiler().inertiaFromGeom != "false") {
    for (const MassPart& part : partsOf(document, geoms)) {
      mass += part.solid.mass;
    }
  }
  return std::max(mass, document.compiler().leastMass);
}

}  // namespace careen
