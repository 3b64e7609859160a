#include "exchange/mjcf_document.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <numbers>
#include <utility>

#include "scene/json_shape.h"
#include "scene/json_tree.h"
#include "stage/turn.h"

namespace careen {
namespace {

constexpr double kLeastDirection = 1e-14;  // as MuJoCo has it: shorter ones have no direction

Quat turnAbout(const Vec3& unitAxis, double degrees) {
  const Turn half = turnFrom(degrees / 2);
  const Vec3 vector = half.sine * unitAxis;
  return {half.cosine, vector.x(), vector.y(), vector.z()};
}

bool contains(MjcfDocument::Words words, std::string_view word) {
  return std::find(words.begin(), words.end(), word) != words.end();
}

}  // namespace

MjcfDocument::MjcfDocument(std::string text, std::string name) : tree_(std::move(text), std::move(name)) {
  if (root().name != "mujoco") {
    fail(root(), "the element <" + root().name + ">", "<mujoco>, the root of MJCF");
  }
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
  check(element,
        {"angle", "eulerseq", "coordinate", "inertiafromgeom", "boundmass", "boundinertia", "balanceinertia"},
        {"autolimits", "strippath", "meshdir", "texturedir", "assetdir", "discardvisual", "fusestatic",
         "convexhull", "usethread", "fitaabb", "inertiagrouprange", "settotalmass"});
  // Those that change masses.
  mustBeZero(element, "boundmass");
  mustBeZero(element, "boundinertia");
  if (element.find("settotalmass") != nullptr && number(element, "settotalmass", -1) > 0) {
    fail(element, *element.find("settotalmass"), "no such change of masses");
  }
  const auto word = [&](std::string_view attribute, Words known, const std::string& whenAbsent) {
    const XmlAttribute* const found = element.find(attribute);
    if (found != nullptr && !contains(known, found->value)) {
      std::string expected;
      for (const std::string_view each : known) {
        expected += (expected.empty() ? "" : " or ") + std::string(each);
      }
      fail(element, *found, expected);
    }
    return found == nullptr ? whenAbsent : found->value;
  };
  isRadian_ = word("angle", {"radian", "degree"}, isRadian_ ? "radian" : "degree") == "radian";
  word("coordinate", {"local"}, "local");
  word("balanceinertia", {"false"}, "false");
  inertiaFromGeom_ = word("inertiafromgeom", {"auto", "true", "false"}, inertiaFromGeom_);
  if (inertiaFromGeom_ != "false" && element.find("inertiagrouprange") != nullptr) {
    fail(element, *element.find("inertiagrouprange"), "masses of all geoms");
  }
  if (const XmlAttribute* const order = element.find("eulerseq")) {
    if (order->value.size() != 3 || order->value.find_first_not_of("xyzXYZ") != std::string::npos) {
      fail(element, *order, "three of x, y, z, X, Y, Z");
    }
    eulerOrder_ = order->value;
  }
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

int MjcfDocument::integer(const XmlElement& element, std::string_view attribute, int whenAbsent) const {
  const double value = number(element, attribute, whenAbsent);
  if (value != std::floor(value) || std::fabs(value) > 0x7fffffff) {
    fail(element, *element.find(attribute), "an integer");
  }
  return static_cast<int>(value);
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

double MjcfDocument::degrees(double angle) const {
  return isRadian_ ? angle * (180 / std::numbers::pi) : angle;
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
    const double largest = vector.cwiseAbs().maxCoeff();
    if (largest < kLeastDirection) {
      fail(element, *given, "a direction, not 0");
    }
    return Vec3((vector / largest).normalized());  // large components would overflow when squared
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
      const char axis = eulerOrder_[i];
      const bool isFixed = axis < 'a';  // capital letters: axes that stay; else those that turn along
      const Quat next = turnAbout(Vec3::Unit(axis - (isFixed ? 'X' : 'x')), degrees(v[i]));
      turn = isFixed ? next * turn : turn * next;
    }
    return turn;
  }
  if (name == "zaxis") {
    const Vec3 z = direction({v[0], v[1], v[2]});
    const double across = z.x() * z.x() + z.y() * z.y();
    if (z.z() < 0 && across < 1e-20) {
      return {0, 1, 0, 0};  // of the many shortest turns from z that about x, as MuJoCo does
    }
    const double w = z.z() < 0 ? across / (1 - z.z()) : 1 + z.z();  // 1 + z without cancellation
    return Quat(w, -z.y(), z.x(), 0).normalized();
  }
  const Vec3 x = direction({v[0], v[1], v[2]});
  const Vec3 second = direction({v[3], v[4], v[5]});
  const Vec3 y = direction(second - x.dot(second) * x);
  Mat3 axes;
  axes << x, y, x.cross(y);
  return Quat(axes).normalized();
}

}  // namespace careen
