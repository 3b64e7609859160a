#include "render/film/film.h"

#include <gtest/gtest.h>
#include <sys/resource.h>

#include <algorithm>
#include <csignal>
#include <filesystem>
#include <string>
#include <vector>

#include "core/error.h"
#include "film/faults.h"
#include "film/folder.h"
#include "image/png.h"
#include "render/stage.h"
#include "support/environment_variable.h"
#include "support/process.h"

namespace careen {
namespace {

class FilmTest : public testing::Test {
 protected:
  FilmTest() {
    settings_ = filmIn("film");
    scene_.picture.width = 64;
    scene_.picture.height = 36;
    scene_.picture.rate = {.numerator = 10, .denominator = 1};
  }

  FilmSettings filmIn(const std::string& name) const {
    FilmSettings settings;
    settings.folder = folder_ / name;
    settings.jobs = 2;
    settings.program = "film_test 1";
    return settings;
  }
  FilmFigures film(const FilmSettings& settings) const { return renderFilm(shownAs(scene_, run_), settings); }
  std::string errorOf(const FilmSettings& settings) const {
    try {
      film(settings);
    } catch (const Error& error) {
      return error.what();
    }
    return {};
  }
  /// Interrupted when so many frames are drawn.
  void interruptedFilm(const FilmSettings& settings, int frames) const {
    std::stop_source stop;
    const auto count = [&](const FilmProgress& progress) {
      if (progress.done == frames) {
        stop.request_stop();
      }
    };
    EXPECT_THROW(renderFilm(shownAs(scene_, run_), settings, count, stop.get_token()), Interrupted);
  }
  std::vector<std::string> files(const std::string& name) const {
    std::vector<std::string> names;
    for (const auto& entry : std::filesystem::directory_iterator(folder_ / name)) {
      names.push_back(entry.path().filename());
    }
    std::sort(names.begin(), names.end());
    return names;
  }
  std::vector<std::string> filmOf(int frames) const {
    std::vector<std::string> names;
    names.reserve(static_cast<std::size_t>(frames) + 1);
    for (int frame = 0; frame < frames; ++frame) {
      names.push_back(frameFileName(frame));
    }
    names.emplace_back("film.json");
    return names;
  }
  void expectSame(const std::string& a, const std::string& b) const {
    ASSERT_EQ(files(a), files(b));
    for (const std::string& name : files(a)) {
      EXPECT_EQ(textOf(folder_ / a / name), textOf(folder_ / b / name)) << name;
    }
  }

