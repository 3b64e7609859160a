// Bodies of several boxes as they are read here and by MuJoCo, and as they come back.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iostream>
#include <random>
#include <string>

#include "core/brief.h"
#include "exchange/export_mjcf.h"
#include "exchange/import_mjcf.h"
#include "scene/plan.h"
#include "scene/scene_reader.h"
#include "support/in_mujoco.h"
#include "support/input_error.h"
#include "support/random_mjcf_parts.h"
#include "trajectory/trajectory.h"

namespace careen {
namespace {

void keepMost(double& of, double found) { of = found <= of ? of : found; }  // NaN counts

Mat3 matrixFrom(const mjtNum* m) {
  Mat3 matrix;
  matrix << m[0], m[1], m[2], m[3], m[4], m[5], m[6], m[7], m[8];
  return matrix;
}

Scene importedScene(const std::string& xml) {
  return parseScene(importMjcf(xml, "m.xml").text, "m.xml (its scene)", Starts::kMayOverlap);
}

std::string geomOfPart(const Body& body, int part) {
  return part == 0 ? body.name : body.name + "-" + std::to_string(part + 1);
}

/// The largest differences between MuJoCo's bodies and those of a world.
struct PartDifferences {
  double place = 0;     // [m] of geoms
  double attitude = 0;  // of geoms
  double size = 0;      // [m]
  double mass = 0;      // relative
  double center = 0;    // [m]
  double inertia = 0;   // relative
  double moments = 0;   // relative
  int bodies = 0;
  int parts = 0;

  void compareGeom(const Body& body, int part, const mjModel& model, const mjData& data) {
    const int geom = mj_name2id(&model, mjOBJ_GEOM, geomOfPart(body, part).c_str());
    ASSERT_GE(geom, 0) << body.name << " " << part;
    const Pose pose = partPose(body, part, boxPose(body, body.initial.pose));
    keepMost(place, (pose.position - Eigen::Map<const Vec3>(data.geom_xpos + 3 * geom)).norm());
    keepMost(attitude, (pose.worldFromBody - matrixFrom(data.geom_xmat + 9 * geom)).norm());
    keepMost(size, (partHalfExtents(body, part) - Eigen::Map<const Vec3>(model.geom_size + 3 * geom)).norm());
    ++parts;
  }

  void compare(const Body& body, const InMujoco& other) {
    const mjModel& model = *other.model;
    const mjData& data = *other.data;
    for (int part = 0; part < body.partCount(); ++part) {
      compareGeom(body, part, model, data);
    }
    const int id = other.body(body.name);
    ASSERT_GE(id, 0) << body.name;
    if (isImmovable(body.mass)) {
      return;
    }
    ++bodies;
    keepMost(mass, std::fabs(body.mass.mass / model.body_mass[id] - 1));
    keepMost(center, (body.initial.pose.position - Eigen::Map<const Vec3>(data.xipos + 3 * id)).norm());
    const Mat3 axes = matrixFrom(data.ximat + 9 * id);
    const Mat3 there =
        axes * Eigen::Map<const Vec3>(model.body_inertia + 3 * id).asDiagonal() * axes.transpose();
    const Mat3& turn = body.initial.pose.worldFromBody;
    const Mat3 here = turn * body.mass.inertiaTensor() * turn.transpose();
    keepMost(inertia, (here - there).norm() / there.norm());
    Vec3 own = body.mass.inertiaBody;
    Vec3 others = Eigen::Map<const Vec3>(model.body_inertia + 3 * id);
    std::sort(own.begin(), own.end());
    std::sort(others.begin(), others.end());
    keepMost(moments, (own - others).norm() / others.norm());
  }

