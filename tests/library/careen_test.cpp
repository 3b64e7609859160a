// The library beside the program: the same states, impacts, hashes and pictures, to the bit.
#include "library/careen.h"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <sstream>
#include <string>
#include <thread>
#include <vector>

#include "library/beside_program.h"

namespace careen::v1 {
namespace {

const std::filesystem::path kScenes = std::filesystem::path(CAREEN_SOURCE_DIR) / "assets/scenes";

// Rows of a table without its heading; names of boxes and walls become 0.
std::vector<std::vector<double>> rowsOf(const std::filesystem::path& path) {
  std::istringstream stream(textOf(path));
  std::vector<std::vector<double>> rows;
  std::string line;
  std::getline(stream, line);
  while (std::getline(stream, line)) {
    rows.emplace_back();
    std::istringstream cells(line);
    for (std::string cell; std::getline(cells, cell, ',');) {
      char* end = nullptr;
      const double number = std::strtod(cell.c_str(), &end);
      rows.back().push_back(*end == '\0' ? number : 0);
    }
  }
  return rows;
}

using Library = BesideProgram;

// The four gains of the scene, by a function.
TEST_F(Library, asksAControllerAtEachSample) {
  const std::filesystem::path file = kScenes / "pole.json";
  std::vector<double> times;
  std::vector<std::string> names;
  const auto controller = [&](double time, const std::vector<State>& boxes,
                              const std::vector<JointReading>& joints) {
    times.push_back(time);
    names = {joints.at(0).name, joints.at(1).name};
    EXPECT_EQ(boxes.size(), 3U);
    double effort = 0;
    effort -= -2.8295 * joints[0].coordinate + -4.2276 * joints[0].rate;
    effort -= -41.3668 * joints[1].coordinate + -10.1851 * joints[1].rate;
    return std::vector<double>{effort, 0};
  };
  Scene scene = Scene::read(file);
  const v1::Run run = simulate(scene.control(0.02, controller));
  EXPECT_EQ(run.hash(), simulate(Scene::read(file)).hash());
  EXPECT_EQ(names, (std::vector<std::string>{"rail", "pole"}));
  ASSERT_GT(times.size(), 50U);
  EXPECT_EQ(times[50], 50 * 0.02);
  EXPECT_THROW(simulate(scene.control(0.02, [](auto&&...) { return std::vector<double>{1}; })), Error);
  EXPECT_THROW(scene.control(0, controller), Error);
}

TEST_F(Library, givesTheStatesImpactsAndHashesOfTheProgram) {
  for (const char* const name : {"careen", "zeno", "stack"}) {
    const std::string file = kScenes / (std::string(name) + ".json");
    const Ended told =
        program({"simulate", file, "--verbose", "-o", "run.careen", "--poses", "poses.csv", "--impacts",
                 "impacts.csv", "--every", "0.01", "--energy", "energy.csv", "--forces", "forces.csv"});
    const v1::Run run = simulate(Scene::read(file));
    EXPECT_NE(told.out.find("state hash   " + run.hash()), std::string::npos) << run.hash();

    const auto poses = rowsOf(folder_ / "poses.csv");
    ASSERT_GT(poses.size(), 100U);
    ASSERT_EQ(poses.size() % run.boxes().size(), 0U);
    for (std::size_t k = 0; k < poses.size(); ++k) {
      const std::vector<double>& row = poses[k];
      const State state = run.state(k % run.boxes().size(), row[0]);
      const std::vector<double> found = {
          state.position[0],       state.position[1],    state.position[2],        state.orientation[0],
          state.orientation[1],    state.orientation[2], state.orientation[3],     state.velocity[0],
          state.velocity[1],       state.velocity[2],    state.angularVelocity[0], state.angularVelocity[1],
          state.angularVelocity[2]};
      ASSERT_EQ(found, std::vector<double>(row.begin() + 2, row.end())) << name << " row " << k;
    }

    const auto energies = rowsOf(folder_ / "energy.csv");
    ASSERT_GT(energies.size(), 100U);
    std::vector<double> times;  // the library takes them in any order
    for (std::size_t k = energies.size(); k-- > 0;) {
      times.push_back(energies[k][0]);
    }
    const std::vector<Energy> asked = run.energies(times);
    for (std::size_t k = 0; k < energies.size(); ++k) {
      const Energy& e = asked[energies.size() - 1 - k];
      const std::vector<double> found = {energies[k][0],
                                         e.translation,
                                         e.rotation,
                                         e.gravity,
                                         e.springs,
                                         e.jointSprings,
                                         e.total,
                                         e.motors,
                                         e.changes,
                                         e.impacts,
                                         e.jointFriction,
                                         e.damping,
                                         e.drag,
                                         e.remaining,
                                         e.momentum[0],
                                         e.momentum[1],
                                         e.momentum[2],
                                         e.angularMomentum[0],
                                         e.angularMomentum[1],
                                         e.angularMomentum[2]};
      ASSERT_EQ(found, energies[k]) << name << " row " << k;
    }
    EXPECT_EQ(run.energy(times.front()).total, energies.back()[6]);
    EXPECT_THROW(run.energy(-1), Error);
    EXPECT_THROW(run.energies({0, run.duration() + 1}), Error);
    EXPECT_THROW(run.energy(std::nan("")), Error);

    const auto forces = rowsOf(folder_ / "forces.csv");
    const std::vector<Force> pushes = run.forces(std::vector(times.rbegin(), times.rend()));
    ASSERT_EQ(pushes.size(), forces.size());
    for (std::size_t k = 0; k < forces.size(); ++k) {
      const Force& push = pushes[k];
      ASSERT_EQ(push.time, forces[k][0]);
      for (std::size_t axis = 0; axis < 3; ++axis) {
        ASSERT_EQ(push.point[axis], forces[k][3 + axis]) << name << " row " << k;
        ASSERT_EQ(push.normal[axis], forces[k][6 + axis]);
        ASSERT_EQ(push.force[axis], forces[k][9 + axis]);
      }
      ASSERT_EQ(push.left, forces[k][14]);
      ASSERT_FALSE(push.a.empty());
    }
    EXPECT_THROW(run.forces(-1), Error);

    const auto impacts = rowsOf(folder_ / "impacts.csv");
    ASSERT_EQ(impacts.size(), run.impacts().size());
    for (std::size_t k = 0; k < impacts.size(); ++k) {
      const Impact& impact = run.impacts()[k];
      const std::vector<double> found = {impact.time,
                                         0,
                                         0,
                                         impact.point[0],
                                         impact.point[1],
                                         impact.point[2],
                                         impact.normal[0],
                                         impact.normal[1],
                                         impact.normal[2],
                                         impact.approach,
                                         impact.impulse,
                                         impact.tangential};
      ASSERT_EQ(found, impacts[k]) << name << " impact " << k;
    }
    EXPECT_EQ(v1::Run::read(folder_ / "run.careen").hash(), run.hash());
    run.save(folder_ / "saved.careen");
    EXPECT_EQ(textOf(folder_ / "saved.careen"), textOf(folder_ / "run.careen"));
  }
}

// A cube falls from 2 m, e = 0.5: it meets the floor at sqrt(2 h / g), h = 2 - 0.5.
TEST_F(Library, simulatesASceneThatWasBuiltInCode) {
  Scene scene(1.0, {0, 0, -9.81});
  scene.add(Box{.name = "crate", .position = {0, 0, 2}, .restitution = 0.5});
  scene.add(Wall{.name = "floor", .restitution = 0.5});
  const v1::Run run = simulate(scene);
  ASSERT_FALSE(run.impacts().empty());
  const Impact& first = run.impacts().front();
  const double time = std::sqrt(2 * 1.5 / 9.81);
  EXPECT_NEAR(first.time, time, 1e-12);
  EXPECT_EQ(first.a, "crate");
  EXPECT_EQ(first.b, "floor");
  EXPECT_NEAR(first.approach, 9.81 * time, 1e-12);
  EXPECT_NEAR(run.state(0, 0.25).position[2], 2 - 9.81 / 2 * 0.0625, 1e-14);
  EXPECT_NEAR(run.state(0, 0.25).velocity[2], -9.81 * 0.25, 1e-14);
  EXPECT_EQ(run.when("crate touches floor"), std::vector<double>{first.time});
  ASSERT_EQ(run.when("height(crate) < 1").size(), 1U);
  EXPECT_NEAR(run.when("height(crate) < 1")[0], std::sqrt(2 / 9.81), 1e-14);
  EXPECT_TRUE(run.when("rest").empty());
  EXPECT_THROW(static_cast<void>(run.when("height(crat) < 1")), Error);
  EXPECT_EQ(run.boxes(), std::vector<std::string>{"crate"});
  EXPECT_EQ(run.duration(), 1.0);
  // It is the scene that a file with its text is.
  folder_.write("built.json", scene.text());
  EXPECT_EQ(simulate(Scene::read(folder_ / "built.json")).hash(), run.hash());
}

// Gravity that grows from none to 6 m/s² in 2 s, and stays: z = −t³/2 until then, and −4 − 6 s − 3 s² after
// it.
TEST_F(Library, gravityRunsThroughPoints) {
  Scene scene(3.0);
  scene.gravityThrough({{0, {0, 0, 0}}, {2, {0, 0, -6}}}).add(Box{.name = "box"});
  const v1::Run run = simulate(scene);
  EXPECT_NEAR(run.state(0, 1).position[2], -0.5, 1e-15);
  EXPECT_NEAR(run.state(0, 3).position[2], -13, 1e-14);
}

// Euler's equations with a torque-free top: L = I ω keeps its direction, and the middle of the box circles
// the centre of mass, which flies straight.
// On a belt of 2 m/s, with friction of .5 g, a box is .4 m behind it when it has its speed; then gravity is
// off, and it goes on with that.
TEST_F(Library, surfacesMoveAndGravityChanges) {
  Scene scene(2.0);
  scene.gravity({{0, {0, 0, -10}}, {1, {0, 0, 0}}});
  scene.add(Wall{.name = "belt", .friction = 0.5, .surfaceVelocity = {2, 0, 0}});
  scene.add(Box{.name = "parcel", .halfExtents = {0.1, 0.1, 0.1}, .position = {0, 0, 0.1}, .friction = 0.5});
  const v1::Run run = simulate(scene);
  EXPECT_NEAR(run.state(0, 2).position[0], 4 - 0.4, 1e-9);
  EXPECT_NEAR(run.state(0, 2).position[2], 0.1, 1e-9);
  EXPECT_NE(scene.text().find("surface_velocity"), std::string::npos);
  Scene turning(1.0, {0, 0, -10});
  turning.add(
      Box{.name = "table", .halfExtents = {1, 1, 0.1}, .friction = 1, .fixed = true, .surfaceSpin = 3});
  turning.add(Box{.name = "rides",
                  .halfExtents = {0.1, 0.1, 0.1},
                  .position = {0, 0, 0.2},
                  .angularVelocity = {0, 0, 3},
                  .friction = 1});
  EXPECT_NEAR(simulate(turning).state(1, 1).angularVelocity[2], 3, 1e-7);
  EXPECT_THROW(Scene::parse("{}").gravity({{0, {0, 0, 0}}}), Error);
  EXPECT_THROW(Scene::parse("{}").gravityThrough({{0, {0, 0, 0}}}), Error);
  EXPECT_THROW(static_cast<void>(simulate(Scene(1.0).gravity({{1, {0, 0, 0}}}).add(Box{.name = "box"}))),
               SceneError);
}

TEST_F(Library, boxesHaveTheInertiaAndTheCentreThatAreGiven) {
  const Vector center = {0.1, -0.05, 0.02};
  const Vector spin = {1, 2, 3};
  const Tensor inertia = {Vector{0.3, 0.05, 0}, Vector{0.05, 0.4, -0.02}, Vector{0, -0.02, 0.5}};
  Scene scene(1.0, {0, 0, 0});
  scene.add(Box{.name = "die", .mass = 2, .angularVelocity = spin, .inertia = inertia, .center = center});
  scene.add(Box{.name = "top",
                .position = {9, 0, 0},
                .angularVelocity = {0, 0, 1},
                .inertia = diagonal(0.2, 0.3, 0.4)});
  const v1::Run run = simulate(scene);
  const auto turned = [](const Quaternion& q, const Vector& v) {
    const auto cross = [](const Vector& a, const Vector& b) {
      return Vector{a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
    };
    const Vector axis = {q[1], q[2], q[3]};
    const Vector once = cross(axis, v);
    const Vector twice = cross(axis, once);
    return Vector{v[0] + 2 * (q[0] * once[0] + twice[0]), v[1] + 2 * (q[0] * once[1] + twice[1]),
                  v[2] + 2 * (q[0] * once[2] + twice[2])};
  };
  const auto times = [](const Tensor& tensor, const Vector& v) {
    Vector product{};
    for (std::size_t i = 0; i < 3; ++i) {
      product[i] = tensor[i][0] * v[0] + tensor[i][1] * v[1] + tensor[i][2] * v[2];
    }
    return product;
  };
  const Vector momentum = times(inertia, spin);
  // The velocity given is that of the middle: v of the centre of mass is ω × center.
  const Vector drift = {spin[1] * center[2] - spin[2] * center[1], spin[2] * center[0] - spin[0] * center[2],
                        spin[0] * center[1] - spin[1] * center[0]};
  for (const double time : {0.0, 0.3, 1.0}) {
    const State state = run.state(0, time);
    const Quaternion back = {state.orientation[0], -state.orientation[1], -state.orientation[2],
                             -state.orientation[3]};
    const Vector kept = turned(state.orientation, times(inertia, turned(back, state.angularVelocity)));
    const Vector arm = turned(state.orientation, center);
    for (std::size_t i = 0; i < 3; ++i) {
      EXPECT_NEAR(kept[i], momentum[i], 1e-13) << time;
      EXPECT_NEAR(state.position[i] + arm[i], center[i] + time * drift[i], 1e-13) << time;
    }
  }
  // About a principal axis it turns steadily.
  EXPECT_NEAR(2 * std::atan2(run.state(1, 1).orientation[3], run.state(1, 1).orientation[0]), 1, 1e-14);
  EXPECT_THROW(simulate(Scene(1).add(Box{.name = "a", .inertia = diagonal(1, 1, 3)})), SceneError);
  EXPECT_THROW(simulate(Scene(1).add(Box{.name = "a", .center = {0.6, 0, 0}})), SceneError);
}

// Three cubes of 1 m and 1 kg, in an L.
TEST_F(Library, boxesMayHaveSeveralParts) {
  const Vector half = {0.5, 0.5, 0.5};
  const double quarter = std::sqrt(0.5);
  const Box body{
      .name = "corner",
      .mass = 3,
      .position = {0, 0, 4},
      .velocity = {0, 0, 1},
      .angularVelocity = {0, 2, 0},
      .parts = {{.halfExtents = half},
                {.halfExtents = half, .position = {1, 0, 0}},
                {.halfExtents = half, .position = {0, 0, 1}, .orientation = {quarter, 0, 0, quarter}}}};
  const v1::Run run = simulate(Scene(1.0, {0, 0, 0}).add(body));
  // The centre of mass is at (1/3, 0, 1/3), which starts with (0, 0, 1) + (0, 2, 0) × (1/3, 0, 1/3); y is a
  // principal axis, since the body is the same on both of its sides.
  const Vector drift = {2.0 / 3, 0, 1 - 2.0 / 3};
  const State state = run.state(0, 1);
  const double sine = std::sin(2.0);
  const double cosine = std::cos(2.0);
  const Vector arm = {(cosine + sine) / 3, 0, (cosine - sine) / 3};
  const Vector start = {1.0 / 3, 0, 4 + 1.0 / 3};
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_NEAR(state.position[i], start[i] + drift[i] - arm[i], 1e-13) << i;
    EXPECT_NEAR(state.angularVelocity[i], i == 1 ? 2 : 0, 1e-13) << i;
  }
  const Scene same = Scene::parse(R"({ "careen": 1, "duration": 1, "boxes": [ { "name": "corner", "mass": 3,
    "parts": [ { "half_extents": [0.5, 0.5, 0.5] }, { "half_extents": [0.5, 0.5, 0.5], "position": [1, 0, 0] },
               { "half_extents": [0.5, 0.5, 0.5], "position": [0, 0, 1],
                 "orientation": [0.7071067811865476, 0, 0, 0.7071067811865476] } ],
    "position": [0, 0, 4], "velocity": [0, 0, 1], "angular_velocity": [0, 2, 0] } ] })");
  EXPECT_EQ(simulate(same).state(0, 1).position, state.position);
  Box wrong = body;
  wrong.parts[1].halfExtents[2] = 0;
  EXPECT_THROW(simulate(Scene(1).add(wrong)), SceneError);
}

