#include <cmath>
#include <nlohmann/json.hpp>
#include <string>

#include "compare/report.h"
#include "compare/report_words.h"

namespace careen {
namespace {

using Json = nlohmann::ordered_json;

Json number(double value) {
  if (std::isnan(value)) {
    return "NaN";
  }
  if (std::isinf(value)) {
    return value > 0 ? "Infinity" : "-Infinity";
  }
  return value;
}

Json number(const std::optional<double>& value) { return value ? number(*value) : Json(nullptr); }

// Names of files and boxes may contain any bytes.
std::string text(const Json& json, int indent) {
  return json.dump(indent, ' ', false, Json::error_handler_t::replace);
}

Json toleranceJson(const Comparison& comparison) {
  const Tolerance& tolerance = comparison.tolerance;
  return {{"name", comparison.toleranceName},
          {"fail", number(tolerance.fail)},
          {"fail_percent", number(tolerance.failPercent)},
          {"hard_fail", number(tolerance.hardFail)},
          {"warn", number(tolerance.warn)},
          {"warn_percent", number(tolerance.warnPercent)},
          {"hard_warn", number(tolerance.hardWarn)},
          {"excuse_edges", tolerance.excuseEdges},
          {"changed_percent", number(tolerance.changedPercent)},
          {"edge_percent", number(tolerance.edgePercent)},
          {"least_ssim", number(tolerance.leastSsim)},
          {"least_window_ssim", number(tolerance.leastWindowSsim)}};
}

Json frameOf(const FrameComparison& frame) {
  Json json = {{"name", frame.name},
               {"verdict", nameOf(frame.verdict)},
               {"reasons", frame.reasons},
               {"identical", frame.identical},
               {"measured", frame.measured}};
  const auto measured = [&frame](double value) { return frame.measured ? number(value) : Json(nullptr); };
  json["largest"] = measured(frame.largest);
  json["largest_at"] = frame.measured ? Json({frame.largestX, frame.largestY}) : Json(nullptr);
  json["mean"] = measured(frame.mean);
  json["psnr"] = measured(frame.psnr);
  json["ssim"] = measured(frame.ssim);
  json["worst_ssim"] = measured(frame.worstSsim);
  json["failing_percent"] = measured(frame.failingPercent);
  json["changed_percent"] = measured(frame.changedPercent);
  json["edge_percent"] = measured(frame.edgePercent);
  json["flip"] = number(frame.measured ? frame.flip : std::nullopt);
  return json;
}

Json countsJson(const Comparison& comparison) {
  const FrameCounts counts = countFrames(comparison);
  return {{"frames", comparison.frames.size()}, {"same", counts.same},
          {"warning", counts.warning},          {"different", counts.different},
          {"identical", counts.identical},      {"not_measured", counts.notMeasured}};
}

Json sampleJson(const RunSample& sample) {
  return {{"time", number(sample.time)},
          {"position", number(sample.difference.position)},
          {"angle", number(sample.difference.angle)},
          {"relative", number(sample.difference.relative)},
          {"box", sample.body}};
}

Json vectorJson(const Vec3& vector) { return {number(vector.x()), number(vector.y()), number(vector.z())}; }

Json impactJson(const std::optional<Impact>& impact, const std::string& bodies) {
  if (!impact) {
    return nullptr;
  }
  return {{"bodies", bodies},
          {"time", number(impact->time)},
          {"point", vectorJson(impact->point)},
          {"normal", vectorJson(impact->normal)},
          {"approach", number(impact->approach)},
          {"impulse", number(impact->impulse)},
          {"tangential", number(impact->tangential)}};
}

Json impactsJson(const ImpactDifference& difference) {
  return {{"index", difference.index},
          {"what", difference.what},
          {"expected", impactJson(difference.expected, difference.expectedBodies)},
          {"actual", impactJson(difference.actual, difference.actualBodies)}};
}

Json impactsJson(const std::optional<ImpactDifference>& difference) {
  return difference ? impactsJson(*difference) : Json(nullptr);
}

template <class Value>
Json bothJson(const Value& expected, const Value& actual) {
  return {{"expected", expected}, {"actual", actual}};
}

Json runJson(const RunDifference& run) {
  Json growth = Json::array();
  for (const RunSample& sample : run.growth) {
    growth.push_back(sampleJson(sample));
  }
  Json around = Json::array();
  for (const ImpactDifference& impact : run.impactsAround) {
    around.push_back(impactsJson(impact));
  }
  return {{"incomparable", run.incomparable},
          {"same_bits", run.sameBits},
          {"until", number(run.until)},
          {"first_time", number(run.firstTime)},
          {"horizon", number(run.horizon)},
          {"growth_per_impact", number(run.growthPerImpact)},
          {"worst", sampleJson(run.worst)},
          {"first_impact", impactsJson(run.firstImpact)},
          {"first_other_event", impactsJson(run.firstOtherEvent)},
          {"last_impact", impactsJson(run.lastImpact)},
          {"first_broken", run.firstBroken.empty() ? Json(nullptr) : Json(run.firstBroken)},
          {"impacts_around", around},
          {"impacts", bothJson(run.expectedImpacts, run.actualImpacts)},
          {"duration", bothJson(number(run.expectedDuration), number(run.actualDuration))},
          {"kinetic_energy", bothJson(number(run.expectedEnergy), number(run.actualEnergy))},
          {"growth", growth}};
}

Json nameOrNull(const FrameComparison* frame) { return frame == nullptr ? Json(nullptr) : Json(frame->name); }

}  // namespace

std::string reportJson(const Comparison& comparison, int indent) {
  Json facts = Json::array();
  for (const Fact& fact : comparison.facts) {
    facts.push_back({{"name", fact.name}, {"expected", fact.expected}, {"actual", fact.actual}});
  }
  Json frames = Json::array();
  for (const FrameComparison& frame : comparison.frames) {
    frames.push_back(frameOf(frame));
  }
  const Json report = {{"report", 1},
                       {"program", comparison.program},
                       {"expected", comparison.expected.string()},
                       {"actual", comparison.actual.string()},
                       {"verdict", nameOf(comparison.verdict)},
                       {"headline", comparison.headline},
                       {"reason", reasonOf(comparison)},
                       {"tolerance", toleranceJson(comparison)},
                       {"ignored", comparison.ignored.names()},
                       {"facts", facts},
                       {"counts", countsJson(comparison)},
                       {"first_different", nameOrNull(comparison.firstDifferent())},
                       {"worst", nameOrNull(comparison.worst())},
                       {"frames", frames},
                       {"run", comparison.run ? runJson(*comparison.run) : Json(nullptr)}};
  return text(report, indent);
}

std::string frameJson(const FrameComparison& frame) { return text(frameOf(frame), -1); }

}  // namespace careen