  void print() const {
    std::cout << bodies << " bodies, " << parts << " parts: place " << place << " attitude " << attitude
              << " size " << size << " mass " << mass << " centre " << center << " inertia " << inertia
              << " moments " << moments << '\n';
  }
};

TEST(ImportMjcfParts, severalGeomsAreOneBoxOfParts) {
  const ImportedScene found = importMjcf(R"(<mujoco><worldbody><body name="hammer" pos="0 0 1"><freejoint/>
      <geom type="box" size="0.5 0.1 0.1" mass="1" rgba="1 0 0 1"/>
      <geom type="box" size="0.1 0.3 0.1" pos="0.5 0 0" quat="0 1 0 0" mass="3" rgba="0 1 0 1"/></body></worldbody></mujoco>)",
                                         "m.xml");
  // About their centre at 3/8: m/3 (y² + z²), and the arms −3/8 and 1/8: 9/64 + 3/64.
  const Scene scene = parseScene(found.text, "s");
  ASSERT_EQ(scene.boxes.size(), 1U);
  const SceneBox& box = scene.boxes[0];
  EXPECT_EQ(box.parts.size(), 2U);
  EXPECT_EQ(box.mass, 4);
  EXPECT_EQ(box.center, Vec3(0.375, 0, 0));
  const Vec3 expected(0.02 / 3 + 0.1, 0.26 / 3 + 0.02 + 0.1875, 0.26 / 3 + 0.1 + 0.1875);
  EXPECT_LT((Mat3(*box.inertia) - Mat3(expected.asDiagonal())).norm(), 1e-15);
  EXPECT_EQ(box.color.red, 255);
  EXPECT_EQ(box.color.green, 0);
  EXPECT_EQ(found.notes.back(), "ignored: geom colours of one body but the first");
  EXPECT_NE(found.text.find(R"("parts":[{"half_extents":[0.5,0.1,0.1],"position":[0.0,0.0,0.0]},)"),
            std::string::npos)
      << found.text;
}

TEST(ImportMjcfParts, randomBodiesAreWhatMujocoTakesThemFor) {
  PartDifferences found;
  for (unsigned seed = 0; seed < 200; ++seed) {
    const std::string xml = RandomMjcfParts(seed).text();
    RunSetup setup;
    ASSERT_NO_THROW(setup = setupOf(importedScene(xml))) << seed << "\n" << xml;
    InMujoco other(xml);
    mj_kinematics(other.model.get(), other.data.get());
    mj_comPos(other.model.get(), other.data.get());
    ASSERT_EQ(other.model->nbody, static_cast<int>(setup.world.bodies.size()) + 1) << xml;
    for (const Body& body : setup.world.bodies) {
      ASSERT_FALSE(body.parts.empty()) << xml;
      found.compare(body, other);
    }
    ASSERT_LT(std::max({found.place, found.attitude, found.mass, found.center, found.moments}), 1e-6)
        << seed << "\n"
        << xml;
  }
  found.print();
  EXPECT_GT(found.bodies, 400);
  EXPECT_LT(found.place, 1e-13);  // measured: 2.8e-14, 200 m from the origin
  EXPECT_LT(found.attitude, 1e-14);
  EXPECT_EQ(found.size, 0);
  EXPECT_LT(found.mass, 2e-15);
  EXPECT_LT(found.center, 1e-13);
  EXPECT_LT(found.inertia, 5e-6) << "MuJoCo finds axes of several geoms to 1e-6";  // 1.1e-6
  EXPECT_LT(found.moments, 5e-12);                                                 // 1.5e-12
}

// Attitudes of MuJoCo are of second order in its step; its axes of inertia are off by 1e-6.
TEST(ImportMjcfParts, randomBodiesMoveAsInMujoco) {
  double mostOff = 0;
  double mostRatio = 0;
  for (unsigned seed = 0; seed < 200; ++seed) {
    const std::string xml = RandomMjcfParts(seed).text();
    Scene scene = importedScene(xml);
    scene.settings.duration = 0.1;
    scene.settings.tolerance = 1e-9;
    const Trajectory run = record(setupOf(scene));
    const auto error = [&](double step) {
      InMujoco other(xml);
      other.model->opt.timestep = step;
      other.model->opt.integrator = mjINT_RK4;
      other.stepTo(0.1);
      double off = 0;
      for (std::size_t i = 0; i < run.world.bodies.size(); ++i) {
        const Body& body = run.world.bodies[i];
        for (int part = 0; part < body.partCount(); ++part) {
          const int geom = mj_name2id(other.model.get(), mjOBJ_GEOM, geomOfPart(body, part).c_str());
          const Pose pose = partPose(body, part, run.boxPoseAt(i, 0.1));
          keepMost(off, (pose.position - Eigen::Map<const Vec3>(other.data->geom_xpos + 3 * geom)).norm());
        }
      }
      return off;
    };
    const double coarse = error(4e-3);
    const double fine = error(1e-3);
    keepMost(mostOff, fine);
    keepMost(mostRatio, coarse > 1e-6 ? fine / coarse : 0);
    ASSERT_LT(fine, 1e-3) << seed << "\n" << xml;
  }
  std::cout << "after 0.1 s " << mostOff << " ratio " << mostRatio << '\n';
  EXPECT_LT(mostOff, 1e-6);  // measured: 2.2e-7
  EXPECT_LT(mostRatio, 0.1);
}

// ---- Out and in again

/// Scenes of boxes of one part and of several, of one friction or of many, some of them fixed.
class RandomParts : RandomText {
 public:
  explicit RandomParts(unsigned seed) : RandomText(seed) {}

