#include <algorithm>
#include <array>
#include <filesystem>
#include <initializer_list>
#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <sstream>
#include <string>
#include <vector>

#include "commands.h"
#include "compare.h"
#include "core/characters.h"
#include "core/error.h"
#include "core/number_range.h"
#include "core/system/file.h"
#include "core/system/processor.h"
#include "film/folder.h"
#include "film/frame_range.h"
#include "film_sound.h"
#include "interruption.h"
#include "other_runs.h"
#include "parsed.h"
#include "picture_options.h"
#include "progress.h"
#include "render/film/film.h"
#include "run_options.h"
#include "runs/run_report.h"
#include "simulation_progress.h"
#include "still.h"
#include "summary.h"
#include "truth/truth_film.h"
#include "truth/truth_frame.h"
#include "view/out_of_view.h"
#include "with_reference.h"

namespace careen {
namespace {

struct FilmOptions {
  std::filesystem::path source;
  std::filesystem::path folder;
  std::string frames;
  std::optional<std::string> still;  ///< a moment [s] of the film, or a range of them
  std::optional<std::filesystem::path> video;
  std::string codec;
  std::string quality = "good";
  std::optional<int> jobs;
  std::string log = "text";
  bool verbose = false;
  bool resume = false;
  bool overwrite = false;
  PictureOptions picture;
  SoundChoice sound;
  std::optional<std::filesystem::path> reference;
  bool approve = false;
  CompareOptions compare;
  SceneOfTable scene;
  OtherRuns others;
  std::optional<std::string> truth;
  Overrides overrides;
  EstimateChoice estimate;
  AuditChoice audit;
};

std::optional<VideoSettings> videoOf(const FilmOptions& options) {
  if (!options.video) {
    return std::nullopt;
  }
  VideoSettings video{.path = *options.video, .codec = options.codec, .alpha = options.picture.alpha};
  video.quality = parsed("--quality", options.quality, videoQualityNamed);
  return video;
}

// A name that is meant for something else: a video, or a picture that is no PNG.
void checkOut(const FilmOptions& options) {
  const std::string suffix = lowered(options.folder.extension().string());
  const auto isAnyOf = [&suffix](std::initializer_list<const char*> others) {
    return std::find(others.begin(), others.end(), suffix) != others.end();
  };
  std::error_code none;
  const bool isVideo = isAnyOf({".mp4", ".mkv", ".webm", ".webp", ".gif", ".mov", ".avi", ".apng"});
  const bool isPicture = isAnyOf({".jpg", ".jpeg", ".bmp", ".tif", ".tiff", ".tga", ".ppm", ".exr"});
  const std::string found = "--out: found " + options.folder.string() + ", expected ";
  if (options.still) {
    if (isVideo || isPicture) {
      throw InputError(found + "the name of a PNG file, such as " +
                       std::filesystem::path(options.folder).replace_extension(".png").string());
    }
  } else if ((isVideo || isPicture || suffix == ".png") &&
             !std::filesystem::is_directory(options.folder, none)) {
    throw InputError(found + "a folder for the frames; " +
                     (isVideo ? "--video names a video" : "--still makes a single picture"));
  }
}

// [s] Of the film: none of a film, many of a picture that shows all of them.
std::vector<double> momentsOf(const FilmOptions& options) {
  return options.still ? parsed("--still", *options.still, numbersOfRange) : std::vector<double>();
}

// Checks everything that can be found wrong before the simulation.
void check(const FilmOptions& options) {
  checkOut(options);
  const auto fail = [](const char* option, const std::string& found, const std::string& expected) {
    throw InputError(std::string(option) + ": found " + found + ", expected " + expected);
  };
  if (options.jobs && (*options.jobs < 1 || *options.jobs > kMostJobs)) {
    fail("--jobs", std::to_string(*options.jobs), "1 to " + std::to_string(kMostJobs));
  }
  if (momentsOf(options).size() > 1 && (options.others.plot || options.others.ghost ||
                                        !options.others.beside.empty() || options.picture.shutter)) {
    fail("--still", "many moments with another run, a plot or a shutter", "one moment, or none of these");
  }
  if (options.log != "text" && options.log != "json") {
    fail("--log", "'" + options.log + "'", "text or json");
  }
  if (const std::optional<VideoSettings> video = videoOf(options)) {
    checkVideo(*video);
    std::error_code none;
    if (std::filesystem::is_directory(video->path, none)) {
      fail("--video", "the folder " + video->path.string(), "a file");
    }
  }
}

// Settings from the options alone: finds everything that can be found wrong before the simulation.
FilmSettings settingsOf(const FilmOptions& options) {
  check(options);
  options.picture.check();
  FilmSettings settings;
  settings.render.context = options.picture.contextOptions();
  settings.folder =
      options.folder.empty() ? std::filesystem::path("out") / options.source.stem() : options.folder;
  if (!options.frames.empty()) {
    settings.frames = parseFrameRanges(options.frames);
  }
  settings.video = videoOf(options);
  settings.besides = options.others.shown({});  // the runs follow
  settings.jobs = options.jobs;
  settings.program = "careen " CAREEN_VERSION;
  settings.there = options.resume      ? FilmThere::kResume
                   : options.overwrite ? FilmThere::kReplace
                                       : FilmThere::kDrawAgain;
  return settings;
}

// Labels of the film's frames, beside them.
std::optional<TruthSettings> truthOf(const FilmOptions& options, const FilmSettings& film) {
  if (!options.truth) {
    return std::nullopt;
  }
  TruthSettings truth;
  truth.folder = film.folder;
  truth.frames = film.frames;
  truth.channels = parsed("--truth", *options.truth, channelsNamed);
  truth.jobs = options.jobs.value_or(std::min(usableCores(), kMostJobs));
  truth.program = film.program;
  return truth;
}

void writeReport(const Run& run, const FilmSettings& settings, const FilmFigures& figures,
                 double wallSeconds) {
  const PictureSettings& picture = figures.picture;
  nlohmann::ordered_json report = runReport(run, wallSeconds);
  report["seconds"]["draw"] = figures.drawSeconds;
  report["seconds"]["read"] = figures.readSeconds;
  report["seconds"]["encode"] = figures.encodeSeconds;
  report["core_seconds"] = figures.coreSeconds;
  report["jobs"] = figures.jobs;
  report["frames"] = figures.drawn + figures.skipped;
  report["frames_drawn"] = figures.drawn;
  report["size"] = {picture.width, picture.height};
  report["fps"] = picture.rate.text();
  report["overlays"] = picture.overlays.text();
  report["renderer"] = figures.renderer;
  writeFile(settings.folder / "report.json", report.dump(2) + "\n");
}

void printFrame(const FilmSettings& settings, const FrameFigures& frame) {
  const nlohmann::ordered_json line = {{"frame", frame.frame},
                                       {"time", frame.time},
                                       {"file", (settings.folder / frameFileName(frame.frame)).string()},
                                       {"draw", frame.drawSeconds},
                                       {"read", frame.readSeconds},
                                       {"encode", frame.encodeSeconds}};
  std::cout << line.dump() << std::endl;  // flushed: somebody may be waiting for it
}

void printDrawing(std::ostream& out, const FilmFigures& figures) {
  out << "drawing      " << figures.drawSeconds << " s, reading back " << figures.readSeconds
      << " s, encoding " << figures.encodeSeconds << " s, " << figures.coreSeconds << " s of all cores, "
      << figures.jobs << (figures.jobs == 1 ? " job\n" : " jobs\n");
  if (!figures.renderer.empty()) {
    out << "renderer     " << figures.renderer << '\n';
  }
}

// Of frames that are compared, the result tells which are kept, and where.
void printFilm(std::ostream& out, const FilmSettings& settings, const FilmFigures& figures,
               const Reference* reference) {
  const PictureSettings& picture = figures.picture;
  out << "frames       " << figures.drawn + figures.skipped << " at " << picture.rate.text()
      << " per second, " << picture.width << 'x' << picture.height;
  if (figures.skipped > 0) {
    out << ", " << figures.skipped << " of them were there already";
  }
  const std::filesystem::path& folder = reference != nullptr ? reference->folder : settings.folder;
  out << (reference != nullptr ? ", compared with " : ": ")
      << printableName(std::filesystem::absolute(folder).lexically_normal().string()) << '\n';
  if (settings.video) {
    out << "film         "
        << printableName(std::filesystem::absolute(settings.video->path).lexically_normal().string()) << '\n';
    if (const int rate = fallbackRate(*settings.video)) {
      out << "its rate     " << rate << " per second: its format has no more\n";
    }
    if (needsEvenSize(*settings.video) && (picture.width % 2 != 0 || picture.height % 2 != 0)) {
      out << "its size     " << picture.width + picture.width % 2 << 'x'
          << picture.height + picture.height % 2 << ": its format needs an even one, so the last "
          << (picture.height % 2 == 0  ? "column comes"
              : picture.width % 2 == 0 ? "row comes"
                                       : "column and row come")
          << " twice\n";
    }
  }
}

ExitCode listBackends(const ContextOptions& options) {
  std::string first = "none";
  std::ostringstream lines;
  for (const BackendFound& each : findRenderingBackends(options)) {
    lines << each.name << (each.available ? ": available, " : ": not available, ") << each.description
          << '\n';
    if (each.available && first == "none") {
      first = each.name;
    }
  }
  std::cout << "auto: " << first << '\n' << lines.str();
  return ExitCode::kDone;
}

// Runs before the simulation, like all checks of options.
Reference openReference(FilmOptions& options) {
  if (!options.others.beside.empty() || options.others.plot) {
    throw InputError("--ref: found it with --beside or --plot, expected a film of one run");
  }
  Reference reference = parsed("--ref", *options.reference, readReference);
  takeFromReference(reference, options.picture, options.frames, options.compare);
  const ComparisonSettings settings = options.compare.settings();
  const auto [width, height] = parseSize(*options.picture.size);
  static_cast<void>(settings.ignored.of(width, height));  // tells if it does not fit
  if (settings.motionTolerance > 0) {
    throw InputError("--motion: found " + options.compare.motion +
                     " and --ref, expected same or any: only of runs it is known how far apart boxes are");
  }
  return reference;
}

// Of the film in --out only what differs is kept, so one that somebody made must not be there. What an
// earlier comparison left there gives way.
void refuseToOverwrite(const Reference& reference, FilmSettings& film) {
  const std::filesystem::path& folder = film.folder;
  if (std::filesystem::weakly_canonical(folder) == std::filesystem::weakly_canonical(reference.folder)) {
    throw InputError("--out: found the folder of --ref, " + folder.string() +
                     ", expected another one for what differs");
  }
  if (film.there != FilmThere::kReplace && readManifest(folder) && !holdsComparison(folder)) {
    throw InputError(
        folder.string() +
        ": holds a film, of which only what differs would be left; name another folder with --out, or "
        "--overwrite to delete that film");
  }
  film.there = FilmThere::kReplace;
}

ExitCode renderCommand(FilmOptions options, const std::stop_token& stop) {
  const Stopwatch stopwatch;
  if (options.source.empty()) {
    options.source = defaultScene();
  }
  std::optional<Reference> reference;
  if (options.reference) {
    reference = openReference(options);
  }
  FilmSettings settings = settingsOf(options);
  const std::optional<TruthSettings> truth = truthOf(options, settings);
  if (reference && !options.approve) {
    refuseToOverwrite(*reference, settings);
  }
  const bool makesFilm = !options.still;
  if (makesFilm && !isRun(options.source) && !isMujocoModel(options.source)) {
    refuseFilmOfAnotherScene(settings, readFile(options.source));
  }
  options.overrides.threads = options.picture.threadsOfCrowds();
  const bool logsJson = options.log == "json";
  SimulationProgress simulation(logsJson);
  Run run = loadRun(options.source, options.overrides, options.scene, stop,
                    simulation.ofRun(options.overrides.mostRecords()));
  if (truth) {
    checkLabels(run.trajectory);
  }
  auditRun(run, options.audit, stop);
  PictureSettings& picture = run.trajectory.stage.picture;
  options.picture.applyTo(picture);
  const std::vector<Trajectory> others = options.others.read(run, options.scene);
  settings.besides = options.others.shown(others);
  if (settings.video) {
    settings.video->rateNumerator = picture.rate.numerator;
    settings.video->rateDenominator = picture.rate.denominator;
  }
  if (!makesFilm) {
    return drawStill(run, settings.render,
                     {.path = options.folder, .moments = momentsOf(options), .besides = settings.besides});
  }
  const std::string sound = options.sound.of(run.trajectory, settings, stop);
  FilmSettings told = settings;
  std::optional<Approval> approval;
  if (options.approve) {
    parsed("--approve", *reference, [&](const Reference& each) { approval.emplace(each); });
    settings.folder = approval->folder();
    told.folder = reference->folder;
  }
  Progress progress;
  if (!reference) {
    setInterruptionHint("; --resume completes the film");
  }
  const FilmFigures figures = renderFilm(
      run.trajectory, settings,
      [&](const FilmProgress& now) {
        progress.update(now);
        if (logsJson) {
          printFrame(told, now.frame);
        }
      },
      stop);
  setInterruptionHint("");
  if (options.sound.asked) {
    writeFile(settings.folder / "sound.wav", sound);
  }
  if (truth) {
    writeTruth(run.trajectory, *truth, {}, stop);
  }
  options.estimate.estimate(run, stopwatch.seconds() - run.auditSeconds, stop, simulation.ofEstimate());
  if (!reference || (approval && std::filesystem::exists(reference->folder / "report.json"))) {
    writeReport(run, settings, figures, stopwatch.seconds());
  }
  std::ostream& summary = logsJson ? std::cerr : std::cout;
  printSummary(summary, run, stopwatch.seconds(), options.verbose);
  print(summary, outOfView(run.trajectory), run.trajectory);
  if (options.verbose) {
    printDrawing(summary, figures);
  }
  printFilm(summary, told, figures, reference ? &*reference : nullptr);
  if (approval) {
    return approveAndTell(*approval, options.compare, logsJson, stop);
  }
  return reference ? compareAndTell(*reference, settings.folder, options.compare, logsJson, stop)
                   : ExitCode::kDone;
}

}  // namespace

void addRender(const CommandLine& commandLine) {
  const CommandLine command = commandLine.addCommand("render", "Make a film of a scene, or of a run");
  const auto options = std::make_shared<FilmOptions>();
  command.add("file", options->source,
              "Scene, trajectory file or table of poses; the default scene if none is named");
  options->scene.addShowingTo(command);
  const CommandOption out =
      command.add("-o,--out", options->folder,
                  "Folder for the frames, or file of a single picture (default: out/ and the file's name)");
  const CommandOption frames =
      command.add("--frames", options->frames, "Which frames, such as 0-119,200:2 (default: all)");
  options->others.addTo(command);
  const CommandOption truth =
      command.add("--truth", options->truth,
                  "Labels of every pixel of the frames too, as by 'careen truth': all, or names such as "
                  "depth,instance,flow");
  options->picture.addTo(command);
  command.addFlag(
      "--alpha", options->picture.alpha,
      "Boxes and their shadows on nothing, in PNG files with alpha, to be laid over other pictures");
  const CommandOption video =
      command.add("--video", options->video,
                  "Film to make of the frames, by ffmpeg: .mp4, .mkv, .mov, .webm, .webp, .gif or .apng");
  command
      .add("--codec", options->codec,
           "h264, vp9, av1 or prores, or h264-444 or vp9-444, with 10 bits and all colours (default: the "
           "first of these that its format has; vp9 for .webm, prores for .mov)")
      .needs(video);
  command.add("--quality", options->quality, "The video's: draft, good or best (default: good)").needs(video);
  command.add("--jobs", options->jobs,
              "Frames drawn at once, each in a process of its own (default: one for each core)");
  const CommandOption sound = options->sound.addTo(command);
  const CommandOption resume =
      command.addFlag("--resume", options->resume,
                      "Keep the frames of the same film that are there and whole, and draw the others");
  const CommandOption overwrite = command.addFlag("--overwrite", options->overwrite,
                                                  "Replace the film in the folder if it is another one");
  overwrite.excludes(resume);
  const CommandOption still =
      command
          .add(
              "--still", options->still,
              "One picture in place of the film: of this moment of it [s], or of many, FROM:TO:STEP, such as "
              "0:2:0.1")
          .excludes(frames, video, resume, truth, sound);
  const CommandLine comparing =
      command.addGroup("Comparing", "With a film that was made before: exit code 1 if this one differs");
  const CommandOption reference =
      comparing
          .add("--ref", options->reference,
               "Folder of that film. Its frames are drawn, of its size, rate and look unless told "
               "otherwise; those that differ stay in --out")
          .excludes(still, video, resume, truth, sound);
  comparing
      .addFlag("--approve", options->approve,
               "The new film takes the place of that one unless they are the same; exit code 0")
      .needs(reference)
      .excludes(out, frames, overwrite);
  const CommandLine how = comparing.addGroup("How", "What counts as different");
  options->compare.addTo(how);
  how.needs(reference);
  command.add(
      "--log", options->log,
      "text, or json: lines on the standard output while the scene is simulated, then one for each frame "
      "drawn, and nothing else there (default: text)");
  command.addFlag("--verbose", options->verbose, "Print all that is known of the run, as report.json has it");
  options->overrides.addAllowOverlapTo(command);
  options->overrides.addLimitTo(command);
  options->estimate.addTo(command);
  options->audit.addTo(command);
  command.runs([options](const std::stop_token& stop) {
    return options->picture.listsBackends() ? listBackends(options->picture.context)
                                            : renderCommand(*options, stop);
  });
}

}  // namespace careen
