#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <vector>

#include "core/brief.h"
#include "core/math/elementary.h"
#include "core/math/linear_algebra.h"
#include "physics/world/joint.h"
#include "support/random_text.h"

namespace careen {

/// Writes scenes of trees of 1 to 12 boxes that joints of all kinds hold in one another, in the world, or in
/// a fixed box, with masses off the middle, springs, dampers, starts of coordinates that are not 0, and
/// velocities that the joints allow.
class RandomJointed : RandomText {
 public:
  struct With {
    bool limits = false;
    bool loops = false;     ///< also ropes, rods and what closes loops
    bool contacts = false;  ///< boxes that all overlap, of which some pass through each other
  };

  RandomJointed(unsigned seed, With with) : RandomText(seed), with_(with) {}

  std::string text() {
    std::string all = R"({ "careen": 1, "name": "tree", "duration": 0.1, "tolerance": 1e-9, "gravity": [)" +
                      list(random(10)) + "],\n\"boxes\": [";
    const std::size_t count = 2 + random_() % 11;
    for (std::size_t i = 0; i < count; ++i) {
      addBox();
    }
    addFixed();
    if (with_.loops) {
      addLoops();
    }
    for (std::size_t i = 0; i < boxes_.size(); ++i) {
      all += (i == 0 ? "\n" : ",\n") + boxes_[i].text;
    }
    all += "],\n\"joints\": [";
    for (std::size_t i = 0; i < joints_.size(); ++i) {
      all += (i == 0 ? "\n" : ",\n") + joints_[i];
    }
    all += "]";
    if (const std::string lists = passThrough(); !lists.empty()) {
      all += ",\n\"pass_through\": [" + lists + "]";
    }
    return all + " }\n";
  }

 private:
  struct Box {
    std::string name;
    std::string text;
    Vec3 place = Vec3::Zero();
    Vec3 velocity = Vec3::Zero();
    Vec3 spin = Vec3::Zero();

    Vec3 at(const Vec3& where) const { return velocity + spin.cross(Vec3(where - place)); }
  };

  Vec3 random(double most) {
    const double x = real(-most, most);
    const double y = real(-most, most);
    return {x, y, real(-most, most)};
  }
  static std::string list(const Vec3& v) {
    return inFull(v.x()) + ", " + inFull(v.y()) + ", " + inFull(v.z());
  }

  // In one of those before, in the world, or in nothing.
  void addBox() {
    Box box{.name = "box " + std::to_string(boxes_.size()), .text = {}};
    const bool isAlone = boxes_.empty() ? chance(2) : chance(8);
    const bool isInWorld = !isAlone && (boxes_.empty() || chance(6));
    box.place = with_.contacts ? random(0.2) : random(1.5);
    if (isAlone) {
      box.velocity = random(2);
      box.spin = random(2);
    } else {
      join(box, isInWorld ? Box{.name = "world", .text = {}} : boxes_[random_() % boxes_.size()], "");
    }
    const Vec3 half = with_.contacts ? Vec3(real(1, 2), real(1, 2), real(1, 2))
                                     : Vec3(real(0.1, 0.5), real(0.1, 0.5), real(0.1, 0.5));
    const Vec3 axis = random(1);
    box.text = R"({ "name": ")" + box.name + R"(", "half_extents": [)" + list(half) + R"(], "mass": )" +
               inFull(real(0.5, 3)) + R"(, "position": [)" + list(box.place) +
               R"(], "orientation": { "axis": [)" + list(axis) + R"(], "angle_deg": )" +
               inFull(real(-180, 180)) + "}" + inertia(half) + R"(, "velocity": [)" + list(box.velocity) +
               R"(], "angular_velocity": [)" + list(box.spin) + "]" + friction() + " }";
    boxes_.push_back(box);
  }
  std::string inertia(const Vec3& half) {
    if (chance(2)) {
      return "";
    }
    const Vec3 center = Vec3(real(-0.5, 0.5), real(-0.5, 0.5), real(-0.5, 0.5)).cwiseProduct(half);
    return R"(, "center": [)" + list(center) +
           R"(], "inertia": [[0.3, 0.02, -0.01], [0.02, 0.25, 0.03], [-0.01, 0.03, 0.2]])";
  }
  std::string friction() { return with_.contacts && chance(3) ? R"(, "friction": 0.5)" : ""; }

  void addFixed() {
    boxes_.push_back(
        {.name = "post",
         .text =
             R"({ "name": "post", "half_extents": [1, 1, 1], "fixed": true, "position": [0.5, 0.2, 0.1] })",
         .place = {0.5, 0.2, 0.1}});
    if (chance(2)) {
      Box last = boxes_[boxes_.size() - 2];
      Box hung{.name = "hung", .text = {}, .place = with_.contacts ? random(0.2) : random(1.5)};
      join(hung, boxes_.back(), "");
      hung.text = R"({ "name": "hung", "half_extents": [1.1, 1.2, 1.3], "mass": 2, "position": [)" +
                  list(hung.place) + R"(], "velocity": [)" + list(hung.velocity) +
                  R"(], "angular_velocity": [)" + list(hung.spin) + "] }";
      boxes_.push_back(hung);
    }
  }

