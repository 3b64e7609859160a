#pragma once

#include <filesystem>
#include <functional>
#include <stop_token>
#include <vector>

#include "command_line.h"

namespace careen {

struct FrameRange;
struct Trajectory;

/// Draws these frames of a run's film into a folder, in a process of its own.
using DrawFilm = std::function<void(const Trajectory& run, const std::filesystem::path& folder,
                                    const std::vector<FrameRange>& frames, const std::stop_token& stop)>;
/// The one of a program that has GL.
void drawFilmOfRun(const Trajectory& run, const std::filesystem::path& folder,
                   const std::vector<FrameRange>& frames, const std::stop_token& stop);

// Each adds one command with its options to the command line.
void addRender(const CommandLine& commandLine);
void addPage(const CommandLine& commandLine);
void addSimulate(const CommandLine& commandLine);
void addCompare(const CommandLine& commandLine);
void addAudit(const CommandLine& commandLine);
void addDice(const CommandLine& commandLine);
void addHelp(const CommandLine& commandLine);
void addExport(const CommandLine& commandLine);
void addInfo(const CommandLine& commandLine);
void addStudy(const CommandLine& commandLine);
/// Without `drawFilm` there are no films of runs.
void addSweep(const CommandLine& commandLine, const DrawFilm& drawFilm = {});
void addTruth(const CommandLine& commandLine);
void addValidate(const CommandLine& commandLine);
void addVerify(const CommandLine& commandLine);
void addView(const CommandLine& commandLine);
void addWhen(const CommandLine& commandLine);

}  // namespace careen
