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
      EXPECT_LE(size.members, kMostMembers) << name << " in " << header;
      EXPECT_LE(size.functions, kMostFunctions) << name << " in " << header;
      ++seen;
    }
  }
  EXPECT_GT(seen, 300U);
}

// An enum says what is meant.
TEST(Types, ofThePhysicsTakeNoBareFlags) {
  static const std::regex kFlag(R"re([(,]\s*(?:const )?bool \w+(?: = \w+)?\s*[,)])re");
  static const std::regex kLoop(R"re(\bfor \()re");
  const fs::path physics = source_text::kRoot / "engine/physics";
  std::size_t seen = 0;
  for (const fs::path& header : sourcesIn(physics)) {
    if (header.extension() == ".h") {
      const std::string code = std::regex_replace(codeOf(textOf(header)), kLoop, "");
      std::smatch flag;
      EXPECT_FALSE(std::regex_search(code, flag, kFlag)) << header << ": " << flag.str();
      ++seen;
    }
  }
  EXPECT_GT(seen, 100U);
}

}  // namespace
}  // namespace careen
