#include "scene/film_shape.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "scene/scene_shape.h"
#include "support/input_error.h"
#include "support/scenes.h"

namespace careen {
namespace {

std::string filmShapeErrorOf(const std::string& text) {
  return inputErrorOf([&text] { readShape(JsonTree(text, "f")); });
}

const std::vector<BadPiece> kBadShown = {
    {R"("linear")", R"(@"slow")", R"(found the unknown easing "slow", expected one of smooth, linear, cut)"},
    {"0.125, \"focus\"", "@0, \"focus\"", "found 0 for camera.f_stop, expected a number above 0"},
    {R"("f_stop": 0.125, )", "@", "found no f_stop in camera, expected that key"},
    {R"("focus": "crate")", R"("focus": @-1)",
     "found -1 for camera.focus, expected a distance above 0, or the name of a box [m]"},
    {R"("focus_samples": 5)", R"("focus_samples": @257)",
     "found 257 for camera.focus_samples, expected a whole number from 1 to 256"},
    {R"("shadows")", R"(@"shades")",
     R"(found the unknown light part "shades", expected one of shadows, occlusion, bounce)"},
    {"[0, 3, -4]", "@[0, 0, 0]", "found a zero vector for light.direction, expected a direction"},
    {R"("size_deg": 8)", R"("size_deg": @61)",
     "found 61 for light.size_deg, expected a number from 0 to 60 [deg]"},
    {R"("#ffe0c0")", R"(@"#ffe0c")", R"(found "#ffe0c" for light.color, expected a colour "#rrggbb")"},
    {R"(["#405060", "black"])", R"(@["black"])",
     "found an array of 1 for light.ambient, expected a colour or [above, below]"},
    {R"("ivory")", "@1", R"(found 1 for background, expected a colour "#rrggbb" or its name)"},
    {R"("marks": false)", R"("marks": @0)", "found 0 for marks, expected true or false"},
    {R"("gloss": 0.75)", R"("gloss": @1.5)", "found 1.5 for gloss, expected a number from 0 to 1"},
    {R"("time": [0.5, 1], )", "@", "found no time in titles[1], expected that key"},
    {R"("top")", R"(@"left")", R"(found the unknown place "left", expected one of top, middle, bottom)"},
};

const std::vector<BadPiece> kBadFilmValues = {
    {R"({ "eye": [6, -8, 4], )", "@{ ", "found no eye in camera, expected that key"},
    {R"("up": [0, 0, 4])", R"("up": @[0, 0, 0])", "found a zero vector for camera.up, expected a direction"},
    {R"("fov_deg": 35)", R"("fov_deg": @0)",
     "found 0 for camera.fov_deg, expected a number between 0 and 180 [deg]"},
    {R"("fov_deg": 35)", R"("fov_deg": @180)",
     "found 180 for camera.fov_deg, expected a number between 0 and 180 [deg]"},
    {"[640, 360]", "[@0, 360]", "found 0 for film.size[0], expected a whole number from 1 to 16384 [px]"},
    {"[640, 360]", "[640, @100000]",
     "found 100000 for film.size[1], expected a whole number from 1 to 16384 [px]"},
    {"[640, 360]", "[@640.5, 360]",
     "found 640.5 for film.size[0], expected a whole number from 1 to 16384 [px]"},
    {"[640, 360]", "@[640]", "found an array of 1 for film.size, expected [width, height] [px]"},
    {"23.976", "@0", "found 0 for film.fps, expected a number from 0.001 to 100000 [1/s]"},
    {"23.976", "@1e6", "found 1e6 for film.fps, expected a number from 0.001 to 100000 [1/s]"},
    {R"("4x")", R"(@"8x")",
     R"(found the unknown antialiasing "8x", expected one of off, edges, 4x, supersampled)"},
    {R"({ "deg_per_s": 20 })", "@20", "found 20 for camera.orbit, expected an object"},
    {R"({ "deg_per_s": 20 })", "@{}", "found no deg_per_s in camera.orbit, expected that key"},
    {R"("follow": "crate")", R"("follow": @0)", "found 0 for camera.follow, expected the name of a box"},
    {R"({ "eye": [6, -8, 4], "target": [0, 0, 1], )", R"(@{ "eye": [6, -8, 4], "keys": [], )",
     "found both keys and eye in camera, expected one of them: keys say where the camera is"},
    {R"({ "eye": [6, -8, 4], "target": [0, 0, 1], )", R"(@{ "keys": [], )",
     "found both keys and orbit in camera, expected one of them: keys say where the camera is"},
    {"[[0, 0.75], [1, 0.75], [3, 2.25]]", "@[[0, 0.75]]",
     "found an array of 1 for film.time, expected an array of two or more [film time, scene time]"},
    {"[1, 0.75]", "@[1]", "found an array of 1 for film.time[1], expected [film time, scene time] [s]"},
    {"[1, 0.75]", "[1, @-0.75]", "found -0.75 for film.time[1][1], expected a number not below 0 [s]"},
    {R"("shutter_deg": 90)", R"("shutter_deg": @360.5)",
     "found 360.5 for film.shutter_deg, expected a number from 0 to 360 [deg]"},
    {R"("shutter_deg": 90)", R"("shutter_deg": @-1)",
     "found -1 for film.shutter_deg, expected a number from 0 to 360 [deg]"},
    {R"("shutter_samples": 4)", R"("shutter_samples": @0)",
     "found 0 for film.shutter_samples, expected a whole number from 1 to 256"},
    {R"("shutter_samples": 4)", R"("shutter_samples": @257)",
     "found 257 for film.shutter_samples, expected a whole number from 1 to 256"},
};

TEST(FilmShape, badLightsLensesAndTitlesAreToldWhereAndWhy) {
  for (const BadPiece& bad : kBadShown) {
    const std::string marked = sceneBut(kShown, bad.piece, bad.instead);
    const std::string error = filmShapeErrorOf(std::string(marked).erase(marked.find('@'), 1));
    EXPECT_NE(error.find(bad.message), std::string::npos) << error;
  }
}

TEST(FilmShape, readsLightLensAndTitles) {
  const Scene scene = readShape(JsonTree(kShown, "f"));
  const Scenery& scenery = scene.scenery;
  EXPECT_LT((*scenery.towardsLight - Vec3(0, -0.6, 0.8)).norm(), 1e-15);
  EXPECT_EQ(scenery.lightDegrees, 8);
  EXPECT_EQ(scenery.lightColor->blue, 0xc0);
  EXPECT_EQ(scenery.ambient->above.red, 0x40);
  EXPECT_EQ(scenery.ambient->below.red, 0);
  EXPECT_EQ(scenery.background->above.blue, 0xf0);
  EXPECT_EQ(scenery.background->below.blue, 0xf0);
  EXPECT_EQ(scenery.marks, false);
  EXPECT_EQ(scenery.gloss, 0.75);
  ASSERT_EQ(scenery.titles.size(), 2U);
  EXPECT_EQ(scenery.titles[0].text, "A box careens\noff a wall");
  EXPECT_EQ(scenery.titles[0].place, TitlePlace::kTop);
  EXPECT_EQ(scenery.titles[1].place, TitlePlace::kBottom);
  EXPECT_EQ(scenery.titles[1].to, 1);
  EXPECT_EQ(scene.picture.light.text(), "shadows");
  EXPECT_EQ(scene.cameraMove.easing, Easing::kLinear);
  EXPECT_EQ(scene.focus->fStop, 0.125);
  EXPECT_FALSE(scene.focus->distance);
  EXPECT_EQ(scene.focus->samples, 5);
}

TEST(FilmShape, badValuesAreToldWhereAndWhy) {
  for (const BadPiece& bad : kBadFilmValues) {
    const MarkedText marked(everyKeyBut(bad.piece, bad.instead));
    EXPECT_EQ(filmShapeErrorOf(marked.text), "f:" + marked.place + ": " + bad.message);
  }
  EXPECT_NE(filmShapeErrorOf(everyKeyBut(R"("shutter_deg": 90, )", ""))
                .find("found shutter_samples without shutter_deg in film, expected both, or neither"),
            std::string::npos);
}

// A scene with these values for camera and film.
Scene filmed(const std::string& camera, const std::string& film) {
  return readShape(JsonTree(R"({"careen": 1, "duration": 1, "boxes": [{"half_extents": [1, 1, 1], "mass": 1}],
                               "camera": )" +
                                camera + R"(, "film": )" + film + "}",
                            "f"));
}

TEST(FilmShape, readsKeys) {
  const Scene scene = filmed(R"({ "fov_deg": 30, "up": [0, 2, 0], "keys": [
      { "time": 0.5, "eye": [1, 2, 3], "target": [4, 5, 6] },
      { "time": 2, "eye": [7, 8, 9], "target": [1, 1, 1], "fov_deg": 50 } ] })",
                             "{}");
  const std::vector<CameraKey>& keys = scene.cameraMove.keys;
  ASSERT_EQ(keys.size(), 2U);
  EXPECT_EQ(keys[0].time, 0.5);
  EXPECT_EQ(keys[0].fovDegrees, 30);  // the camera's
  EXPECT_EQ(keys[1].eye, Vec3(7, 8, 9));
  EXPECT_EQ(keys[1].target, Vec3(1, 1, 1));
  EXPECT_EQ(keys[1].fovDegrees, 50);
  EXPECT_EQ(scene.camera->eye, keys[0].eye);  // where it begins
  EXPECT_EQ(scene.camera->up, Vec3::UnitY());
}

TEST(FilmShape, aKeyNeedsToSayWhereAndWhen) {
  for (const char* keys :
       {R"([{ "eye": [1, 2, 3], "target": [4, 5, 6] }])", R"([{ "time": 1, "target": [4, 5, 6] }])",
        R"([{ "time": 1, "eye": [4, 5, 6] }])", R"([{ "time": -1, "eye": [1, 2, 3], "target": [4, 5, 6] }])",
        R"([{ "time": 1, "eye": [1, 2, 3], "target": [4, 5, 6] }])"}) {
    EXPECT_THROW(filmed(std::string(R"({ "keys": )") + keys + "}", "{}"), InputError) << keys;
  }
}

}  // namespace
}  // namespace careen
