#include "question/question.h"

#include <gtest/gtest.h>

#include "support/exact_runs.h"
#include "support/input_error.h"

namespace careen {
namespace {

class Questions : public testing::Test {
 protected:
  Questions() {
    world_.bodies = {box("ball", Vec3::Ones(), 1, Vec3::Zero()),
                     box("big box", Vec3::Ones(), 1, Vec3::Zero()),
                     box("rest", Vec3::Ones(), 1, Vec3::Zero()), box("a(1)", Vec3::Ones(), 1, Vec3::Zero())};
    world_.walls = {wall("floor", Vec3::UnitZ(), 0)};
  }
  Question read(const std::string& text) const { return readQuestion(text, world_); }
  std::string errorOf(const std::string& text) const {
    return inputErrorOf([&] { readQuestion(text, world_); });
  }

  World world_;
  const Partner ball_ = Partner::ofBody(0);
};

TEST_F(Questions, whatTouchesHasABoxFirst) {
  for (const char* const text :
       {"ball touches floor", "floor touches ball", "  'ball'  touches\t\"floor\" "}) {
    const Question question = read(text);
    EXPECT_EQ(question.kind, Question::Kind::kTouches) << text;
    EXPECT_EQ(question.of, (std::vector{ball_, Partner::ofWall(0)})) << text;
    EXPECT_EQ(question.text, text);
  }
  EXPECT_EQ(read("\"big box\" leaves 'a(1)'").of, (std::vector{Partner::ofBody(1), Partner::ofBody(3)}));
  EXPECT_EQ(read("ball leaves rest").kind, Question::Kind::kLeaves);
}

TEST_F(Questions, anythingMayBeLeftOut) {
  for (const char* const text : {"ball touches", "ball touches anything"}) {
    EXPECT_EQ(read(text).of, std::vector{ball_}) << text;
  }
  EXPECT_EQ(read("floor touches").of, std::vector{Partner::ofWall(0)});
}

TEST_F(Questions, quantitiesAreComparedWithNumbers) {
  for (const char* const text : {"height(ball)<-1.5e-1", " height ( ball ) < -0.15 "}) {
    const Question question = read(text);
    EXPECT_EQ(question.kind, Question::Kind::kBelow) << text;
    EXPECT_EQ(question.quantity, Quantity::kHeight) << text;
    EXPECT_EQ(question.level, -0.15) << text;
    EXPECT_EQ(question.of, std::vector{ball_}) << text;
  }
  for (std::size_t i = 0; i + 1 < kQuantityNames.size(); ++i) {
    const Question question = read(std::string(kQuantityNames[i]) + "('big box') > 2");
    EXPECT_EQ(question.kind, Question::Kind::kAbove);
    EXPECT_EQ(static_cast<std::size_t>(question.quantity), i);
  }
  EXPECT_EQ(read("distance(ball, 'big box') > 2").of, (std::vector{ball_, Partner::ofBody(1)}));
}

TEST_F(Questions, restIsThatOfAllOrOfOne) {
  EXPECT_TRUE(read("rest").of.empty());
  EXPECT_EQ(read("rest(rest)").of, std::vector{Partner::ofBody(2)});
  EXPECT_EQ(read("rest touches ball").of.front(), Partner::ofBody(2));
}

// Columns are counted in characters: ä has two bytes.
TEST_F(Questions, badOnesTellWhereAndWhatWasExpected) {
  const std::string boxes = "a box: ball, big box, rest, a(1)";
  const std::string all = "a box or wall: ball, big box, rest, a(1), floor";
  for (const auto& [text, told] : std::vector<std::pair<std::string, std::string>>{
           {"", "column 1: found its end, expected a statement, such as"},
           {"height(bal) < 1", "column 8: found 'bal', expected " + boxes},
           {"height(floor) < 1", "column 8: found 'floor', expected " + boxes},
           {"heigth(ball) < 1",
            "column 1: found 'heigth', expected one of: height, x, y, z, speed, spin, energy, "
            "tilt, distance, rest"},
           {"height(ball) = 1", "column 14: found '=', expected '<' or '>'"},
           {"height(ball)", "column 13: found its end, expected '<' or '>'"},
           {"height(ball) < high", "column 16: found 'high', expected a number"},
           {"height(ball) < 1e999", "column 16: found '1e999', expected a number"},
           {"height(ball) < nan", "column 16: found 'nan', expected a number"},
           {"height(ball) < 1 m", "column 18: found 'm', expected its end"},
           {"height(ball < 1", "column 13: found '<', expected ')'"},
           {"distance(ball) < 1", "column 14: found ')', expected ','"},
           {"ball hits floor", "column 6: found 'hits', expected 'touches' or 'leaves'"},
           {"ball", "column 5: found its end, expected 'touches' or 'leaves'"},
           {"ball touches flor", "column 14: found 'flor', expected " + all},
           {"ball touches ball", "column 14: found 'ball', expected another than itself"},
           {"floor touches floor", "column 15: found 'floor', expected " + boxes},
           {"rest(floor)", "column 6: found 'floor', expected " + boxes},
           {"rest(ball", "column 10: found its end, expected ')'"},
           {"'bäll' touches ball", "column 1: found 'bäll', expected " + all},
           {"ball touches 'bäll' x", "column 14: found 'bäll', expected " + all},
           {"'big box touches ball", "column 1: found ''big box touches ball', expected another ' where"},
           {"ball touches anything else", "column 23: found 'else', expected its end"},
           {"rest ball", "column 6: found 'ball', expected 'touches' or 'leaves'"}}) {
    const std::string error = errorOf(text);
    EXPECT_NE(error.find("question '" + text + "', " + told), std::string::npos) << error;
  }
  EXPECT_NE(errorOf("ball touches 'big box' ä ö").find("column 24: found 'ä'"), std::string::npos);
  EXPECT_NE(errorOf("'ä' touches").find("column 1"), std::string::npos);
}

TEST_F(Questions, manyNamesAreNotAllListed) {
  for (int i = 0; i < 100; ++i) {
    world_.bodies.push_back(box("b" + std::to_string(i), Vec3::Ones(), 1, Vec3::Zero()));
  }
  EXPECT_NE(errorOf("rest(x)").find("b7 and 92 more"), std::string::npos) << errorOf("rest(x)");
}

TEST_F(Questions, partnersHaveNames) {
  EXPECT_EQ(nameOf(Partner::ofBody(1), world_), "big box");
  EXPECT_EQ(nameOf(Partner::ofWall(0), world_), "floor");
}

}  // namespace
}  // namespace careen
