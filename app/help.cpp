#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <iostream>
#include <memory>
#include <sstream>
#include <string>
#include <vector>

#include "commands.h"
#include "core/characters.h"
#include "manual.h"
#include "nearest.h"
#include "scene_keys.h"

namespace careen {
namespace {

// The title is the first line, "# Title".
std::string_view titleOf(std::string_view page) { return page.substr(2, page.find('\n') - 2); }

void listPages() {
  std::cout << "The manual, a page a task:\n\n";
  for (const std::string_view name : kManualPages) {
    constexpr std::size_t kWidth = 18;
    std::cout << "  " << name << std::string(kWidth - name.size(), ' ')
              << titleOf(manualPage(std::string(name) + ".md")) << '\n';
  }
  std::cout
      << "\n'careen help PAGE' shows one, 'careen help COMMAND' the options of a command, 'careen help keys' "
         "every key of scenes.\n'careen help --search WORD' looks in all of them.\n";
}

std::size_t columns() {
  constexpr std::size_t kUsual = 100;
  winsize size{};
  return ioctl(STDOUT_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col >= 40 ? size.ws_col : kUsual;
}

// Lines of words, as wide as the terminal.
void printWrapped(const std::string& text, const std::string& indent) {
  const std::size_t most = columns();
  std::istringstream words(text);
  std::string line = indent;
  for (std::string word; words >> word;) {
    if (line.size() > indent.size() && line.size() + 1 + word.size() > most) {
      std::cout << line << '\n';
      line = indent;
    }
    line += line.size() > indent.size() ? " " : "";
    line += word;
  }
  std::cout << line << '\n';
}

void printKey(const SceneKey& key) {
  std::cout << key.path << '\n';
  printWrapped(key.text, "    ");
}

// Lines of a text that have the word, each after where it stands.
int printLinesWith(const std::string& word, std::string_view text, const std::string& where) {
  int found = 0;
  std::istringstream lines{std::string(text)};
  for (std::string line; std::getline(lines, line);) {
    if (lowered(line).find(word) != std::string::npos) {
      std::cout << where << ":\n";
      printWrapped(line, "    ");
      ++found;
    }
  }
  return found;
}

ExitCode search(const CommandLine& commandLine, const std::string& asked) {
  const std::string word = lowered(asked);
  int found = 0;
  for (const SceneKey& key : sceneKeys()) {
    if (lowered(key.path + " " + key.text).find(word) != std::string::npos) {
      printKey(key);
      ++found;
    }
  }
  for (const std::string& command : commandLine.commands()) {
    found += printLinesWith(word, commandLine.helpOf(command), "careen help " + command);
  }
  for (const std::string_view page : kManualPages) {
    found += printLinesWith(word, manualPage(std::string(page) + ".md"), "careen help " + std::string(page));
  }
  if (found == 0) {
    throw InputError("help: found '" + asked + "' in no page, key or option; 'careen help' lists the pages");
  }
  return ExitCode::kDone;
}

// Of a command that has no page of its name: the one that commands.md links in the command's row,
// "| `render` | makes a film | [film](film.md) |", or else commands.md.
std::string_view pageOf(const std::string& command) {
  const std::string_view page = manualPage("commands.md");
  const std::size_t begin = page.find("\n| `" + command + "` |");
  if (begin == std::string_view::npos) {
    return "commands";
  }
  const std::string_view row = page.substr(begin, page.find('\n', begin + 1) - begin);
  const std::size_t link = row.rfind("](");
  const std::size_t end = row.find(".md)", link);
  return link == std::string_view::npos || end == std::string_view::npos
             ? "commands"
             : row.substr(link + 2, end - link - 2);
}

ExitCode helpCommand(const CommandLine& commandLine, const std::string& topic) {
  if (topic.empty()) {
    listPages();
    return ExitCode::kDone;
  }
  if (topic == "keys") {
    for (const SceneKey& key : sceneKeys()) {
      printKey(key);
    }
    return ExitCode::kDone;
  }
  const std::string_view page = manualPage(topic + ".md");
  const std::vector<std::string> commands = commandLine.commands();
  const bool isCommand = std::find(commands.begin(), commands.end(), topic) != commands.end();
  if (isCommand) {
    std::cout << commandLine.helpOf(topic);
    if (page.empty()) {
      std::cout << "\nIn the manual: 'careen help " << pageOf(topic) << "'.\n";
    } else {
      std::cout << "\nIts page of the manual:\n\n";
    }
  }
  if (isCommand || !page.empty()) {
    std::cout << page;
    return ExitCode::kDone;
  }
  std::vector<std::string> topics(kManualPages.begin(), kManualPages.end());
  topics.insert(topics.end(), commands.begin(), commands.end());
  topics.emplace_back("keys");
  throw InputError("help: found '" + topic + "', expected a page of the manual or a command" +
                   didYouMean(topic, topics) + "; 'careen help' lists the pages");
}

}  // namespace

void addHelp(const CommandLine& commandLine) {
  const CommandLine command = commandLine.addCommand("help", "Show the manual, or the options of a command");
  const auto topic = std::make_shared<std::string>();
  const auto word = std::make_shared<std::string>();
  command.add("topic", *topic,
              "Page of the manual, command, or keys: every key of scenes; without one, lists the pages");
  command.add("--search", *word, "Lines of pages, keys and options that have this word");
  // The command line outlives its commands; a copy of it within one would keep it alive for ever.
  command.runs([topic, word, &commandLine](const std::stop_token&) {
    return word->empty() ? helpCommand(commandLine, *topic) : search(commandLine, *word);
  });
}

}  // namespace careen