TEST_F(Library, auditsAsTheProgramDoes) {
  const v1::Run run = simulate(Scene::read(kScenes / "zeno.json"));
  const Audit audit = run.audit();
  EXPECT_TRUE(audit.breaches.empty());
  ASSERT_GE(audit.figures.size(), 10U);
  EXPECT_EQ(audit.figures[1].kind, "box_overlap");
  EXPECT_EQ(audit.figures[1].unit, "m");
  program({"simulate", kScenes / "zeno.json", "--report", "report.json"});
  const std::string report = textOf(folder_ / "report.json");
  for (const AuditFigure& figure : audit.figures) {
    EXPECT_NE(report.find('"' + figure.kind + '"'), std::string::npos) << figure.kind;
  }
}

TEST_F(Library, errorsNameThePlace) {
  const auto fault = [](const std::string& text) -> SceneError {
    try {
      simulate(Scene::parse(text, "mine"));
    } catch (const SceneError& error) {
      return error;
    }
    return {"none", "", 0, 0};
  };
  const SceneError unknown = fault("{ \"careen\": 1, \"duration\": 1,\n  \"boxen\": [] }");
  EXPECT_EQ(unknown.file(), "mine") << unknown.what();
  EXPECT_EQ(unknown.line(), 2U);
  EXPECT_EQ(unknown.column(), 3U);
  EXPECT_NE(std::string(unknown.what()).find("boxen"), std::string::npos);
  EXPECT_THROW(Scene::read("nowhere.json"), SceneError);
  EXPECT_THROW(v1::Run::read(kScenes / "careen.json"), SceneError);
  EXPECT_THROW(Scene::read(kScenes / "careen.json").add(Box{}), Error);
  EXPECT_THROW(Scene(1).method("guess"), SceneError);
  for (const double tolerance : {0.0, -1.0, std::nan(""), 1e9}) {
    EXPECT_THROW(Scene(1).tolerance(tolerance), SceneError) << tolerance;
  }
  Scene overlapping(1);
  overlapping.add(Box{}).add(Box{});
  EXPECT_THROW(simulate(overlapping), SceneError);
  EXPECT_THROW(simulate(Scene(1).add(Box{.name = "a", .mass = std::nan("")})), SceneError);
  const v1::Run run = simulate(Scene(1).add(Box{}));
  EXPECT_THROW(static_cast<void>(run.state(1, 0)), Error);
  for (const double time : {-1e-9, 1.0000001, std::nan("")}) {
    EXPECT_THROW(static_cast<void>(run.state(0, time)), Error) << time;
  }
  EXPECT_THROW(run.save("no/such/folder/run.careen"), Error);
}

