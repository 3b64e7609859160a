// Films as their user meets them.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <vector>

#include "core/system/release.h"
#include "image/png.h"
#include "support/copied_program.h"
#include "support/environment_variable.h"
#include "support/film_command.h"
#include "support/process.h"

namespace careen {
namespace {

using test::kFilmScene;

class Render : public test::FilmCommand {};

TEST_F(Render, helpIsTheSameWithEveryVersionOfCli11) {
  const std::string help = careen({"render", "--help"}).out;
  for (const char* const part :
       {"\n  --quality TEXT Needs: --video\n                              The video's",
        "\n  --overwrite Excludes: --approve --resume\n",
        "\n[Option Group: Comparing]\n  With a film that was made before",
        " differs\n  Options:\n    --ref TEXT Excludes: ",
        "\n  [Option Group: How]\n    What counts as different\n    Options:\n"
        "      --threshold TEXT=same-picture\n",
        "\n      --ignore TEXT ...           Of pictures"}) {
    EXPECT_NE(help.find(part), std::string::npos) << part << help;
  }
}

TEST_F(Render, filmsASceneInOneCommand) {
  const Ended ended = careen({"render", "scene.json", "--out", "film", "--verbose"});
  ASSERT_EQ(ended.exitCode, 0) << ended.err;
  const std::vector<std::string> frames = framesIn("film");
  ASSERT_EQ(frames.size(), 10U);
  EXPECT_EQ(frames.front(), "000000.png");
  EXPECT_EQ(frames.back(), "000009.png");
  const nlohmann::json report = nlohmann::json::parse(textOf(folder_ / "film/report.json"));
  for (const char* key : {"simulate", "draw", "read", "encode"}) {
    EXPECT_TRUE(report["seconds"].contains(key)) << key;
  }
  EXPECT_NE(std::string(report["renderer"]).find("llvmpipe"), std::string::npos);
  EXPECT_NE(ended.out.find("state hash"), std::string::npos) << ended.out;
}

TEST_F(Render, shadersBesideTheProgramAreIgnoredUnlessTheEnvironmentNamesThem) {
  const CopiedProgram copy(CAREEN_BINARY);
  for (const auto& entry : std::filesystem::directory_iterator(CAREEN_SOURCE_DIR "/shaders")) {
    copy.plant("shaders" / entry.path().filename(), "not GLSL\n");
  }
  std::vector<std::string> command = {copy.path(), "render", "scene.json", "--frames",
                                      "3",         "--out",  "copied"};
  Ended ended = Process(command, folder_.path()).wait();
  EXPECT_EQ(ended.exitCode, 0) << ended.err;
  EXPECT_EQ(textOf(folder_ / "copied/000003.png"), frameOf({"scene.json"}, "own"));

  const EnvironmentVariable data("CAREEN_DATA", copy.data().string());
  command.back() = "told";
  ended = Process(command, folder_.path()).wait();
  EXPECT_EQ(ended.exitCode, 3);
  EXPECT_NE(ended.err.find((copy.data() / "shaders").string()), std::string::npos) << ended.err;
}

TEST_F(Render, trajectoryGivesTheSameFilmAsItsScene) {
  ASSERT_EQ(careen({"simulate", "scene.json", "-o", "run.careen"}).exitCode, 0);
  ASSERT_EQ(careen({"render", "run.careen", "--out", "a"}).exitCode, 0);
  ASSERT_EQ(careen({"render", "scene.json", "--out", "b"}).exitCode, 0);
  expectSameFilm("a", "b");
}

TEST_F(Render, choosesFramesSizeAndRate) {
  const Ended ended = careen(
      {"render", "--size", "32x24", "--frames", "0-3,10:5", "--fps", "20", "scene.json", "--out", "film"});
  ASSERT_EQ(ended.exitCode, 0) << ended.err;
  EXPECT_EQ(framesIn("film"), (std::vector<std::string>{"000000.png", "000001.png", "000002.png",
                                                        "000003.png", "000010.png", "000015.png"}));
  // A PNG's width and height stand big-endian behind its 16th byte.
  const std::string png = textOf(folder_ / "film/000000.png");
  EXPECT_EQ(png[19], 32);
  EXPECT_EQ(png[23], 24);
}

TEST_F(Render, truthStandsBesideThePicturesAndIsThatOfItsOwnCommand) {
  ASSERT_EQ(
      careen({"render", "scene.json", "--frames", "2-3", "--out", "film", "--truth", "depth,flow"}).exitCode,
      0);
  ASSERT_EQ(careen({"truth", "scene.json", "--frames", "2-3", "--out", "truth", "--channels", "depth,flow"})
                .exitCode,
            0);
  EXPECT_TRUE(std::filesystem::exists(folder_ / "film/000003.png"));
  for (const char* const file : {"000002.npz", "000003.npz", "truth.json"}) {
    EXPECT_EQ(textOf(folder_ / "film" / file), textOf(folder_ / "truth" / file)) << file;
    EXPECT_FALSE(textOf(folder_ / "film" / file).empty());
  }
  const Ended refused = careen({"render", "scene.json", "--out", "no", "--truth", "color"});
  EXPECT_EQ(refused.exitCode, 2);
  EXPECT_NE(refused.err.find("--truth: found 'color'"), std::string::npos) << refused.err;
  EXPECT_FALSE(std::filesystem::exists(folder_ / "no"));
}

TEST_F(Render, refusesWhatCannotBeFilmed) {
  for (const std::vector<std::string>& options :
       std::vector<std::vector<std::string>>{{"--size", "0x10"},
                                             {"--size", "100000x100000"},
                                             {"--size", "ten"},
                                             {"--fps", "0"},
                                             {"--fps", "-3"},
                                             {"--frames", "5-2"},
                                             {"--frames", "0-99"},
                                             {"--frames", "x"},
                                             {"--overlays", "energy,wind"},
                                             {"--look", "mud"},
                                             {"--antialiasing", "8x"},
                                             {"--overlays", ""},
                                             {"--rendering-backend", "glx"},
                                             {"--threads", "-1"},
                                             {"--jobs", "0"},
                                             {"--log", "xml"},
                                             {"--video", "film.avi"},
                                             {"--video=film.webm", "--codec=h264"},
                                             {"--video=film.mp4", "--quality=ultra"}}) {
    std::vector<std::string> arguments = {"render", "scene.json", "--out", "film"};
    arguments.insert(arguments.end(), options.begin(), options.end());
    const Ended ended = careen(arguments);
    EXPECT_EQ(ended.exitCode, 2) << options[0] << ' ' << options[1] << ": " << ended.err;
    EXPECT_NE(ended.err.find("found"), std::string::npos) << ended.err;
    EXPECT_NE(ended.err.find("expected"), std::string::npos) << ended.err;
    EXPECT_FALSE(std::filesystem::exists(folder_ / "film")) << options[1];
  }
}

TEST_F(Render, anotherFilmInTheFolderIsReplacedOnlyIfAskedTo) {
  ASSERT_EQ(careen({"render", "scene.json", "--out", "film", "--frames", "0-2"}).exitCode, 0);
  const std::string first = textOf(folder_ / "film/000001.png");
  const Ended refused = careen({"render", "scene.json", "--out", "film", "--look", "clay", "--frames", "1"});
  EXPECT_EQ(refused.exitCode, 2);
  EXPECT_NE(refused.err.find("--overwrite"), std::string::npos) << refused.err;
  EXPECT_NE(refused.err.find("look studio there, clay now"), std::string::npos) << refused.err;
  EXPECT_EQ(careen({"render", "scene.json", "--ref", "film", "--out", "film"}).exitCode, 2);
  EXPECT_EQ(textOf(folder_ / "film/000001.png"), first);
  // Of the same film frames are drawn again, and none is lost.
  ASSERT_EQ(careen({"render", "scene.json", "--out", "film", "--frames", "1"}).exitCode, 0);
  EXPECT_EQ(framesIn("film").size(), 3U);
  EXPECT_EQ(careen({"verify", "film"}).exitCode, 0);
  ASSERT_EQ(
      careen({"render", "scene.json", "--out", "film", "--look", "clay", "--frames", "1", "--overwrite"})
          .exitCode,
      0);
  EXPECT_EQ(framesIn("film"), std::vector<std::string>{"000001.png"});
  EXPECT_NE(textOf(folder_ / "film/000001.png"), first);
}

// A scene that could not be simulated in a year.
TEST_F(Render, aFilmOfAnotherSceneIsToldBeforeTheSimulation) {
  ASSERT_EQ(careen({"render", "scene.json", "--out", "film", "--frames", "0"}).exitCode, 0);
  std::string text = kFilmScene;
  text.replace(text.find("0.001"), 5, "1e-12");
  folder_.write("scene.json", text);
  for (const char* const how : {"--jobs=1", "--resume"}) {
    const Ended ended = careen({"render", "scene.json", "--limit", "1000000000000", "--out", "film", how});
    EXPECT_EQ(ended.exitCode, 2);
    EXPECT_NE(ended.err.find("another scene"), std::string::npos) << ended.err;
  }
}

TEST_F(Render, aComparisonDoesNotThinOutAFilmThatSomebodyMade) {
  ASSERT_EQ(careen({"render", "scene.json", "--out", "golden", "--frames", "0-1"}).exitCode, 0);
  ASSERT_EQ(careen({"render", "scene.json", "--out", "mine", "--frames", "0-1"}).exitCode, 0);
  EXPECT_EQ(careen({"render", "scene.json", "--ref", "golden", "--out", "mine"}).exitCode, 2);
  EXPECT_EQ(framesIn("mine").size(), 2U);
  // What an earlier comparison left gives way.
  for (int i = 0; i < 2; ++i) {
    EXPECT_EQ(careen({"render", "scene.json", "--ref", "golden", "--out", "off", "--look", "clay"}).exitCode,
              1);
  }
}

TEST_F(Render, namesOfVideosAndOtherPicturesAreNoFolders) {
  for (const std::vector<std::string>& options :
       std::vector<std::vector<std::string>>{{"film.mp4"},
                                             {"film.WebM"},
                                             {"film.png"},
                                             {"picture.jpg", "--still", "0.1"},
                                             {"picture.TIFF", "--still", "0:0.2:0.1"}}) {
    std::vector<std::string> arguments = {"render", "scene.json", "--out"};
    arguments.insert(arguments.end(), options.begin(), options.end());
    const Ended ended = careen(arguments);
    EXPECT_EQ(ended.exitCode, 2) << options[0];
    EXPECT_NE(ended.err.find("found " + options[0] + ", expected"), std::string::npos) << ended.err;
    EXPECT_FALSE(std::filesystem::exists(folder_ / options[0])) << options[0];
  }
}

// Drawing can do with none of its own, where a crowd takes one; the film is the same.
TEST_F(Render, threadsOfDrawingAndOfCrowdsChangeNoBit) {
  folder_.write("crowd.json", R"({
    "careen": 1, "duration": 0.5, "gravity": [0, 0, -10], "crowds": { "when": 1 },
    "room": { "min": [-2, -2, 0], "max": [2, 2, 4] },
    "boxes": [ { "half_extents": [0.3, 0.2, 0.1], "mass": 1, "position": [0, 0, 0.4] },
               { "half_extents": [0.3, 0.2, 0.1], "mass": 1, "position": [0.1, 0, 0.7] } ],
    "film": { "size": [64, 48], "fps": 10 }
  })");
  const Ended none = careen({"render", "crowd.json", "--threads", "0", "--out", "none"});
  ASSERT_EQ(none.exitCode, 0) << none.err;
  EXPECT_NE(none.out.find("\ncrowd        from "), std::string::npos) << none.out;
  ASSERT_EQ(careen({"render", "crowd.json", "--threads", "64", "--out", "most"}).exitCode, 0);
  expectSameFilm("none", "most");
  EXPECT_EQ(careen({"render", "crowd.json", "--threads", "65", "--out", "more"}).exitCode, 2);
  EXPECT_EQ(careen({"simulate", "crowd.json", "--threads", "0", "-o", "run.careen"}).exitCode, 2);
}

TEST_F(Render, drawsTheOverlaysOfTheSceneOrThoseAskedFor) {
  std::string text = kFilmScene;
  text.insert(text.rfind('}'), R"(, "overlays": ["velocity"])");
  folder_.write("explained.json", text);
  const std::string bare = frameOf({"scene.json"}, "bare");
  const std::string explained = frameOf({"explained.json"}, "explained");
  EXPECT_NE(explained, bare);
  EXPECT_EQ(frameOf({"scene.json", "--overlays", "velocity"}, "asked"), explained);
  EXPECT_EQ(frameOf({"explained.json", "--overlays", "none"}, "none"), bare);
  EXPECT_NE(textOf(folder_ / "explained/report.json").find(R"("overlays": "velocity")"), std::string::npos);
}

// Glyphs and boxes that occlude boxes are both in textures that stay from frame to frame.
TEST_F(Render, textIsTheSameWhateverFrameWasDrawnBefore) {
  std::string text = kFilmScene;
  const std::string boxes = R"("boxes": [ )";
  text.insert(text.find(boxes) + boxes.size(),
              R"({ "half_extents": [0.5, 0.5, 0.2], "mass": 1, "position": [0, 0, 0.2] }, )");
  folder_.write("two.json", text);
  ASSERT_EQ(careen({"render", "two.json", "--jobs", "1", "--overlays", "names", "--out", "film", "--size",
                    "320x240"})
                .exitCode,
            0);
  const std::string alone = frameOf({"two.json", "--overlays", "names", "--size", "320x240"}, "alone");
  EXPECT_EQ(textOf(folder_ / "film/000003.png"), alone);
  EXPECT_NE(frameOf({"two.json", "--size", "320x240"}, "nameless"), alone);
}

TEST_F(Render, looksAndAntialiasingOfTheCommandLineTakeTheScenesPlace) {
  const std::string usual = frameOf({"scene.json"}, "usual");
  EXPECT_EQ(frameOf({"scene.json", "--look", "studio", "--antialiasing", "edges"}, "same"), usual);
  EXPECT_NE(frameOf({"scene.json", "--look", "clay"}, "clay"), usual);
  EXPECT_NE(frameOf({"scene.json", "--antialiasing", "off"}, "off"), usual);
  const Ended other = careen({"render", "scene.json", "--out", "clay", "--resume"});
  EXPECT_EQ(other.exitCode, 2);
  EXPECT_NE(other.err.find("look clay there, studio now"), std::string::npos) << other.err;
}

TEST_F(Render, takesBoxesOffTheirStage) {
  EXPECT_EQ(careen({"render", "scene.json", "--out", "cut", "--alpha", "--video", "cut.webm"}).exitCode, 0);
  EXPECT_FALSE(readPng(folder_ / "cut/000000.png").alpha.empty());
  EXPECT_TRUE(std::filesystem::exists(folder_ / "cut.webm"));
  const Ended again = careen({"render", "scene.json", "--ref", "cut", "--out", "differing"});
  EXPECT_EQ(again.exitCode, 0) << again.out << again.err;
  const Ended mixed = careen({"render", "scene.json", "--out", "cut", "--resume"});
  EXPECT_EQ(mixed.exitCode, 2);
  EXPECT_NE(mixed.err.find("alpha yes there, no now"), std::string::npos) << mixed.err;
  const Ended video = careen({"render", "scene.json", "--out", "other", "--alpha", "--video", "cut.mp4"});
  EXPECT_EQ(video.exitCode, 2);
  EXPECT_NE(video.err.find("cut.mp4: found .mp4, which has no alpha"), std::string::npos) << video.err;
  EXPECT_EQ(careen({"render", "scene.json", "--alpha", "--still", "0", "--out", "still.png"}).exitCode, 0);
  EXPECT_EQ(readPng(folder_ / "still.png").rgb, readPng(folder_ / "cut/000000.png").rgb);
}

// Whether this release of the system has OSMesa: Mesa gave it up in 25.1.
const bool kHasOsMesa = drawingPackages() == "libosmesa6";

TEST_F(Render, drawsWithTheBackendAskedFor) {
  for (const std::string backend : {"auto", "osmesa", "egl"}) {
    if (backend == "osmesa" && !kHasOsMesa) {
      continue;
    }
    const Ended ended = careen({"render", "scene.json", "--out", backend, "--rendering-backend", backend});
    ASSERT_EQ(ended.exitCode, 0) << ended.err;
    const nlohmann::json report = nlohmann::json::parse(textOf(folder_ / backend / "report.json"));
    const std::string library = backend == "egl" || !kHasOsMesa ? "libEGL.so" : "libOSMesa.so";
    EXPECT_NE(std::string(report["renderer"]).find(library), std::string::npos) << report["renderer"];
  }
  expectSameFilm("auto", kHasOsMesa ? "osmesa" : "egl");
}

TEST_F(Render, namesTheBackendsThatThereAre) {
  const Ended ended = careen({"render", "scene.json", "--rendering-backend", "glx"});
  EXPECT_NE(ended.err.find("--rendering-backend: found 'glx', expected one of: auto, osmesa, egl"),
            std::string::npos)
      << ended.err;
}

// Files of these names that are no libraries stand before the real ones.
class RenderWithout : public Render {
 protected:
  Ended careenWithout(const std::vector<std::string>& libraries, std::vector<std::string> arguments) const {
    for (const std::string& library : libraries) {
      folder_.write(library, "");
    }
    arguments.insert(arguments.begin(), {"env", "LD_LIBRARY_PATH=" + folder_.path().string(), CAREEN_BINARY});
    return Process(arguments, folder_.path()).wait();
  }