  TemporaryFolder folder_;
  Scene scene_ = crateInRoom();
  Trajectory run_ = drifting(scene_, Vec3(1, 0, 0.5));
  FilmSettings settings_;
};

TEST_F(FilmTest, framesAreTheSameWhicheverOthersAreDrawn) {
  scene_.cameraMove.orbitDegrees = 40;
  scene_.cameraMove.followed = 0;
  scene_.timeMap.keys = {{0, 0}, {0.4, 0.4}, {0.8, 0.42}};
  scene_.picture.shutter = {.degrees = 180, .samples = 3};
  film(settings_);
  FilmSettings some = filmIn("some");
  some.frames = parseFrameRanges("2,3,7");
  film(some);
  for (const int frame : {2, 3, 7}) {
    const std::string name = frameFileName(frame);
    EXPECT_EQ(textOf(folder_ / "some" / name), textOf(folder_ / "film" / name)) << frame;
  }
}

TEST_F(FilmTest, keysThatLeaveTheCameraNothingToLookAtAreToldBeforeAnyFrame) {
  // Eye and target change places: half way they meet.
  scene_.cameraMove.keys = {{.time = 0, .eye = Vec3(0, -5, 1), .target = Vec3(0, 5, 1)},
                            {.time = 1, .eye = Vec3(0, 5, 1), .target = Vec3(0, -5, 1)}};
  EXPECT_NE(errorOf(settings_).find("0.5 s into the film"), std::string::npos) << errorOf(settings_);
  EXPECT_TRUE(folder_.files().empty());
}

TEST_F(FilmTest, overlaysAreDrawnOverTheirFrames) {
  film(filmIn("bare"));
  scene_.picture.overlays = OverlaySet::named("velocity");
  film(settings_);
  ASSERT_EQ(files("film"), files("bare"));
  for (const std::string& name : filmOf(10)) {
    EXPECT_NE(textOf(folder_ / "film" / name), textOf(folder_ / "bare" / name)) << name;
  }
  scene_.picture.overlays = {};
  FilmSettings other = filmIn("film");
  other.there = FilmThere::kResume;
  EXPECT_NE(errorOf(other).find("overlays velocity there, none now"), std::string::npos) << errorOf(other);
}

TEST_F(FilmTest, drawsTheFramesAskedFor) {
  settings_.frames = parseFrameRanges("1,4:3");
  EXPECT_EQ(film(settings_).drawn, 3);
  EXPECT_EQ(files("film"), (std::vector<std::string>{"000001.png", "000004.png", "000007.png", "film.json"}));
}

TEST_F(FilmTest, tellsProgressAndFigures) {
  std::vector<std::int64_t> done;
  const FilmFigures figures = renderFilm(shownAs(scene_, run_), settings_, [&](const FilmProgress& progress) {
    done.push_back(progress.done);
    EXPECT_EQ(progress.total, 10);
    EXPECT_GT(progress.framesPerSecond, 0);
    EXPECT_GE(progress.secondsLeft, 0);
  });
  EXPECT_EQ(done, (std::vector<std::int64_t>{1, 2, 3, 4, 5, 6, 7, 8, 9, 10}));
  EXPECT_GT(figures.drawSeconds, 0);
  EXPECT_GT(figures.readSeconds, 0);
  EXPECT_GT(figures.encodeSeconds, 0);
  EXPECT_EQ(figures.jobs, 2);
  EXPECT_GE(2 * figures.wallSeconds, figures.drawSeconds + figures.readSeconds + figures.encodeSeconds);
  EXPECT_GT(figures.coreSeconds, figures.encodeSeconds);
  EXPECT_NE(figures.renderer.find("Mesa"), std::string::npos);
}

TEST_F(FilmTest, interruptedFilmLeavesWholeFramesAndIsResumedToTheSameBytes) {
  film(filmIn("whole"));
  for (const bool resume : {true, false}) {
    interruptedFilm(settings_, 4);
    const std::vector<std::string> there = files("film");
    EXPECT_LT(there.size(), 10U);
    EXPECT_EQ(there.back(), "film.json");
    settings_.there = resume ? FilmThere::kResume : FilmThere::kDrawAgain;
    const FilmFigures figures = film(settings_);
    EXPECT_EQ(figures.skipped > 0, resume);
    EXPECT_EQ(figures.drawn + figures.skipped, 10);
    expectSame("film", "whole");
    std::filesystem::remove_all(folder_ / "film");
    settings_.there = FilmThere::kDrawAgain;
  }
}

TEST_F(FilmTest, sameBytesHoweverTheWorkIsSplit) {
  film(filmIn("whole"));
  for (const int jobs : {1, 4}) {
    for (const int threads : {0, 1, 3}) {
      settings_.jobs = jobs;
      settings_.render.context.threads = threads;
      EXPECT_EQ(film(settings_).jobs, jobs);
      expectSame("film", "whole");
    }
  }
  std::filesystem::remove_all(folder_ / "film");
  settings_.there = FilmThere::kResume;
  for (const char* frames : {"6-8", "1:2", "0:1"}) {
    settings_.frames = parseFrameRanges(frames);
    film(settings_);
  }
  expectSame("film", "whole");
}

TEST_F(FilmTest, noMoreJobsThanFrames) {
  settings_.jobs = 5;
  settings_.frames = parseFrameRanges("3,7");
  EXPECT_EQ(film(settings_).jobs, 2);
  for (const int jobs : {0, -1, kMostJobs + 1}) {
    settings_.jobs = jobs;
    EXPECT_THROW(film(settings_), InputError) << jobs;
  }
}

TEST_F(FilmTest, framesTellWhatTheyTook) {
  std::vector<std::int64_t> frames;
  settings_.frames = parseFrameRanges("2,5");
  renderFilm(shownAs(scene_, run_), settings_, [&](const FilmProgress& progress) {
    frames.push_back(progress.frame.frame);
    EXPECT_EQ(progress.frame.time, static_cast<double>(progress.frame.frame) / 10);
    EXPECT_GT(progress.frame.drawSeconds, 0);
    EXPECT_GT(progress.frame.readSeconds, 0);
    EXPECT_GT(progress.frame.encodeSeconds, 0);
  });
  std::sort(frames.begin(), frames.end());
  EXPECT_EQ(frames, (std::vector<std::int64_t>{2, 5}));
}

TEST_F(FilmTest, resumeDrawsAgainWhatIsBroken) {
  film(filmIn("whole"));
  film(settings_);
  const std::string cut = textOf(folder_ / "film/000003.png").substr(0, 100);
  folder_.write("film/000003.png", cut);
  folder_.write("film/000005.png", "");
  std::string changed = textOf(folder_ / "film/000007.png");
  changed[changed.size() / 2] = static_cast<char>(changed[changed.size() / 2] ^ 1);
  folder_.write("film/000007.png", changed);
  settings_.there = FilmThere::kResume;
  EXPECT_EQ(film(settings_).drawn, 3);
  expectSame("film", "whole");
}

TEST_F(FilmTest, finishedFilmIsResumedWithoutGl) {
  film(settings_);
  settings_.there = FilmThere::kResume;
  settings_.render.context = nowhereToDraw();
  const FilmFigures figures = film(settings_);
  EXPECT_EQ(figures.skipped, 10);
  EXPECT_EQ(figures.renderer, "");
  EXPECT_NE(readManifest(folder_ / "film")->renderer.find("Mesa"), std::string::npos);
}

TEST_F(FilmTest, otherFramesOfTheSameFilmAreAddedByResuming) {
  settings_.frames = parseFrameRanges("0-2");
  film(settings_);
  settings_.frames = parseFrameRanges("6,2");
  settings_.there = FilmThere::kResume;
  EXPECT_EQ(film(settings_).drawn, 1);
  EXPECT_EQ(readManifest(folder_ / "film")->frames, (std::vector<std::int64_t>{0, 1, 2, 6}));
}

TEST_F(FilmTest, anotherFilmIsNotResumed) {
  film(settings_);
  const std::string before = textOf(folder_ / "film/film.json");
  FilmSettings other = settings_;
  other.there = FilmThere::kResume;
  scene_.picture.width = 32;
  EXPECT_NE(errorOf(other).find("size 64x36 there, 32x36 now"), std::string::npos) << errorOf(other);
  scene_.picture.width = 64;
  scene_.picture.rate.numerator = 20;
  EXPECT_NE(errorOf(other).find("fps 10 there, 20 now"), std::string::npos) << errorOf(other);
  scene_.picture.rate.numerator = 10;
  scene_.picture.shutter.degrees = 90;
  EXPECT_NE(errorOf(other).find("shutter none there, 90:8 now"), std::string::npos) << errorOf(other);
  scene_.picture.shutter.degrees = 0;
  run_ = drifting(scene_, Vec3(1, 0, 0.25));
  EXPECT_NE(errorOf(other).find("run "), std::string::npos) << errorOf(other);
  EXPECT_THROW(film(other), InputError);
  EXPECT_EQ(textOf(folder_ / "film/film.json"), before);
}

TEST_F(FilmTest, filmOfAnotherProgramOrRendererIsNotResumed) {
  film(settings_);
  std::filesystem::remove(folder_ / "film/000004.png");
  settings_.there = FilmThere::kResume;
  settings_.program = "film_test 2";
  EXPECT_NE(errorOf(settings_).find("program film_test 1 there, film_test 2 now"), std::string::npos)
      << errorOf(settings_);
  settings_.program = "film_test 1";
  FilmManifest manifest = *readManifest(folder_ / "film");
  manifest.renderer = "softpipe";
  writeManifest(folder_ / "film", manifest);
  EXPECT_NE(errorOf(settings_).find("renderer softpipe there, llvmpipe"), std::string::npos)
      << errorOf(settings_);
  EXPECT_THROW(film(settings_), InputError);
  EXPECT_EQ(files("film").size(), 10U);
}

TEST_F(FilmTest, newFilmTakesTheOldOnesPlaceAndLeavesAllElse) {
  film(settings_);
  folder_.write("film/notes.txt", "mine");
  folder_.write("film/still.png", "mine");
  scene_.picture.rate.numerator = 5;
  EXPECT_NE(errorOf(settings_).find("fps 10 there, 5 now"), std::string::npos) << errorOf(settings_);
  EXPECT_EQ(files("film").size(), 13U);
  settings_.there = FilmThere::kReplace;
  film(settings_);
  EXPECT_EQ(files("film"), (std::vector<std::string>{"000000.png", "000001.png", "000002.png", "000003.png",
                                                     "000004.png", "film.json", "notes.txt", "still.png"}));
}

TEST_F(FilmTest, picturesThatAreNoFilmAreLeftAlone) {
  std::filesystem::create_directory(folder_ / "film");
  folder_.write("film/000000.png", "mine");
  EXPECT_NE(errorOf(settings_).find("no film of careen's"), std::string::npos) << errorOf(settings_);
  EXPECT_EQ(textOf(folder_ / "film/000000.png"), "mine");
  EXPECT_EQ(files("film").size(), 1U);
}

TEST_F(FilmTest, whatAKilledRunLeftIsRemoved) {
  std::filesystem::create_directory(folder_ / "film");
  folder_.write("film/.000003.png.4711.partial", "half");
  folder_.write("film/.film.json.4711.partial", "half");
  folder_.write("film/.letter.txt.partial", "mine");
  film(settings_);
  std::vector<std::string> expected = filmOf(10);
  expected.insert(expected.begin(), ".letter.txt.partial");
  EXPECT_EQ(files("film"), expected);
}

TEST_F(FilmTest, oldFilmStaysWhenANewOneCannotBegin) {
  film(settings_);
  FilmSettings other = settings_;
  other.render.context = nowhereToDraw();
  EXPECT_THROW(film(other), MachineError);
  other = settings_;
  scene_.picture.width = 100000;
  EXPECT_THROW(film(other), InputError);
  scene_.picture.width = 64;
  other = settings_;
  other.frames = parseFrameRanges("10");
  EXPECT_THROW(film(other), InputError);
  other = settings_;
  other.video = VideoSettings{.path = folder_ / "none/film.mp4"};
  EXPECT_THROW(film(other), MachineError);
  EXPECT_EQ(files("film"), filmOf(10));
}

TEST_F(FilmTest, failureWritesNothing) {
  scene_.picture.width = 100000;
  EXPECT_THROW(film(settings_), InputError);
  EXPECT_TRUE(folder_.files().empty());
}

TEST_F(FilmTest, placeThatCannotBeAFolderIsAnError) {
  folder_.write("occupied", "a file");
  EXPECT_THROW(film(filmIn("occupied")), MachineError);
  EXPECT_THROW(film(filmIn("occupied/film")), MachineError);
}

TEST_F(FilmTest, fullDiskEndsTheFilmWithWholeFramesOnly) {
  rlimit before{};
  getrlimit(RLIMIT_FSIZE, &before);
  const auto handler = std::signal(SIGXFSZ, SIG_IGN);
  const rlimit limit{.rlim_cur = 650, .rlim_max = before.rlim_max};  // room for film.json, not for a frame
  setrlimit(RLIMIT_FSIZE, &limit);
  const std::string said = errorOf(settings_);
  setrlimit(RLIMIT_FSIZE, &before);
  std::signal(SIGXFSZ, handler);
  EXPECT_NE(said.find("cannot be written"), std::string::npos) << said;
  EXPECT_EQ(files("film"), std::vector<std::string>{"film.json"});
}

TEST_F(FilmTest, twoFilmsAtOnceInOneFolderAreRefused) {
  std::filesystem::create_directory(folder_ / "film");
  const FilmFolder held(folder_ / "film");
  EXPECT_NE(errorOf(settings_).find("another careen"), std::string::npos) << errorOf(settings_);
}

TEST_F(FilmTest, resumedVideoIsTheSameAsOneMadeAtOnce) {
  settings_.video = VideoSettings{.path = folder_ / "film.mp4"};
  interruptedFilm(settings_, 4);
  EXPECT_FALSE(std::filesystem::exists(folder_ / "film.mp4"));
  settings_.there = FilmThere::kResume;
  EXPECT_GT(film(settings_).skipped, 0);
  FilmSettings whole = filmIn("whole");
  whole.video = VideoSettings{.path = folder_ / "whole.mp4"};
  film(whole);
  EXPECT_EQ(textOf(folder_ / "film.mp4"), textOf(folder_ / "whole.mp4"));
  expectSame("film", "whole");
  for (const std::string& name : folder_.files()) {
    EXPECT_EQ(name.find(".partial"), std::string::npos) << name;
  }
}

TEST_F(FilmTest, missingFfmpegIsToldBeforeAnyFrame) {
  const EnvironmentVariable path("PATH", folder_.path());
  settings_.video = VideoSettings{.path = folder_ / "film.mp4"};
  const std::string said = errorOf(settings_);
  EXPECT_NE(said.find("apt install ffmpeg"), std::string::npos) << said;
  EXPECT_TRUE(folder_.files().empty());
}

TEST_F(FilmTest, faultsAreFound) {
  film(settings_);
  const FilmManifest manifest = *readManifest(folder_ / "film");
  EXPECT_TRUE(findFaults(folder_ / "film", manifest).empty());
  std::filesystem::remove(folder_ / "film/000002.png");
  std::string changed = textOf(folder_ / "film/000005.png");
  changed[changed.size() / 2] = static_cast<char>(changed[changed.size() / 2] ^ 1);
  folder_.write("film/000005.png", changed);
  writePng(folder_ / "film/000007.png", Picture{.width = 2, .height = 1, .rgb = {1, 2, 3, 4, 5, 6}});
  const std::vector<FrameFault> faults = findFaults(folder_ / "film", manifest);
  ASSERT_EQ(faults.size(), 3U);
  EXPECT_EQ(faults[0].frame, 2);
  EXPECT_EQ(faults[0].what, "is missing");
  EXPECT_EQ(faults[1].what, "is a damaged PNG: a checksum is wrong");
  EXPECT_EQ(faults[2].what, "is 2x1, expected 64x36");
}

TEST_F(FilmTest, damagedManifestIsNamed) {
  film(settings_);
  folder_.write("film/film.json", "{ \"careen_film\": 1 }");
  EXPECT_NE(errorOf(settings_).find("film.json: is not a film manifest"), std::string::npos);
}

TEST_F(FilmTest, withAlphaIsAnotherFilmAndResumedIsTheSame) {
  scene_.picture.alpha = true;
  settings_.video = VideoSettings{.path = folder_ / "film.apng"};
  interruptedFilm(settings_, 4);
  settings_.there = FilmThere::kResume;
  EXPECT_GT(film(settings_).skipped, 0);
  FilmSettings whole = filmIn("whole");
  whole.video = VideoSettings{.path = folder_ / "whole.apng"};
  film(whole);
  expectSame("film", "whole");
  EXPECT_EQ(textOf(folder_ / "film.apng"), textOf(folder_ / "whole.apng"));
  const Picture frame = readPng(folder_ / "film/000002.png");
  EXPECT_EQ(frame.alpha.size(), 64U * 36U);
  EXPECT_EQ(*std::min_element(frame.alpha.begin(), frame.alpha.end()), 0);
  EXPECT_EQ(*std::max_element(frame.alpha.begin(), frame.alpha.end()), 255);
  scene_.picture.alpha = false;
  const std::string said = errorOf(settings_);
  EXPECT_NE(said.find("alpha yes there, no now"), std::string::npos) << said;
}

// The last ones, for they open GL in this process, after which no job can draw.
TEST_F(FilmTest, frameKShowsTimeKOverFps) {
  scene_.picture.rate = {.numerator = 24000, .denominator = 1001};
  const FilmFigures figures = film(settings_);
  EXPECT_EQ(figures.drawn, 24);
  EXPECT_EQ(files("film"), filmOf(24));
  Renderer renderer(setupOf(scene_));
  for (const int frame : {0, 7, 23}) {
    const Picture expected = renderer.draw(run_.poses(frame * 1001 / 24000.0));
    EXPECT_EQ(readPng(folder_ / "film" / frameFileName(frame)).rgb, expected.rgb) << frame;
  }
}

TEST_F(FilmTest, lastsAsLongAsItsTimeMap) {
  scene_.timeMap.keys = {{0, 0}, {1.5, 0.1}, {2, 0.1}};
  EXPECT_EQ(film(settings_).drawn, 20);
  Renderer renderer(setupOf(scene_));
  EXPECT_EQ(readPng(folder_ / "film/000012.png").rgb, renderer.draw(run_.poses(0.08)).rgb);
  EXPECT_EQ(textOf(folder_ / "film/000015.png"), textOf(folder_ / "film/000019.png"));  // a freeze frame
}

}  // namespace
}  // namespace careen
