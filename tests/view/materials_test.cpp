#include "view/materials.h"

#include <gtest/gtest.h>

#include <array>

namespace careen {
namespace {

constexpr std::array kAllLooks = {Look::kStudio, Look::kBlueprint, Look::kClay};

bool isPart(double value) { return value >= 0 && value <= 1; }

TEST(Materials, ofEveryLookArePartsAndColours) {
  for (const Look look : kAllLooks) {
    const Materials materials = materialsOf(look);
    for (const double part : {materials.boxRoughness, materials.ownColor, materials.tileRoughness,
                              materials.wallRoughness, materials.tileContrast, materials.joints,
                              materials.bounce, materials.corners, materials.shoulder}) {
      EXPECT_TRUE(isPart(part));
    }
    for (const Vec3& color :
         {materials.boxColor, materials.lineColor, materials.floor, materials.wall, materials.slab}) {
      EXPECT_TRUE(isPart(color.minCoeff()) && isPart(color.maxCoeff()));
    }
  }
}

// Boxes are told apart by marks, or by lines along their edges, or by shades: never by nothing.
TEST(Materials, letBoxesBeSeen) {
  const Materials studio = materialsOf(Look::kStudio);
  EXPECT_TRUE(studio.marks);
  EXPECT_EQ(studio.ownColor, 1);
  EXPECT_GT(materialsOf(Look::kBlueprint).edgeLine, 0);
  EXPECT_TRUE(studio.occlusion);
  EXPECT_TRUE(materialsOf(Look::kClay).occlusion);
  for (const Look look : kAllLooks) {
    EXPECT_GT(materialsOf(look).ownColor, 0) << "boxes of two colours look alike";
  }
}

// What is drawn of blueprints is lines: neither shade nor tiles.
TEST(Materials, ofBlueprintsHaveNeitherShadeNorTiles) {
  const Materials blueprint = materialsOf(Look::kBlueprint);
  EXPECT_FALSE(blueprint.occlusion);
  EXPECT_EQ(blueprint.tileContrast, 0);
  EXPECT_TRUE(blueprint.ownJoints);
  EXPECT_GT(blueprint.lineColor.minCoeff(), blueprint.boxColor.maxCoeff()) << "light on dark";
}

TEST(Materials, areTheLooksButForWhatTheSceneSays) {
  Stage stage;
  stage.picture.look = Look::kClay;
  EXPECT_EQ(materialsOf(stage).boxRoughness, materialsOf(Look::kClay).boxRoughness);
  EXPECT_FALSE(materialsOf(stage).marks);
  stage.scenery.marks = true;
  stage.scenery.gloss = 1;
  EXPECT_TRUE(materialsOf(stage).marks);
  EXPECT_NEAR(materialsOf(stage).boxRoughness, 0.1, 1e-15);
  stage.scenery.gloss = 0;
  EXPECT_EQ(materialsOf(stage).boxRoughness, 1);
}

}  // namespace
}  // namespace careen
