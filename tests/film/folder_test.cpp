#include "film/folder.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "core/error.h"
#include "image/png.h"
#include "support/process.h"

namespace careen {
namespace {

using Frames = std::vector<std::int64_t>;
using Names = std::vector<std::string>;

Picture black(int width, int height) {
  return {.width = width,
          .height = height,
          .rgb = std::vector<std::uint8_t>(static_cast<std::size_t>(3 * width * height))};
}

FilmManifest filmOf(const Frames& frames) {
  FilmManifest manifest;
  manifest.program = "careen 1.2.3";
  manifest.sceneHash = "0123";
  manifest.stateHash = "4567";
  manifest.picture.width = 4;
  manifest.picture.height = 2;
  manifest.frameCount = 100;
  manifest.frames = frames;
  return manifest;
}

TEST(FilmFolder, namesFramesWithSixDigitsOrMore) {
  EXPECT_EQ(frameFileName(0), "000000.png");
  EXPECT_EQ(frameFileName(1234), "001234.png");
  EXPECT_EQ(frameFileName(999999), "999999.png");
  EXPECT_EQ(frameFileName(1000000), "1000000.png");
}

TEST(FilmFolder, isGoneAgainIfItWasMadeAndNothingWasWritten) {
  const TemporaryFolder folder;
  {
    const FilmFolder film(folder / "new/film");
    EXPECT_TRUE(std::filesystem::is_directory(folder / "new/film"));
    EXPECT_FALSE(film.manifest().has_value());
  }
  EXPECT_FALSE(std::filesystem::exists(folder / "new/film"));
}

TEST(FilmFolder, thatWasThereStays) {
  const TemporaryFolder folder;
  { const FilmFolder film(folder.path()); }
  EXPECT_TRUE(std::filesystem::exists(folder.path()));
}

TEST(FilmFolder, isOneProcessesAtATime) {
  const TemporaryFolder folder;
  const FilmFolder film(folder.path());
  EXPECT_THROW(FilmFolder second(folder.path()), InputError);
}

TEST(FilmFolder, refusesPicturesThatNoManifestTellsOf) {
  const TemporaryFolder folder;
  writePng(folder / "holiday.png", black(1, 1));
  EXPECT_THROW(FilmFolder film(folder.path()), InputError);
  EXPECT_EQ(folder.files(), (Names{"holiday.png"}));
}

TEST(FilmFolder, thatCannotBeMadeIsTheMachinesFault) {
  const TemporaryFolder folder;
  folder.write("file", "");
  EXPECT_THROW(FilmFolder film(folder / "file/film"), MachineError);
}

TEST(FilmFolder, missesFramesThatAreNotThereNotWholeOrOfAnotherSize) {
  const TemporaryFolder folder;
  FilmFolder film(folder.path());
  const FilmManifest asked = filmOf({0, 1, 2, 3});
  film.begin(asked, false);
  EXPECT_EQ(film.missing(asked), (Frames{0, 1, 2, 3}));
  writePng(folder / frameFileName(0), black(4, 2));
  writePng(folder / frameFileName(1), black(2, 4));
  writePng(folder / frameFileName(2), black(4, 2));
  const std::string whole = textOf(folder / frameFileName(2));
  folder.write(frameFileName(2), whole.substr(0, whole.size() - 1));
  EXPECT_EQ(film.missing(asked), (Frames{1, 2, 3}));
}

TEST(FilmFolder, ofTheSameFilmKeepsItsFramesAndKnowsThoseOfBefore) {
  const TemporaryFolder folder;
  {
    FilmFolder film(folder.path());
    FilmManifest first = filmOf({0, 1, 2});
    first.renderer = "a renderer";
    film.begin(first, false);
    writePng(folder / frameFileName(1), black(4, 2));
  }
  FilmFolder film(folder.path());
  ASSERT_TRUE(film.manifest().has_value());
  film.begin(filmOf({2, 7}), true);
  EXPECT_EQ(film.manifest()->frames, (Frames{0, 1, 2, 7}));
  EXPECT_EQ(film.manifest()->renderer, "a renderer");
  EXPECT_EQ(readManifest(folder.path())->frames, (Frames{0, 1, 2, 7}));
  EXPECT_TRUE(std::filesystem::exists(folder / frameFileName(1)));
}

TEST(FilmFolder, ofAnotherFilmLosesItsFramesAndNothingElse) {
  const TemporaryFolder folder;
  {
    FilmFolder film(folder.path());
    film.begin(filmOf({0, 1}), false);
  }
  for (const char* name : {"000000.png", "1234567.png", "00001.png", "frame-000000.png", "notes.txt"}) {
    folder.write(name, "");
  }
  {
    FilmFolder film(folder.path());
    film.begin(filmOf({5}), false);
  }
  EXPECT_EQ(folder.files(),
            (Names{"00001.png", "1234567.png", "film.json", "frame-000000.png", "notes.txt"}));
  EXPECT_EQ(readManifest(folder.path())->frames, (Frames{5}));
}

TEST(FilmFolder, missesFramesThatShowAnotherPicture) {
  const TemporaryFolder folder;
  const FilmManifest asked = filmOf({0, 1});
  {
    FilmFolder film(folder.path());
    film.begin(asked, false);
    writePng(folder / frameFileName(0), black(4, 2));
    writePng(folder / frameFileName(1), black(4, 2));
    film.keep({{0, frameHash(textOf(folder / frameFileName(0)))}, {1, frameHash("another")}});
  }
  FilmFolder film(folder.path());
  EXPECT_EQ(film.missing(asked), (Frames{1}));
  film.begin(asked, true);
  EXPECT_EQ(readManifest(folder.path())->hashes.size(), 2U);
}

TEST(FilmFolder, takesWhatAKilledRunLeftUnfinishedWithItself) {
  const TemporaryFolder folder;
  const Names ours = {".000012.png.4711.partial", ".film.json.1.partial"};
  const Names others = {".000012.png.x.partial", ".notes.txt.4711.partial", "000012.png.4711.partial"};
  for (const Names& names : {ours, others}) {
    for (const std::string& name : names) {
      folder.write(name, "");
    }
  }
  { const FilmFolder film(folder.path()); }
  EXPECT_EQ(folder.files(), others);
}

TEST(FilmFolder, reportsOfAnEarlierComparisonGiveWayAndNoOtherFiles) {
  const TemporaryFolder folder;
  const auto write = [&folder](const std::string& junit) {
    folder.write("junit.xml", junit);
    folder.write("index.html", "page");
  };
  const std::string xml = "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n";
  EXPECT_FALSE(holdsComparison(folder.path()));
  write(xml + "<testsuites name=\"careen compare\" tests=\"0\"></testsuites>");
  EXPECT_TRUE(holdsComparison(folder.path()));
  FilmFolder(folder.path()).begin(filmOf({1}), false);
  EXPECT_EQ(folder.files(), Names{"film.json"});
  write(xml + "<testsuites name=\"mine\"></testsuites>");
  EXPECT_FALSE(holdsComparison(folder.path()));
  FilmFolder(folder.path()).begin(filmOf({1}), false);
  EXPECT_EQ(folder.files(), (Names{"film.json", "index.html", "junit.xml"}));
}

}  // namespace
}  // namespace careen
