#pragma once

#include <array>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "core/math/linear_algebra.h"
#include "exchange/mjcf_document.h"

namespace careen {

/// What a <geom> says once the defaults of its class are in it. Those here are MuJoCo's own.
struct MjcfGeom {
  const XmlElement* element = nullptr;
  std::string name;
  std::string type = "sphere";
  std::vector<double> size;      ///< [m]
  std::vector<double> fromTo;    ///< [m] two points that say position, turn and length
  Vec3 position = Vec3::Zero();  ///< [m] in its body
  Quat turn = Quat::Identity();  ///< its body from it
  std::optional<double> mass;    ///< [kg]
  double density = 1000;         ///< [kg/m³] if there is no mass
  bool isShell = false;          ///< its mass is at its surface
  std::string mesh;              ///< that gives its shape
  int group = 0;
  double friction = 1;                         ///< [1] sliding
  int condim = 3;                              ///< dimension of contact forces: 1 is without friction
  int contype = 1;                             ///< bits: what it is
  int conaffinity = 1;                         ///< bits: what it collides with
  int priority = 0;                            ///< the contact takes after the geom with the larger one
  std::optional<std::array<double, 3>> color;  ///< [1] red, green, blue in sRGB

  /// It collides with nothing but what a <pair> names.
  bool isVisual() const { return contype == 0 && conaffinity == 0; }
};

/// What a <joint> says likewise, in its body; "fixed" is the type of none at all.
struct MjcfJoint {
  const XmlElement* element = nullptr;
  std::string name;
  std::string type = "free";
  Vec3 position = Vec3::Zero();   ///< [m]
  Vec3 axis = Vec3::UnitZ();      ///< [1] of a hinge or slide
  std::string limited = "auto";   ///< "auto": if there is a range, and <compiler autolimits> lets it
  std::array<double, 2> range{};  ///< [rad] of a hinge, [m] of a slide
  double ref = 0;                 ///< likewise: its coordinate as the model stands
  double springRef = 0;           ///< likewise: where its spring rests
  double stiffness = 0;           ///< [N m/rad] or [N/m]
  double damping = 0;             ///< [N m s/rad] or [N s/m]; of a free joint both
  double friction = 0;            ///< [N m] or [N] frictionloss
  double armature = 0;            ///< which no scene has

  bool isFree() const { return type == "free"; }
  bool isBall() const { return type == "ball"; }
  bool hasCoordinate() const { return type == "hinge" || type == "slide"; }
};

/// The classes of <default>, each with the settings of those above it.
class MjcfDefaults {
 public:
  explicit MjcfDefaults(MjcfDocument& document);

  /// The class that an element names, else that of its body; InputError if there is none of that name.
  const std::string& classOf(const XmlElement& element, std::string_view attribute,
                             const std::string& whenAbsent) const;
  MjcfGeom geom(const XmlElement& element, const std::string& ofBody) const;
  /// <joint> or <freejoint>; the latter takes no defaults. Refuses what no joint of a scene has.
  MjcfJoint joint(const XmlElement& element, const std::string& ofBody) const;

  static const std::string kMain;

 private:
  struct Class {
    MjcfGeom geom;
    MjcfJoint joint;
  };
  void read(const XmlElement& element, const Class& above, bool isTop);
  void readMaterials();
  void apply(const XmlElement& element, MjcfGeom& geom) const;
  void applyShape(const XmlElement& element, MjcfGeom& geom) const;
  void applyContact(const XmlElement& element, MjcfGeom& geom) const;
  void applyColor(const XmlElement& element, MjcfGeom& geom) const;
  void placeBetween(MjcfGeom& geom) const;
  void apply(const XmlElement& element, MjcfJoint& joint) const;
  void check(const MjcfJoint& joint) const;

  MjcfDocument& document_;
  std::map<std::string, Class> classes_;
  std::map<std::string, std::array<double, 3>> materials_;  // colours
};

}  // namespace careen