  std::string text() {
    isOneFriction_ = chance(2);
    std::string boxes;
    const std::size_t count = 1 + random_() % 4;
    for (std::size_t i = 0; i < count; ++i) {
      boxes += (i == 0 ? "" : ",\n") + box(i);
    }
    return R"({"careen": 1, "duration": 1, "gravity": )" + list(3, 10) +
           R"(, "walls": [{"name": "floor", "point": [0, 0, -99], "normal": [0, 0, 1], "friction": )" +
           friction() + "}], \"boxes\": [" + boxes + "]}";
  }

 private:
  std::string list(int count, double most) {
    std::string text = "[";
    for (int i = 0; i < count; ++i) {
      text += (i == 0 ? "" : ", ") + inFull(real(-most, most));
    }
    return text + "]";
  }
  std::string sizes() {
    return "[" + inFull(real(0.1, 0.5)) + ", " + inFull(real(0.1, 0.5)) + ", " + inFull(real(0.1, 0.5)) + "]";
  }
  std::string friction() { return isOneFriction_ ? "0.5" : inFull(real(0.1, 1)); }

  std::string box(std::size_t index) {
    // A name that is like that of a part.
    std::string text =
        "{\"name\": \"" + std::string(index == 1 ? "b0-2" : "b" + std::to_string(index)) + "\", ";
    std::size_t count = 0;
    if (chance(4)) {
      text += "\"half_extents\": " + sizes();
    } else {
      count = 1 + random_() % 5;
      text += "\"parts\": [";
      for (std::size_t i = 0; i < count; ++i) {
        text += (i == 0 ? "" : ", ") + std::string("{\"half_extents\": ") + sizes() +
                ", \"position\": " + list(3, 0.4) + (chance(3) ? "" : ", \"orientation\": " + list(4, 1)) +
                "}";
      }
      text += "]";
    }
    const bool isFixed = index > 0 && chance(4);
    text += isFixed ? ", \"fixed\": true" : ", \"mass\": " + inFull(real(0.5, 4));
    if (!isFixed && count != 1 && chance(3)) {  // one box comes back in its own frame
      text +=
          R"(, "center": [0.01, -0.02, 0.03], "inertia": [[0.5, 0.02, -0.01], [0.02, 0.6, 0.03], [-0.01, 0.03, 0.7]])";
    }
    text += ", \"position\": [" + inFull(10.0 * static_cast<double>(index)) +
            ", 1, 2], \"orientation\": " + list(4, 1);
    return text + (isFixed ? "" : ", \"velocity\": " + list(3, 2) + ", \"angular_velocity\": " + list(3, 2)) +
           ", \"friction\": " + friction() + "}";
  }

