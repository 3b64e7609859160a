#include "scene/scene_check.h"

#include <gtest/gtest.h>

#include <optional>
#include <string>
#include <vector>

#include "scene/scene_reader.h"
#include "support/input_error.h"
#include "support/scenes.h"

namespace careen {
namespace {

std::string sceneErrorOf(const std::string& text) {
  return inputErrorOf([&text] { parseScene(text, "f"); });
}

const std::vector<BadPiece> kBadScenes = {
    {R"("friction": 0.125)", R"("surface_velocity": @[1, 0, 0])",
     R"(found a surface_velocity that leaves wall "ramp", expected one along the wall)"},
    {R"("friction": 0.5, "fixed": false)", R"("surface_spin": @1)",
     R"(found surface_spin for box "crate", which is not fixed, expected it for fixed boxes and walls only)"},
    {R"("friction": 0.5, "fixed": false)", R"("surface_velocity": @[0, 0, 0])",
     R"(found surface_velocity for box "crate", which is not fixed, expected it for fixed boxes and walls only)"},
    {"[0, 0, -9.81]", R"({ "path": [[@1, 0, 0, -9.81]] })",
     "found 1 for gravity.path[0][0], expected 0, the start"},
    {"[0, 0, -9.81]", R"({ "path": [[0, 0, 0, -9.81], [1, 0, 0, 0], [@1, 0, 0, 1]] })",
     "found 1 for gravity.path[2][0], expected a time after that of the point before"},
    {R"("max": [3, 2, 4])", R"("max": [3, @-2, 4])",
     "found -2 for room.max[1], expected more than room.min[1], which is -2"},
    {R"("max": [3, 2, 4])", R"("max": [3, 2, @-4.5])",
     "found -4.5 for room.max[2], expected more than room.min[2], which is 0"},
    {R"("ramp")", R"(@"room-z")",
     R"(found "room-z" for walls[0], expected another name: a wall of the room has this one)"},
    {R"("crate", "half)", R"(@"room+z", "half)",
     R"(found "room+z" for boxes[0], expected another name: a wall of the room has this one)"},
    {R"("crate", "half)", R"(@"ramp", "half)",
     R"(found "ramp" for boxes[0], expected another name: walls[0] has this one)"},
    {R"("post", "half)", R"(@"crate", "half)",
     R"(found "crate" for boxes[2], expected another name: boxes[0] has this one)"},
    {R"("post", "half)", R"(@"box-1", "half)",
     R"(found "box-1" for boxes[2], expected another name: boxes[1] has this one)"},
    {R"("velocity": [0, 0, 0])", R"("velocity": @[0, 0, -1])",
     R"(found velocity for the fixed box "post", expected none, as it stays where it is)"},
    {R"("velocity": [0, 0, 0])", R"("angular_velocity": @[0, 0, -1])",
     R"(found angular_velocity for the fixed box "post", expected none, as it stays where it is)"},
    {R"(["crate", [0.5, 0.25, 0.125]])", R"([@"create", [0.5, 0.25, 0.125]])",
     R"(found no box of the name "create", expected "crate")"},
    {R"(["post", [0, 0, 0.1]])", R"([@"elephant", [0, 0, 0.1]])",
     R"(found no box of the name "elephant", expected the name of a box of the scene)"},
    {R"(["post", [0, 0, 0.1]])", R"([@"ramp", [0, 0, 0.1]])",
     R"(found no box of the name "ramp", expected the name of a box of the scene)"},
    {R"(["post", [0, 0, 0.1]])", R"(@["box-1", [0, 0, 0.1]])",
     "found a spring from a box to itself, expected two ends that can move apart"},
    {R"(["crate", [0.5, 0.25, 0.125]], "to": [-1.5, 0, 3])", R"([0, 0, 0], "to": @[-1.5, 0, 3])",
     "found a spring from the world to the world, expected two ends that can move apart"},
    {R"("follow": "crate")", R"("follow": @"crte")", R"(found no box of the name "crte", expected "crate")"},
    {R"("follow": "crate")", R"("follow": @"ramp")",
     R"(found no box of the name "ramp", expected the name of a box of the scene)"},
    // The crate is turned by 90° about z: 0.25 m along x, 0.5 m along y, 0.125 m along z.
    {"[1, 0.5, 2]", "@[2.875, 0.5, 2]",
     R"(found box "crate" 0.125 m behind wall "room+x", expected a start on the wall's free side)"},
    {"[1, 0.5, 2]", "@[1, 1.75, 2]",
     R"(found box "crate" 0.25 m behind wall "room+y", expected a start on the wall's free side)"},
    {"[1, 0.5, 2]", "@[1, 0.5, 0]",
     R"(found box "crate" 0.125 m behind wall "room-z", expected a start on the wall's free side)"},
    {"[1, 0.5, 2]", "@[1, 0.5, 100]",
     R"(found box "crate" 96.12 m behind wall "wall-1", expected a start on the wall's free side)"},
    // Ramp through (-3, 0, 1) with normal (1, 0, 2)/√5: the gap is (0.5 + 2·-0.6 - 0.1 - 0.2)/√5.
    {"[2, 1, 0.5]", "@[-2.5, 1, 0.4]",
     R"(found box "post" 0.4472 m behind wall "ramp", expected a start on the wall's free side)"},
};

TEST(SceneCheck, badScenesAreToldWhereAndWhy) {
  for (const BadPiece& bad : kBadScenes) {
    const MarkedText marked(everyKeyBut(bad.piece, bad.instead));
    EXPECT_EQ(sceneErrorOf(marked.text), "f:" + marked.place + ": " + bad.message);
  }
}

std::string withBoxes(const std::string& boxes) {
  return R"({"careen": 1, "duration": 1, "room": {"min": [-2, -2, 0], "max": [2, 2, 4]}, "boxes": [)" +
         boxes + "]}";
}

TEST(SceneCheck, namesForWantOfOneAreNamesToo) {
  const MarkedText marked(
      withBoxes(R"({"name": "box-1", "half_extents": [1, 1, 1], "mass": 1, "position": [0, 0, 1]},
    @{"half_extents": [1, 1, 1], "mass": 1, "position": [0, 0, 1]})"));
  EXPECT_EQ(sceneErrorOf(marked.text), "f:" + marked.place +
                                           R"(: found "box-1" for boxes[1], its name for want of one, )"
                                           "expected another name: boxes[0] has this one");
}

TEST(SceneCheck, massesMadeByDensityKeepToTheRange) {
  const MarkedText heavy(
      withBoxes(R"({"half_extents": [1, 1, 1], "density": @1e60, "position": [0, 0, 1]})"));
  EXPECT_EQ(sceneErrorOf(heavy.text), "f:" + heavy.place +
                                          R"(: found 1e60 for the density of box "box-0", whose mass it )"
                                          "makes 8e+60 kg, expected a mass from 1e-60 "
                                          "to 1e60 kg");
  const MarkedText light(
      withBoxes(R"({"half_extents": [1e-9, 1e-9, 1e-9], "density": @1e-40, "position": [0, 0, 1]})"));
  EXPECT_NE(sceneErrorOf(light.text).find("f:" + light.place + ": found 1e-40 for the density"),
            std::string::npos);
}

// What is said of the marked place of a box; whole if it is said of another place.
std::string errorAtMark(const std::string& box) {
  const MarkedText marked(withBoxes(box));
  const std::string error = sceneErrorOf(marked.text);
  const std::string place = "f:" + marked.place + ": ";
  return error.starts_with(place) ? error.substr(place.size()) : error;
}

TEST(SceneCheck, theCentreOfMassLiesInsideTheBox) {
  const auto errorOf = [](const std::string& center) {
    return errorAtMark(R"({"half_extents": [0.5, 0.6, 0.7], "mass": 1, "position": [0, 0, 1], "center": )" +
                       center + "}");
  };
  EXPECT_EQ(errorOf("@[0.49, -0.59, 0.69]"), "no error");
  EXPECT_EQ(errorOf("[0, @-0.6, 0]"),
            "found -0.6 for center[1] of box \"box-0\", whose half extent is 0.6 m, expected a centre of "
            "mass inside "
            "the box");
  const MarkedText fixed(withBoxes(
      R"({"half_extents": [1, 1, 1], "fixed": true, "position": [0, 0, 1], "center": @[0.1, 0, 0]})"));
  EXPECT_EQ(sceneErrorOf(fixed.text),
            "f:" + fixed.place +
                R"(: found center for the fixed box "box-0", expected none, as it stays )"
                "where it is");
}

TEST(SceneCheck, inertiaIsThatOfSomeBody) {
  const auto errorOf = [](const std::string& inertia) {
    return errorAtMark(R"({"half_extents": [1, 1, 1], "mass": 1, "position": [0, 0, 1], "inertia": @)" +
                       inertia + "}");
  };
  EXPECT_EQ(errorOf("[1, 2, 2.5]"), "no error");
  EXPECT_EQ(errorOf("[1, 2, 3]"), "no error");  // a flat plate
  EXPECT_EQ(errorOf("[[1, 0, 0], [0, 2, 0], [0, 0, 2.5]]"), "no error");
  EXPECT_EQ(
      errorOf("[1, 2, 3.5]"),
      "found the inertia of box \"box-0\" with moments 1, 2, 3.5 kg m², expected no moment of inertia above "
      "the sum of the two others, 3 kg m²");
  EXPECT_EQ(errorOf("[[1, 0, 0], [0, -2, 0], [0, 0, 2.5]]"),
            "found the inertia of box \"box-0\" with moments 1, -2, 2.5 kg m², expected moments of inertia "
            "that are "
            "positive");
  EXPECT_EQ(errorOf("[[1, 0.5, 0], [0.5, 2, 0], [0, 0, 2.5]]"), "no error");
  EXPECT_EQ(errorOf("[[1, 0.5, 0], [0.4, 2, 0], [0, 0, 2.5]]"),
            "found the inertia of box \"box-0\" with rows 1, 0.5, 0; 0.4, 2, 0; 0, 0, 2.5 kg m², expected a "
            "symmetric tensor");
  // Principal moments 0.5, 1.5 and 2.5.
  EXPECT_EQ(errorOf("[[1, 0.5, 0], [0.5, 1, 0], [0, 0, 2.5]]")
                    .find("expected no moment of inertia above the "
                          "sum of the two others, 2 kg m²") == std::string::npos,
            false);
  const MarkedText fixed(withBoxes(
      R"({"half_extents": [1, 1, 1], "fixed": true, "position": [0, 0, 1], "inertia": @[1, 1, 1]})"));
  EXPECT_EQ(sceneErrorOf(fixed.text),
            "f:" + fixed.place +
                R"(: found inertia for the fixed box "box-0", expected none, as it )"
                "stays where it is");
}

TEST(SceneCheck, boxWithoutAPositionIsToldAtItsBrace) {
  const MarkedText marked(withBoxes(R"(@{"half_extents": [1, 1, 1], "mass": 1})"));
  EXPECT_EQ(sceneErrorOf(marked.text),
            "f:" + marked.place +
                R"(: found box "box-0" 1 m behind wall "room-z", expected a start on the wall's free side)");
}

// The second, turned by 45 degrees about z, reaches √2/2 m towards the first.
TEST(SceneCheck, boxesThatCanMeetStartApart) {
  const std::string first = R"({"half_extents": [0.5, 0.5, 0.5], "mass": 1, "position": [0, 0, 1]})";
  const std::string turned = R"(, "orientation": {"axis": [0, 0, 1], "angle_deg": 45}})";
  const MarkedText inside(withBoxes(
      first + R"(, {"half_extents": [0.5, 0.5, 0.5], "mass": 1, "position": @[1.125, 0, 1])" + turned));
  EXPECT_EQ(
      sceneErrorOf(inside.text),
      "f:" + inside.place +
          R"(: found box "box-1" 0.08211 m inside box "box-0", expected a start outside every other box)");
  EXPECT_EQ(
      sceneErrorOf(withBoxes(
          first + R"(, {"half_extents": [0.5, 0.5, 0.5], "mass": 1, "position": [1.2072, 0, 1])" + turned)),
      "no error");
  // Touching, and two that stay where they are.
  EXPECT_EQ(sceneErrorOf(withBoxes(
                first + R"(, {"half_extents": [0.5, 0.5, 0.1], "mass": 1, "position": [0, 0, 1.6]})")),
            "no error");
  const std::string held = R"({"half_extents": [0.5, 0.5, 0.5], "fixed": true, "position": [0, 0, 1]})";
  EXPECT_EQ(sceneErrorOf(withBoxes(held + ", " + held)), "no error");
  // By the 1997 method boxes pass through one another.
  std::string of1997 = inside.text;
  of1997.insert(1, R"("method": "listing1", )");
  EXPECT_EQ(sceneErrorOf(of1997), "no error");
}

// A unit cube on the floor, and one that stands on its edge or its corner: touching is no overlap.
TEST(SceneCheck, boxesMayStartTouchingAWall) {
  for (const char* box :
       {R"({"half_extents": [0.5, 0.5, 0.5], "mass": 1, "position": [0, 0, 0.5]})",
        R"({"half_extents": [0.5, 0.5, 0.5], "mass": 1, "position": [1.5, -1.5, 0.5]})",
        R"({"half_extents": [0.5, 0.5, 0.5], "mass": 1, "position": [0, 0, 0.7071067811865476],
                              "orientation": {"axis": [1, 0, 0], "angle_deg": 45}})",
        R"({"half_extents": [0.1, 0.1, 0.1], "mass": 1, "position": [0, 0, 3.9]})"}) {
    EXPECT_EQ(sceneErrorOf(withBoxes(box)), "no error") << box;
  }
  // Two hundred times the allowance, which is 1e-12 of the lengths that make up the gap.
  EXPECT_NE(sceneErrorOf(withBoxes(
                R"({"half_extents": [0.5, 0.5, 0.5], "mass": 1, "position": [0, 0, 0.4999999998]})")),
            "no error");
}

TEST(SceneCheck, openSidesHoldNothing) {
  const std::string scene = R"({"careen": 1, "duration": 1,
    "room": {"min": [-2, -2, 0], "max": [2, 2, 4], "open": ["+z", "-x"]},
    "boxes": [{"half_extents": [1, 1, 1], "mass": 1, "position": [-20, 0, 50]}]})";
  EXPECT_EQ(sceneErrorOf(scene), "no error");
}

