#include "command_line.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <filesystem>
#include <iostream>
#include <sstream>
#include <utility>

#include "core/characters.h"
#include "nearest.h"

namespace careen {
namespace {

// An argument that is refused is part of the message.
std::string printableLines(const std::string& text) {
  std::istringstream stream(text);
  std::string lines;
  for (std::string line; std::getline(stream, line);) {
    lines += printableName(line) + '\n';
  }
  return lines;
}

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
  app_->set_version_flag("--version", version);
  app_->require_subcommand(1);
}

CommandLine::CommandLine(std::shared_ptr<CLI::App> app, std::shared_ptr<Command> chosen)
    : app_(std::move(app)), chosen_(std::move(chosen)) {}

CommandLine CommandLine::addCommand(const std::string& name, const std::string& help) const {
  return {std::shared_ptr<CLI::App>(app_, app_->add_subcommand(name, help)), chosen_};
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
  return app_->get_subcommand(command)->help("careen " + command);
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
    std::cerr << printableLines(
        "careen: found '" + first + "', expected a command" + didYouMean(first, names) +
        (std::filesystem::is_regular_file(first, none) ? "; to film it: careen render " + first
                                                       : "; 'careen --help' lists them"));
    return {.command = nullptr, .exitCode = ExitCode::kBadInput};
  }
  try {
    app_->parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    std::ostringstream wrong;
    const int code = app_->exit(error, std::cout, wrong);
    std::cerr << printableLines(wrong.str());
    return {.command = nullptr, .exitCode = code == 0 ? ExitCode::kDone : ExitCode::kBadInput};
  }
  return {.command = *chosen_};
}

}  // namespace careen
