#include "scene/box_names.h"

#include <gtest/gtest.h>

#include "scene/scene_reader.h"
#include "support/input_error.h"
#include "support/scenes.h"

namespace careen {
namespace {

TEST(BoxNames, findsBoxesInTheOrderOfTheScene) {
  const Scene scene = parseScene(kJoints, "f");
  const BoxNames boxes(scene);
  const JsonTree tree(R"(["bob", "bobb", "elephant"])", "f");
  EXPECT_EQ(boxes.named(tree, tree.root().children[0]), 2);
  EXPECT_TRUE(boxes.has("rock"));
  EXPECT_FALSE(boxes.has("world"));
  EXPECT_EQ(inputErrorOf([&] { boxes.named(tree, tree.root().children[1]); }),
            R"(f:1:9: found no box of the name "bobb", expected "bob")");
  EXPECT_EQ(inputErrorOf([&] { boxes.named(tree, tree.root().children[2]); }),
            R"(f:1:17: found no box of the name "elephant", expected the name of a box of the scene)");
}

}  // namespace
}  // namespace careen
