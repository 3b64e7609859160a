#include "exchange/mjcf_replicate.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <string>
#include <vector>

#include "exchange/mjcf_model.h"
#include "support/input_error.h"

namespace careen {
namespace {

const std::string kCopiedBox = R"(<geom name="Alice" type="box" size="1 1 1"/>)";

MjcfModel modelFrom(const std::string& elements) {
  MjcfDocument document("<mujoco>" + elements + "</mujoco>", "m.xml");
  replicate(document);
  return readModel(document);
}
std::map<std::string, MjcfFrame> framesIn(const std::string& world) {
  std::map<std::string, MjcfFrame> frames;
  for (const MjcfSurface& each : modelFrom("<worldbody>" + world + "</worldbody>").surfaces) {
    frames[each.name] = each.frame;
  }
  return frames;
}
void expectAt(const MjcfFrame& found, const Vec3& position, const Quat& turn) {
  EXPECT_LT((found.position - position).norm(), 1e-15);
  EXPECT_LT((found.turn.toRotationMatrix() - turn.normalized().toRotationMatrix()).norm(), 1e-15);
}

// The example of MuJoCo's manual: names and poses as it says that they become.
TEST(MjcfReplicate, nestedCopiesAreThoseOfMujocosManual) {
  const auto frames = framesIn(R"(<replicate count="2" offset="0 1 0" euler="90 0 0">
      <replicate count="2" sep="-" offset="1 0 0" euler="0 90 0">)" +
                               kCopiedBox + "</replicate></replicate>");
  ASSERT_EQ(frames.size(), 4U);
  expectAt(frames.at("Alice-00"), {0, 0, 0}, {1, 0, 0, 0});
  expectAt(frames.at("Alice-10"), {1, 0, 0}, {1, 0, 1, 0});
  expectAt(frames.at("Alice-01"), {0, 1, 0}, {1, 1, 0, 0});
  expectAt(frames.at("Alice-11"), {1, 1, 0}, {0.5, 0.5, 0.5, 0.5});
}

// On a ring each copy is 1 m farther along an axis that has turned by 90° each time.
TEST(MjcfReplicate, offsetsTurnWithTheCopies) {
  const auto frames =
      framesIn(R"(<replicate count="4" offset="1 0 0" euler="0 0 90">)" + kCopiedBox + "</replicate>");
  expectAt(frames.at("Alice1"), {1, 0, 0}, {1, 0, 0, 1});
  expectAt(frames.at("Alice2"), {1, 1, 0}, {0, 0, 0, 1});
  expectAt(frames.at("Alice3"), {0, 1, 0}, {-1, 0, 0, 1});
}

// About several axes the i-th has i times the angles, not the i-th power of the turn.
TEST(MjcfReplicate, anglesAreMultiplied) {
  const auto frames = framesIn(R"(<replicate count="3" euler="45 90 0">)" + kCopiedBox + "</replicate>");
  const Quat x = Quat(1, 1, 0, 0).normalized();  // 90° about x, then 180° about y
  expectAt(frames.at("Alice2"), Vec3::Zero(), x * Quat(0, 0, 1, 0));
}

TEST(MjcfReplicate, numbersHaveTheDigitsOfTheCount) {
  const auto frames =
      framesIn(R"(<replicate count="10" sep="_" offset="0 0 2">)" + kCopiedBox + "</replicate>");
  ASSERT_EQ(frames.size(), 10U);
  expectAt(frames.at("Alice_09"), {0, 0, 18}, {1, 0, 0, 0});
  EXPECT_TRUE(framesIn(R"(<replicate count="1">)" + kCopiedBox + "</replicate>").contains("Alice0"));
}

TEST(MjcfReplicate, framesAndClassesAreThoseAroundIt) {
  const MjcfModel model =
      modelFrom(R"(<default><default class="flat"><geom type="box" size="3 3 1"/></default></default>
      <worldbody><frame pos="0 0 5" euler="0 0 90"><replicate count="2" offset="1 0 0" childclass="flat">
      <geom/><frame pos="0 7 0"><geom/></frame></replicate></frame></worldbody>)");
  ASSERT_EQ(model.surfaces.size(), 4U);
  EXPECT_EQ(model.surfaces[3].geom.size, (std::vector<double>{3, 3, 1}));
  EXPECT_LT((model.surfaces[2].frame.position - Vec3(0, 1, 5)).norm(), 1e-15);
  EXPECT_LT((model.surfaces[3].frame.position - Vec3(-7, 1, 5)).norm(), 1e-14);
}

const std::string kHung = R"(<replicate count="2" offset="3 0 0"><site name="top" pos="0 0 5"/>
  <body name="b"><freejoint/><geom name="g" type="box" size="1 1 1"/><site name="end" pos="0 0 1"/></body></replicate>)";

