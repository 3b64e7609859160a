// The layout as the project's rules give it: who may include whom, and where foreign headers may appear.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <map>
#include <regex>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "support/source_text.h"

namespace careen {
namespace {

namespace fs = std::filesystem;
using source_text::kRoot;
using source_text::sourcesIn;
using source_text::textOf;
using Names = std::set<std::string>;

// The whole of it: a folder that is not here may not exist.
const std::map<std::string, Names> kMayInclude = {
    {"core", {}},
    {"physics", {"core"}},
    {"image", {"core"}},
    {"stage", {"physics", "core"}},
    {"film", {"image", "stage", "core"}},
    {"scene", {"physics", "stage", "core"}},
    {"trajectory", {"physics", "stage", "core"}},
    {"audit", {"trajectory", "physics", "stage", "core"}},
    {"study", {"scene", "trajectory", "audit", "physics", "core"}},
    {"compare", {"image", "trajectory", "core"}},
    {"view", {"trajectory", "physics", "stage", "core"}},
    {"truth", {"view", "film", "trajectory", "stage", "physics", "core"}},
    {"sweep", {"scene", "trajectory", "audit", "physics", "stage", "core"}},
    {"exchange", {"scene", "view", "trajectory", "physics", "stage", "core"}},
    {"render", {"view", "trajectory", "film", "stage", "image", "core"}},
    {"library", {"render", "scene", "trajectory", "audit", "stage", "physics", "core"}},
};

// Rooms of a folder, and whom each may include among them; "" is what lies in the folder itself.
using Rooms = std::map<std::string, Names>;
const std::map<std::string, Rooms> kRooms = {
    {"core", {{"", {}}, {"math", {}}, {"system", {""}}}},
    {"physics",
     {{"world", {}},
      {"attitude", {"world"}},
      {"geometry", {"world"}},
      {"motion", {"attitude", "world"}},
      {"start", {"geometry", "world"}},
      {"search", {"geometry", "motion"}},
      {"impact", {"geometry", "solver", "world"}},
      {"solver", {"world"}},
      {"contact", {"geometry", "impact", "motion", "solver", "world"}},
      {"pile", {"attitude", "geometry", "motion", "solver", "world"}},
      {"exact", {"attitude", "contact", "geometry", "impact", "motion", "pile", "search", "world"}},
      {"compared", {"attitude", "geometry", "impact", "motion", "world"}},
      {"", {"exact", "compared", "attitude", "motion", "world"}}}},
    {"render",
     {{"gl", {}},
      {"look", {}},
      {"overlay", {"gl"}},
      {"draw", {"gl", "look", "overlay"}},
      {"window", {"gl", "overlay"}},
      {"film", {"draw", "overlay"}}}},
};

// What the rest of the program may include of a folder that has a door: rooms, and single headers.
const std::map<std::string, Names> kDoors = {{"physics", {"world", "motion", "start", "simulate.h"}}};
// Who may enter fewer of its rooms.
const std::map<std::string, Names> kNarrowDoors = {{"stage", {"world"}}, {"audit", {"world", "motion"}}};

std::vector<std::string> includesOf(const fs::path& source) {
  static const std::regex kInclude(R"re((?:^|\n)\s*#\s*include\s*[<"]([^>"]+)[>"])re");
  const std::string text = textOf(source);
  std::vector<std::string> includes;
  for (auto match = std::sregex_iterator(text.begin(), text.end(), kInclude); match != std::sregex_iterator();
       ++match) {
    includes.push_back((*match)[1]);
  }
  return includes;
}

/// Where a header or a source lies: physics/world/body.h is {physics, world, body.h}.
struct Place {
  std::string folder;
  std::string room{};  // "" for the folder itself
  std::string file{};