TEST_F(Library, methodAndToleranceReplaceThoseOfTheScene) {
  const std::string file = kScenes / "careen.json";
  for (const char* const method : {"exact", "listing1", "taylor-8"}) {
    const Ended told = program({"simulate", file, "--verbose", "--method", method});
    EXPECT_NE(told.out.find("state hash   " + simulate(Scene::read(file).method(method)).hash()),
              std::string::npos);
  }
  const std::string stack = kScenes / "stack.json";
  const Ended told = program({"simulate", stack, "--verbose", "--tolerance", "1e-4"});
  EXPECT_NE(told.out.find("state hash   " + simulate(Scene::read(stack).tolerance(1e-4)).hash()),
            std::string::npos);
}

TEST_F(Library, threadsOfACrowdChangeNoBit) {
  Scene pour(0.6);
  pour.add(Wall{});
  for (int k = 0; k < 120; ++k) {  // more than go on in exact contact
    Box box;
    box.halfExtents = {0.1, 0.1, 0.1};
    box.position = {0.21 * (k % 6), 0.21 * (k / 6 % 5), 0.15 + 0.25 * (k / 30)};
    box.angularVelocity = {1, 0.1 * (k % 7), 0};
    box.friction = 0.5;
    pour.add(box);
  }
  const std::string one = simulate(pour).hash();
  EXPECT_EQ(simulate(pour.threads(3)).hash(), one);
  EXPECT_THROW(pour.threads(0), Error);
  EXPECT_THROW(pour.threads(65), Error);
}