TEST(MjcfReplicate, whatNamesCopiesIsCopied) {
  const MjcfModel model = modelFrom("<worldbody>" + kHung + R"(</worldbody><tendon>
      <spatial stiffness="2"><site site="top"/><site site="end"/></spatial></tendon>)");
  ASSERT_EQ(model.springs.size(), 2U);
  EXPECT_EQ(model.springs[0].to.surface, 0U);
  EXPECT_EQ(model.springs[1].to.surface, 1U);
  EXPECT_EQ(model.springs[1].from.point, Vec3(3, 0, 5));
  EXPECT_EQ(model.springs[1].stiffness, 2);
}

TEST(MjcfReplicate, referencesOfOneCopyByItsNameStay) {
  const MjcfModel model = modelFrom("<worldbody>" + kHung + R"(<site name="far"/></worldbody><tendon>
      <spatial><site site="far"/><site site="end1"/></spatial></tendon>)");
  ASSERT_EQ(model.springs.size(), 1U);
  EXPECT_EQ(model.springs[0].to.surface, 1U);
}

TEST(MjcfReplicate, refusesWhatCannotBeCopied) {
  const auto refusal = [](const std::string& world, const std::string& after = "") {
    return inputErrorOf([&] { modelFrom("<worldbody>\n" + world + "</worldbody>" + after); });
  };
  EXPECT_EQ(refusal("<replicate>" + kCopiedBox + "</replicate>"),
            "m.xml:2:2: found <replicate> without count, expected one");
  EXPECT_EQ(refusal("<replicate count='0'>" + kCopiedBox + "</replicate>"),
            "m.xml:2:12: found count=\"0\" for <replicate>, expected a number above 0");
  EXPECT_EQ(refusal("<replicate count='1.5'>" + kCopiedBox + "</replicate>"),
            "m.xml:2:12: found count=\"1.5\" for <replicate>, expected an integer");
  EXPECT_NE(refusal("<replicate count='2' quat='1 0 0 0'>" + kCopiedBox + "</replicate>").find("found quat="),
            std::string::npos);
  EXPECT_EQ(
      refusal("<body><replicate count='1'><frame><freejoint/></frame>" + kCopiedBox + "</replicate></body>"),
      "m.xml:2:36: found <freejoint> in <replicate>, expected it in a <body>");
  EXPECT_EQ(refusal(kHung, "<contact><pair geom1='g' geom2='floor'/></contact>").substr(0, 58),
            "m.xml:3:141: found <pair> of what is in a <replicate> and ");
  // Each has a tenth of what is allowed, but ten in ten in ten have more.
  const std::string open = "<replicate count='100'>";
  const std::string close = "</replicate>";
  EXPECT_EQ(refusal(open + kCopiedBox + close), "no error");
  EXPECT_EQ(refusal(open + open + open + kCopiedBox + close + close + close),
            "m.xml:2:12: found count=\"100\" for <replicate>, expected at most 100000 elements in all copies "
            "together");
  EXPECT_NE(refusal("<replicate count='2147483647'>" + kCopiedBox + close).find("at most 100000"),
            std::string::npos);
}

}  // namespace
}  // namespace careen
