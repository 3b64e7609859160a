#include "command_line.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <filesystem>
#include <iostream>
#include <optional>
#include <set>
#include <sstream>
#include <utility>

#include "core/characters.h"
#include "nearest.h"
#include "terminal_text.h"

namespace careen {
namespace {

// The options of a command and of its groups, as they are typed.
std::vector<std::string> optionsOf(CLI::App& app) {
  std::vector<std::string> names;
  for (const CLI::Option* const option : app.get_options()) {
    for (const std::string& name : option->get_lnames()) {
      names.push_back("--" + name);
    }
  }
  for (CLI::App* const group : app.get_subcommands([](CLI::App* each) { return each->get_name().empty(); })) {
    const std::vector<std::string> more = optionsOf(*group);
    names.insert(names.end(), more.begin(), more.end());
  }
  return names;
}

// What is wrong with arguments that were refused, and where to look. An argument is part of the message.
std::string explained(const CLI::ParseError& error, CLI::App& app, const char* firstArgument) {
  const std::vector<CLI::App*> used = app.get_subcommands();
  CLI::App& command = used.empty() ? app : *used.front();
  const std::string name = used.empty() ? "careen" : "careen " + command.get_name();
  std::vector<std::string> unknown = app.remaining(true);
  if (used.empty() && unknown.empty()) {
    unknown = {firstArgument};  // that no command follows is found first
  }
  const auto option = std::find_if(unknown.begin(), unknown.end(),
                                   [](const std::string& word) { return word.size() > 1 && word[0] == '-'; });
  std::string message = error.what();
  if (option != unknown.end()) {
    const std::string typed = option->substr(0, option->find('='));
    message = "knows no option '" + typed + "'" + didYouMean(typed, optionsOf(command));
  } else if (!unknown.empty()) {
    message = "found '" + unknown.front() + "', expected no more arguments";
  }
  return printableName("careen: " + (used.empty() ? "" : command.get_name() + ": ") + message + "; '" + name +
                       " --help' lists what there is");
}

// A line of help: what is typed, then, from one column on, what it is.
std::string inColumns(const std::string& name, const std::string& description) {
  std::string line = "  " + name;
  if (description.empty()) {
    return line + '\n';
  }
  const std::string indented(30, ' ');
  line += line.size() < indented.size() ? indented.substr(line.size()) : '\n' + indented;
  for (const char c : description) {
    line += c == '\n' ? c + indented : std::string(1, c);
  }
  return line + '\n';
}

// CLI11 has them in the order of their addresses.
std::string sortedNames(const std::string& title, const std::set<CLI::Option*>& options) {
  std::set<std::string> names;
  for (const CLI::Option* const option : options) {
    names.insert(option->get_name());
  }
  std::string text = names.empty() ? "" : ' ' + title + ':';
  for (const std::string& name : names) {
    text += ' ' + name;
  }
  return text;
}

bool takesMany(const CLI::Option& option) {
  return option.get_expected_max() >= CLI::detail::expected_max_vector_size;
}

std::string optionHelp(const CLI::Option& option) {
  std::string text = option.get_name(option.get_positional(), !option.get_positional());
  if (option.get_type_size() != 0) {  // no flag
    text += option.get_type_name().empty() ? "" : ' ' + option.get_type_name();
    text += option.get_default_str().empty() ? "" : '=' + option.get_default_str();
    text += takesMany(option) ? " ..." : "";
    text += option.get_required() ? " REQUIRED" : "";
  }
  text += sortedNames("Needs", option.get_needs()) + sortedNames("Excludes", option.get_excludes());
  return inColumns(text, option.get_description());
}

// Help of an application, a command or a group of options. CLI11's own differs from version to version.
class HelpFormatter : public CLI::FormatterBase {
 public:
  std::string make_help(const CLI::App* app, std::string name, CLI::AppFormatMode /*mode*/) const override {
    std::string usage;
    std::string positionals;
    std::string options;
    for (const CLI::Option* const option : app->get_options()) {
      if (option->get_positional()) {
        const std::string typed = option->get_name(true) + (takesMany(*option) ? "..." : "");
        usage += option->get_required() ? ' ' + typed : " [" + typed + ']';
        positionals += optionHelp(*option);
      } else if (!name.empty() || option != app->get_help_ptr()) {  // a group has that of its command
        options += optionHelp(*option);
      }
    }
    std::string groups;
    std::string commands;
    for (const CLI::App* const each : app->get_subcommands({})) {
      if (each->get_name().empty()) {
        groups += "[Option Group: " + each->get_group() + "]\n" + indented(make_help(each, "", {}));
      } else {
        commands += inColumns(each->get_name(), each->get_description());
      }
    }
    if (name.empty()) {  // of a group
      return app->get_description() + "\nOptions:\n" + options + groups;
    }
    return app->get_description() + "\nUsage: " + name + " [OPTIONS]" + usage +
           (commands.empty() ? "" : " SUBCOMMAND") + '\n' + titled("Positionals", positionals) +
           titled("Options", options) + groups + titled("Subcommands", commands) + '\n' +
           (app->get_footer().empty() ? "" : app->get_footer() + '\n');
  }

