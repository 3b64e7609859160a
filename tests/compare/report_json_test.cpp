#include <gtest/gtest.h>

#include <limits>
#include <nlohmann/json.hpp>
#include <string>
#include <valijson/adapters/nlohmann_json_adapter.hpp>
#include <valijson/schema.hpp>
#include <valijson/schema_parser.hpp>
#include <valijson/validator.hpp>

#include "compare/report.h"
#include "comparisons.h"
#include "core/system/file.h"

namespace careen {
namespace {

using Json = nlohmann::json;

Comparison threeFrames() {
  Comparison comparison;
  comparison.expected = "reference";
  comparison.actual = "film";
  comparison.program = "careen 1.2.3";
  comparison.toleranceName = "exact, fail=0.5";
  comparison.tolerance = toleranceOf("exact");
  comparison.tolerance.fail = 0.5;
  comparison.verdict = Verdict::kDifferent;
  comparison.headline = "other picture in 2 of 3 frames";
  comparison.ignored.add("1,2,3,4");
  comparison.facts = {{"renderer", "one", "other"}};
  comparison.frames = {sameFrame("a.png"), otherFrame("b.png", 0.25, 7, 8), {}};
  comparison.frames[1].flip = 0.125;
  comparison.frames[2].name = "c.png";
  comparison.frames[2].verdict = Verdict::kDifferent;
  comparison.frames[2].reasons = {"it is missing"};
  return comparison;
}

TEST(ReportJson, isAsItsSchemaTells) {
  using Adapter = valijson::adapters::NlohmannJsonAdapter;
  const Json text =
      Json::parse(readFile(std::string(CAREEN_SOURCE_DIR) + "/assets/compare/report.schema.json"));
  valijson::Schema schema;
  valijson::SchemaParser(valijson::SchemaParser::kDraft7).populateSchema(Adapter(text), schema);
  const auto accepts = [&schema](const Json& report) {
    return valijson::Validator().validate(schema, Adapter(report), nullptr);
  };
  Comparison none = twoRuns();
  none.run->incomparable = {"box a is not there"};
  none.run->firstImpact->actual.reset();
  for (const Comparison& comparison : {threeFrames(), twoRuns(), none}) {
    Json report = Json::parse(reportJson(comparison));
    EXPECT_TRUE(accepts(report));
    report["another"] = 1;
    EXPECT_FALSE(accepts(report));
    report.erase("another");
    report.erase("headline");
    EXPECT_FALSE(accepts(report));
  }
}

TEST(ReportJson, hasEveryFieldOfTheComparison) {
  const Json report = Json::parse(reportJson(threeFrames()));
  EXPECT_EQ(report.at("report"), 1);
  EXPECT_EQ(report.at("program"), "careen 1.2.3");
  EXPECT_EQ(report.at("expected"), "reference");
  EXPECT_EQ(report.at("actual"), "film");
  EXPECT_EQ(report.at("verdict"), "different");
  EXPECT_EQ(report.at("headline"), "other picture in 2 of 3 frames");
  EXPECT_EQ(report.at("tolerance").at("name"), "exact, fail=0.5");
  EXPECT_EQ(report.at("tolerance").at("fail"), 0.5);
  EXPECT_EQ(report.at("facts"),
            Json::parse(R"([{"name": "renderer", "expected": "one", "actual": "other"}])"));
  EXPECT_EQ(report.at("counts"), Json::parse(R"({"frames": 3, "same": 1, "warning": 0, "different": 2,
                                                "identical": 1, "not_measured": 1})"));
  EXPECT_EQ(report.at("first_different"), "b.png");
  EXPECT_EQ(report.at("worst"), "b.png");
  EXPECT_TRUE(report.at("run").is_null());
  EXPECT_EQ(report.at("frames").size(), 3U);
  EXPECT_EQ(report.at("frames").at(1), Json::parse(R"({"name": "b.png", "verdict": "different",
      "reasons": ["3 % of the pixels differ; at most 0.01 % may"], "identical": false, "measured": true,
      "largest": 0.25, "largest_at": [7, 8], "mean": 0.0025, "psnr": 15.0, "ssim": 0.875, "worst_ssim": 0.5,
      "failing_percent": 3.0, "changed_percent": 1.0, "edge_percent": 0.0, "flip": 0.125})"));
}

TEST(ReportJson, namesIgnoredRegions) {
  EXPECT_EQ(Json::parse(reportJson(threeFrames())).at("ignored"), Json({"1,2,3,4"}));
  EXPECT_EQ(Json::parse(reportJson(twoRuns())).at("ignored"), Json::array());
}

TEST(ReportJson, tellsWhatIsInfiniteAndWhatWasNotMeasured) {
  const Json report = Json::parse(reportJson(threeFrames(), -1));
  EXPECT_EQ(report.at("tolerance").at("hard_fail"), "Infinity");
  EXPECT_EQ(report.at("frames").at(0).at("psnr"), "Infinity");
  EXPECT_TRUE(report.at("frames").at(0).at("flip").is_null());
  const Json& missing = report.at("frames").at(2);
  for (const char* key : {"largest", "largest_at", "mean", "psnr", "ssim", "worst_ssim", "failing_percent",
                          "changed_percent", "edge_percent", "flip"}) {
    EXPECT_TRUE(missing.at(key).is_null()) << key;
  }
  EXPECT_EQ(missing.at("reasons"), Json::parse(R"(["it is missing"])"));
}

TEST(ReportJson, namesThatAreNoUtf8StillMakeJson) {
  Comparison comparison = threeFrames();
  comparison.frames[1].name = "b\xFF\"\n.png";
  EXPECT_EQ(Json::parse(reportJson(comparison)).at("frames").at(1).at("name"), "b\uFFFD\"\n.png");
}

TEST(ReportJson, ofRunsHasImpactsAndGrowth) {
  const Comparison comparison = twoRuns();
  const Json found = Json::parse(reportJson(comparison)).at("run");
  EXPECT_FALSE(found.at("same_bits").get<bool>());
  EXPECT_EQ(found.at("first_time"), 0.5);
  EXPECT_GT(found.at("horizon").get<double>(), 0.5);
  EXPECT_EQ(found.at("impacts"), Json::parse(R"({"expected": 1, "actual": 1})"));
  EXPECT_EQ(found.at("duration"), Json::parse(R"({"expected": 1.0, "actual": 1.0})"));
  EXPECT_EQ(found.at("kinetic_energy").at("expected"), comparison.run->expectedEnergy);
  EXPECT_EQ(found.at("first_impact").at("index"), 0);
  EXPECT_EQ(found.at("first_impact").at("expected").at("bodies"), "drifter against room+x");
  EXPECT_EQ(found.at("first_impact").at("expected").at("impulse"), 8);
  EXPECT_EQ(found.at("first_impact").at("actual").at("impulse"), 8.5);
  EXPECT_EQ(found.at("first_impact").at("actual").at("point"), Json::parse("[2.1, 0.0, 0.0]"));
  EXPECT_TRUE(found.at("first_other_event").is_null());
  EXPECT_EQ(found.at("impacts_around").size(), 1U);
  EXPECT_EQ(found.at("growth").size(), kRunSamples + 1U);
  EXPECT_EQ(found.at("growth").back().at("box"), "drifter");
  EXPECT_DOUBLE_EQ(found.at("growth").back().at("position"), 0.5);
}

}  // namespace
}  // namespace careen
