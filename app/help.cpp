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

ExitCode helpCommand(const CommandLine& commandLine, const std::string& topic) {
  if (topic.empty()) {
    listPages();
    return ExitCode::kDone;
  }
  if (const std::string_view page = manualPage(topic + ".md"); !page.empty()) {
    std::cout << page;
    return ExitCode::kDone;
  }
  const std::vector<std::string> commands = commandLine.commands();
  if (std::find(commands.begin(), commands.end(), topic) != commands.end()) {
    std::cout << commandLine.helpOf(topic);
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
