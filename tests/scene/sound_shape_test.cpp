#include "scene/sound_shape.h"

#include <gtest/gtest.h>

#include "scene/plan.h"
#include "scene/scene_shape.h"
#include "support/input_error.h"
#include "support/scenes.h"

namespace careen {
namespace {

TEST(SoundShape, readsNamesAndNumbers) {
  const Scene scene = readShape(JsonTree(kShown, "f"));
  EXPECT_EQ(scene.boxes[0].sound, kSoundMaterials[2].material);
  EXPECT_EQ(scene.room->sound, (SoundMaterial{.modulus = 1e9, .density = 500, .damping = 0.125}));
  ASSERT_EQ(scene.wallSounds.size(), 1U);
  EXPECT_EQ(scene.wallSounds[0], kSoundMaterials[3].material);
}

TEST(SoundShape, theStageHasThemInTheOrderOfTheWorld) {
  const Scene scene = readShape(JsonTree(kShown, "f"));
  const Stage stage = stageOf(scene);
  ASSERT_EQ(stage.boxSounds.size(), 1U);
  ASSERT_EQ(stage.wallSounds.size(), 7U);
  EXPECT_EQ(stage.wallSounds[5].modulus, 1e9);
  EXPECT_EQ(stage.wallSounds[6], kSoundMaterials[3].material);
  EXPECT_TRUE(stageOf(readShape(JsonTree(kEveryKey, "f"))).boxSounds.empty());
  EXPECT_TRUE(stageOf(readShape(JsonTree(kEveryKey, "f"))).wallSounds.empty());
}

TEST(SoundShape, badMaterialsAreToldWhereAndWhy) {
  const auto errorOf = [](const std::string& piece, const std::string& instead) {
    return inputErrorOf([&] { readShape(JsonTree(sceneBut(kShown, piece, instead), "f")); });
  };
  EXPECT_EQ(errorOf(R"("metal")", R"("glass")"),
            "f:4:112: found the unknown material \"glass\", expected one of wood, stone, metal, plastic");
  EXPECT_NE(errorOf(R"("damping": 0.125)", R"("damping": 2)")
                .find("found 2 for room.material.damping, expected a number from 1e-6 to 1"),
            std::string::npos);
  EXPECT_NE(errorOf(R"(, "damping": 0.125)", "").find("found no damping in room.material"),
            std::string::npos);
}

}  // namespace
}  // namespace careen
