#include "sweep/family.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <string>

#include "core/error.h"
#include "support/scenes.h"

namespace careen {
namespace {

const std::string kMixedFamily =
    R"({ "careen": 1, "duration": 1, "gravity": [0, 0, { "choice": [-9.81, -1.62, { "uniform": [-4, -3] }] }],
  "sweep": { "seed": 3, "tries": 200 },
  "walls": [ { "point": [0, 0, 0], "normal": [0, 0, 1], "friction": { "log_uniform": [0.01, 1] } } ],
  "boxes": [
    { "name": "post", "half_extents": [0.1, 0.1, 0.1], "fixed": true, "position": [0, 0, 5] },
    { "name": "die", "count": { "uniform_integer": [1, 4] }, "half_extents": [0.1, 0.1, 0.1], "mass": 1,
      "position": [{ "uniform": [-0.5, 0.5] }, { "uniform": [-0.5, 0.5] }, { "normal": [1, 0.1] }],
      "orientation": { "rotation": "uniform" }, "velocity": { "unit_vector": 2 } } ] })";

TEST(Family, drawsEveryKindOfValueInItsRange) {
  const Family family(kMixedFamily, "family.json");
  std::set<std::size_t> counts;
  std::set<double> gravities;
  int retried = 0;
  for (std::uint64_t run = 0; run < 300; ++run) {
    const Family::Member member = family.member(run);
    const Scene& scene = member.scene;
    counts.insert(scene.boxes.size() - 1);
    gravities.insert(std::round(scene.gravity.z()));
    retried += member.attempts > 1 ? 1 : 0;
    ASSERT_GE(scene.walls[0].material.friction, 0.01);
    ASSERT_LE(scene.walls[0].material.friction, 1);
    ASSERT_EQ(member.drawn.size(), 3U);  // which gravity, the third gravity, friction
    EXPECT_EQ(member.drawn[2], scene.walls[0].material.friction);
    for (std::size_t i = 1; i < scene.boxes.size(); ++i) {
      ASSERT_EQ(scene.boxes[i].name, "die-" + std::to_string(i));
      ASSERT_NEAR(scene.boxes[i].velocity.norm(), 2, 1e-12);
      ASSERT_LE(std::abs(scene.boxes[i].pose.position.x()), 0.5);
      for (std::size_t k = 1; k < i; ++k) {
        ASSERT_NE(scene.boxes[i].pose.position, scene.boxes[k].pose.position);
      }
    }
  }
  EXPECT_EQ(counts, (std::set<std::size_t>{1, 2, 3, 4}));
  EXPECT_TRUE(gravities.contains(-10) && gravities.contains(-2) && gravities.size() <= 4);
  EXPECT_GT(retried, 30);  // measured: more than a third of them
}

TEST(Family, runIsTheSameWhateverElseIsAsked) {
  const Family one(kMixedFamily, "family.json");
  const Family two(kMixedFamily, "elsewhere.json");
  static_cast<void>(two.member(5));
  const std::string text = one.member(41).scene.text;
  EXPECT_EQ(text, two.member(41).scene.text);
  EXPECT_NE(text, one.member(42).scene.text);
  std::string other = kMixedFamily;
  other.replace(other.find("\"seed\": 3"), 9, "\"seed\": 4");
  EXPECT_NE(text, Family(other, "family.json").member(41).scene.text);
}

TEST(Family, tellsWhatVaries) {
  const Family family(kMixedFamily, "family.json");
  EXPECT_EQ(family.columns(),
            (std::vector<std::string>{"gravity[2]", "gravity[2].choice[2]", "walls[0].friction"}));
  ASSERT_EQ(family.varying().size(), 3 + 1 + 3 + 4 + 3U);
  EXPECT_EQ(family.varying()[0].range, "one of 3");
  EXPECT_EQ(family.varying()[3].path, "boxes[1].count");
  EXPECT_TRUE(family.varying()[3].inBoxes);
}

TEST(Family, ofAPlainSceneIsThatScene) {
  const Family family(kEveryKey, "scene.json");
  EXPECT_TRUE(family.varying().empty());
  EXPECT_EQ(family.member(9).scene.boxes[0].velocity, Vec3(6, 1.5, 0));
  EXPECT_FALSE(looksLikeFamily(kEveryKey));
  EXPECT_TRUE(looksLikeFamily(kMixedFamily));
  EXPECT_FALSE(looksLikeFamily("{ nonsense"));
}

TEST(Family, refusesWhatIsNoDistribution) {
  const auto refusal = [](const std::string& piece, const std::string& marked) {
    std::string text = kMixedFamily;
    text.replace(text.find(piece), piece.size(), marked);
    const MarkedText bad(text);
    try {
      const Family family(bad.text, "f.json");
      ADD_FAILURE() << marked;
      return std::string();
    } catch (const InputError& error) {
      EXPECT_TRUE(std::string(error.what()).starts_with("f.json:" + bad.place + ": ")) << error.what();
      return std::string(error.what());
    }
  };
  const std::string uniform = "\"position\": [{ \"uniform\": [-0.5, 0.5] }";
  EXPECT_NE(refusal(uniform, "\"position\": [{ \"uniform\": @[0.5, -0.5] }").find("the smaller number first"),
            std::string::npos);
  refusal(uniform, "\"position\": [{ \"uniform\": @[0.5] }");
  refusal(uniform, "\"position\": [{ \"uniform\": @\"any\" }");
  refusal("[0.01, 1]", "@[0, 1]");
  refusal("[1, 0.1]", "@[1, -0.1]");
  refusal("[1, 4]", "@[1.5, 4]");
  refusal("{ \"uniform_integer\": [1, 4] }", "@{ \"normal\": [1, 0.5] }");
  refusal("{ \"uniform_integer\": [1, 4] }", "@-1");
  refusal("\"uniform\" }, \"velocity\"", "@\"normal\" }, \"velocity\"");
  refusal("\"unit_vector\": 2", "\"unit_vector\": @[1]");
  refusal("[-9.81, -1.62, { \"uniform\": [-4, -3] }]", "@[]");
  refusal("\"seed\": 3", "\"seed\": @-3");
  refusal("\"seed\": 3", "@\"sead\": 3");
}

TEST(Family, whatIsNoSceneIsToldWithTheRun) {
  std::string text = kMixedFamily;
  text.replace(text.find("\"mass\": 1"), 9, "\"mass\": { \"uniform\": [-2, -1] }");
  try {
    const Family family(text, "f.json");
    FAIL();
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("f.json (run 0):"), std::string::npos) << error.what();
    EXPECT_NE(std::string(error.what()).find("mass"), std::string::npos) << error.what();
  }
}

TEST(Family, startsThatCannotBeAreGivenUpAfterTheBound) {
  std::string text = kMixedFamily;
  text.replace(text.find("{ \"uniform_integer\": [1, 4] }"), 29, "60");
  try {
    const Family family(text, "f.json");
    FAIL();
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("f.json (run 0): found no start without overlap in 200 tries"),
              std::string::npos)
        << error.what();
  }
}

}  // namespace
}  // namespace careen
