#pragma once

#include "command_line.h"

namespace careen {

// Each adds one command with its options to the command line.
void addRender(const CommandLine& commandLine);
void addSimulate(const CommandLine& commandLine);
void addCompare(const CommandLine& commandLine);
void addAudit(const CommandLine& commandLine);
void addDice(const CommandLine& commandLine);
void addHelp(const CommandLine& commandLine);
void addExport(const CommandLine& commandLine);
void addInfo(const CommandLine& commandLine);
void addStudy(const CommandLine& commandLine);
void addSweep(const CommandLine& commandLine);
void addTruth(const CommandLine& commandLine);
void addValidate(const CommandLine& commandLine);
void addVerify(const CommandLine& commandLine);
void addView(const CommandLine& commandLine);

}  // namespace careen
