// Films of the library beside the program's: the same bytes. In a process of their own, for after a picture
// was drawn none can be made.
#include <gtest/gtest.h>

#include <filesystem>
#include <string>
#include <thread>
#include <vector>

#include "image/png.h"
#include "library/careen.h"
#include "support/process.h"

#ifdef CAREEN_RENDER
namespace careen::v1 {
namespace {

const std::filesystem::path kFilmed = std::filesystem::path(CAREEN_SOURCE_DIR) / "assets/scenes/careen.json";

TEST(LibraryFilm, isThatOfTheProgram) {
  const TemporaryFolder folder;
  const v1::Run run = simulate(Scene::read(kFilmed));
  for (const bool alpha : {false, true}) {
    const std::string name = alpha ? "alpha" : "usual";
    const std::filesystem::path own = folder / ("own-" + name);
    run.film({.folder = own,
              .video = folder / ("own-" + name + ".webm"),
              .frames = "0-4:2",
              .size = std::array{64, 36},
              .alpha = alpha});
    std::vector<std::string> arguments = {CAREEN_BINARY, "render",   kFilmed,       "--out",
                                          name,          "--frames", "0-4:2",       "--size",
                                          "64x36",       "--video",  name + ".webm"};
    if (alpha) {
      arguments.emplace_back("--alpha");
    }
    ASSERT_EQ(Process(arguments, folder.path()).wait().exitCode, 0);
    for (const char* const frame : {"000000.png", "000002.png", "000004.png"}) {
      EXPECT_TRUE(textOf(own / frame) == textOf(folder / (name + "/" + frame))) << name << ' ' << frame;
    }
    EXPECT_TRUE(textOf(folder / ("own-" + name + ".webm")) == textOf(folder / (name + ".webm"))) << name;
  }
  EXPECT_THROW(run.film({.folder = folder / "own-usual", .alpha = true}), Error) << "another film is there";
  EXPECT_THROW(run.film({.folder = folder / "x", .video = "film.avi"}), Error);
  EXPECT_THROW(run.film({.folder = folder / "x", .video = "film.mp4", .quality = "ultra"}), Error);
  EXPECT_THROW(run.film({.folder = folder / "x", .frames = "a-b"}), Error);
}

TEST(LibraryFilm, pagesAndLabelsAreThoseOfTheProgram) {
  const TemporaryFolder folder;
  const std::filesystem::path scene = std::filesystem::path(CAREEN_SOURCE_DIR) / "assets/scenes/zeno.json";
  const v1::Run run = simulate(Scene::read(scene));
  run.page({.path = folder / "own.html", .quality = "draft", .size = {64, 36}, .sound = true});
  run.labels({.folder = folder / "own",
              .channels = "depth,instance",
              .frames = "0-2:2",
              .size = std::array{64, 36}});
  for (const std::vector<std::string>& arguments :
       {std::vector<std::string>{"page", scene, "-o", "theirs.html", "--quality", "draft", "--size", "64x36",
                                 "--sound"},
        {"truth", scene, "-o", "theirs", "--channels", "depth,instance", "--frames", "0-2:2", "--size",
         "64x36"}}) {
    std::vector<std::string> command = arguments;
    command.insert(command.begin(), CAREEN_BINARY);
    const Ended ended = Process(command, folder.path()).wait();
    ASSERT_EQ(ended.exitCode, 0) << ended.err;
  }
  EXPECT_TRUE(textOf(folder / "own.html") == textOf(folder / "theirs.html"));
  for (const char* const file : {"000000.npz", "000002.npz", "truth.json"}) {
    EXPECT_TRUE(textOf(folder / "own" / file) == textOf(folder / "theirs" / file)) << file;
  }
  EXPECT_THROW(run.page({.path = folder / "none/page.html", .size = {64, 36}}), Error);
  EXPECT_THROW(run.page({.path = folder / "x.html", .quality = "ultra"}), Error);
  EXPECT_THROW(run.labels({.folder = folder / "x", .channels = "smell"}), Error);
  EXPECT_THROW(run.labels({.folder = folder / "x", .frames = "9999"}), Error);
  run.film(
      {.folder = folder / "heard", .video = folder / "heard.mp4", .size = std::array{64, 36}, .sound = true});
  const Ended heard = Process({CAREEN_BINARY, "render", scene, "-o", "film", "--video", "film.mp4", "--size",
                               "64x36", "--sound"},
                              folder.path())
                          .wait();
  ASSERT_EQ(heard.exitCode, 0) << heard.err;
  EXPECT_TRUE(textOf(folder / "heard/sound.wav") == textOf(folder / "film/sound.wav"));
  EXPECT_TRUE(textOf(folder / "heard.mp4") == textOf(folder / "film.mp4"));
}

TEST(LibraryPictures, drawsTheBytesOfTheProgram) {
  const TemporaryFolder folder;
  const v1::Run run = simulate(Scene::read(kFilmed));
  const std::vector<Image> images = run.frames({0.3, 2.5}, std::array{160, 90});
  for (const auto& [time, image] : {std::pair{"0.3", images.at(0)}, std::pair{"2.5", images.at(1)}}) {
    ASSERT_EQ(
        Process({CAREEN_BINARY, "render", kFilmed, "--still", time, "--size", "160x90", "--out", "still.png"},
                folder.path())
            .wait()
            .exitCode,
        0);
    const Picture still = readPng(folder / "still.png");
    EXPECT_EQ(image.width, 160);
    EXPECT_EQ(image.height, 90);
    EXPECT_TRUE(image.rgb == still.rgb) << time;
  }
  EXPECT_EQ(run.frame(0).width, 1280);  // the scene's own size, again
  EXPECT_THROW(static_cast<void>(run.frame(99)), Error);
  EXPECT_THROW(static_cast<void>(run.frame(0, std::array{0, 90})), Error);
}

TEST(LibraryPictures, drawsFromSeveralThreads) {
  const v1::Run run = simulate(Scene::read(kFilmed));
  const Image expected = run.frame(1, std::array{64, 36});
  std::vector<Image> images(4);
  std::vector<std::thread> threads;
  for (Image& image : images) {
    threads.emplace_back([&] { image = run.frame(1, std::array{64, 36}); });
  }
  for (std::thread& thread : threads) {
    thread.join();
  }
  for (const Image& image : images) {
    EXPECT_TRUE(image.rgb == expected.rgb);
  }
}

}  // namespace
}  // namespace careen::v1
#endif
