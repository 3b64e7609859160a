#include "scene/shown_as.h"

#include <gtest/gtest.h>

#include "scene/plan.h"
#include "scene/scene_reader.h"
#include "support/input_error.h"
#include "support/scenes.h"

namespace careen {
namespace {

RunSetup everyKeysRun() { return setupOf(parseScene(kEveryKey, "own")); }

TEST(ShownAs, takesWhatIsSaidOfTheFilmAndNothingElse) {
  RunSetup run = everyKeysRun();
  const RunSetup before = run;
  showAs(run, kShown, "f");
  EXPECT_EQ(run.stage.cameraMove.keys.size(), 2U);
  EXPECT_EQ(run.stage.focus->body, 0U);
  EXPECT_EQ(run.stage.picture.look, Look::kStudio) << "the other scene is silent";
  EXPECT_EQ(run.stage.picture.overlays.text(), "none");
  EXPECT_TRUE(run.stage.timeMap.keys.empty());
  EXPECT_EQ(run.stage.scenery.titles.size(), 2U);
  EXPECT_EQ(run.stage.name, before.stage.name);
  EXPECT_EQ(run.stage.colors.size(), before.stage.colors.size());
  EXPECT_EQ(run.settings.duration, before.settings.duration);
  EXPECT_EQ(run.sceneText, before.sceneText);
  EXPECT_TRUE(before.stage.shownAs.empty());
  EXPECT_FALSE(run.stage.shownAs.empty());
}

TEST(ShownAs, needsNoBoxesAndNoDuration) {
  RunSetup run = everyKeysRun();
  showAs(run, R"({ "careen": 1, "look": "blueprint" })", "f");
  EXPECT_EQ(run.stage.picture.look, Look::kBlueprint);
  EXPECT_FALSE(run.stage.camera);
}

TEST(ShownAs, namesAreThoseOfTheRunsBoxesAndTimesThoseOfItsDuration) {
  RunSetup run = everyKeysRun();
  const auto errorOf = [&](const std::string& text) { return inputErrorOf([&] { showAs(run, text, "f"); }); };
  EXPECT_EQ(
      errorOf(R"({ "careen": 1, "camera": { "eye": [1, 2, 3], "target": [0, 0, 0], "follow": "crane" } })"),
      "f:1:77: found no box of the name \"crane\", expected \"crate\"");
  EXPECT_EQ(
      errorOf(R"({ "careen": 1, "film": { "time": [[0, 0], [1, 2.75]] } })"),
      "f:1:47: found 2.75 for film.time[1][1], expected a scene time within the duration, which is 2.5");
  EXPECT_NE(errorOf(R"({ "careen": 1, "camara": 1 })").find("camara"), std::string::npos);
  EXPECT_NE(errorOf(R"({ "look": "clay" })").find("no careen in the scene"), std::string::npos);
}

}  // namespace
}  // namespace careen
