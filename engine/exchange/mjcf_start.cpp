#include "exchange/mjcf_start.h"

#include <cmath>
#include <cstddef>
#include <numbers>
#include <string>
#include <vector>

#include "core/brief.h"
#include "core/math/elementary.h"
#include "scene/json_tree.h"

namespace careen {
namespace {

std::size_t placesOf(const MjcfJoint& joint) {
  return joint.isFree() ? 7 : joint.isBall() ? 4 : joint.hasCoordinate() ? 1 : 0;
}
std::size_t speedsOf(const MjcfJoint& joint) {
  return joint.isFree() ? 6 : joint.isBall() ? 3 : joint.hasCoordinate() ? 1 : 0;
}

class StartReader {
 public:
  StartReader(MjcfDocument& document, MjcfModel& model) : document_(document), model_(model) {}

  void read() {
    std::size_t places = 0;
    std::size_t speeds = 0;
    for (const MjcfSurface& surface : model_.surfaces) {
      places += surface.movable ? placesOf(surface.joint) : 0;
      speeds += surface.movable ? speedsOf(surface.joint) : 0;
    }
    for (const XmlElement* const keys : document_.sections("keyframe")) {
      for (const XmlElement& key : keys->children) {
        if (key.text("name") != "start") {
          document_.ignore("key " + inQuotes(key.text("name")));
          continue;
        }
        document_.check(key, {"name", "qpos", "qvel", "ctrl"}, {"time"});
        key_ = &key;
        places_ = document_.numbers(key, "qpos", places, places);
        speeds_ = document_.numbers(key, "qvel", speeds, speeds);
        model_.notes.emplace_back("starts from the key frame \"start\"");
      }
    }
    const double* q = places_.empty() ? nullptr : places_.data();
    const double* v = speeds_.empty() ? nullptr : speeds_.data();
    for (MjcfSurface& surface : model_.surfaces) {
      if (surface.movable) {
        place(surface, q);
        move(surface, v);
        q += q == nullptr ? 0 : placesOf(surface.joint);
        v += v == nullptr ? 0 : speedsOf(surface.joint);
        checkStart(surface);
      }
    }
  }

 private:
  const MjcfSurface* movingParent(const MjcfSurface& surface) const {
    return surface.parent && model_.surfaces[*surface.parent].movable ? &model_.surfaces[*surface.parent]
                                                                      : nullptr;
  }

  Quat quaternion(const double* q) const {
    const Quat turn(q[0], q[1], q[2], q[3]);
    if (turn.coeffs().cwiseAbs().maxCoeff() < 1e-14) {
      document_.fail(*key_, *key_->find("qpos"), "quaternions that are not 0");
    }
    return turn.normalized();
  }

  // Without a key frame all stands as it does.
  void place(MjcfSurface& surface, const double* q) const {
    const MjcfJoint& joint = surface.joint;
    surface.coordinate = q != nullptr && joint.hasCoordinate() ? *q : joint.ref;
    if (q == nullptr) {
      return;
    }
    const MjcfSurface* const parent = movingParent(surface);
    MjcfFrame frame = parent == nullptr ? surface.inParent
                                        : parent->body.of(surface.inParent.position, surface.inParent.turn);
    const Vec3 anchor = frame.position + frame.turn * joint.position;
    const double way = surface.coordinate - joint.ref;
    if (joint.isFree()) {
      frame = {Vec3(q[0], q[1], q[2]), quaternion(q + 3)};
    } else if (joint.type == "slide") {
      frame.position += frame.turn * Vec3(way * joint.axis);
    } else if (joint.isBall() || way != 0) {
      frame.turn = (frame.turn * (joint.isBall() ? quaternion(q) : turnAbout(joint.axis, way))).normalized();
      frame.position = anchor - frame.turn * joint.position;
    }
    if (!frame.position.allFinite()) {
      document_.fail(*key_, *key_->find("qpos"), "angles of fewer turns");
    }
    surface.body = frame;
    surface.frame = frame.of(surface.geom.position, surface.geom.turn);
  }
  static Quat turnAbout(const Vec3& unitAxis, double angle) {
    const auto half = elementary::sinCos(angle / 2);
    const Vec3 vector = half.sin * unitAxis;
    return {half.cos, vector.x(), vector.y(), vector.z()};
  }

  // Of a free joint: velocity in the world's frame, angular velocity in the body's. That of a ball is
  // relative to the parent, along the body's axes.
  void move(MjcfSurface& surface, const double* v) const {
    if (v == nullptr) {
      return;
    }
    const MjcfJoint& joint = surface.joint;
    const MjcfFrame& body = surface.body;
    const Vec3 anchor = body.position + body.turn * joint.position;
    Vec3 spin = Vec3::Zero();
    Vec3 velocity = Vec3::Zero();  // of the anchor, or of a body that is not held by one
    const bool turns = joint.isBall() || joint.type == "hinge";
    const Vec3 point = turns ? anchor : body.position;
    if (const MjcfSurface* const parent = movingParent(surface)) {
      spin = parent->angularVelocity;
      velocity = parent->velocity + spin.cross(Vec3(point - parent->frame.position));
    }
    if (joint.isFree()) {
      velocity = Vec3(v[0], v[1], v[2]);
      spin = body.turn * Vec3(v[3], v[4], v[5]);
    } else if (joint.isBall()) {
      spin += body.turn * Vec3(v[0], v[1], v[2]);
    } else if (joint.type == "hinge") {
      spin += *v * (body.turn * joint.axis);
    } else if (joint.type == "slide") {
      velocity += *v * (body.turn * joint.axis);
    }
    surface.angularVelocity = spin;
    surface.velocity = velocity + spin.cross(Vec3(surface.frame.position - point));
  }

  // Coordinates of hinges of scenes are known up to whole turns.
  void checkStart(const MjcfSurface& surface) const {
    const MjcfJoint& joint = surface.joint;
    if (!joint.hasCoordinate()) {
      return;
    }
    const auto fail = [&](const std::string& found, const std::string& expected) {
      document_.fail(*joint.element, found, expected);
    };
    if (std::isnan(elementary::sinCos(surface.coordinate).cos)) {
      fail("a joint that starts at " + brief(surface.coordinate), "an angle of fewer turns");
    }
    const auto [lowest, highest] = joint.range;
    const bool isHinge = joint.type == "hinge";
    if (document_.isLimited(*joint.element, joint.limited, joint.range)) {
      if (!(lowest <= surface.coordinate && surface.coordinate <= highest)) {
        fail("a joint that starts at " + brief(surface.coordinate) + ", out of its range " + brief(lowest) +
                 " to " + brief(highest),
             "a start within it");
      }
      if (isHinge && !(highest - lowest < 2 * std::numbers::pi)) {
        fail("a range of a turn or more", "less than a turn");
      }
    } else if (isHinge && joint.stiffness != 0 &&
               !(std::fabs(surface.coordinate - joint.springRef) < std::numbers::pi)) {
      fail("a spring that rests half a turn or more from the start", "less, or a range");
    }
  }

  MjcfDocument& document_;
  MjcfModel& model_;
  const XmlElement* key_ = nullptr;
  std::vector<double> places_;
  std::vector<double> speeds_;
};

}  // namespace

void readStart(MjcfDocument& document, MjcfModel& model) { StartReader(document, model).read(); }

}  // namespace careen
