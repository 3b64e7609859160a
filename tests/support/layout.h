#pragma once

#include <map>
#include <set>
#include <string>

namespace careen::layout {

using Names = std::set<std::string>;

// The whole of it: a folder that is not here may not exist.
inline const std::map<std::string, Names> kMayInclude = {
    {"core", {}},
    {"physics", {"core"}},
    {"image", {"core"}},
    {"stage", {"physics", "core"}},
    {"film", {"image", "stage", "core"}},
    {"scene", {"physics", "stage", "core"}},
    {"trajectory", {"physics", "stage", "core"}},
    {"audit", {"trajectory", "physics", "stage", "core"}},
    {"question", {"trajectory", "audit", "physics", "stage", "core"}},
    {"compare", {"film", "image", "trajectory", "stage", "core"}},
    {"runs",
     {"scene", "exchange", "question", "audit", "compare", "film", "trajectory", "physics", "stage", "core"}},
    {"study", {"runs", "scene", "exchange", "trajectory", "audit", "physics", "core"}},
    {"view", {"trajectory", "physics", "stage", "core"}},
    {"sound", {"film", "view", "trajectory", "physics", "stage", "core"}},
    {"page", {"audit", "trajectory", "physics", "stage", "core"}},
    {"truth", {"view", "film", "trajectory", "stage", "physics", "core"}},
    {"sweep", {"runs", "scene", "trajectory", "audit", "question", "physics", "stage", "core"}},
    {"exchange", {"scene", "view", "trajectory", "physics", "stage", "core"}},
    {"render", {"view", "trajectory", "film", "stage", "image", "core"}},
    {"library",
     {"render", "runs", "page", "sound", "truth", "sweep", "compare", "exchange", "scene", "trajectory",
      "audit", "question", "film", "image", "stage", "physics", "core"}},
};

// Rooms of a folder, and whom each may include among them; "" is what lies in the folder itself.
using Rooms = std::map<std::string, Names>;
inline const std::map<std::string, Rooms> kRooms = {
    {"core", {{"", {}}, {"math", {}}, {"system", {""}}}},
    {"physics",
     {{"world", {}},
      {"attitude", {"world"}},
      {"geometry", {"world"}},
      {"motion", {"attitude", "world"}},
      {"start", {"geometry", "solver", "world"}},
      {"search", {"geometry", "motion"}},
      {"impact", {"geometry", "solver", "world"}},
      {"solver", {"world"}},
      {"contact", {"geometry", "impact", "motion", "solver", "world"}},
      {"pile", {"attitude", "contact", "geometry", "motion", "solver", "world"}},
      {"exact", {"attitude", "contact", "geometry", "impact", "motion", "pile", "search", "world"}},
      {"compared", {"attitude", "geometry", "impact", "motion", "world"}},
      {"",
       {"exact", "compared", "contact", "attitude", "geometry", "motion", "pile", "search", "solver",
        "world"}}}},
    {"render",
     {{"gl", {}},
      {"look", {}},
      {"overlay", {"gl"}},
      {"draw", {"gl", "look", "overlay"}},
      {"window", {"gl", "overlay"}},
      {"film", {"draw", "overlay"}}}},
};

}  // namespace careen::layout