 private:
  static std::string titled(const std::string& title, const std::string& lines) {
    return lines.empty() ? "" : '\n' + title + ":\n" + lines;
  }
  static std::string indented(const std::string& lines) {
    std::string text = "  ";
    for (std::size_t i = 0; i < lines.size(); ++i) {
      text += lines[i];
      text += lines[i] == '\n' && i + 1 < lines.size() ? "  " : "";
    }
    return text;
  }
};

}  // namespace

CommandOption CommandOption::required() const {
  option_->required();
  return *this;
}

CommandOption CommandOption::showsDefault() const {
  option_->capture_default_str();
  return *this;
}

CommandOption CommandOption::delimiter(char separator) const {
  option_->delimiter(separator);
  return *this;
}

CommandOption CommandOption::onePerUse() const {
  option_->allow_extra_args(false);
  return *this;
}

CommandOption CommandOption::oneOf(const std::vector<std::string>& texts) const {
  option_->check(CLI::IsMember(texts));
  return *this;
}

CommandOption CommandOption::needs(CommandOption other) const {
  option_->needs(other.option_);
  return *this;
}

void CommandOption::exclude(CommandOption other) const { option_->excludes(other.option_); }

CommandLine::CommandLine(const std::string& description, const std::string& name, const std::string& version)
    : CommandLine(std::make_shared<CLI::App>(description, name), std::make_shared<Command>()) {
  app_->formatter(std::make_shared<HelpFormatter>());
  app_->option_defaults()->group("Options");
  app_->get_help_ptr()->group("Options");
  app_->set_version_flag("--version", version);
  app_->require_subcommand(1);
}

CommandLine::CommandLine(std::shared_ptr<CLI::App> app, std::shared_ptr<Command> chosen)
    : app_(std::move(app)), chosen_(std::move(chosen)) {}

CommandLine CommandLine::addCommand(const std::string& name, const std::string& help) const {
  CLI::App* const added = app_->add_subcommand(name, help)->group("Subcommands");
  added->get_help_ptr()->group("Options");
  return {std::shared_ptr<CLI::App>(app_, added), chosen_};
}

CommandLine CommandLine::addGroup(const std::string& name, const std::string& help) const {
  return {std::shared_ptr<CLI::App>(app_, app_->add_option_group(name, help)), chosen_};
}

template <class Value>
CommandOption CommandLine::add(const std::string& names, Value& value, const std::string& help) const {
  return CommandOption(app_->add_option(names, value, help));
}

using Path = std::filesystem::path;
template CommandOption CommandLine::add(const std::string&, std::string&, const std::string&) const;
template CommandOption CommandLine::add(const std::string&, Path&, const std::string&) const;
template CommandOption CommandLine::add(const std::string&, double&, const std::string&) const;
template CommandOption CommandLine::add(const std::string&, std::optional<std::string>&,
                                        const std::string&) const;
template CommandOption CommandLine::add(const std::string&, std::optional<Path>&, const std::string&) const;
template CommandOption CommandLine::add(const std::string&, std::optional<double>&, const std::string&) const;
template CommandOption CommandLine::add(const std::string&, std::optional<int>&, const std::string&) const;
template CommandOption CommandLine::add(const std::string&, std::vector<std::string>&,
                                        const std::string&) const;

CommandOption CommandLine::add(const std::string& names, const std::function<void(double)>& take,
                               const std::string& help) const {
  return CommandOption(app_->add_option_function<double>(names, take, help));
}

CommandOption CommandLine::addFlag(const std::string& name, bool& value, const std::string& help) const {
  return CommandOption(app_->add_flag(name, value, help));
}

CommandOption CommandLine::addFlag(const std::string& name, const std::function<void()>& given,
                                   const std::string& help) const {
  return CommandOption(app_->add_flag_callback(name, given, help));
}

void CommandLine::needs(CommandOption option) const { app_->needs(option.option_); }

void CommandLine::footer(const std::string& text) const { app_->footer(text); }

std::vector<std::string> CommandLine::commands() const {
  std::vector<std::string> names;
  for (const CLI::App* const command : app_->get_subcommands(nullptr)) {
    if (!command->get_name().empty()) {  // a group of options has none
      names.push_back(command->get_name());
    }
  }
  return names;
}

std::string CommandLine::helpOf(const std::string& command) const {
  return app_->get_subcommand(command)->help("careen");  // CLI11 adds the name of the command
}

void CommandLine::runs(Command command) const {
  app_->callback([chosen = chosen_, command = std::move(command)] { *chosen = command; });
}

CommandLine::Parsed CommandLine::parse(int argc, const char* const* argv) const {
  if (argc < 2) {
    std::cout << app_->help();
    return {.command = nullptr, .exitCode = ExitCode::kDone};
  }
  const std::string first = argv[1];
  const std::vector<std::string> names = commands();
  if (!first.starts_with('-') && std::find(names.begin(), names.end(), first) == names.end()) {
    std::error_code none;
    std::cerr << printableName(
                     "careen: found '" + first + "', expected a command" + didYouMean(first, names) +
                     (std::filesystem::is_regular_file(first, none) ? "; to film it: careen render " + first
                                                                    : "; 'careen --help' lists them"))
              << '\n';
    return {.command = nullptr, .exitCode = ExitCode::kBadInput};
  }
  try {
    app_->parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    if (error.get_exit_code() == 0) {  // help, version
      std::ostringstream text;
      app_->exit(error, text, std::cerr);
      const std::optional<std::size_t> columns = readingColumns();
      showText(columns ? wrappedOptions(text.str(), *columns) : text.str());
      return {.command = nullptr, .exitCode = ExitCode::kDone};
    }
    std::cerr << explained(error, *app_, argv[1]) << '\n';
    return {.command = nullptr, .exitCode = ExitCode::kBadInput};
  }
  return {.command = *chosen_};
}

}  // namespace careen
