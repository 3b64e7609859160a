#include "page/run_page.h"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <vector>

#include "core/base64.h"
#include "trajectory/energy_samples.h"

namespace careen {
namespace {

using Json = nlohmann::ordered_json;

// Impacts of the page, in order of time: the hardest, if there are too many.
std::vector<Impact> impactsOf(const Trajectory& run) {
  std::vector<Impact> impacts = run.impacts;
  if (impacts.size() > kMostImpactsOnPage) {
    const auto isHarder = [](const Impact& a, const Impact& b) { return a.impulse > b.impulse; };
    std::nth_element(impacts.begin(), impacts.begin() + kMostImpactsOnPage, impacts.end(), isHarder);
    impacts.resize(kMostImpactsOnPage);
    std::stable_sort(impacts.begin(), impacts.end(),
                     [](const Impact& a, const Impact& b) { return a.time < b.time; });
  }
  return impacts;
}

Json impactsJson(const Trajectory& run, const std::vector<Impact>& impacts) {
  Json list = Json::array();
  for (const Impact& impact : impacts) {
    list.push_back({impact.time, run.world.bodies[static_cast<std::size_t>(impact.a.value)].name,
                    run.partnerName(impact), impact.approach, impact.impulse, impact.tangential});
  }
  return list;
}

// Evenly, and on both sides of impacts, where energies jump: as many as there are evenly.
std::vector<double> momentsOf(const Trajectory& run, const std::vector<Impact>& impacts) {
  std::vector<double> moments;
  for (std::size_t k = 0; k <= kMomentsOnPage; ++k) {
    moments.push_back(run.settings.duration * static_cast<double>(k) / static_cast<double>(kMomentsOnPage));
  }
  const std::size_t every = impacts.size() / kMomentsOnPage + 1;
  for (std::size_t k = 0; k < impacts.size(); k += every) {
    moments.push_back(std::max(0.0, impacts[k].time * (1 - 1e-9)));
    moments.push_back(impacts[k].time);
  }
  std::sort(moments.begin(), moments.end());
  return moments;
}

Json energiesJson(const Trajectory& run, const std::vector<Impact>& impacts) {
  Json columns = {{"time", Json::array()}};
  EnergySamples samples(run);
  for (const double time : momentsOf(run, impacts)) {
    const RunEnergies energies = samples.at(time);
    columns["time"].push_back(time);
    for (const EnergyColumn& column : kEnergyColumns) {
      columns[std::string(column.name)].push_back(column.of(energies));
    }
  }
  return columns;
}

Json auditJson(const Trajectory& run, const Audit& audit) {
  Json breaches = Json::array();
  for (const AuditBreach& breach : audit.breaches) {
    breaches.push_back(describe(breach, run));
  }
  return {{"words", inWords(audit)}, {"breaches", std::move(breaches)}};
}

Json clockJson(const Trajectory& run) {
  Json keys = Json::array();
  for (const TimeKey& key : run.stage.timeMap.within(run.settings.duration).keys) {
    keys.push_back({key.film, key.scene});
  }
  return keys;
}

// In HTML nothing may end the script but its own end.
std::string scriptText(const Json& json) {
  std::string text = json.dump(-1, ' ', false, Json::error_handler_t::replace);
  for (std::size_t at = text.find('<'); at != std::string::npos; at = text.find('<', at)) {
    text.replace(at, 1, "\\u003c");
  }
  return text;
}

void replace(std::string& page, std::string_view mark, std::string_view text) {
  page.replace(page.find(mark), mark.size(), text);
}

}  // namespace

std::string runPage(const Trajectory& run, const Audit& audit, const PageFilm& film,
                    const std::string& program) {
  const std::vector<Impact> impacts = impactsOf(run);
  const Json data = {{"name", run.stage.name},
                     {"program", program},
                     {"method", run.methodName()},
                     {"duration", run.settings.duration},
                     {"boxes", run.world.bodies.size()},
                     {"impact_count", run.impacts.size()},
                     {"clock", clockJson(run)},
                     {"energies", energiesJson(run, impacts)},
                     {"impacts", impactsJson(run, impacts)},
                     {"audit", auditJson(run, audit)}};
  std::string page(embeddedRunPage("run.html"));
  replace(page, "/*STYLE*/", std::string(embeddedRunPage("base.css")).append(embeddedRunPage("run.css")));
  replace(page, "/*SCRIPT*/", embeddedRunPage("run.js"));
  replace(page, "{{DATA}}", scriptText(data));
  replace(page, "{{FILM}}", "data:" + film.type + ";base64," + base64(film.bytes));
  return page;
}

}  // namespace careen
