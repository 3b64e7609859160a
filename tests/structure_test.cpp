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

#include "support/layout.h"
#include "support/source_text.h"

namespace careen {
namespace {

namespace fs = std::filesystem;
using layout::kMayInclude;
using layout::kRooms;
using layout::Names;
using layout::Rooms;
using source_text::kRoot;
using source_text::sourcesIn;
using source_text::textOf;

// What the rest of the program may include of a folder that has a door: rooms, and single headers.
const std::map<std::string, Names> kDoors = {
    {"physics", {"world", "motion", "start", "simulate.h", "joint_freedom.h", "contact_pushes.h"}}};
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
       {"scene", "runs", "study", "compare", "film", "exchange", "page", "truth", "sweep", "library", "app"}},
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
