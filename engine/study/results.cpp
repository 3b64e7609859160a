#include "study/results.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <set>
#include <utility>

#include "study/verdicts.h"

namespace careen {
namespace {

using OrderedJson = nlohmann::ordered_json;

constexpr double kMostDigits = 16;

const char* nameOf(Measure measure) {
  switch (measure) {
    case Measure::kPoses:
      return "poses";
    case Measure::kEnergy:
      return "energy";
    case Measure::kReversal:
      return "reversal";
    case Measure::kScaled:
      return "scaled";
    case Measure::kOverlap:
      return "overlap";
  }
  return "";
}

OrderedJson toJson(const Attempt& attempt) {
  OrderedJson json = {{"contestant", attempt.contestant}, {"settings", attempt.settings}};
  if (attempt.dt > 0) {
    json["dt"] = attempt.dt;
  }
  if (attempt.tolerance > 0) {
    json["tolerance"] = attempt.tolerance;
  }
  if (attempt.sameTo > 0) {
    json["same_to"] = attempt.sameTo;
  }
  if (!attempt.failure.empty()) {
    json["failure"] = attempt.failure;
    return json;
  }
  json["error"] = attempt.judgement.error;
  if (attempt.judgement.displacement) {
    json["displacement"] = *attempt.judgement.displacement;
  }
  if (attempt.judgement.jointGap) {
    json["joint_gap"] = *attempt.judgement.jointGap;
  }
  json["audit"] = attempt.audit;
  json["cost_us"] = attempt.cost;
  json["spread"] = attempt.spread;
  json["repeats"] = attempt.repeats;
  json["energy"] = attempt.judgement.energy;
  return json;
}

// A float in the file must not be converted: beyond int that is undefined.
int wholeNumber(const OrderedJson& json) {
  const auto value = json.get<double>();
  return value >= 0 && value <= 1e9 ? static_cast<int>(value) : 0;
}

Attempt attemptFrom(const OrderedJson& json) {
  Attempt attempt;
  attempt.contestant = json.at("contestant").get<std::string>();
  attempt.settings = json.at("settings").get<std::string>();
  attempt.dt = json.value("dt", 0.0);
  attempt.tolerance = json.value("tolerance", 0.0);
  attempt.sameTo = json.value("same_to", 0.0);
  attempt.failure = json.value("failure", "");
  if (attempt.failure.empty()) {
    attempt.judgement.error = json.at("error").get<double>();
    if (json.contains("displacement")) {
      attempt.judgement.displacement = json["displacement"].get<double>();
    }
    if (json.contains("joint_gap")) {
      attempt.judgement.jointGap = json["joint_gap"].get<double>();
    }
    attempt.judgement.energy = json.at("energy").get<std::vector<double>>();
    attempt.audit = json.at("audit").get<std::string>();
    attempt.cost = json.at("cost_us").get<double>();
    attempt.spread = json.at("spread").get<double>();
    attempt.repeats = wholeNumber(json.at("repeats"));
  }
  return attempt;
}

bool isBetter(const Attempt& attempt, const Attempt& other) {
  return attempt.failure.empty() && attempt.cost > 0 && attempt.cost < other.cost &&
         attempt.judgement.error < other.judgement.error;
}

OrderedJson toJson(const CaseResult& result) {
  OrderedJson attempts = OrderedJson::array();
  for (const Attempt& attempt : result.attempts) {
    attempts.push_back(toJson(attempt));
  }
  OrderedJson json = {{"case", result.name},
                      {"title", result.title},
                      {"why_hard", result.whyHard},
                      {"truth", result.source},
                      {"measure", result.measure}};
  if (!result.published.empty()) {
    json["published"] = result.published;
    for (const std::string& contestant :
         StudyResult{.machine = {}, .command = {}, .cases = {result}}.contestants()) {
      json["verdicts"][contestant] = verdictOf(usualAttempt(result, contestant));
    }
  }
  json["stamp"] = result.stamp;
  json["usual_dt"] = result.usualStep;
  json["usual_tolerance"] = result.usualTolerance;
  json["times"] = result.times;
  OrderedJson promises = OrderedJson::array();
  for (const double factor : kPromisedTolerances) {
    if (const std::optional<double> kept = promiseOf(result, factor)) {
      promises.push_back({{"tolerance", factor * result.usualTolerance}, {"error_over_tolerance", *kept}});
    }
  }
  json["promises"] = std::move(promises);
  json["attempts"] = std::move(attempts);
  return json;
}

}  // namespace

CaseResult resultOf(const Case& study, std::vector<Attempt> attempts, std::string stamp) {
  return {.name = study.name,
          .title = study.title,
          .whyHard = study.whyHard,
          .source = study.source,
          .measure = nameOf(study.measure),
          .published = study.published,
          .stamp = std::move(stamp),
          .usualStep = study.scene.settings.dt,
          .usualTolerance = study.scene.settings.tolerance,
          .times = study.times,
          .attempts = std::move(attempts)};
}

std::string encodeResult(const CaseResult& result) { return toJson(result).dump(1) + "\n"; }

std::optional<CaseResult> decodeResult(const std::string& text) {
  try {
    const OrderedJson json = OrderedJson::parse(text);
    CaseResult result{.name = json.at("case").get<std::string>(),
                      .title = json.at("title").get<std::string>(),
                      .whyHard = json.at("why_hard").get<std::string>(),
                      .source = json.at("truth").get<std::string>(),
                      .measure = json.at("measure").get<std::string>(),
                      .published = json.value("published", ""),
                      .stamp = json.at("stamp").get<std::string>(),
                      .usualStep = json.at("usual_dt").get<double>(),
                      .usualTolerance = json.at("usual_tolerance").get<double>(),
                      .times = json.at("times").get<std::vector<double>>(),
                      .attempts = {}};
    for (const OrderedJson& attempt : json.at("attempts")) {
      result.attempts.push_back(attemptFrom(attempt));
    }
    const bool fits = std::all_of(
        result.attempts.begin(), result.attempts.end(),
        [&](const Attempt& attempt) { return attempt.judgement.energy.size() <= result.times.size(); });
    return fits ? std::optional(std::move(result)) : std::nullopt;
  } catch (const OrderedJson::exception&) {
    return std::nullopt;
  }
}

std::vector<std::string> StudyResult::contestants() const {
  std::vector<std::string> names;
  std::set<std::string> known;
  for (const CaseResult& result : cases) {
    for (const Attempt& attempt : result.attempts) {
      if (known.insert(attempt.contestant).second) {
        names.push_back(attempt.contestant);
      }
    }
  }
  return names;
}

std::vector<std::pair<std::string, std::string>> StudyResult::settings() const {
  std::vector<std::pair<std::string, std::string>> known;
  for (const CaseResult& result : cases) {
    for (const Attempt& attempt : result.attempts) {
      const std::pair<std::string, std::string> entry(attempt.contestant, attempt.settings);
      if (std::find(known.begin(), known.end(), entry) == known.end()) {
        known.push_back(entry);
      }
    }
  }
  return known;
}

const Attempt* usualAttempt(const CaseResult& result, const std::string& contestant) {
  const auto found =
      std::find_if(result.attempts.begin(), result.attempts.end(), [&](const Attempt& attempt) {
        return attempt.contestant == contestant && (attempt.dt == 0 || attempt.dt == result.usualStep) &&
               (attempt.tolerance == 0 ||
                (attempt.sameTo <= result.usualTolerance && result.usualTolerance <= attempt.tolerance));
      });
  return found == result.attempts.end() ? nullptr : &*found;
}

bool onFront(const CaseResult& result, const Attempt& attempt) {
  return attempt.failure.empty() && attempt.cost > 0 &&
         std::none_of(result.attempts.begin(), result.attempts.end(),
                      [&](const Attempt& other) { return isBetter(other, attempt); });
}

std::vector<const Attempt*> betterThan(const CaseResult& result, const Attempt& attempt) {
  std::vector<const Attempt*> better;
  for (const Attempt& other : result.attempts) {
    if (other.contestant != attempt.contestant && isBetter(other, attempt)) {
      better.push_back(&other);
    }
  }
  return better;
}

double correctDigits(double error) {
  return error > 0 ? std::clamp(-std::log10(error), 0.0, kMostDigits) : kMostDigits;
}

std::string resultsJson(const StudyResult& study) {
  OrderedJson cases = OrderedJson::array();
  for (const CaseResult& result : study.cases) {
    cases.push_back(toJson(result));
  }
  return OrderedJson{{"machine", study.machine}, {"command", study.command}, {"cases", std::move(cases)}}
             .dump(1) +
         "\n";
}

}  // namespace careen
