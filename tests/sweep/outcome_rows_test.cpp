#include "sweep/outcome_rows.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/error.h"
#include "support/trajectories.h"
#include "trajectory/numpy_array.h"
#include "trajectory/zip_archive.h"

namespace careen {
namespace {

// Two boxes like those of driftAndReturn(), the fixed one second.
const std::string kDrifters = R"({ "careen": 1, "duration": 1, "gravity": [0, 0, { "uniform": [-2, -1] }],
  "boxes": [ { "name": "drifter", "half_extents": [0.1, 0.2, 0.3], "mass": 2, "position": [1, 0, 0], "restitution": 0.5 },
             { "name": "anchor", "half_extents": [1, 1, 1], "fixed": true, "position": [0, 5, 0] } ] })";

class OutcomeRows : public testing::Test {
 protected:
  OutcomeRows() { run_.world.bodies[0].name = "a \"b\",\nc"; }
  double value(const OutcomeTable& table, const std::string& column) const {
    for (std::size_t i = 0; i < table.numbers.size(); ++i) {
      if (table.columns[i].name == column) {
        return table.numbers[i].at(0);
      }
    }
    ADD_FAILURE() << column;
    return 0;
  }

  Family family_{kDrifters, "family.json"};
  Trajectory run_ = driftAndReturn();
};

TEST_F(OutcomeRows, tellWhatBecameOfEachBoxThatMoves) {
  const Family::Member member = family_.member(12);
  const std::string rows = outcomeRows(12, member, run_, {}, {}, {});
  const OutcomeTable table(family_, {}, rows + rows, "rows");
  ASSERT_EQ(table.boxes, (std::vector<std::string>{"a \"b\",\nc", "a \"b\",\nc"}));
  EXPECT_EQ(value(table, "run"), 12);
  EXPECT_EQ(value(table, "gravity[2]"), member.scene.gravity.z());
  EXPECT_EQ(value(table, "half_y"), 0.2);
  EXPECT_EQ(value(table, "mass"), 2);
  EXPECT_EQ(value(table, "restitution"), 0.5);
  EXPECT_EQ(value(table, "start_vx"), 2);
  EXPECT_EQ(value(table, "end_x"), 1);
  EXPECT_EQ(value(table, "end_vx"), -2);
  EXPECT_EQ(value(table, "face_up"), 6);
  EXPECT_EQ(value(table, "impacts"), 1);
  EXPECT_EQ(value(table, "first_impact"), 0.5);
  EXPECT_TRUE(std::isnan(value(table, "rest_since")));
  EXPECT_EQ(value(table, "broken"), 0);
  const std::vector<ZipEntry> entries = unzipped(table.archive(), "table.npz");
  ASSERT_EQ(entries.size(), table.columns.size() + 1);
  EXPECT_EQ(entries[0].first, "run.npy");
  EXPECT_EQ(decodeNumpy(entries[0].second, "run").numbers, (std::vector<double>{12, 12}));
}

TEST_F(OutcomeRows, faceUpIsThatAgainstGravity) {
  const Family::Member member = family_.member(0);
  auto& step = std::get<EulerStep>(run_.tracks[0].segments.open()[1].motion);
  step.start.angularMomentum = Vec3::Zero();
  const auto face = [&](const Mat3& worldFromBody, const Vec3& gravity) {
    step.start.pose.worldFromBody = worldFromBody;
    run_.world.gravity = gravity;
    return value(OutcomeTable(family_, {}, outcomeRows(0, member, run_, {}, {}, {}), "rows"), "face_up");
  };
  const Mat3 quarter = Eigen::AngleAxisd(M_PI / 2, Vec3::UnitX()).toRotationMatrix();  // y to z
  EXPECT_EQ(face(quarter, Vec3(0, 0, -1)), 4);
  EXPECT_EQ(face(quarter.transpose(), Vec3(0, 0, -1)), 3);
  EXPECT_EQ(face(Mat3::Identity(), Vec3(1, 0, 0)), 1);
  EXPECT_EQ(face(Mat3::Identity(), Vec3(-1, 0, 0)), 2);
  EXPECT_EQ(face(Mat3::Identity(), Vec3(0, 0, 3)), 5);
}

TEST_F(OutcomeRows, damagedLinesAreRefused) {
  const std::string rows = outcomeRows(1, family_.member(1), run_, {}, {}, {});
  EXPECT_EQ(OutcomeTable(family_, {}, rows, "rows").boxes.size(), 1U);
  for (std::size_t cut = 1; cut < rows.size(); ++cut) {
    EXPECT_THROW(OutcomeTable(family_, {}, rows.substr(0, cut), "rows"), InputError) << cut;
  }
  EXPECT_THROW(OutcomeTable(family_, {}, "x" + rows, "rows"), InputError);
}

// It is at 2 m at 0.5 s, where it is hit and turns back; without a box "other" there is no such moment.
TEST_F(OutcomeRows, tellWhenQuestionsAreFirstTrue) {
  run_.world.bodies[0].name = "drifter";
  const std::vector<std::string> questions = {"x(drifter) > 1.5", "x(drifter) > 3", "rest(other)"};
  const std::string rows = outcomeRows(12, family_.member(12), run_, {}, {}, {.questions = questions});
  const OutcomeTable table(family_, {.questions = questions}, rows, "rows");
  EXPECT_NEAR(value(table, questions[0]), 0.25, 1e-12);
  EXPECT_TRUE(std::isnan(value(table, questions[1])));
  EXPECT_TRUE(std::isnan(value(table, questions[2])));
  EXPECT_TRUE(
      outcomeHeader(family_, {.questions = questions})
          .ends_with(",rest_since,x(drifter) > 1.5,x(drifter) > 3,rest(other),run_impacts,broken,box\n"));
  EXPECT_NO_THROW(checkQuestions(family_, {"x(drifter) > 1.5", "rest"}));
  EXPECT_THROW(checkQuestions(family_, {"rest(other)"}), InputError);
  EXPECT_THROW(checkQuestions(family_, {"rest", "rest"}), InputError);
}

TEST_F(OutcomeRows, headerNamesTheColumns) {
  const std::string header = outcomeHeader(family_, {});
  EXPECT_TRUE(header.starts_with("run,attempts,gravity[2],half_x,")) << header;
  EXPECT_TRUE(header.ends_with(",run_impacts,broken,box\n")) << header;
}

TEST_F(OutcomeRows, errorsAreThereIfTheyAreAskedFor) {
  const OutcomesAsked asked{.errors = true};
  const ErrorEstimate error{.by = "", .position = 0.25, .angle = 0.5, .until = 1.5};
  const OutcomeTable known(family_, asked, outcomeRows(1, family_.member(1), run_, {}, error, asked), "rows");
  EXPECT_EQ(value(known, "error_position"), 0.25);
  EXPECT_EQ(value(known, "error_angle"), 0.5);
  EXPECT_EQ(value(known, "error_until"), 1.5);
  const OutcomeTable unknown(family_, asked, outcomeRows(1, family_.member(1), run_, {}, {}, asked), "rows");
  EXPECT_TRUE(std::isnan(value(unknown, "error_position")));
  EXPECT_EQ(outcomeHeader(family_, {}).find("error_"), std::string::npos);
}

}  // namespace
}  // namespace careen
