#pragma once

#include <array>
#include <cstddef>
#include <initializer_list>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "core/math/linear_algebra.h"
#include "exchange/xml_tree.h"

namespace careen {

/// An MJCF file while it is read: its elements, what <compiler> says of angles, and what was ignored. What
/// does not fit is an InputError "file:line:column: found …, expected …".
class MjcfDocument {
 public:
  using Words = std::initializer_list<std::string_view>;

  /// The root must be <mujoco>. All <compiler> elements are read.
  MjcfDocument(std::string text, std::string name);

  const XmlTree& tree() const { return tree_; }
  const XmlElement& root() const { return tree_.root(); }
  /// Elements <section> of the root, of which there may be several.
  std::vector<const XmlElement*> sections(std::string_view section) const;

  /// How masses are found: from <inertial> if there is one ("auto"), always ("false"), or never ("true").
  const std::string& inertiaFromGeom() const { return inertiaFromGeom_; }

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
  /// Refuses an attribute that is there and not 0.
  void mustBeZero(const XmlElement& element, std::string_view attribute) const;

  /// Attributes that say an orientation; at most one of them may be given.
  static constexpr std::array<std::string_view, 5> kOrientations = {"quat", "axisangle", "euler", "xyaxes",
                                                                    "zaxis"};
  /// The unit quaternion that takes the element's frame to its parent's, as MuJoCo has it.
  Quat orientation(const XmlElement& element, const Quat& whenAbsent) const;

 private:
  void readCompiler(const XmlElement& element);
  double degrees(double angle) const;

  XmlTree tree_;
  bool isRadian_ = false;
  std::string eulerOrder_ = "xyz";
  std::string inertiaFromGeom_ = "auto";
  std::set<std::string> ignored_;
};

}  // namespace careen