TEST_F(Library, simulatesInSeveralThreadsAtOnce) {
  std::vector<std::string> alone;
  const std::vector<std::string> names = {"careen", "zeno", "hecker-1997", "housner"};
  for (const std::string& name : names) {
    alone.push_back(simulate(Scene::read(kScenes / (name + ".json"))).hash());
  }
  std::vector<std::string> together(names.size());
  std::vector<std::thread> threads;
  for (std::size_t i = 0; i < names.size(); ++i) {
    threads.emplace_back([&, i] {
      const v1::Run run = simulate(Scene::read(kScenes / (names[i] + ".json")));
      together[i] = run.audit().breaches.empty() ? run.hash() : "broken";
    });
  }
  for (std::thread& thread : threads) {
    thread.join();
  }
  EXPECT_EQ(together, alone);
}

// What else it is made from stays within: another version of it may be in the same process.
TEST_F(Library, showsNothingButItsHeader) {
  const Ended symbols =
      Process({"nm", "--dynamic", "--defined-only", "--demangle", CAREEN_SHARED_LIBRARY}, folder_.path())
          .wait();
  std::istringstream lines(symbols.out);
  int seen = 0;
  for (std::string line; std::getline(lines, line); ++seen) {
    EXPECT_NE(line.find("careen::v1::"), std::string::npos) << line;
  }
  EXPECT_GT(seen, 20) << symbols.err;
}

}  // namespace
}  // namespace careen::v1