  bool isOurs() const { return kMayInclude.contains(folder) || folder == "app" || folder == "tests"; }
};

// `path` is from engine/; one without a folder is nobody's.
Place placeOf(const fs::path& path) {
  std::vector<std::string> parts;
  for (const fs::path& part : path) {
    parts.push_back(part.string());
  }
  if (parts.size() < 2) {
    return {};
  }
  return {.folder = parts[0], .room = parts.size() > 2 ? parts[1] : "", .file = parts.back()};
}

/// An include of one of our headers.
struct Include {
  fs::path source;
  Place from;
  Place to;
};

std::vector<Include> includesInEngine() {
  std::vector<Include> includes;
  for (const fs::path& source : sourcesIn(kRoot / "engine")) {
    for (const std::string& include : includesOf(source)) {
      if (const Place to = placeOf(include); to.isOurs()) {
        includes.push_back(
            {.source = source, .from = placeOf(fs::relative(source, kRoot / "engine")), .to = to});
      }
    }
  }
  return includes;
}

Names subfoldersOf(const fs::path& folder) {
  Names folders;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder)) {
    if (entry.is_directory()) {
      folders.insert(entry.path().filename().string());
    }
  }
  return folders;
}

Names wordsOf(const std::string& text) {
  std::istringstream stream(text);
  Names words;
  for (std::string word; stream >> word;) {
    words.insert(word);
  }
  return words;
}

TEST(Structure, engineHasTheFoldersOfTheRulesAndNoOthers) {
  Names ruled;
  for (const auto& [folder, mayInclude] : kMayInclude) {
    ruled.insert(folder);
  }
  EXPECT_EQ(subfoldersOf(kRoot / "engine"), ruled);
}

TEST(Structure, cmakeTargetOfEveryFolderStatesWhomItMayInclude) {
  const std::regex call(R"(careen_library\((\w+)(?: SHARED| TEXT)*(?:\s+DEPENDS\s+([\w\s]+))?\))");
  for (const auto& [folder, mayInclude] : kMayInclude) {
    const std::string text = textOf(kRoot / "engine" / folder / "CMakeLists.txt");
    std::smatch match;
    ASSERT_TRUE(std::regex_search(text, match, call)) << folder;
    EXPECT_EQ(match[1], folder);
    EXPECT_EQ(wordsOf(match[2]), mayInclude) << folder;
  }
}

TEST(Structure, foldersHaveTheRoomsOfTheRulesAndNoOthers) {
  for (const auto& [folder, mayInclude] : kMayInclude) {
    Names ruled;
    if (const auto rooms = kRooms.find(folder); rooms != kRooms.end()) {
      for (const auto& [room, others] : rooms->second) {
        ruled.insert(room);
      }
    }
    ruled.erase("");
    EXPECT_EQ(subfoldersOf(kRoot / "engine" / folder), ruled) << folder;
  }
}

TEST(Structure, everyIncludeInTheEngineKeepsToTheRules) {
  const std::vector<Include> includes = includesInEngine();
  for (const Include& include : includes) {
    const Place& from = include.from;
    const Place& to = include.to;
    if (from.folder != to.folder) {
      EXPECT_TRUE(kMayInclude.at(from.folder).contains(to.folder))
          << include.source << " includes " << to.folder;
    } else if (from.room != to.room) {
      EXPECT_TRUE(kRooms.at(from.folder).at(from.room).contains(to.room))
          << include.source << " includes " << to.folder << '/' << to.room << '/' << to.file;
    }
  }
  EXPECT_GT(includes.size(), 500U);  // measured: 767
}

TEST(Structure, whatHasADoorIsEnteredByIt) {
  std::vector<Include> includes = includesInEngine();
  for (const fs::path& source : sourcesIn(kRoot / "app")) {
    for (const std::string& include : includesOf(source)) {
      includes.push_back({.source = source, .from = {.folder = "app"}, .to = placeOf(include)});
    }
  }
  for (const Include& include : includes) {
    const auto door = kDoors.find(include.to.folder);
    if (door != kDoors.end() && include.from.folder != include.to.folder) {
      const std::string& entered = include.to.room.empty() ? include.to.file : include.to.room;
      const auto narrow = kNarrowDoors.find(include.from.folder);
      const Names& open = narrow != kNarrowDoors.end() ? narrow->second : door->second;
      EXPECT_TRUE(open.contains(entered)) << include.source << " includes " << entered;
    }
  }
}