  bool isOneFriction_ = true;
};

TEST(ImportMjcfParts, whatIsExportedComesBack) {
  double place = 0;
  double speed = 0;
  double mass = 0;
  double friction = 0;
  int several = 0;
  int fixed = 0;
  for (unsigned seed = 0; seed < 200; ++seed) {
    const std::string text = RandomParts(seed).text();
    const RunSetup before = setupOf(parseScene(text, "s"));
    const std::string xml = encodeMjcf(before, "test").text;
    RunSetup after;
    ASSERT_NO_THROW(after = setupOf(importedScene(xml))) << text << "\n" << xml;
    std::size_t at = 0;
    const auto next = [&]() -> const Body& { return after.world.bodies.at(at++); };
    std::vector<std::size_t> asBefore;
    for (const Body& one : before.world.bodies) {
      const Pose box = boxPose(one, one.initial.pose);
      if (isImmovable(one.mass)) {  // each of its boxes is one that does not move
        for (int part = 0; part < one.partCount(); ++part) {
          const Body& other = next();
          ASSERT_TRUE(isImmovable(other.mass));
          const Pose pose = partPose(one, part, box);
          keepMost(place, (pose.position - other.initial.pose.position).norm());
          keepMost(place, (pose.worldFromBody - other.initial.pose.worldFromBody).norm());
          EXPECT_EQ(partHalfExtents(one, part), other.halfExtents);
        }
        asBefore.push_back(at - 1);
        ++fixed;
        continue;
      }
      const Body& other = next();
      asBefore.push_back(at - 1);
      EXPECT_EQ(one.name, other.name);
      ASSERT_EQ(one.partCount(), other.partCount()) << text << "\n" << xml;
      several += one.partCount() > 1 ? 1 : 0;
      for (int part = 0; part < one.partCount(); ++part) {
        const Pose here = partPose(one, part, box);
        const Pose there = partPose(other, part, boxPose(other, other.initial.pose));
        keepMost(place, (here.position - there.position).norm());
        keepMost(place, (here.worldFromBody - there.worldFromBody).norm());
        EXPECT_EQ(partHalfExtents(one, part), partHalfExtents(other, part));
      }
      keepMost(place, (one.initial.pose.position - other.initial.pose.position).norm());
      EXPECT_EQ(one.mass.mass, other.mass.mass);
      const Mat3 inertia = one.initial.pose.worldFromBody * one.mass.inertiaTensor() *
                           one.initial.pose.worldFromBody.transpose();
      const Mat3 again = other.initial.pose.worldFromBody * other.mass.inertiaTensor() *
                         other.initial.pose.worldFromBody.transpose();
      keepMost(mass, (inertia - again).norm() / inertia.norm());
      keepMost(speed, (one.initial.velocity - other.initial.velocity).norm());
      keepMost(speed,
               (angularVelocity(one.mass, one.initial) - angularVelocity(other.mass, other.initial)).norm());
    }
    EXPECT_EQ(at, after.world.bodies.size());
    for (std::size_t a = 0; a < asBefore.size(); ++a) {
      const Body& one = before.world.bodies[a];
      const Material& again = after.world.bodies[asBefore[a]].material;
      if (isImmovable(one.mass)) {
        continue;
      }
      keepMost(friction, std::fabs(touching(one.material, before.world.walls[0].material).friction -
                                   touching(again, after.world.walls[0].material).friction));
      for (std::size_t b = 0; b < asBefore.size(); ++b) {
        keepMost(friction,
                 a == b ? 0
                        : std::fabs(touching(one.material, before.world.bodies[b].material).friction -
                                    touching(again, after.world.bodies[asBefore[b]].material).friction));
      }
    }
    InMujoco other(xml);
    mj_kinematics(other.model.get(), other.data.get());
    ASSERT_EQ(other.model->nbody, static_cast<int>(before.world.bodies.size()) + 1);
  }
  std::cout << several << " of several, " << fixed << " fixed: place " << place << " speed " << speed
            << " inertia " << mass << " friction " << friction << '\n';
  EXPECT_GT(several, 200);
  EXPECT_GT(fixed, 40);
  EXPECT_LT(place, 1e-14);
  EXPECT_LT(speed, 1e-13);
  EXPECT_LT(mass, 1e-14);
  EXPECT_LT(friction, 1e-14);
}

// ---- Contacts

std::string twoBodies(const std::string& contacts) {
  const auto body = [](const std::string& name) {
    return "<body name=\"" + name + "\"><freejoint/><geom name=\"" + name +
           R"(1" type="box" size="1 1 1"/><geom name=")" + name +
           R"(2" type="box" size="1 1 1" pos="1 0 0"/></body>)";
  };
  return "<mujoco><worldbody><geom name=\"floor\" type=\"plane\"/>" + body("a") + body("b") +
         "</worldbody>\n<contact>\n" + contacts + "</contact></mujoco>";
}
std::string pairElement(const std::string& a, const std::string& b, const std::string& friction) {
  return "<pair geom1=\"" + a + "\" geom2=\"" + b + "\" friction=\"" + friction + " " + friction + "\"/>\n";
}

TEST(ImportMjcfParts, pairsNameAllGeomsOfTwoBodies) {
  const std::string all = pairElement("a1", "floor", "0.25") + pairElement("floor", "a2", "0.25") +
                          pairElement("a1", "b1", "0.25") + pairElement("b2", "a1", "0.25") +
                          pairElement("a2", "b1", "0.25") + pairElement("a2", "b2", "0.25");
  const Scene scene = importedScene(twoBodies(all + pairElement("a1", "a2", "3")));
  const Material floor = scene.walls[0].material;
  EXPECT_NEAR(touching(scene.boxes[0].material, floor).friction, 0.25, 1e-15);
  EXPECT_NEAR(touching(scene.boxes[1].material, floor).friction, 1, 1e-15);
  EXPECT_NEAR(touching(scene.boxes[0].material, scene.boxes[1].material).friction, 0.25, 1e-15);
  const auto refusal = [](const std::string& contacts) {
    return inputErrorOf([&] { importMjcf(twoBodies(contacts), "m.xml"); });
  };
  EXPECT_EQ(refusal(pairElement("a1", "floor", "0.25")),
            "m.xml:3:2: found 1 pairs of geoms of \"floor\" and \"a\", expected none, or all 2");
  EXPECT_EQ(
      refusal(pairElement("a1", "floor", "0.25") + pairElement("floor", "a2", "0.5")),
      "m.xml:4:2: found a friction of 0.5 where other geoms of the two bodies have 0.25, expected one for "
      "all geoms of two bodies");
}

}  // namespace
}  // namespace careen
