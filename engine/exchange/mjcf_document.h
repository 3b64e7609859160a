#pragma once

#include <array>
#include <cstddef>
#include <initializer_list>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "core/math/linear_algebra.h"
#include "exchange/xml_tree.h"

namespace careen {

/// What <compiler> says.
struct MjcfCompiler {
  bool isRadian = false;
  std::string eulerOrder = "xyz";
  /// How masses are found: from <inertial> if there is one ("auto"), always ("false"), or never ("true").
  std::string inertiaFromGeom = "auto";
  int firstMassGroup = 0;  ///< geoms in these groups count for mass
  int lastMassGroup = 5;
  double leastMass = 0;         ///< [kg]
  double leastInertia = 0;      ///< [kg m²] of each principal moment
  double totalMass = -1;        ///< [kg] what masses are scaled to, if above 0
  bool balanceInertia = false;  ///< impossible moments become their mean
  bool discardVisual = false;
  bool fuseStatic = false;
  bool autoLimits = true;  ///< a range limits
};

/// An MJCF file while it is read: its elements with those of the files it includes, what <compiler> says, and
/// what was ignored. What does not fit is an InputError "file:line:column: found …, expected …".
class MjcfDocument {
 public:
  using Words = std::initializer_list<std::string_view>;

  /// The root must be <mujoco>. All <compiler> elements are read.
  MjcfDocument(std::string text, std::string name);

  const XmlTree& tree() const { return tree_; }
  const XmlElement& root() const { return tree_.root(); }
  XmlElement& root() { return tree_.root(); }
  /// Elements <section> of the root, of which there may be several.
  std::vector<const XmlElement*> sections(std::string_view section) const;

  const MjcfCompiler& compiler() const { return compiler_; }

  /// Refuses attributes other than those that are read and those that change no motion here; notes the
  /// latter.
  void check(const XmlElement& element, Words read, Words ignored = {});
  /// Notes what was ignored, as "option timestep".
  void ignore(const std::string& what) { ignored_.insert(what); }
  const std::set<std::string>& ignored() const { return ignored_; }

  [[noreturn]] void fail(const XmlElement& element, const std::string& found,
                         const std::string& expected) const {
    tree_.fail(element.offset, found, expected);
  }
  /// "found friction="x" for <geom>, expected …"
  [[noreturn]] void fail(const XmlElement& element, const XmlAttribute& attribute,
                         const std::string& expected) const;

  /// `least` to `most` finite numbers; empty if there is no such attribute.
  std::vector<double> numbers(const XmlElement& element, std::string_view attribute, std::size_t least,
                              std::size_t most) const;
  double number(const XmlElement& element, std::string_view attribute, double whenAbsent) const;
  int integer(const XmlElement& element, std::string_view attribute, int whenAbsent) const;
  Vec3 vector(const XmlElement& element, std::string_view attribute, const Vec3& whenAbsent) const;
  /// A number not below 0.
  double positive(const XmlElement& element, std::string_view attribute, double whenAbsent) const;
  std::string word(const XmlElement& element, std::string_view attribute, Words known,
                   const std::string& whenAbsent) const;
  /// [rad] An angle of the file.
  double radians(double angle) const;
  /// Whether a range limits, given what its attribute `limited` says, or none ("auto"); InputError where
  /// MuJoCo has it too.
  bool isLimited(const XmlElement& element, const std::string& limited,
                 const std::array<double, 2>& range) const;
  /// Refuses an attribute that is there and not 0.
  void mustBeZero(const XmlElement& element, std::string_view attribute) const;

  /// Attributes that say an orientation; at most one of them may be given.
  static constexpr std::array<std::string_view, 5> kOrientations = {"quat", "axisangle", "euler", "xyaxes",
                                                                    "zaxis"};
  /// The unit quaternion that takes the element's frame to its parent's, as MuJoCo has it.
  Quat orientation(const XmlElement& element, const Quat& whenAbsent) const;
  /// The shortest turn that takes z into a direction; none if it is too short to have one.
  static std::optional<Quat> turnToZ(const Vec3& direction);

 private:
  void readCompiler(const XmlElement& element);
  void readMassRules(const XmlElement& element);
  double degrees(double angle) const;

  XmlTree tree_;
  MjcfCompiler compiler_;
  std::set<std::string> ignored_;
};

}  // namespace careen
