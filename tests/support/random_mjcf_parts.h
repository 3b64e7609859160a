#pragma once

#include <string>

#include "core/brief.h"
#include "support/random_text.h"

namespace careen {

/// Writes models of bodies of several boxes that overlap, turned against each other, with masses of all
/// kinds: free ones, and such as hang on them by hinges. Bodies of one tree pass through each other; trees
/// are far from each other.
class RandomMjcfParts : RandomText {
 public:
  explicit RandomMjcfParts(unsigned seed) : RandomText(seed) {}

  std::string text() {
    std::string bodies;
    const std::size_t trees = 1 + random_() % 3;
    for (std::size_t i = 0; i < trees; ++i) {
      bodies +=
          body("pos=\"" + inFull(100.0 * static_cast<double>(i)) + " 0 0\"", "<freejoint/>", random_() % 3);
      append(places_, inFull(100.0 * static_cast<double>(i)) + " " + numbers(2, 1) + " " + numbers(4, 1));
      append(speeds_, numbers(6, 2));
      places_ += hinges_;
      speeds_ += hingeSpeeds_;
      hinges_.clear();
      hingeSpeeds_.clear();
    }
    std::string all = "<mujoco model=\"parts\">\n<compiler angle=\"radian\"" +
                      std::string(chance(4) ? " settotalmass=\"" + inFull(real(1, 5)) + "\"" : "") +
                      (chance(4) ? " inertiagrouprange=\"0 2\"" : "") + "/>\n<option gravity=\"" +
                      vector(10) + "\"/>\n<default><geom type=\"box\" density=\"" + inFull(real(100, 2000)) +
                      "\" contype=\"2\" conaffinity=\"4\"/></default>\n<worldbody>\n" + bodies +
                      "</worldbody>\n";
    if (chance(3)) {
      return all + "</mujoco>\n";
    }
    return all + "<keyframe><key name=\"start\" qpos=\"" + places_ + "\" qvel=\"" + speeds_ +
           "\"/></keyframe>\n</mujoco>\n";
  }

 private:
  static void append(std::string& text, const std::string& more) { text += (text.empty() ? "" : " ") + more; }

  std::string geom(const std::string& name) {
    const std::string mass = chance(3) ? " mass=\"" + inFull(real(0.1, 2)) + "\"" : "";
    return "<geom name=\"" + name + "\" size=\"" + inFull(real(0.1, 0.4)) + " " + inFull(real(0.1, 0.4)) +
           " " + inFull(real(0.1, 0.4)) + "\" pos=\"" + vector(0.5) + "\"" +
           (chance(4) ? "" : " quat=\"" + numbers(4, 1) + "\"") + mass + "/>";
  }

  // Geoms are named after their body: b1, b1-2, …
  std::string body(const std::string& place, const std::string& joint, std::size_t inside) {
    const std::string name = "b" + std::to_string(++bodies_);
    std::string text = "<body name=\"" + name + "\" " + place + ">" + joint;
    const std::size_t count = 2 + random_() % 4;
    for (std::size_t i = 0; i < count; ++i) {
      text += geom(name + (i == 0 ? "" : "-" + std::to_string(i + 1)));
    }
    if (chance(3)) {  // whose mass counts, or not
      text += "<geom type=\"sphere\" size=\"" + inFull(real(0.05, 0.2)) +
              "\" contype=\"0\" conaffinity=\"0\" group=\"" + std::to_string(random_() % 5) + "\" pos=\"" +
              vector(0.1) + "\"/>";
    }
    if (chance(4)) {
      const double least = real(0.1, 1);
      text += "<inertial pos=\"" + vector(0.1) + "\" quat=\"" + numbers(4, 1) + "\" mass=\"" +
              inFull(real(0.5, 3)) + "\" diaginertia=\"" + inFull(least) + " " + inFull(1.3 * least) + " " +
              inFull(1.7 * least) + "\"/>";
    }
    for (std::size_t i = 0; i < inside; ++i) {
      hinges_ += " " + inFull(real(-1, 1));
      hingeSpeeds_ += " " + inFull(real(-2, 2));
      text += body("pos=\"" + vector(1) + "\" quat=\"" + numbers(4, 1) + "\"",
                   "<joint axis=\"" + vector(1) + "\" pos=\"" + vector(0.5) + "\"/>", 0);
    }
    return text + "</body>\n";
  }

  int bodies_ = 0;
  std::string places_;
  std::string speeds_;
  std::string hinges_;  // of the tree that is written
  std::string hingeSpeeds_;
};

}  // namespace careen
