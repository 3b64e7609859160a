#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <stop_token>
#include <string>
#include <vector>

#include "core/error.h"

namespace CLI {
class App;
class Option;
}  // namespace CLI

namespace careen {

/// What the command line asked for; runs until done or until asked to stop.
using Command = std::function<ExitCode(const std::stop_token&)>;

/// An option that was added.
class CommandOption {
 public:
  explicit CommandOption(CLI::Option* option) : option_(option) {}

  CommandOption required() const;
  CommandOption showsDefault() const;
  /// The text is a list, with this between its elements.
  CommandOption delimiter(char separator) const;
  /// Each use of the option takes one text, and what follows that is another argument.
  CommandOption onePerUse() const;
  CommandOption oneOf(const std::vector<std::string>& texts) const;
  CommandOption needs(CommandOption other) const;
  template <class... Others>
  CommandOption excludes(Others... others) const {
    (exclude(others), ...);
    return *this;
  }

 private:
  friend class CommandLine;
  void exclude(CommandOption other) const;

  CLI::Option* option_;
};

/// The command line, one of its commands, or a group of options. Copies stand for the same one. CLI11 is
/// behind command_line.cpp alone: its header takes seven seconds of every source that includes it.
class CommandLine {
 public:
  CommandLine(const std::string& description, const std::string& name, const std::string& version);

  CommandLine addCommand(const std::string& name, const std::string& help) const;
  CommandLine addGroup(const std::string& name, const std::string& help) const;

  /// `value` must last until the command line is parsed. Types: std::string, std::filesystem::path, double,
  /// std::optional of these and of int, std::vector<std::string>.
  template <class Value>
  CommandOption add(const std::string& names, Value& value, const std::string& help) const;
  CommandOption add(const std::string& names, const std::function<void(double)>& take,
                    const std::string& help) const;
  CommandOption addFlag(const std::string& name, bool& value, const std::string& help) const;
  CommandOption addFlag(const std::string& name, const std::function<void()>& given,
                        const std::string& help) const;

  /// A group may only be used together with that option.
  void needs(CommandOption option) const;
  void footer(const std::string& text) const;
  /// Names of the commands that were added, in that order.
  std::vector<std::string> commands() const;
  /// What `command`, one of these, prints with --help.
  std::string helpOf(const std::string& command) const;
  /// What this command does.
  void runs(Command command) const;

  /// Reads the arguments: what they ask for, or, where all is said already (help, version, bad usage), the
  /// exit code.
  struct Parsed {
    Command command;
    ExitCode exitCode = ExitCode::kDone;  ///< if there is no command
  };
  Parsed parse(int argc, const char* const* argv) const;

 private:
  CommandLine(std::shared_ptr<CLI::App> app, std::shared_ptr<Command> chosen);

  std::shared_ptr<CLI::App> app_;
  std::shared_ptr<Command> chosen_;
};

}  // namespace careen