  const std::vector<std::string> osMesa_ = {"libOSMesa.so.8", "libOSMesa.so"};
  const std::vector<std::string> both_ = {"libOSMesa.so.8", "libOSMesa.so", "libEGL.so.1"};
};

TEST_F(RenderWithout, anyLackTheListSaysSo) {
  const std::vector<std::string> list = {"render", "--rendering-backend", "list"};
  Ended ended = careen(list);
  EXPECT_EQ(ended.exitCode, 0) << ended.err;
  EXPECT_TRUE(ended.out.starts_with(kHasOsMesa ? "auto: osmesa\nosmesa: available, llvmpipe"
                                               : "auto: egl\nosmesa: not available, "))
      << ended.out;
  EXPECT_NE(ended.out.find("\negl: available, "), std::string::npos) << ended.out;
  EXPECT_FALSE(std::filesystem::exists(folder_ / "out"));

  ended = careenWithout(osMesa_, list);
  EXPECT_EQ(ended.exitCode, 0) << ended.err;
  EXPECT_TRUE(ended.out.starts_with("auto: egl\nosmesa: not available, libOSMesa.so cannot be loaded"))
      << ended.out;
  EXPECT_NE(ended.out.find("apt install " + std::string(drawingPackages())), std::string::npos) << ended.out;

  ended = careenWithout(both_, list);
  EXPECT_EQ(ended.exitCode, 0) << ended.err;
  EXPECT_TRUE(ended.out.starts_with("auto: none\n")) << ended.out;
  EXPECT_NE(ended.out.find("\negl: not available, libEGL.so.1 cannot be loaded"), std::string::npos)
      << ended.out;
}

TEST_F(RenderWithout, osMesaTheFilmIsDrawnThroughEgl) {
  const Ended ended = careenWithout(osMesa_, {"render", "scene.json", "--out", "film"});
  ASSERT_EQ(ended.exitCode, 0) << ended.err;
  const nlohmann::json report = nlohmann::json::parse(textOf(folder_ / "film/report.json"));
  EXPECT_NE(std::string(report["renderer"]).find("libEGL.so"), std::string::npos) << report["renderer"];
  EXPECT_EQ(careenWithout(osMesa_, {"render", "scene.json", "--rendering-backend", "osmesa"}).exitCode, 3);
}

TEST_F(RenderWithout, bothItSaysWhatToInstall) {
  const Ended ended = careenWithout(both_, {"render", "scene.json", "--out", "film"});
  EXPECT_EQ(ended.exitCode, 3) << ended.err;
  EXPECT_NE(ended.err.find("apt install " + std::string(drawingPackages())), std::string::npos) << ended.err;
  EXPECT_NE(ended.err.find("apt install libegl1 libegl-mesa0 libgl1-mesa-dri"), std::string::npos)
      << ended.err;
  EXPECT_FALSE(std::filesystem::exists(folder_ / "film"));
}

TEST_F(Render, placeThatCannotBeWrittenExitsWith3) {
  folder_.write("occupied", "a file, not a folder");
  const Ended ended = careen({"render", "scene.json", "--out", "occupied/film"});
  EXPECT_EQ(ended.exitCode, 3) << ended.err;
  EXPECT_NE(ended.err.find("occupied"), std::string::npos) << ended.err;
}

TEST_F(Render, logsTheSimulationAndEveryFrameDrawnAsLinesOfJson) {
  ASSERT_EQ(careen({"render", "scene.json", "--out", "film", "--frames", "0-1"}).exitCode, 0);
  const Ended ended = careen({"render", "scene.json", "--out", "film", "--resume", "--log", "json"});
  ASSERT_EQ(ended.exitCode, 0) << ended.err;
  EXPECT_NE(ended.err.find("\nframes       10 at 10 per second, 64x48, 2 of them were there already: "),
            std::string::npos)
      << ended.err;
  std::istringstream lines(ended.out);
  std::string line;
  ASSERT_TRUE(std::getline(lines, line));
  const nlohmann::json simulated = nlohmann::json::parse(line);
  EXPECT_EQ(simulated["phase"], "simulate");
  EXPECT_EQ(simulated["simulated"], simulated["duration"]);
  std::vector<int> frames;
  while (std::getline(lines, line)) {
    const nlohmann::json frame = nlohmann::json::parse(line);
    if (frame.contains("phase")) {  // of the error estimate, after the film
      EXPECT_EQ(frame["phase"], "estimate");
      continue;
    }
    frames.push_back(frame["frame"]);
    EXPECT_EQ(frame["time"], frames.back() / 10.0);
    EXPECT_TRUE(std::filesystem::exists(folder_ / std::string(frame["file"]))) << line;
    for (const char* key : {"draw", "read", "encode"}) {
      EXPECT_GT(frame[key], 0) << line;
    }
  }
  std::sort(frames.begin(), frames.end());
  EXPECT_EQ(frames, (std::vector<int>{2, 3, 4, 5, 6, 7, 8, 9}));
}

TEST_F(Render, verifyFindsAMissingAndABrokenFrame) {
  ASSERT_EQ(careen({"render", "scene.json", "--out", "film"}).exitCode, 0);
  EXPECT_EQ(careen({"verify", "film"}).exitCode, 0);
  std::filesystem::remove(folder_ / "film/000003.png");
  std::filesystem::resize_file(folder_ / "film/000007.png", 100);
  const Ended ended = careen({"verify", "film"});
  EXPECT_EQ(ended.exitCode, 1);
  EXPECT_NE(ended.out.find("000003.png: is missing"), std::string::npos) << ended.out;
  EXPECT_NE(ended.out.find("000007.png: is a PNG cut short"), std::string::npos) << ended.out;
  EXPECT_TRUE(ended.out.ends_with("\n--frames 3,7\n")) << ended.out;
  EXPECT_EQ(careen({"verify", "nowhere"}).exitCode, 2);
}

TEST_F(Render, writesAVideoThatPlayersRead) {
  const Ended ended = careen({"render", "scene.json", "--out", "film", "--video", "film.mp4"});
  ASSERT_EQ(ended.exitCode, 0) << ended.err;
  const Ended probe =
      Process({"ffprobe", "-v", "error", "-count_frames", "-select_streams", "v", "-show_entries",
               "stream=codec_name,pix_fmt,r_frame_rate,nb_read_frames", "-of", "csv=p=0", "film.mp4"},
              folder_.path())
          .wait();
  EXPECT_EQ(probe.out, "h264,yuv420p,10/1,10\n") << probe.err;
}

TEST_F(Render, saysThatFfmpegIsMissing) {
  const Ended ended = Process({"env", "PATH=/nowhere", CAREEN_BINARY, "render", "scene.json", "--out", "film",
                               "--video", "film.mp4"},
                              folder_.path())
                          .wait();
  EXPECT_EQ(ended.exitCode, 3) << ended.err;
  EXPECT_NE(ended.err.find("ffmpeg"), std::string::npos) << ended.err;
  EXPECT_FALSE(std::filesystem::exists(folder_ / "film.mp4"));
}

// The scene has colours, a sloping wall, a camera that moves, slow motion, a shutter and overlays.
TEST_F(Render, aRunIsShownAsItsSceneIs) {
  const std::string scene = CAREEN_SOURCE_DIR "/tests/scenes/falling-pair.json";
  ASSERT_EQ(careen({"simulate", scene, "-o", "new.careen"}).exitCode, 0);
  const std::string picture = frameOf({scene}, "scene");
  EXPECT_EQ(frameOf({"new.careen"}, "new"), picture);
  EXPECT_NE(frameOf({"new.careen", "--look", "studio"}, "studio"), picture);
}

}  // namespace
}  // namespace careen