TEST(SceneCheck, springsFindTheirBoxes) {
  const Scene scene = parseScene(kEveryKey, "f");
  ASSERT_EQ(scene.springs.size(), 2U);
  EXPECT_EQ(scene.springs[0].from.body, 0);
  EXPECT_EQ(scene.springs[0].to.body, std::nullopt);
  EXPECT_EQ(scene.springs[1].from.body, 1);
  EXPECT_EQ(scene.springs[1].to.body, 2);
}

// The largest numbers a scene may hold go through every check without overflow.
TEST(SceneCheck, largestNumbersAreHandled) {
  EXPECT_EQ(sceneErrorOf(R"({"careen": 1, "duration": 1e60, "gravity": [1e60, -1e60, 1e60],
    "walls": [{"point": [1e60, 1e60, 1e60], "normal": [-1, -1, -1]}],
    "boxes": [{"half_extents": [1e60, 1e60, 1e60], "mass": 1e60, "position": [-1e60, -1e60, -1e60],
               "velocity": [1e60, 1e60, 1e60], "angular_velocity": [1e60, 1e60, 1e60],
               "orientation": {"axis": [1e-60, 1e60, 0], "angle_deg": 1e60}}],
    "camera": {"eye": [1e60, 0, 0], "target": [-1e60, 0, 0]}})"),
            "no error");
}

}  // namespace
}  // namespace careen
