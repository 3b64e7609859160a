// The layout as the project's rules give it: who may include whom, and where foreign headers may appear.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <map>
#include <regex>
#include <set>
#include <sstream>
#include <string>
#include <vector>

namespace careen {
namespace {

namespace fs = std::filesystem;
const fs::path kRoot = CAREEN_SOURCE_DIR;
using Names = std::set<std::string>;

// The whole of it: a folder that is not here may not exist.
const std::map<std::string, Names> kMayInclude = {
    {"core", {}},
    {"physics", {"core"}},
    {"image", {"core"}},
    {"scene", {"physics", "core"}},
    {"trajectory", {"physics", "core"}},
    {"study", {"scene", "trajectory", "physics", "core"}},
    {"compare", {"image", "trajectory", "core"}},
    {"render", {"trajectory", "scene", "image", "core"}},
};

std::string textOf(const fs::path& path) {
  std::ifstream stream(path);
  std::stringstream text;
  text << stream.rdbuf();
  return text.str();
}

std::vector<fs::path> sourcesIn(const fs::path& folder) {
  std::vector<fs::path> sources;
  for (const fs::directory_entry& entry : fs::recursive_directory_iterator(folder)) {
    if (entry.path().extension() == ".h" || entry.path().extension() == ".cpp") {
      sources.push_back(entry.path());
    }
  }
  return sources;
}

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

Names foldersOfEngine() {
  Names folders;
  for (const fs::directory_entry& entry : fs::directory_iterator(kRoot / "engine")) {
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
  EXPECT_EQ(foldersOfEngine(), ruled);
}

TEST(Structure, cmakeTargetOfEveryFolderStatesWhomItMayInclude) {
  const std::regex call(R"(careen_library\((\w+)(?:\s+DEPENDS\s+([\w\s]+))?\))");
  for (const auto& [folder, mayInclude] : kMayInclude) {
    const std::string text = textOf(kRoot / "engine" / folder / "CMakeLists.txt");
    std::smatch match;
    ASSERT_TRUE(std::regex_search(text, match, call)) << folder;
    EXPECT_EQ(match[1], folder);
    EXPECT_EQ(wordsOf(match[2]), mayInclude) << folder;
  }
}

TEST(Structure, everyIncludeInTheEngineKeepsToTheRules) {
  std::size_t checked = 0;
  for (const auto& [folder, mayInclude] : kMayInclude) {
    for (const fs::path& source : sourcesIn(kRoot / "engine" / folder)) {
      for (const std::string& include : includesOf(source)) {
        const std::string from = include.substr(0, include.find('/'));
        const bool ours = from != include && (kMayInclude.contains(from) || from == "app" || from == "tests");
        EXPECT_TRUE(!ours || from == folder || mayInclude.contains(from))
            << source << " includes " << include;
        ++checked;
      }
    }
  }
  EXPECT_GT(checked, 100U);
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
      {std::regex("^nlohmann/.*"), {"scene", "study", "compare", "render", "app"}},
      {std::regex("^CLI/.*"), {"app"}},
      {std::regex("^(bt[A-Z]|Bullet|LinearMath/).*"), {"study"}, "peer_bullet"},
      {std::regex("^ode/.*"), {"study"}, "peer_ode"},
  };
  for (const char* top : {"engine", "app"}) {
    for (const fs::path& source : sourcesIn(kRoot / top)) {
      const std::string folder = source.parent_path().filename().string();
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

// <file>_test.cpp, or <file>_<aspect>_test.cpp where a source has more than one; the source may be the tests'
// own.
TEST(Structure, testsMirrorTheSources) {
  for (const auto& [folder, mayInclude] : kMayInclude) {
    Names tested;
    for (const fs::path& source : sourcesIn(kRoot / "engine" / folder)) {
      tested.insert(source.stem().string());
    }
    const std::vector<fs::path> tests = sourcesIn(kRoot / "tests" / folder);
    for (const fs::path& source : tests) {
      if (!source.stem().string().ends_with("_test")) {
        tested.insert(source.stem().string());
      }
    }
    for (const fs::path& test : tests) {
      const std::string stem = test.stem().string();
      if (stem.ends_with("_test")) {
        EXPECT_TRUE(std::any_of(tested.begin(), tested.end(),
                                [&stem](const std::string& name) { return stem.starts_with(name + "_"); }))
            << test << " has no source of its name";
      }
    }
  }
}

}  // namespace
}  // namespace careen
