// Command lines, an argument in each line: read, not run.

#include <iostream>
#include <sstream>
#include <vector>

#include "commands.h"
#include "fuzz/fuzz.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace careen;
  std::vector<std::string> words = {"careen"};
  std::istringstream lines{std::string(fuzz::textOf(data, size))};
  for (std::string word; std::getline(lines, word);) {
    words.push_back(word.substr(0, word.find('\0')));
  }
  std::vector<const char*> arguments;
  arguments.reserve(words.size());
  for (const std::string& word : words) {
    arguments.push_back(word.c_str());
  }
  std::ostringstream printed;
  std::streambuf* const out = std::cout.rdbuf(printed.rdbuf());
  std::streambuf* const err = std::cerr.rdbuf(printed.rdbuf());
  fuzz::refusesOrReads([&] {
    const CommandLine commandLine("", "careen", "careen");
    addSimulate(commandLine);
    addStudy(commandLine);
    addDice(commandLine);
    addCompare(commandLine);
    addAudit(commandLine);
    addExport(commandLine);
    addHelp(commandLine);
    addInfo(commandLine);
    addSweep(commandLine);
    addTruth(commandLine);
    addValidate(commandLine);
    addVerify(commandLine);
    addWhen(commandLine);
    commandLine.parse(static_cast<int>(arguments.size()), arguments.data());
  });
  std::cout.rdbuf(out);
  std::cerr.rdbuf(err);
  return 0;
}