// Of the includes that there are, not of the rules.
TEST(Structure, noRoomIncludesItselfThroughOthers) {
  std::map<std::string, Names> arrows;
  Names rooms;
  for (const Include& include : includesInEngine()) {
    const std::string from = include.from.folder + '/' + include.from.room;
    const std::string to = include.to.folder + '/' + include.to.room;
    rooms.insert({from, to});
    if (from != to) {
      arrows[from].insert(to);
    }
  }
  std::size_t count = 0;
  Names cycles;
  for (const std::string& start : rooms) {
    count += arrows[start].size();
    Names reached;
    std::vector<std::string> left(arrows[start].begin(), arrows[start].end());
    while (!left.empty()) {
      const std::string room = left.back();
      left.pop_back();
      if (reached.insert(room).second) {
        left.insert(left.end(), arrows[room].begin(), arrows[room].end());
      }
    }
    if (reached.contains(start)) {
      cycles.insert(start);
    }
  }
  EXPECT_EQ(cycles, Names());
  std::cout << rooms.size() << " rooms, " << count << " arrows, " << cycles.size() << " in cycles\n";
}

// Where a foreign header may be seen: folder, which of its files, and whether in .cpp files only.
TEST(Structure, foreignHeadersStayWhereTheyBelong) {
  struct Rule {
    std::regex header;
    Names folders;
    std::string files{};  // how their names begin
  };
  const std::vector<Rule> rules = {
      {std::regex("^(GL|EGL|GLFW)/.*"), {"render"}},
      {std::regex("^(stb/)?stb_.*"), {"image"}},
      {std::regex("^nlohmann/.*"),
       {"scene", "study", "compare", "film", "exchange", "truth", "sweep", "library", "app"}},
      {std::regex("^CLI/.*"), {"app"}, "command_line"},
      {std::regex(R"(^zip\.h)"), {"trajectory"}, "zip_archive"},
      {std::regex("^pugixml.*"), {"exchange"}, "xml_tree"},
      {std::regex("^(bt[A-Z]|Bullet|LinearMath/).*"), {"study"}, "peer_bullet"},
      {std::regex("^ode/.*"), {"study"}, "peer_ode"},
      {std::regex("^mujoco/.*"), {"study"}, "peer_mujoco"},
  };
  for (const char* top : {"engine", "app"}) {
    for (const fs::path& source : sourcesIn(kRoot / top)) {
      const fs::path under = fs::relative(source, kRoot);
      const std::string folder =
          under.begin()->string() == "app" ? "app" : std::next(under.begin())->string();
      for (const std::string& include : includesOf(source)) {
        for (const Rule& rule : rules) {
          const bool allowed = rule.folders.contains(folder) &&
                               source.filename().string().starts_with(rule.files) &&
                               (source.extension() == ".cpp" || include.ends_with("json_fwd.hpp"));
          EXPECT_TRUE(!std::regex_match(include, rule.header) || allowed)
              << source << " includes " << include;
        }
      }
    }
  }
}

TEST(Structure, onlyOneHeaderSpellsOutEigenTypes) {
  for (const fs::path& source : sourcesIn(kRoot / "engine")) {
    if (source.filename() != "linear_algebra.h") {
      EXPECT_EQ(textOf(source).find("Eigen::Matrix<"), std::string::npos) << source;
    }
  }
}

// Eigen's own has other bits from version to version. Of what moves, and of the state that a run starts from.
TEST(Structure, dotProductsOfMotionAreThoseOfTheProject) {
  for (const char* const folder : {"core", "physics", "scene", "stage", "trajectory"}) {
    for (const fs::path& source : sourcesIn(kRoot / "engine" / folder)) {
      EXPECT_EQ(textOf(source).find(".dot("), std::string::npos) << source << " calls Eigen's dot";
    }
  }
}

// ---- Tests know their sources, and sources their tests.

Names stemsIn(const fs::path& folder, bool tests) {
  Names stems;
  if (!fs::exists(folder)) {
    return stems;
  }
  for (const fs::directory_entry& entry : fs::directory_iterator(folder)) {
    const std::string stem = entry.path().stem().string();
    const bool isSource = entry.path().extension() == ".h" || entry.path().extension() == ".cpp";
    if (isSource && stem.ends_with("_test") == tests) {
      stems.insert(stem);
    }
  }
  return stems;
}

