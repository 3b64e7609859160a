// Types as the project's rules give them: one name, one type; few members, few functions, no bare flags.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <regex>
#include <string>
#include <vector>

#include "support/source_text.h"

namespace careen {
namespace {

namespace fs = std::filesystem;
using source_text::sourcesIn;
using source_text::textOf;

// Two types of one name have one destructor: the linker keeps either. The public header has a namespace of
// its own.
TEST(Types, noTwoTypesOfTheEngineHaveOneName) {
  static const std::regex kType(
      R"re((?:^|\n)(?:(?:struct|class|enum class)\s+(\w+)(?: final)?[^;{\n]*\{|using (\w+) =))re");
  std::map<std::string, fs::path> headerOf;
  for (const fs::path& source : sourcesIn(source_text::kRoot / "engine")) {
    if (source.extension() != ".h" || source.parent_path().filename() == "library") {
      continue;
    }
    const std::string text = textOf(source);
    for (auto match = std::sregex_iterator(text.begin(), text.end(), kType); match != std::sregex_iterator();
         ++match) {
      const std::string name = (*match)[1].matched ? (*match)[1] : (*match)[2];
      const auto [other, isNew] = headerOf.emplace(name, source);
      EXPECT_TRUE(isNew || other->second == source)
          << name << " is a type in " << source << " and in " << other->second;
    }
  }
  EXPECT_GT(headerOf.size(), 200U);  // that it looks
}

/// Without comments, strings and characters, whose braces and semicolons are none.
std::string codeOf(const std::string& text) {
  static const std::regex kNoCode(R"re(//[^\n]*|"(?:\\.|[^"\\\n])*"|'(?:\\.|[^'\\\n])*')re");
  return std::regex_replace(text, kNoCode, "");
}

struct Size {
  int members = 0;  // not static
  int functions = 0;
};

/// Parts of a declaration that are between brackets.
std::string outsideOf(const std::string& text, const std::string& opening, const std::string& closing) {
  std::string outside;
  int depth = 0;
  for (const char c : text) {
    depth += opening.find(c) != std::string::npos ? 1 : 0;
    if (depth == 0) {
      outside += c;
    }
    depth -= closing.find(c) != std::string::npos ? 1 : 0;
  }
  return outside;
}

/// One declaration of a class, without its last semicolon or its body.
void count(std::string declaration, Size& size) {
  static const std::regex kAccess(R"re(\b(?:public|private|protected)\s*:)re");
  static const std::regex kNone(
      R"re(\s*|\s*(?:template\s*<[^{]*>\s*)?(?:using|friend|static_assert|enum|union|struct|class)\b[^]*)re");
  static const std::regex kStatic(R"re(\bstatic\b)re");
  declaration = std::regex_replace(declaration, kAccess, "");
  if (std::regex_match(declaration, kNone)) {
    return;
  }
  const std::string plain = outsideOf(declaration, "<", ">");
  const std::string named = plain.substr(0, plain.find('='));
  if (named.find('(') != std::string::npos) {
    ++size.functions;
  } else if (!std::regex_search(plain, kStatic)) {
    const std::string names = outsideOf(plain, "({", ")}");
    size.members += 1 + static_cast<int>(std::count(names.begin(), names.end(), ','));
  }
}

/// Of the class whose body begins at `at`.
Size sizeOf(const std::string& code, std::size_t at) {
  Size size;
  std::string declaration;
  int depth = 1;
  for (; at < code.size() && depth > 0; ++at) {
    const char c = code[at];
    depth -= c == '}' ? 1 : 0;
    if (depth > 1 || (depth == 1 && (c == '{' || c == '}'))) {
      declaration += depth == 1 || declaration.back() == '{' ? std::string(1, c) : "";
    } else if (depth == 1 && c != ';') {
      declaration += c;
    }
    depth += c == '{' ? 1 : 0;
    // A function's body ends without a semicolon, a type's or a value's with one.
    const bool endsBody = c == '}' && depth == 1 && declaration.find('(') != std::string::npos &&
                          declaration.find('(') < declaration.find('{');
    if ((depth == 1 && c == ';') || endsBody) {
      count(declaration, size);
      declaration.clear();
    }
  }
  return size;
}

constexpr int kMostMembers = 25;
constexpr int kMostFunctions = 40;
/// Larger than that: to become several, and off this list. Their numbers may only fall.
const std::map<std::string, Size> kLarge = {
    {"Crowd", {70, 133}},
    {"PileSolver", {22, 70}},
    {"PileManifold", {31, 2}},
};

TEST(Types, haveFewMembersAndFunctions) {
  static const std::regex kClass(
      R"re((enum\s+)?\b(?:class|struct)\s+(?:alignas\(\d+\)\s*)?(\w+)(?:\s+final)?(?:\s*:[^;{(]*)?\s*\{)re");
  std::size_t seen = 0;
  for (const fs::path& header : sourcesIn(source_text::kRoot / "engine")) {
    if (header.extension() != ".h") {
      continue;
    }
    const std::string code = codeOf(textOf(header));
    for (auto match = std::sregex_iterator(code.begin(), code.end(), kClass); match != std::sregex_iterator();
         ++match) {
      if ((*match)[1].matched) {
        continue;
      }
      const std::string name = (*match)[2];
      const Size size = sizeOf(code, static_cast<std::size_t>(match->position() + match->length()));
      const auto large = kLarge.find(name);
      const Size most = large != kLarge.end() ? large->second : Size{kMostMembers, kMostFunctions};
      EXPECT_LE(size.members, std::max(most.members, kMostMembers)) << name << " in " << header;
      EXPECT_LE(size.functions, std::max(most.functions, kMostFunctions)) << name << " in " << header;
      if (large != kLarge.end()) {
        EXPECT_TRUE(size.members > kMostMembers || size.functions > kMostFunctions)
            << name << " is not large any more: off the list";
      }
      ++seen;
    }
  }
  EXPECT_GT(seen, 300U);
}

/// Parameters that only say true or false, by header of the physics: an enum says what is meant. Their
/// numbers may only fall.
const std::map<std::string, int> kFlags = {
    {"pile/projection.h", 1},
    {"pile/crowd.h", 3},
    {"pile/solver.h", 2},
    {"solver/interior_point.h", 2},
    {"contact/contact_system.h", 1},
    {"solver/contact_newton.h", 1},
};

TEST(Types, ofThePhysicsTakeNoBareFlags) {
  static const std::regex kFlag(R"re([(,]\s*(?:const )?bool \w+(?: = \w+)?\s*[,)])re");
  static const std::regex kLoop(R"re(\bfor \()re");
  const fs::path physics = source_text::kRoot / "engine/physics";
  std::map<std::string, int> found;
  for (const fs::path& header : sourcesIn(physics)) {
    const std::string code = std::regex_replace(codeOf(textOf(header)), kLoop, "");
    if (header.extension() == ".h") {
      const auto flags =
          std::distance(std::sregex_iterator(code.begin(), code.end(), kFlag), std::sregex_iterator());
      if (flags > 0) {
        found[fs::relative(header, physics).string()] = static_cast<int>(flags);
      }
    }
  }
  for (const auto& [header, flags] : found) {
    const auto known = kFlags.find(header);
    EXPECT_LE(flags, known == kFlags.end() ? 0 : known->second) << header;
  }
  for (const auto& [header, flags] : kFlags) {
    EXPECT_EQ(found[header], flags) << header << " has fewer: so must the list";
  }
}

}  // namespace
}  // namespace careen
