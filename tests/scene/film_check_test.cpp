#include "scene/film_check.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "scene/scene_reader.h"
#include "support/input_error.h"
#include "support/scenes.h"

namespace careen {
namespace {

const std::vector<BadPiece> kBadFilms = {
    {R"("target": [0, 0, 1])", R"("target": @[6, -8, 4])",
     "found the camera's target where its eye is, expected another place to look at"},
    {R"("target": [0, 0, 1], "up": [0, 0, 4])", R"("target": [6, -8, 1], "up": @[0, 0, 4])",
     "found a camera that looks along its up, expected an up that points elsewhere"},
    {R"({ "eye": [6, -8, 4], "target": [0, 0, 1], "up": [0, 0, 4])",
     R"(@{ "eye": [6, -8, 4], "target": [6, -8, 7])",
     "found a camera that looks along its up, expected an up that points elsewhere"},
    {"[[0, 0.75]", "[[@0.5, 0.75]", "found 0.5 for film.time[0][0], expected 0, as the film begins there"},
    {"[1, 0.75]", "[@0, 0.75]",
     "found 0 for film.time[1][0], expected a later film time than the one before it, which is 0"},
    {"[1, 0.75]", "[1, @0.5]",
     "found 0.5 for film.time[1][1], expected no earlier scene time than the one before it, which is 0.75"},
    {"[3, 2.25]", "[3, @2.75]",
     "found 2.75 for film.time[2][1], expected a scene time within the duration, which is 2.5"},
};

TEST(FilmCheck, theLensIsSharpAtABoxThatThereIsAndTitlesLast) {
  EXPECT_EQ(parseScene(kShown, "f").focus->body, 0U);
  EXPECT_EQ(
      inputErrorOf([] { parseScene(sceneBut(kShown, R"("focus": "crate")", R"("focus": "crane")"), "f"); }),
      "f:9:61: found no box of the name \"crane\", expected \"crate\"");
  EXPECT_EQ(inputErrorOf([] { parseScene(sceneBut(kShown, "[0.5, 1]", "[0.5, 0.5]"), "f"); }),
            "f:16:31: found 0.5 for titles[1].time[1], expected more than its begin, which is 0.5");
}

TEST(FilmCheck, badScenesAreToldWhereAndWhy) {
  for (const BadPiece& bad : kBadFilms) {
    const MarkedText marked(everyKeyBut(bad.piece, bad.instead));
    EXPECT_EQ(inputErrorOf([&marked] { parseScene(marked.text, "f"); }),
              "f:" + marked.place + ": " + bad.message);
  }
}

TEST(FilmCheck, everyKeyOfTheCameraMustLookSomewhereLaterThanTheOneBefore) {
  const auto errorOf = [](const std::string& key) {
    const MarkedText marked(everyKeyBut(
        R"("eye": [6, -8, 4], "target": [0, 0, 1], "up": [0, 0, 4], "fov_deg": 35,
              "orbit": { "deg_per_s": 20 }, "follow": "crate")",
        R"("keys": [{ "time": 1, "eye": [6, -8, 4], "target": [0, 0, 1] }, )" + key + "]"));
    const std::string error = inputErrorOf([&marked] { parseScene(marked.text, "f"); });
    const std::string place = "f:" + marked.place + ": ";
    return error.starts_with(place) ? error.substr(place.size()) : "elsewhere: " + error;
  };
  EXPECT_EQ(errorOf(R"({ "time": @1, "eye": [6, -8, 4], "target": [0, 0, 1] })"),
            "found 1 for camera.keys[1].time, expected more than the key's before it, which is 1");
  EXPECT_EQ(errorOf(R"({ "time": 2, "eye": [6, -8, 4], "target": @[6, -8, 4] })"),
            "found the camera's target where its eye is, expected another place to look at");
  EXPECT_EQ(errorOf(R"(@{ "time": 2, "eye": [6, -8, 4], "target": [6, -8, 1] })"),
            "found a camera that looks along its up, expected an up that points elsewhere");
}

}  // namespace
}  // namespace careen