  // What holds the box moves, and it as the joint lets it.
  void join(Box& box, const Box& holder, const std::string& given) {
    static const std::array<const char*, 4> kTypes = {"hinge", "slider", "ball", "fixed"};
    const std::string type =
        given.empty() ? kTypes[random_() % (holder.name == "world" || holder.name == "post" ? 3 : 4)] : given;
    const Vec3 at = box.place + random(0.4);
    const Vec3 axis = random(1).normalized();
    const double rate = real(-3, 3);
    const bool isFirst = chance(2);
    box.spin = holder.spin;
    Vec3 there = holder.at(at);
    if (type == "hinge") {
      box.spin += (isFirst ? rate : -rate) * axis;
    } else if (type == "ball") {
      box.spin += random(2);
    } else if (type == "slider") {
      there += (isFirst ? rate : -rate) * axis;
    }
    box.velocity = there + box.spin.cross(Vec3(box.place - at));
    addJoint(type, isFirst ? box.name : holder.name, isFirst ? holder.name : box.name, at, axis);
  }

  void addJoint(const std::string& type, const std::string& one, const std::string& other, const Vec3& at,
                const Vec3& axis) {
    std::string text = R"({ "name": "joint )" + std::to_string(joints_.size()) + R"(", "type": ")" + type +
                       R"(", "between": [")" + one + R"(", ")" + other + R"("], "at": [)" + list(at) + "]";
    if (type == "hinge" || type == "slider") {
      const double start = chance(2) ? 0 : real(-1, 1);
      text += R"(, "axis": [)" + list(axis) + R"(], "start": )" + inFull(start);
      if (chance(2)) {
        text += R"(, "spring": { "stiffness": )" + inFull(real(1, 10)) + R"(, "rest": )" +
                inFull(real(-1, 1)) + " }";
      }
      text += chance(2) ? R"(, "damping": )" + inFull(real(0, 2)) : "";
      if (with_.limits && chance(2)) {
        text += R"(, "range": [)" + inFull(chance(3) ? start : start - real(0.1, 1.5)) + ", " +
                inFull(start + real(0.1, 1.5)) + "]";
      }
    }
    joints_.push_back(text + (with_.contacts && chance(3) ? R"(, "collide": true })" : " }"));
  }

  // Of boxes that the velocities do not fit: those are not compared.
  void addLoops() {
    const auto any = [this]() -> const Box& { return boxes_[random_() % boxes_.size()]; };
    const std::size_t count = random_() % 4;
    for (std::size_t i = 0; i < count; ++i) {
      const Box& one = any();
      const Box& other = any();
      if (one.name == other.name || one.name == "post" || other.name == "post") {
        continue;
      }
      const std::size_t kind = random_() % 5;
      if (kind < 2) {
        addJoint(kind == 0 ? "ball" : "fixed", one.name, other.name, one.place + random(0.4), Vec3::UnitZ());
      } else if (kind == 4) {
        joints_.push_back(R"({ "name": "joint )" + std::to_string(joints_.size()) +
                          R"(", "type": "hinge", "between": [")" + one.name + R"(", ")" + other.name +
                          R"("], "at": [)" + list(one.place + random(0.4)) + R"(], "axis": [)" +
                          list(random(1)) + "] }");
      } else {
        joints_.push_back(R"({ "name": "joint )" + std::to_string(joints_.size()) + R"(", "type": ")" +
                          (kind == 2 ? "rod" : "rope") + R"(", "between": [")" + one.name + R"(", ")" +
                          (chance(3) ? "world" : other.name) + R"("], "points": [[)" + list(random(0.3)) +
                          "], [" + list(random(0.3)) + "]] }");
      }
    }
  }

  std::string passThrough() {
    std::string lists;
    if (!with_.contacts) {
      for (const Box& box : boxes_) {
        lists += (lists.empty() ? "[\"" : ", \"") + box.name + "\"";
      }
      return lists + "]";
    }
    for (std::size_t i = 0; i < boxes_.size(); ++i) {
      for (std::size_t j = 0; j < i; ++j) {
        if (chance(4)) {
          lists += (lists.empty() ? "[\"" : ", [\"") + boxes_[i].name + "\", \"" + boxes_[j].name + "\"]";
        }
      }
    }
    return lists;
  }

  With with_;
  std::vector<Box> boxes_;
  std::vector<std::string> joints_;
};

}  // namespace careen
