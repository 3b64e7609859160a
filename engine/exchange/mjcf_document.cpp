#include "exchange/mjcf_document.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <numbers>
#include <utility>

#include "core/brief.h"
#include "exchange/mjcf_include.h"
#include "scene/json_shape.h"
#include "scene/json_tree.h"
#include "stage/turn.h"

namespace careen {
namespace {

constexpr double kLeastDirection = 1e-14;  // as MuJoCo has it: shorter ones have no direction

std::optional<Vec3> directionOf(const Vec3& vector) {
  const double largest = vector.cwiseAbs().maxCoeff();
  if (largest < kLeastDirection) {
    return std::nullopt;
  }
  return Vec3((vector / largest).normalized());  // large components would overflow when squared
}

Quat turnAbout(const Vec3& unitAxis, double degrees) {
  const Turn half = turnFrom(degrees / 2);
  const Vec3 vector = half.sine * unitAxis;
  return {half.cosine, vector.x(), vector.y(), vector.z()};
}

// The nearest; another number than `value` where it is none.
int integerOf(double value) {
  return static_cast<int>(std::round(std::clamp(value, -2147483647.0, 2147483647.0)));
}

bool contains(MjcfDocument::Words words, std::string_view word) {
  return std::find(words.begin(), words.end(), word) != words.end();
}

}  // namespace

MjcfDocument::MjcfDocument(std::string text, std::string name) : tree_(std::move(text), std::move(name)) {
  if (root().name != "mujoco") {
    fail(root(), "the element <" + root().name + ">", "<mujoco>, the root of MJCF");
  }
  includeFiles(tree_);
  for (const XmlElement* const compiler : sections("compiler")) {
    readCompiler(*compiler);
  }
}

std::vector<const XmlElement*> MjcfDocument::sections(std::string_view section) const {
  std::vector<const XmlElement*> found;
  for (const XmlElement& child : root().children) {
    if (child.name == section) {
      found.push_back(&child);
    }
  }
  return found;
}

void MjcfDocument::readCompiler(const XmlElement& element) {
  check(
      element,
      {"angle", "eulerseq", "coordinate", "inertiafromgeom", "inertiagrouprange", "boundmass", "boundinertia",
       "balanceinertia", "settotalmass", "discardvisual", "fusestatic", "alignfree", "autolimits"},
      {"strippath", "meshdir", "texturedir", "assetdir", "convexhull", "usethread", "fitaabb",
       "exactmeshinertia", "saveinertial"});
  const auto flag = [&](std::string_view attribute, bool whenAbsent) {
    return word(element, attribute, {"true", "false"}, whenAbsent ? "true" : "false") == "true";
  };
  compiler_.isRadian =
      word(element, "angle", {"radian", "degree"}, compiler_.isRadian ? "radian" : "degree") == "radian";
  word(element, "coordinate", {"local"}, "local");
  word(element, "alignfree", {"false"}, "false");
  compiler_.discardVisual = flag("discardvisual", compiler_.discardVisual);
  compiler_.fuseStatic = flag("fusestatic", compiler_.fuseStatic);
  compiler_.autoLimits = flag("autolimits", compiler_.autoLimits);
  compiler_.balanceInertia = flag("balanceinertia", compiler_.balanceInertia);
  readMassRules(element);
  if (const XmlAttribute* const order = element.find("eulerseq")) {
    if (order->value.size() != 3 || order->value.find_first_not_of("xyzXYZ") != std::string::npos) {
      fail(element, *order, "three of x, y, z, X, Y, Z");
    }
    compiler_.eulerOrder = order->value;
  }
}

void MjcfDocument::readMassRules(const XmlElement& element) {
  compiler_.inertiaFromGeom =
      word(element, "inertiafromgeom", {"auto", "true", "false"}, compiler_.inertiaFromGeom);
  const std::vector<double> groups = numbers(element, "inertiagrouprange", 2, 2);
  if (!groups.empty()) {
    compiler_.firstMassGroup = integerOf(groups[0]);
    compiler_.lastMassGroup = integerOf(groups[1]);
    if (compiler_.firstMassGroup != groups[0] || compiler_.lastMassGroup != groups[1]) {
      fail(element, *element.find("inertiagrouprange"), "two integers");
    }
  }
  compiler_.leastMass = number(element, "boundmass", compiler_.leastMass);
  compiler_.leastInertia = number(element, "boundinertia", compiler_.leastInertia);
  compiler_.totalMass = number(element, "settotalmass", compiler_.totalMass);
}

std::string MjcfDocument::word(const XmlElement& element, std::string_view attribute, Words known,
                               const std::string& whenAbsent) const {
  const XmlAttribute* const found = element.find(attribute);
  if (found != nullptr && !contains(known, found->value)) {
    std::string expected;
    for (const std::string_view each : known) {
      expected += (expected.empty() ? "" : " or ") + std::string(each);
    }
    fail(element, *found, expected);
  }
  return found == nullptr ? whenAbsent : found->value;
}

void MjcfDocument::check(const XmlElement& element, Words read, Words ignored) {
  for (const XmlAttribute& attribute : element.attributes) {
    if (contains(read, attribute.name)) {
      continue;
    }
    if (!contains(ignored, attribute.name)) {
      fail(element, attribute, "none: it says what a scene of boxes cannot");
    }
    ignore(element.name + " " + attribute.name);
  }
}

void MjcfDocument::fail(const XmlElement& element, const XmlAttribute& attribute,
                        const std::string& expected) const {
  tree_.fail(attribute.offset,
             attribute.name + "=" + inQuotes(attribute.value) + " for <" + element.name + ">", expected);
}

std::vector<double> MjcfDocument::numbers(const XmlElement& element, std::string_view attribute,
                                          std::size_t least, std::size_t most) const {
  const XmlAttribute* const found = element.find(attribute);
  if (found == nullptr) {
    return {};
  }
  constexpr std::string_view kBlanks = " \t\r\n";
  const std::string_view text = found->value;
  std::vector<double> values;
  for (std::size_t at = text.find_first_not_of(kBlanks); at != std::string_view::npos;) {
    const std::size_t end = std::min(text.find_first_of(kBlanks, at), text.size());
    std::string_view word = text.substr(at, end - at);
    if (word.starts_with('+')) {
      word.remove_prefix(1);
    }
    double value = 0;
    const auto [stop, error] = std::from_chars(word.data(), word.data() + word.size(), value);
    if (error != std::errc() || stop != word.data() + word.size() || !(std::fabs(value) <= kLargestNumber)) {
      tree_.fail(found->offset,
                 inQuotes(text.substr(at, end - at)) + " in " + found->name + " for <" + element.name + ">",
                 "a number from -1e60 to 1e60");
    }
    values.push_back(value + 0.0);  // no -0
    at = text.find_first_not_of(kBlanks, end);
  }
  if (values.size() < least || values.size() > most) {
    const std::string count =
        least == most ? std::to_string(least) : std::to_string(least) + " to " + std::to_string(most);
    tree_.fail(found->offset,
               std::to_string(values.size()) + " numbers in " + found->name + " for <" + element.name + ">",
               count);
  }
  return values;
}

double MjcfDocument::number(const XmlElement& element, std::string_view attribute, double whenAbsent) const {
  const std::vector<double> values = numbers(element, attribute, 1, 1);
  return values.empty() ? whenAbsent : values[0];
}

double MjcfDocument::positive(const XmlElement& element, std::string_view attribute,
                              double whenAbsent) const {
  const double value = number(element, attribute, whenAbsent);
  if (value < 0) {
    fail(element, *element.find(attribute), "a number not below 0");
  }
  return value;
}

double MjcfDocument::radians(double angle) const {
  return compiler_.isRadian ? angle : angle * (std::numbers::pi / 180);
}

bool MjcfDocument::isLimited(const XmlElement& element, const std::string& limited,
                             const std::array<double, 2>& range) const {
  const bool isRange = range[0] < range[1];
  const XmlAttribute* const given = element.find("range");
  const auto refuse = [&](const std::string& expected) {
    tree_.fail(given == nullptr ? element.offset : given->offset,
               "the range " + brief(range[0]) + " " + brief(range[1]) + " for <" + element.name + ">",
               expected);
  };
  if (limited == "true" && !isRange) {
    refuse("the lower end first");
  }
  if (limited == "auto" && isRange && !compiler_.autoLimits) {
    refuse("limited=\"true\" or limited=\"false\" beside it, or autolimits=\"true\"");
  }
  return limited == "true" || (limited == "auto" && isRange);
}

int MjcfDocument::integer(const XmlElement& element, std::string_view attribute, int whenAbsent) const {
  const double value = number(element, attribute, whenAbsent);
  if (integerOf(value) != value) {
    fail(element, *element.find(attribute), "an integer");
  }
  return integerOf(value);
}

Vec3 MjcfDocument::vector(const XmlElement& element, std::string_view attribute,
                          const Vec3& whenAbsent) const {
  const std::vector<double> values = numbers(element, attribute, 3, 3);
  return values.empty() ? whenAbsent : Vec3(values[0], values[1], values[2]);
}

void MjcfDocument::mustBeZero(const XmlElement& element, std::string_view attribute) const {
  for (const double value : numbers(element, attribute, 1, 100)) {
    if (value != 0) {
      fail(element, *element.find(attribute), "0: a scene of boxes has no such thing");
    }
  }
}

std::optional<Quat> MjcfDocument::turnToZ(const Vec3& direction) {
  const std::optional<Vec3> z = directionOf(direction);
  if (!z) {
    return std::nullopt;
  }
  const double across = z->x() * z->x() + z->y() * z->y();
  if (z->z() < 0 && across < 1e-20) {
    return Quat(0, 1, 0, 0);  // of the many shortest turns from z that about x, as MuJoCo does
  }
  const double w = z->z() < 0 ? across / (1 - z->z()) : 1 + z->z();  // 1 + z without cancellation
  return Quat(w, -z->y(), z->x(), 0).normalized();
}

double MjcfDocument::degrees(double angle) const {
  return compiler_.isRadian ? angle * (180 / std::numbers::pi) : angle;
}

Quat MjcfDocument::orientation(const XmlElement& element, const Quat& whenAbsent) const {
  const XmlAttribute* given = nullptr;
  for (const std::string_view word : kOrientations) {
    if (const XmlAttribute* const found = element.find(word)) {
      if (given != nullptr) {
        fail(element, *found, "one orientation; there is " + given->name + " already");
      }
      given = found;
    }
  }
  if (given == nullptr) {
    return whenAbsent;
  }
  const std::string& name = given->name;
  const std::size_t count = name == "xyaxes" ? 6 : name == "quat" || name == "axisangle" ? 4 : 3;
  const std::vector<double> v = numbers(element, name, count, count);
  const auto direction = [&](const Vec3& vector) {
    const std::optional<Vec3> found = directionOf(vector);
    if (!found) {
      fail(element, *given, "a direction, not 0");
    }
    return *found;
  };
  if (name == "quat") {
    Quat quat(v[0], v[1], v[2], v[3]);
    const double largest = quat.coeffs().cwiseAbs().maxCoeff();
    if (largest < kLeastDirection) {
      fail(element, *given, "a rotation, not 0");
    }
    quat.coeffs() /= largest;
    return quat.normalized();
  }
  if (name == "axisangle") {
    return turnAbout(direction({v[0], v[1], v[2]}), degrees(v[3]));
  }
  if (name == "euler") {
    Quat turn = Quat::Identity();
    for (std::size_t i = 0; i < 3; ++i) {
      const char axis = compiler_.eulerOrder[i];
      const bool isFixed = axis < 'a';  // capital letters: axes that stay; else those that turn along
      const Quat next = turnAbout(Vec3::Unit(axis - (isFixed ? 'X' : 'x')), degrees(v[i]));
      turn = isFixed ? next * turn : turn * next;
    }
    return turn;
  }
  if (name == "zaxis") {
    const std::optional<Quat> turn = turnToZ({v[0], v[1], v[2]});
    if (!turn) {
      fail(element, *given, "a direction, not 0");
    }
    return *turn;
  }
  const Vec3 x = direction({v[0], v[1], v[2]});
  const Vec3 second = direction({v[3], v[4], v[5]});
  const Vec3 y = direction(second - x.dot(second) * x);
  Mat3 axes;
  axes << x, y, x.cross(y);
  return Quat(axes).normalized();
}

}  // namespace careen
