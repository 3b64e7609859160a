#include "film/manifest.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "support/input_error.h"
#include "support/process.h"

namespace careen {
namespace {

FilmManifest everyField() {
  FilmManifest manifest;
  manifest.program = "careen 1.2.3";
  manifest.renderer = "llvmpipe";
  manifest.libraries = "glibc 2.36";
  manifest.sceneHash = "0123";
  manifest.stateHash = "4567";
  manifest.picture.width = 640;
  manifest.picture.height = 360;
  manifest.picture.rate = {.numerator = 24000, .denominator = 1001};
  manifest.picture.look = Look::kClay;
  manifest.picture.antialiasing = Antialiasing::kMultisampled;
  manifest.picture.shutter = parseShutter("180");
  manifest.picture.overlays = OverlaySet::named("time,energy");
  manifest.frameCount = 240;
  manifest.frames = {0, 1, 2, 10, 12};
  manifest.hashes = {{1, frameHash("one")}, {12, frameHash("twelve")}};
  return manifest;
}

TEST(Manifest, comesBackFromItsFile) {
  const TemporaryFolder folder;
  const FilmManifest manifest = everyField();
  writeManifest(folder.path(), manifest);
  EXPECT_EQ(folder.files(), (std::vector<std::string>{"film.json"}));
  const std::optional<FilmManifest> back = readManifest(folder.path());
  ASSERT_TRUE(back.has_value());
  EXPECT_EQ(differenceOf(*back, manifest), "");
  EXPECT_EQ(back->libraries, manifest.libraries);
  EXPECT_EQ(back->renderer, manifest.renderer);
  EXPECT_EQ(back->frames, manifest.frames);
  EXPECT_EQ(back->hashes, manifest.hashes);
  EXPECT_EQ(back->picture.rate, manifest.picture.rate);
}

TEST(Manifest, isNoneWhereThereIsNoFile) {
  const TemporaryFolder folder;
  EXPECT_FALSE(readManifest(folder.path()).has_value());
}

TEST(Manifest, withoutFramesIsOneToo) {
  const TemporaryFolder folder;
  FilmManifest manifest = everyField();
  manifest.frames.clear();
  writeManifest(folder.path(), manifest);
  EXPECT_TRUE(readManifest(folder.path())->frames.empty());
}

TEST(Manifest, thatCannotBeUnderstoodIsNamed) {
  const TemporaryFolder folder;
  writeManifest(folder.path(), everyField());
  const std::string text = textOf(folder / kManifestName);
  const auto saysOf = [&](const std::string& bytes) {
    folder.write(kManifestName, bytes);
    return inputErrorOf([&] { readManifest(folder.path()); });
  };
  const std::string start = (folder / kManifestName).string() + ": is not a film manifest: ";
  EXPECT_TRUE(saysOf("").starts_with(start));
  EXPECT_TRUE(saysOf("[]").starts_with(start));
  EXPECT_TRUE(saysOf(text.substr(0, text.size() / 2)).starts_with(start));
  const auto with = [&text](const std::string& piece, const std::string& instead) {
    return std::string(text).replace(text.find(piece), piece.size(), instead);
  };
  EXPECT_EQ(saysOf(with("\"careen_film\": 1", "\"careen_film\": 2")), start + "another version");
  EXPECT_TRUE(saysOf(with("\"frame_count\": 240", "\"frame_count\": 11")).starts_with(start))
      << "frame 12 of 11";
  EXPECT_TRUE(saysOf(with("24000/1001", "fast")).starts_with(start));
  EXPECT_EQ(saysOf(with("\"frame_count\": 240", "\"frame_count\": 1e60")),
            start + "found 1e+60 for frame_count, expected a whole number from 0 to 1000000000");
  EXPECT_EQ(saysOf(with("\"frame_count\": 240", "\"frame_count\": [240]")),
            start + "found [240] for frame_count, expected a whole number from 0 to 1000000000");
  EXPECT_TRUE(saysOf(with("640", "1e60")).starts_with(start + "found 1e+60 for size"));
  EXPECT_TRUE(saysOf(with("640", "18446744073709551615")).starts_with(start + "found 18446744073709551615"));
  EXPECT_TRUE(saysOf(with("\"careen_film\": 1", "\"careen_film\": 1e60")).starts_with(start));
  EXPECT_TRUE(saysOf(with("\"12\": ", "\"0-12\": ")).starts_with(start + "found a hash of 0-12"));
  EXPECT_TRUE(saysOf(with("\"12\": ", "\"240\": ")).starts_with(start)) << "frame 240 of 240";
  EXPECT_EQ(saysOf(text), "no error");
}

// 140 bytes that list 1e11 frames.
TEST(Manifest, ofMoreFramesThanCanBeListedIsRefused) {
  const TemporaryFolder folder;
  FilmManifest manifest = everyField();
  manifest.frameCount = kMostFrames;
  writeManifest(folder.path(), manifest);
  std::string text = textOf(folder / kManifestName);
  text.replace(text.find("0-2,10,12"), 9, "0-999999999");
  folder.write(kManifestName, text);
  EXPECT_NE(inputErrorOf([&] { readManifest(folder.path()); }).find("expected at most 10000000 at once"),
            std::string::npos);
}

TEST(Manifest, ofAnotherFilmDiffersInWhatItSays) {
  const FilmManifest there = everyField();
  const std::vector<std::pair<std::string, std::function<void(FilmManifest&)>>> changes = {
      {"scene 0123 there, x now", [](FilmManifest& film) { film.sceneHash = "x"; }},
      {"run 4567 there, x now", [](FilmManifest& film) { film.stateHash = "x"; }},
      {"size 640x360 there, 640x361 now", [](FilmManifest& film) { film.picture.height = 361; }},
      {"fps 24000/1001 there, 24 now",
       [](FilmManifest& film) {
         film.picture.rate = {24, 1};
       }},
      {"look clay there, studio now", [](FilmManifest& film) { film.picture.look = Look::kStudio; }},
      {"antialiasing 4x there, edges now",
       [](FilmManifest& film) { film.picture.antialiasing = Antialiasing::kEdges; }},
      {"shutter 180:8 there, none now", [](FilmManifest& film) { film.picture.shutter = {}; }},
      {"overlays time,energy there, time now",
       [](FilmManifest& film) { film.picture.overlays = OverlaySet::named("time"); }},
      {"shown as its scene there, 89ab now", [](FilmManifest& film) { film.shownAs = "89ab"; }},
      {"frames in all 240 there, 241 now", [](FilmManifest& film) { film.frameCount = 241; }},
      {"program careen 1.2.3 there, careen 2 now", [](FilmManifest& film) { film.program = "careen 2"; }},
      {"renderer llvmpipe there, other now", [](FilmManifest& film) { film.renderer = "other"; }},
  };
  for (const auto& [said, change] : changes) {
    FilmManifest asked = there;
    change(asked);
    EXPECT_EQ(differenceOf(there, asked), said);
  }
  FilmManifest asked = there;
  asked.picture.look = Look::kStudio;
  asked.picture.shutter = {};
  EXPECT_EQ(differenceOf(there, asked), "look clay there, studio now; shutter 180:8 there, none now");
}

TEST(Manifest, ofTheSameFilmMayHaveOtherFramesLibrariesAndNoRendererYet) {
  const FilmManifest there = everyField();
  FilmManifest asked = there;
  asked.frames = {7};
  asked.libraries = "others";
  asked.renderer.clear();
  EXPECT_EQ(differenceOf(there, asked), "");
}

TEST(Manifest, namesTheLibrariesOfThisMachine) {
  const std::string libraries = librariesHere();
  for (const char* name : {"Eigen 3.", "nlohmann-json 3.", "glibc 2."}) {
    EXPECT_NE(libraries.find(name), std::string::npos) << libraries;
  }
}

}  // namespace
}  // namespace careen
