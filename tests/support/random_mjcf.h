#pragma once

#include <random>
#include <string>

#include "core/brief.h"

namespace careen {

/// Writes models that use every notation of orientations, nested classes, masses of all kinds and a key
/// frame.
class RandomMjcf {
 public:
  explicit RandomMjcf(unsigned seed) : random_(seed) {}

  std::string text() {
    isRadian_ = chance(2);
    std::string all = "<mujoco model=\"random\">\n<compiler" +
                      std::string(isRadian_   ? " angle=\"radian\""
                                  : chance(2) ? " angle=\"degree\""
                                              : "") +
                      (chance(2) ? " eulerseq=\"" + sequence() + "\"" : "") + "/>\n<option gravity=\"" +
                      vector(10) + "\"/>\n";
    all += "<default>\n<geom density=\"" + positive() + "\" friction=\"0.5\"/>\n<joint damping=\"0\"/>\n" +
           "<default class=\"one\"><geom type=\"box\" size=\"" + positives(3) + "\" " + orientation() +
           "/>\n" + "<default class=\"two\"><geom size=\"" + positives(1) + "\"" +
           (chance(2) ? " mass=\"" + positive() + "\"" : "") + "/>" + "<joint type=\"free\"/></default>" +
           "</default></default>\n<worldbody>\n";
    const std::size_t count = 1 + random_() % 5;
    for (std::size_t i = 0; i < count; ++i) {
      all += chance(3) ? plane() : chance(3) ? statics(1) : movable();
    }
    all += movable() + "</worldbody>\n";
    if (chance(2)) {
      all += "<keyframe><key name=\"start\" qpos=\"";
      for (int i = 0; i < movables_; ++i) {
        all += (i == 0 ? "" : " ") + vector(3) + " " + numbers(4, 2);
      }
      all += "\" qvel=\"";
      for (int i = 0; i < movables_; ++i) {
        all += (i == 0 ? "" : " ") + numbers(6, 5);
      }
      all += "\"/></keyframe>\n";
    }
    return all + "</mujoco>\n";
  }

 private:
  bool chance(unsigned of) { return random_() % of == 0; }
  double real(double least, double most) {
    return std::uniform_real_distribution<double>(least, most)(random_);
  }
  std::string numbers(int count, double most) {
    std::string text;
    for (int i = 0; i < count; ++i) {
      text += (i == 0 ? "" : " ") + inFull(real(-most, most));
    }
    return text;
  }
  std::string vector(double most) { return numbers(3, most); }
  std::string positive() { return inFull(real(0.1, 3)); }
  std::string positives(int count) {
    std::string text = positive();
    for (int i = 1; i < count; ++i) {
      text += " " + positive();
    }
    return text;
  }
  std::string sequence() {
    std::string axes;
    for (int i = 0; i < 3; ++i) {
      axes += "xyzXYZ"[random_() % 6];
    }
    return axes;
  }
  std::string angle() { return inFull(isRadian_ ? real(-4, 4) : real(-400, 400)); }

  // The classes "one" and "two" have an orientation already, and MuJoCo takes no two.
  std::string orientation() {
    switch (random_() % 6) {
      case 0:
        return "quat=\"" + numbers(4, 2) + "\"";
      case 1:
        return "axisangle=\"" + vector(2) + " " + angle() + "\"";
      case 2:
        return "euler=\"" + angle() + " " + angle() + " " + angle() + "\"";
      case 3:
        return "xyaxes=\"" + vector(2) + " " + vector(2) + "\"";
      case 4:
        return "zaxis=\"" + (chance(5) ? "0 0 -2" : vector(2)) + "\"";
      default:
        return "";
    }
  }
  std::string placed(double most) { return " pos=\"" + vector(most) + "\" " + orientation(); }
  std::string name(const char* kind) { return kind + std::to_string(++names_); }

  std::string plane() {
    return "<geom name=\"" + name("w") + "\" type=\"plane\" size=\"1 1 1\"" + placed(3) + "/>\n";
  }
  std::string fixedBox() {
    const std::string own = chance(2) ? " class=\"one\" pos=\"" + vector(2) + "\""
                                      : " type=\"box\" size=\"" + positives(3) + "\"" + placed(2);
    return "<geom name=\"" + name("s") + "\"" + own + "/>\n";
  }
  std::string statics(int depth) {
    return "<body " + placed(2) + ">" + fixedBox() + (chance(2) ? fixedBox() : "") +
           (depth < 4 && chance(2) ? statics(depth + 1) : "") + "</body>\n";
  }

  std::string movable() {
    ++movables_;
    const std::string own = name("m");
    const int kind = static_cast<int>(random_() % 4);
    std::string text =
        "<body name=\"" + own + "\"" + (kind == 1 ? " childclass=\"two\"" : "") + placed(5) + ">";
    text += kind == 1 ? "<joint/>" : chance(2) ? "<freejoint/>" : "<joint type=\"free\"/>";
    const std::string place = " pos=\"" + vector(1) + "\" ";
    const std::string geom = "<geom name=\"" + own + "\"";
    if (kind == 0) {
      return text + geom + " class=\"one\"" + place + "/></body>\n";
    }
    if (kind == 1) {
      return text + geom + place + (chance(2) ? "density=\"" + positive() + "\"" : "") + "/></body>\n";
    }
    const std::string box = " type=\"box\" size=\"" + positives(3) + "\"" + place;
    const std::string turn = orientation();
    if (kind == 2) {
      return text + geom + box + turn + (chance(2) ? " mass=\"" + positive() + "\"" : "") + "/></body>\n";
    }
    const double least = real(0.1, 1);
    const std::string mass = " mass=\"" + positive() + "\" diaginertia=\"" + inFull(least) + " " +
                             inFull(least * 1.3) + " " + inFull(least * 1.7) + "\"/></body>\n";
    if (chance(2)) {  // about a place of its own, as near as the smallest box allows, along axes of its own
      std::string middle;
      std::string near;
      for (int axis = 0; axis < 3; ++axis) {
        const double at = real(-1, 1);
        middle += (axis > 0 ? " " : "") + inFull(at);
        near += (axis > 0 ? " " : "") + inFull(at + real(-0.05, 0.05));
      }
      return text + geom + " type=\"box\" size=\"" + positives(3) + "\" pos=\"" + middle + "\" " + turn +
             "/><inertial pos=\"" + near + "\" " + orientation() + mass;
    }
    // The axes of <inertial> are those of the box.
    return text + geom + box + turn + "/><inertial" + place + turn + mass;
  }

  std::mt19937 random_;
  bool isRadian_ = false;
  int names_ = 0;
  int movables_ = 0;
};

}  // namespace careen
