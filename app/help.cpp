#include <algorithm>
#include <memory>
#include <sstream>
#include <string>
#include <vector>

#include "advice.h"
#include "commands.h"
#include "core/characters.h"
#include "manual.h"
#include "nearest.h"
#include "scene_keys.h"
#include "terminal_text.h"

namespace careen {
namespace {

// The title is the first line, "# Title".
std::string_view titleOf(std::string_view page) { return page.substr(2, page.find('\n') - 2); }

// A text that is shown at the end, in lines that fit.
class HelpText {
 public:
  HelpText() : columns_(readingColumns()) {}
  void add(std::string_view text) { text_ += text; }
  void page(std::string_view page) {
    text_ += columns_ ? wrappedMarkdown(page, *columns_) : std::string(page);
  }
  void options(const std::string& help) { text_ += columns_ ? wrappedOptions(help, *columns_) : help; }
  // What is found, indented under where it is.
  void found(const std::string& where, const std::string& text) {
    text_ += where + '\n' + wrapped("    " + text, columns_.value_or(100));
  }
  bool isEmpty() const { return text_.empty(); }
  void show() const { showText(text_); }

 private:
  std::optional<std::size_t> columns_;
  std::string text_;
};

void listPages(HelpText& text) {
  text.add("The manual, a page a task:\n\n");
  for (const std::string_view name : kManualPages) {
    constexpr std::size_t kWidth = 18;
    text.add("  " + std::string(name) + std::string(kWidth - name.size(), ' '));
    text.add(titleOf(manualPage(std::string(name) + ".md")));
    text.add("\n");
  }
  text.add(
      "\n'careen help PAGE' shows one, 'careen help COMMAND' the options of a command, 'careen help keys' "
      "every key of scenes.\n'careen help --search WORD' looks in all of them.\n");
}

// Lines of a page or of options that have the word.
void addLinesWith(const std::string& word, std::string_view lines, const std::string& topic, HelpText& text) {
  std::istringstream stream{std::string(lines)};
  for (std::string line; std::getline(stream, line);) {
    if (lowered(line).find(word) != std::string::npos) {
      text.found("careen help " + topic + ":", line);
    }
  }
}

void search(const CommandLine& commandLine, const std::string& asked, HelpText& text) {
  const std::string word = lowered(asked);
  for (const SceneKey& key : sceneKeys()) {
    if (lowered(key.path + " " + key.text).find(word) != std::string::npos) {
      text.found(key.path, key.text);
    }
  }
  for (const std::string& command : commandLine.commands()) {
    addLinesWith(word, commandLine.helpOf(command), command, text);
  }
  for (const std::string_view page : kManualPages) {
    addLinesWith(word, manualPage(std::string(page) + ".md"), std::string(page), text);
  }
  for (const Advice& advice : allAdvice()) {
    if (lowered(std::string(advice.sign) + " " + std::string(advice.next)).find(word) != std::string::npos) {
      text.found("message \"" + std::string(advice.sign) + "\":", std::string(advice.next));
    }
  }
  if (text.isEmpty()) {
    throw InputError("help: found '" + asked +
                     "' in no page, key, option or message; 'careen help' lists the pages");
  }
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

void addTopic(const CommandLine& commandLine, const std::string& topic, HelpText& text) {
  const std::string_view page = manualPage(topic + ".md");
  const std::vector<std::string> commands = commandLine.commands();
  const bool isCommand = std::find(commands.begin(), commands.end(), topic) != commands.end();
  if (!isCommand && page.empty()) {
    std::vector<std::string> topics(kManualPages.begin(), kManualPages.end());
    topics.insert(topics.end(), commands.begin(), commands.end());
    topics.emplace_back("keys");
    throw InputError("help: found '" + topic + "', expected a page of the manual or a command" +
                     didYouMean(topic, topics) + "; 'careen help' lists the pages, 'careen help --search " +
                     topic + "' looks in all of them");
  }
  if (isCommand) {
    text.options(commandLine.helpOf(topic));
    text.add(page.empty() ? "\nIn the manual: 'careen help " + std::string(pageOf(topic)) + "'.\n"
                          : "\nIts page of the manual:\n\n");
  }
  text.page(page);
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
    HelpText text;
    if (!word->empty()) {
      search(commandLine, *word, text);
    } else if (topic->empty()) {
      listPages(text);
    } else if (*topic == "keys") {
      for (const SceneKey& key : sceneKeys()) {
        text.found(key.path, key.text);
      }
    } else {
      addTopic(commandLine, *topic, text);
    }
    text.show();
    return ExitCode::kDone;
  });
}

}  // namespace careen
