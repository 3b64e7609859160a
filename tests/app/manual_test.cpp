// The manual and the README: what they name is there, and what is there is named. tests/manual runs their
// commands.
#include <gtest/gtest.h>
#include <pty.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <iterator>
#include <map>
#include <regex>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "support/process.h"
#include "support/program.h"

namespace careen {
namespace {

namespace fs = std::filesystem;

const fs::path kSource = CAREEN_SOURCE_DIR;
const fs::path kManual = kSource / "assets/manual";

std::vector<fs::path> pages() {
  std::vector<fs::path> found;
  for (const auto& entry : fs::directory_iterator(kManual)) {
    found.push_back(entry.path());
  }
  std::sort(found.begin(), found.end());
  return found;
}

Ended careen(std::vector<std::string> arguments) {
  const TemporaryFolder folder;
  arguments.insert(arguments.begin(), program());
  return Process(arguments, folder.path()).wait();
}

std::vector<std::string> linesOf(const std::string& text) {
  std::istringstream stream(text);
  std::vector<std::string> lines;
  for (std::string line; std::getline(stream, line);) {
    lines.push_back(line);
  }
  return lines;
}

// Every match of the expression's first group.
std::vector<std::string> matches(const std::string& text, const std::string& expression) {
  const std::regex regex(expression);
  std::vector<std::string> found;
  for (std::sregex_iterator match(text.begin(), text.end(), regex), end; match != end; ++match) {
    found.push_back((*match)[1]);
  }
  return found;
}

// As GitHub names a heading: small letters, blanks as hyphens, no other signs.
std::set<std::string> headingsOf(const fs::path& page) {
  std::set<std::string> headings;
  for (const std::string& title : matches(textOf(page), "\n#+ ([^\n]*)")) {
    std::string name;
    for (const char letter : title) {
      if (letter == ' ' || letter == '-') {
        name += '-';
      } else if (std::isalnum(static_cast<unsigned char>(letter)) != 0) {
        name += static_cast<char>(std::tolower(static_cast<unsigned char>(letter)));
      }
    }
    headings.insert(name);
  }
  return headings;
}

TEST(Manual, readmeIsShort) {
  const std::string readme = textOf(kSource / "README.md");
  EXPECT_LE(linesOf(readme).size(), 150U);
  std::istringstream stream(readme);
  const std::vector<std::string> words{std::istream_iterator<std::string>(stream), {}};
  EXPECT_LE(words.size(), 1200U);
}

// The sentences of a page: of paragraphs and items of lists, without code, tables and headings. A code within
// a sentence is one word.
std::vector<std::string> sentencesOf(const std::string& page) {
  std::vector<std::string> paragraphs = {""};
  bool isCode = false;
  for (const std::string& line : linesOf(page)) {
    const std::string text = line.substr(std::min(line.find_first_not_of(' '), line.size()));
    const bool isFence = text.starts_with("```");
    isCode = isCode != isFence;
    if (isCode || isFence || text.empty() || text.find_first_of("|#!") == 0) {
      paragraphs.emplace_back();
    } else if (text.starts_with("- ")) {
      paragraphs.push_back(text.substr(2));
    } else {
      paragraphs.back().append(paragraphs.back().empty() ? "" : " ").append(text);
    }
  }
  std::vector<std::string> sentences;
  for (std::string text : paragraphs) {
    text = std::regex_replace(text, std::regex("`[^`]*`"), "Code");
    text = std::regex_replace(text, std::regex(R"(\[([^\]]*)\]\([^)]*\))"), "$1");
    text = std::regex_replace(text, std::regex(R"re(([.!?][)"*]*) +(?=[^a-z ]|careen ))re"), "$1\n");
    const std::vector<std::string> parts = linesOf(text);
    sentences.insert(sentences.end(), parts.begin(), parts.end());
  }
  return sentences;
}

TEST(Manual, sentencesAreShort) {
  constexpr std::ptrdiff_t kMostWords = 30;
  std::vector<fs::path> all = pages();
  all.push_back(kSource / "README.md");
  std::size_t sentences = 0;
  for (const fs::path& page : all) {
    for (const std::string& sentence : sentencesOf(textOf(page))) {
      std::istringstream stream(sentence);
      const std::ptrdiff_t words =
          std::count_if(std::istream_iterator<std::string>(stream), {}, [](const std::string& word) {
            return std::any_of(word.begin(), word.end(),
                               [](unsigned char letter) { return std::isalnum(letter) != 0; });
          });
      EXPECT_LE(words, kMostWords) << page << ": " << sentence;
      ++sentences;
    }
  }
  EXPECT_GT(sentences, 1000U);
}

TEST(Manual, linksLeadSomewhere) {
  std::vector<fs::path> all = pages();
  all.push_back(kSource / "README.md");
  std::size_t links = 0;
  for (const fs::path& page : all) {
    for (const std::string& link : matches(textOf(page), R"(\]\(([^)\s]+)\))")) {
      ++links;
      const std::size_t hash = link.find('#');
      const fs::path target = hash == 0 ? page : page.parent_path() / link.substr(0, hash);
      EXPECT_TRUE(fs::exists(target)) << page << ": " << link;
      if (hash != std::string::npos) {
        EXPECT_EQ(headingsOf(target).count(link.substr(hash + 1)), 1U) << page << ": " << link;
      }
    }
  }
  EXPECT_GT(links, 60U);
}

TEST(Manual, helpListsAndShowsEveryPage) {
  const std::string all = careen({"--help"}).out;
  const Ended list = careen({"help"});
  ASSERT_EQ(list.exitCode, 0) << list.err;
  const std::vector<std::string> named = matches(list.out, "\n  ([a-z-]+) ");
  EXPECT_EQ(named.size(), pages().size());
  const std::string readme = textOf(kSource / "README.md");
  for (const fs::path& page : pages()) {
    const std::string name = page.stem();
    EXPECT_EQ(std::count(named.begin(), named.end(), name), 1) << name;
    const std::string shown = careen({"help", name}).out;
    EXPECT_TRUE(shown.ends_with(textOf(page))) << name;
    if (all.find("\n  " + name + " ") == std::string::npos) {  // no command of this name
      EXPECT_EQ(shown, textOf(page));
    }
    EXPECT_NE(readme.find("| [" + name + "](assets/manual/" + name + ".md) |"), std::string::npos) << name;
  }
}

// Users who film need no page on code, and find theirs first; the README lists pages in the same order.
TEST(Manual, pagesForDevelopersComeLast) {
  const std::vector<std::string> named = matches(careen({"help"}).out, "\n  ([a-z-]+) ");
  const std::vector<std::string> last = {"python", "library", "dependencies", "developing"};
  ASSERT_GT(named.size(), last.size());
  EXPECT_EQ(std::vector(named.end() - 4, named.end()), last);
  EXPECT_EQ(named.front(), "tutorial");
  EXPECT_EQ(matches(textOf(kSource / "README.md"), R"(\n\| \[([a-z-]+)\]\(assets/manual/)"), named);
}

// The options as by --help, then the page of the command's name, or the name of the page that tells more.
TEST(Manual, helpOfACommandShowsItsOptionsAndThenItsPage) {
  const std::string all = careen({"--help"}).out;
  const std::string page = textOf(kManual / "commands.md");
  for (const std::string& command : matches(all.substr(all.find("Subcommands:")), "\n  ([a-z]+)  ")) {
    const std::string options = careen({command, "--help"}).out;
    const std::string shown = careen({"help", command}).out;
    EXPECT_TRUE(shown.starts_with(options)) << shown.substr(0, options.size());
    EXPECT_EQ(shown.find("careen " + command + " " + command), std::string::npos) << command;
    const std::string rest = shown.substr(std::min(options.size(), shown.size()));
    if (fs::exists(kManual / (command + ".md"))) {
      EXPECT_EQ(rest, "\nIts page of the manual:\n\n" + textOf(kManual / (command + ".md")));
    } else {
      const std::vector<std::string> more =
          matches(page, "\n\\| `" + command + "` \\|[^\n]*\\]\\(([a-z-]+)\\.md\\) \\|\n");
      EXPECT_EQ(rest, "\nIn the manual: 'careen help " + (more.empty() ? "commands" : more.front()) + "'.\n");
    }
  }
}

TEST(Manual, helpListsEveryKeyOfTheSchema) {
  const std::string keys = careen({"help", "keys"}).out;
  for (const char* const key :
       {"duration", "boxes[].half_extents", "boxes[].orientation.angle_deg", "springs[].rest_length",
        "camera.keys[].fov_deg", "film.fps", "crowds.when"}) {
    EXPECT_NE(("\n" + keys).find("\n" + std::string(key) + "\n"), std::string::npos) << key;
  }
  EXPECT_NE(keys.find("Default: 30."), std::string::npos);  // film.fps
  EXPECT_EQ(keys.find("\n\n"), std::string::npos) << "a key without a word";
  for (const std::string& line : matches(keys, "([^\n]*)\n")) {
    EXPECT_LE(line.size(), 100U) << line;
  }
}

TEST(Manual, helpFindsAWordInPagesKeysAndOptions) {
  const std::string found = careen({"help", "--search", "RESTITUTION"}).out;
  EXPECT_NE(found.find("boxes[].restitution\n"), std::string::npos);
  EXPECT_NE(found.find("careen help scenes:\n"), std::string::npos);
  EXPECT_NE(careen({"help", "--search", "threads"}).out.find("careen help simulate:\n"), std::string::npos);
  EXPECT_EQ(careen({"help", "--search", "xylophone"}).exitCode, 2);
}

// What the program prints on a terminal of 24 lines of 70 letters.
std::string onTerminal(const std::vector<std::string>& arguments, const char* pager) {
  winsize size = {};
  size.ws_row = 24;
  size.ws_col = 70;
  int terminal = -1;
  const pid_t child = forkpty(&terminal, nullptr, nullptr, &size);
  if (child == 0) {
    setenv("PAGER", pager, 1);
    std::string name = program();
    std::vector<char*> words = {name.data()};
    for (const std::string& argument : arguments) {
      words.push_back(const_cast<char*>(argument.c_str()));
    }
    words.push_back(nullptr);
    execv(name.c_str(), words.data());
    _exit(127);
  }
  std::string text;
  std::array<char, 4096> part{};
  for (ssize_t n = 0; (n = read(terminal, part.data(), part.size())) > 0;) {
    text.append(part.data(), static_cast<std::size_t>(n));
  }
  close(terminal);
  int status = 0;
  waitpid(child, &status, 0);
  EXPECT_EQ(status, 0);
  text.erase(std::remove(text.begin(), text.end(), '\r'), text.end());
  return text;
}

// The words of a page in their order, whatever the lines; without the signs and heads of its tables.
std::string lettersIn(const std::string& text) {
  std::string letters;
  std::copy_if(text.begin(), text.end(), std::back_inserter(letters),
               [](char letter) { return std::isalnum(static_cast<unsigned char>(letter)) != 0; });
  return letters;
}

TEST(Manual, helpWrapsItsPagesToTheTerminalAndPagesThem) {
  const std::string shown = onTerminal({"help", "troubleshooting"}, "sed s/^/paged:/");
  std::size_t lines = 0;
  std::size_t wide = 0;
  for (const std::string& line : linesOf(shown)) {
    ++lines;
    EXPECT_TRUE(line.starts_with("paged:")) << line;
    const auto letters = std::count_if(line.begin(), line.end(), [](char byte) {
      return (static_cast<unsigned char>(byte) & 0xc0U) != 0x80U;
    });
    wide += letters > 70 + 6 && line.find(' ', 12) != std::string::npos ? 1 : 0;
  }
  EXPECT_GT(lines, 50U);
  EXPECT_LT(wide, 4U);  // what stands between ``` is left as it is
  // Nothing is lost: the words of each paragraph, and of each cell of a table but its heads, are in their
  // order.
  std::string plain;
  for (const std::string& line : linesOf(shown)) {
    plain += line.substr(6) + ' ';
  }
  const std::string all = lettersIn(plain);
  bool isCode = false;
  for (const std::string& line : linesOf(textOf(kManual / "troubleshooting.md"))) {
    isCode = isCode != line.starts_with("```");
    for (const std::string& cell :
         matches(line, isCode || !line.starts_with("|") ? "(.+)" : R"(([^|]+)\|)")) {
      EXPECT_TRUE(line.starts_with("| what you see |") || all.find(lettersIn(cell)) != std::string::npos)
          << cell;
    }
  }
  // What fits is not paged.
  EXPECT_TRUE(onTerminal({"--version"}, "sed s/^/paged:/").starts_with("careen "));
}

TEST(Manual, optionsOfHelpAreWrappedToTheTerminal) {
  const std::string shown = onTerminal({"simulate", "--help"}, "cat");
  for (const std::string& line : linesOf(shown)) {
    EXPECT_LE(line.size(), 70U) << line;
  }
  EXPECT_EQ(lettersIn(shown), lettersIn(careen({"simulate", "--help"}).out));
  // What is told of an option stays in its column.
  EXPECT_NE(shown.find("\n  --verbose                   Print all"), std::string::npos);
  EXPECT_NE(shown.find("\n                              "), std::string::npos);
}

TEST(Manual, helpKnowsNothingElse) {
  const Ended ended = careen({"help", "tutorail"});
  EXPECT_EQ(ended.exitCode, 2);
  EXPECT_NE(ended.err.find("did you mean 'tutorial'?"), std::string::npos) << ended.err;
  EXPECT_NE(careen({"help", "slow"}).err.find("'careen help --search slow' looks in all of them"),
            std::string::npos);
  EXPECT_EQ(careen({"help", "tutorail"}).out, "");
  EXPECT_EQ(careen({"help", "../README"}).exitCode, 2);
}

// The options in the lines of commands.md, by command.
std::map<std::string, std::set<std::string>> usage() {
  const std::string page = textOf(kManual / "commands.md");
  const std::size_t begin = page.find("```usage\n");
  const std::size_t end = page.find("\n```\n", begin);
  std::map<std::string, std::set<std::string>> options;
  std::string command;
  for (const std::string& line : linesOf(page.substr(begin, end - begin))) {
    if (line.starts_with("careen ")) {
      command = line.substr(7, line.find(' ', 7) - 7);
      options[command];
    }
    for (const std::string& option : matches(line, "(--[a-z-]+)")) {
      options[command].insert(option);
    }
  }
  return options;
}

TEST(Manual, usageNamesCommandsAndOptionsThatThereAre) {
  const std::string all = careen({"--help"}).out;
  const auto used = usage();
  const std::vector<std::string> commands = matches(all.substr(all.find("Subcommands:")), "\n  ([a-z]+)  ");
  EXPECT_GE(commands.size(), 12U);
  const bool draws = std::find(commands.begin(), commands.end(), "render") != commands.end();
  for (const std::string& command : commands) {
    ASSERT_EQ(used.count(command), 1U) << command;
    const std::string help = careen({command, "--help"}).out;
    for (const std::string& option : used.at(command)) {
      if (option == "--film" && !draws) {  // the program built without GL
        continue;
      }
      EXPECT_NE(help.find(option), std::string::npos) << command << ' ' << option;
    }
  }
}

TEST(Manual, namesEveryOption) {
  std::string manual;
  for (const fs::path& page : pages()) {
    manual += textOf(page);
  }
  const std::string all = careen({"--help"}).out;
  std::size_t options = 0;
  for (const std::string& command : matches(all.substr(all.find("Subcommands:")), "\n  ([a-z]+)  ")) {
    for (const std::string& option :
         matches(careen({command, "--help"}).out, "\n *(?:-[a-z],)?(--[a-z-]+)")) {
      ++options;
      EXPECT_TRUE(std::regex_search(manual, std::regex(option + "(?![a-z-])"))) << command << ' ' << option;
    }
  }
  EXPECT_GT(options, 80U);
}

TEST(Manual, readmeHasTheFiguresOfTheStudy) {
  constexpr const char* kContestants[] = {"exact",         "bullet-best", "ode-best",
                                          "mujoco-3-best", "jolt-best",   "rapier-best"};
  std::vector<std::string> names;
  std::map<std::string, std::map<std::string, std::string>> errors;  // by case and contestant
  const auto cells = [](const std::string& line) { return matches(line, R"(\| ([^|]*) (?=\|))"); };
  for (const std::string& line : linesOf(textOf(kSource / "assets/study/results.md"))) {
    if (line.starts_with("| case | exact |") && names.empty()) {
      names = cells(line);
    } else if (line.starts_with("| ") && !names.empty()) {
      const std::vector<std::string> row = cells(line);
      for (std::size_t i = 0; i < std::min(row.size(), names.size()); ++i) {
        errors[row[0]].emplace(names[i], row[i]);  // the first table is that of errors
      }
    }
  }
  int rows = 0;
  for (const std::string& line : linesOf(textOf(kSource / "README.md"))) {
    const std::vector<std::string> row = cells(line);
    std::smatch match;
    if (row.size() == 1 + std::size(kContestants) &&
        std::regex_match(row[0], match, std::regex(R"(.*\(`(.*)`\))"))) {
      ++rows;
      for (std::size_t i = 0; i < std::size(kContestants); ++i) {
        EXPECT_EQ(row[i + 1], errors[match[1]][kContestants[i]]) << kContestants[i] << line;
      }
    }
  }
  EXPECT_GE(rows, 5);
}

}  // namespace
}  // namespace careen
