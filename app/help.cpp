#include <algorithm>
#include <iostream>
#include <memory>
#include <string>

#include "commands.h"
#include "manual.h"
#include "nearest.h"

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
  std::cout << "\n'careen help PAGE' shows one, 'careen help COMMAND' the options of a command.\n";
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
  throw InputError("help: found '" + topic + "', expected a page of the manual or a command" +
                   didYouMean(topic, topics) + "; 'careen help' lists the pages");
}

}  // namespace

void addHelp(const CommandLine& commandLine) {
  const CommandLine command = commandLine.addCommand("help", "Show the manual, or the options of a command");
  const auto topic = std::make_shared<std::string>();
  command.add("topic", *topic, "Page of the manual, or command; without one, lists the pages");
  // The command line outlives its commands; a copy of it within one would keep it alive for ever.
  command.runs([topic, &commandLine](const std::stop_token&) { return helpCommand(commandLine, *topic); });
}

}  // namespace careen