/// Which of the sources a test is of: <file>_test.cpp, or <file>_<aspect>_test.cpp where one has several. The
/// longest name counts: folder_lock_test is of folder_lock, not of folder. "" if it is of none.
std::string sourceOf(const std::string& test, const Names& sources) {
  std::string longest;
  for (const std::string& source : sources) {
    if (test.starts_with(source + "_") && source.size() > longest.size()) {
      longest = source;
    }
  }
  return longest;
}

// The source may be the tests' own.
TEST(Structure, everyTestLiesWhereItsSourceDoes) {
  std::size_t checked = 0;
  for (const auto& [folder, mayInclude] : kMayInclude) {
    Names places = {""};
    if (kRooms.contains(folder)) {
      for (const auto& [room, others] : kRooms.at(folder)) {
        places.insert(room);
      }
    }
    for (const fs::path& test : sourcesIn(kRoot / "tests" / folder)) {
      const fs::path place = fs::relative(test.parent_path(), kRoot / "tests" / folder);
      EXPECT_TRUE(places.contains(place == "." ? "" : place.string())) << test << " lies in no room";
      if (test.stem().string().ends_with("_test")) {
        Names sources = stemsIn(kRoot / "engine" / folder / place, false);
        sources.merge(stemsIn(test.parent_path(), false));
        EXPECT_NE(sourceOf(test.stem().string(), sources), "") << test << " has no source of its name";
        ++checked;
      }
    }
  }
  EXPECT_GT(checked, 100U);
}

// Sources that have no test of their name, and why.
const std::map<std::string, std::string> kWithoutTest = {
    {"audit/kinds", "names only"},
    {"core/math/linear_algebra", "aliases only"},
    {"core/math/pose", "data and one sum, tested through everything that moves"},
    {"image/picture", "data only"},
    {"physics/contact/contact_forces", "tested through island"},
    {"physics/contact/contact_system", "tested through island"},
    {"physics/exact/groups", "part of class ExactWorld, tested through exact_world"},
    {"physics/exact/islands", "part of class ExactWorld, tested through exact_world"},
    {"physics/exact/pair_contacts", "part of class ExactWorld, tested through exact_world"},
    {"physics/exact/crowd_meetings", "part of class ExactWorld, tested through exact_world"},
    {"physics/exact/crowds", "part of class ExactWorld, tested through exact_world"},
    {"physics/exact/places", "part of class ExactWorld, tested through exact_world"},
    {"physics/geometry/box_at", "data and one sum, tested through separation and exact_world_center"},
    {"physics/geometry/contact_manifold", "a part of contact_points, tested through it"},
    {"physics/geometry/feature_overlap", "a part of contact_points, tested through it"},
    {"physics/geometry/support_feature", "a part of contact_points, tested through it"},
    {"physics/impact/simultaneous_impact",
     "what resolveImpact does once it knows who takes part: impact_law"},
    {"physics/impact/single_impact", "tested through impact_law"},
    {"physics/motion/recorder", "data and an interface"},
    {"physics/pile/crowd_bounce", "part of class Crowd, tested through crowd"},
    {"physics/pile/crowd_contacts", "part of class Crowd, tested through crowd"},
    {"physics/pile/crowd_direct", "part of class Crowd, tested through crowd"},
    {"physics/pile/crowd_loads", "part of class Crowd, tested through crowd"},
    {"physics/pile/crowd_motion", "part of class Crowd, tested through crowd"},
    {"physics/pile/crowd_retake", "part of class Crowd, tested through crowd and crowd_projection"},
    {"physics/pile/index", "one cast"},
    {"physics/pile/solver_groups", "part of class PileSolver, tested through solver"},
    {"physics/search/time_of_impact_boxes",
     "the half of time_of_impact.h for two boxes, tested through time_of_impact"},
    {"physics/world/contact_residuals",
     "data, and the larger of two; filled in tests of solver/residual_sum"},
    {"physics/world/plan", "data and look-ups, tested through scene/plan"},
    {"physics/world/run_settings", "data only"},
    {"physics/world/world", "data only"},
    {"render/draw/box_batch", "sends face_records; tested through renderer"},
    {"render/draw/face_records",
     "lists what drawn_box, neighbors and shadow_pairs find; tested through renderer"},
    {"render/gl/texture_units", "names only"},
    {"render/draw/occlusion_map", "sends what decals find; tested through renderer"},
    {"render/draw/shadow_batch", "sends what decals find; tested through renderer"},
    {"render/draw/surface_batch", "sends what surfaces and renderer test"},
    {"render/overlay/frame", "data, and functions of arrows, impacts and panels"},
    {"render/overlay/shapes", "data only"},
    {"render/window/window", "needs a display; tested by app/view_test"},
    {"physics/solver/contact_problem", "data only"},
    {"stage/camera", "data only"},
    {"stage/color", "data only"},
    {"stage/run_setup", "data only"},
    {"stage/light_part", "names only"},
    {"stage/name_set", "tested with its names through overlay"},
    {"stage/stage", "data only"},
    {"stage/triangle_mesh", "data only"},
    {"study/contestant", "an interface"},
    {"trajectory/exporter", "data only; tested through exchange/exporters"},
    {"study/peer_bullet", "behind peers.h, tested with the other peers by peers_test"},
    {"study/peer_mujoco", "behind peers.h, tested with the other peers by peers_test"},
    {"study/peer_ode", "behind peers.h, tested with the other peers by peers_test"},
};

