#pragma once

#include <string>
#include <vector>

#include "core/brief.h"
#include "support/random_text.h"

namespace careen {

/// Writes models of bodies in bodies with all kinds of joints, at places, along axes and in units of all
/// kinds, some by classes, with a key frame that is not how the model stands. Nothing collides.
class RandomMjcfJoints : RandomText {
 public:
  enum class Limits { kNo, kYes };

  RandomMjcfJoints(unsigned seed, Limits limits) : RandomText(seed), hasLimits_(limits == Limits::kYes) {}

  std::string text() {
    isRadian_ = chance(2);
    hasAuto_ = chance(2);
    std::string bodies;
    const std::size_t trees = 1 + random_() % 3;
    for (std::size_t i = 0; i < trees; ++i) {
      bodies += body(3, true);
    }
    std::string all =
        "<mujoco model=\"joints\">\n<compiler angle=\"" + std::string(isRadian_ ? "radian" : "degree") +
        "\"" + (hasAuto_ ? " autolimits=\"true\"" : "") + "/>\n<option gravity=\"" + vector(10) +
        "\"/>\n<default><geom type=\"box\" contype=\"2\" conaffinity=\"4\" density=\"1000\"/>"
        "<joint axis=\"1 2 -1\"/><default class=\"loose\"><joint damping=\"0.5\" axis=\"0 3 0\"/></default>"
        "<default class=\"sprung\"><joint stiffness=\"3\"/></default></default>\n<worldbody>\n" +
        bodies + "</worldbody>\n";
    if (chance(3)) {
      return all + "</mujoco>\n";
    }
    return all + "<keyframe><key name=\"start\" qpos=\"" + places_ + "\" qvel=\"" + speeds_ +
           "\"/></keyframe>\n</mujoco>\n";
  }

 private:
  // [rad], as the file has it.
  std::string angle(double value) const { return inFull(isRadian_ ? value : value * kDegrees); }
  static constexpr double kDegrees = 180 / 3.141592653589793;

  static void append(std::string& text, const std::string& more) { text += (text.empty() ? "" : " ") + more; }

  std::string body(int depth, bool isTop) {
    const std::string name = "b" + std::to_string(++bodies_);
    const bool isStill = isTop && bodies_ > 1 && chance(4);
    std::string text = "<body name=\"" + name + "\" pos=\"" + vector(2) + "\" quat=\"" + numbers(4, 1) +
                       "\"" + (chance(4) ? " childclass=\"loose\"" : "") + ">";
    text += isStill ? "" : joint(isTop);
    const std::string geom = "<geom name=\"" + name + "\" size=\"" + inFull(real(0.1, 0.4)) + " " +
                             inFull(real(0.1, 0.4)) + " " + inFull(real(0.1, 0.4)) + "\" pos=\"" +
                             vector(0.5) + "\" axisangle=\"" + vector(1) + " " + angle(real(-3, 3)) + "\"/>";
    const bool isLast = chance(2);
    text += isLast ? "" : geom;
    const std::size_t inside = depth == 0 ? 0 : random_() % 3;
    for (std::size_t i = 0; i < inside; ++i) {
      text += body(depth - 1, false);
    }
    return text + (isLast ? geom : "") + "</body>\n";
  }

  std::string joint(bool isTop) {
    const std::size_t kind = random_() % 5;
    const std::string name = "j" + std::to_string(bodies_);
    if (isTop && kind == 0) {
      append(places_, vector(2) + " " + numbers(4, 1));
      append(speeds_, numbers(6, 2));
      return chance(2) ? "<freejoint/>" : "<joint class=\"main\" type=\"free\"/>";
    }
    if (kind == 0) {
      return "";
    }
    if (kind == 1) {
      append(places_, numbers(4, 1));
      append(speeds_, vector(2));
      return "<joint class=\"main\" name=\"" + name + "\" type=\"ball\" pos=\"" + vector(0.5) + "\"/>";
    }
    const bool turns = kind != 2;
    const auto number = [&](double value) { return turns ? angle(value) : inFull(value); };
    const double start = real(-1, 1);
    append(places_, inFull(start));
    append(speeds_, numbers(1, 3));
    std::string text = "<joint name=\"" + name + "\"";
    text += turns ? (chance(2) ? " type=\"hinge\"" : "") : " type=\"slide\"";
    text += chance(3) ? " class=\"sprung\"" : "";
    text += chance(2) ? " pos=\"" + vector(0.5) + "\"" : "";
    text += chance(2) ? " axis=\"" + vector(3) + "\"" : "";
    text += chance(2) ? " damping=\"" + inFull(real(0, 1)) + "\"" : "";
    text += chance(3) ? " stiffness=\"" + inFull(real(1, 9)) + "\" springref=\"" + number(real(-1, 1)) + "\""
                      : "";
    const double ref = chance(2) ? real(-0.5, 0.5) : 0;
    text += ref != 0 ? " ref=\"" + number(ref) + "\"" : "";
    if (hasLimits_ && chance(2)) {
      text += " range=\"" + number(-1 - real(0, 0.5)) + " " + number(1 + real(0, 0.5)) + "\"";
      text += hasAuto_ ? (chance(4) ? " limited=\"false\"" : "") : " limited=\"true\"";
    }
    return text + "/>";
  }

  bool hasLimits_;
  bool isRadian_ = false;
  bool hasAuto_ = false;
  int bodies_ = 0;
  std::string places_;
  std::string speeds_;
};

}  // namespace careen