std::ptrdiff_t linesOf(const fs::path& source) {
  const std::string text = textOf(source);
  return std::count(text.begin(), text.end(), '\n');
}

TEST(Structure, everySourceHasATestOrAReason) {
  struct Lines {
    std::ptrdiff_t tested = 0;
    std::ptrdiff_t all = 0;
  };
  std::map<std::string, Lines> lines;  // of a folder
  Names untested;
  for (const fs::path& file : sourcesIn(kRoot / "engine")) {
    const fs::path place = fs::relative(file.parent_path(), kRoot / "engine");
    const std::string source = file.stem().string();
    const Names sources = stemsIn(file.parent_path(), false);
    const Names tests = stemsIn(kRoot / "tests" / place, true);
    const bool tested = std::any_of(tests.begin(), tests.end(), [&](const std::string& test) {
      return sourceOf(test, sources) == source;
    });
    if (!tested) {
      untested.insert((place / source).string());
    }
    Lines& ofFolder = lines[place.begin()->string()];
    ofFolder.all += linesOf(file);
    ofFolder.tested += tested ? linesOf(file) : 0;
  }
  for (const std::string& source : untested) {
    EXPECT_TRUE(kWithoutTest.contains(source)) << source << " has neither a test nor a reason";
  }
  for (const auto& [source, reason] : kWithoutTest) {
    EXPECT_TRUE(untested.contains(source)) << source << " has a test, or is no source";
  }
  for (const auto& [folder, count] : lines) {
    std::cout << folder << ": " << 100 * count.tested / count.all << " % of " << count.all
              << " lines have a test of their source's name\n";
  }
}

// Paths in backquotes, from the root, engine/ or engine/physics/; patterns and options are no paths.
TEST(Structure, theMapNamesOnlyWhatThereIs) {
  const std::string map = textOf(kRoot / "engine" / "ARCHITECTURE.md");
  const std::regex path("`([A-Za-z0-9_.]+/[A-Za-z0-9_./]*)`");
  std::size_t checked = 0;
  for (auto match = std::sregex_iterator(map.begin(), map.end(), path); match != std::sregex_iterator();
       ++match) {
    const std::string named = (*match)[1];
    EXPECT_TRUE(fs::exists(kRoot / named) || fs::exists(kRoot / "engine" / named) ||
                fs::exists(kRoot / "engine" / "physics" / named))
        << named;
    ++checked;
  }
  EXPECT_GT(checked, 30U);
}

}  // namespace
}  // namespace careen
