// Films damaged after they were drawn, and what a comparison of two renderers must catch.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "compare/comparison.h"
#include "image/png.h"
#include "mutation/subject.h"
#include "render/look/lighting.h"
#include "render/stage.h"
#include "support/process.h"

namespace careen {
namespace {

namespace fs = std::filesystem;
constexpr int kFrames = 8;
constexpr int kWidth = 160;
constexpr int kHeight = 90;

fs::path frame(const fs::path& film, int index) { return film / ("00000" + std::to_string(index) + ".png"); }

// The crate in flight, 30 frames per second.
const std::vector<Picture>& film() {
  static const std::vector<Picture> kFilm = [] {
    const Subject crate = thrownCrate();
    const Trajectory run = runOf(crate.scene);
    RenderOptions options;
    options.context.threads = 0;
    Renderer renderer(setupOf(crate.scene, kWidth, kHeight), options);
    std::vector<Picture> pictures;
    pictures.reserve(kFrames);
    for (int i = 0; i < kFrames; ++i) {
      pictures.push_back(renderer.draw(run.poses(i / 30.0)));
    }
    return pictures;
  }();
  return kFilm;
}

void write(const fs::path& folder, const std::vector<Picture>& pictures) {
  fs::create_directories(folder);
  for (std::size_t i = 0; i < pictures.size(); ++i) {
    writePng(frame(folder, static_cast<int>(i)), pictures[i]);
  }
}

/// A fault of the pictures, or of their files.
struct FilmMutation {
  const char* name;
  std::function<void(std::vector<Picture>&)> pictures;
  std::function<void(const fs::path&)> files = {};
};

using Pixel = std::array<std::uint8_t, 3>;
// Frame 4 with every pixel taken from another place, by x and y.
FilmMutation moved(const char* name, const std::function<std::pair<int, int>(int, int)>& from) {
  return {name, [from](std::vector<Picture>& pictures) {
            Picture& picture = pictures.at(4);
            const Picture before = picture;
            for (int y = 0; y < picture.height; ++y) {
              for (int x = 0; x < picture.width; ++x) {
                const auto [fromX, fromY] = from(x, y);
                const std::array<int, 3> color =
                    pixelAt(before, std::clamp(fromX, 0, kWidth - 1), std::clamp(fromY, 0, kHeight - 1));
                for (std::size_t k = 0; k < 3; ++k) {
                  picture.rgb.at(static_cast<std::size_t>(y) * picture.rowBytes() +
                                 3 * static_cast<std::size_t>(x) + k) =
                      static_cast<std::uint8_t>(color.at(k));
                }
              }
            }
          }};
}

// Frame 4 with other colours.
FilmMutation colored(const char* name, const std::function<Pixel(const Pixel&)>& color) {
  return {name, [color](std::vector<Picture>& pictures) {
            std::vector<std::uint8_t>& rgb = pictures.at(4).rgb;
            for (std::size_t i = 0; i + 2 < rgb.size(); i += 3) {
              const Pixel changed = color({rgb[i], rgb[i + 1], rgb[i + 2]});
              std::copy(changed.begin(), changed.end(), rgb.begin() + static_cast<std::ptrdiff_t>(i));
            }
          }};
}

// Frame 4 in another size, by nearest pixels.
FilmMutation sized(const char* name, int width, int height) {
  return {name, [width, height](std::vector<Picture>& pictures) {
            const Picture before = pictures.at(4);
            Picture& picture = pictures.at(4);
            picture = {.width = width, .height = height, .rgb = {}};
            for (int y = 0; y < height; ++y) {
              for (int x = 0; x < width; ++x) {
                for (const int value : pixelAt(before, x * kWidth / width, y * kHeight / height)) {
                  picture.rgb.push_back(static_cast<std::uint8_t>(value));
                }
              }
            }
          }};
}

// The file of frame 4 with other bytes.
FilmMutation damaged(const char* name, const std::function<void(std::string&)>& damage) {
  return {name, [](std::vector<Picture>&) {},
          [damage](const fs::path& folder) {
            std::string bytes = textOf(frame(folder, 4));
            damage(bytes);
            std::ofstream(frame(folder, 4), std::ios::binary) << bytes;
          }};
}

FilmMutation onDisk(const char* name, const std::function<void(const fs::path&)>& files) {
  return {name, [](std::vector<Picture>&) {}, files};
}

std::uint8_t curved(std::uint8_t value, double power) {
  return static_cast<std::uint8_t>(std::lround(255 * std::pow(value / 255.0, power)));
}

std::uint8_t more(std::uint8_t value, int by) { return static_cast<std::uint8_t>(std::min(value + by, 255)); }

std::vector<FilmMutation> orders() {
  using Pictures = std::vector<Picture>;
  return {{"the first is dropped", [](Pictures& it) { it.erase(it.begin()); }},
          {"one is dropped", [](Pictures& it) { it.erase(it.begin() + 4); }},
          {"the last is dropped", [](Pictures& it) { it.pop_back(); }},
          {"one is doubled", [](Pictures& it) { it.insert(it.begin() + 4, it[4]); }},
          {"one is doubled, the last lost",
           [](Pictures& it) {
             it.insert(it.begin() + 4, it[4]);
             it.pop_back();
           }},
          {"the last is doubled", [](Pictures& it) { it.push_back(it.back()); }},
          {"one stands in its neighbour's place", [](Pictures& it) { it[4] = it[5]; }},
          {"two neighbours are swapped", [](Pictures& it) { std::swap(it[3], it[4]); }},
          {"first and last are swapped", [](Pictures& it) { std::swap(it.front(), it.back()); }},
          {"backwards", [](Pictures& it) { std::reverse(it.begin(), it.end()); }},
          {"all one later", [](Pictures& it) { std::rotate(it.begin(), it.begin() + 1, it.end()); }},
          onDisk("a file is missing", [](const fs::path& film) { fs::remove(frame(film, 4)); }),
          onDisk("a file has another name",
                 [](const fs::path& film) { fs::rename(frame(film, 4), frame(film, 9)); })};
}

std::vector<FilmMutation> pictures() {
  return {moved("upside down", [](int x, int y) { return std::pair(x, kHeight - 1 - y); }),
          moved("left and right exchanged", [](int x, int y) { return std::pair(kWidth - 1 - x, y); }),
          moved("turned by half", [](int x, int y) { return std::pair(kWidth - 1 - x, kHeight - 1 - y); }),
          moved("a pixel to the right", [](int x, int y) { return std::pair(x - 1, y); }),
          moved("a pixel down", [](int x, int y) { return std::pair(x, y - 1); }),
          moved("a row lost", [](int x, int y) { return std::pair(x, y < 45 ? y : y + 1); }),
          moved("every other row lost", [](int x, int y) { return std::pair(x, y / 2 * 2); }),
          moved("a corner of another place",
                [](int x, int y) { return x < 8 && y < 8 ? std::pair(x + 80, y + 45) : std::pair(x, y); }),
          colored("red and blue exchanged",
                  [](const Pixel& it) {
                    return Pixel{it[2], it[1], it[0]};
                  }),
          colored("red and green exchanged",
                  [](const Pixel& it) {
                    return Pixel{it[1], it[0], it[2]};
                  }),
          colored("green and blue exchanged",
                  [](const Pixel& it) {
                    return Pixel{it[0], it[2], it[1]};
                  }),
          colored("grey",
                  [](const Pixel& it) {
                    return Pixel{it[1], it[1], it[1]};
                  }),
          colored("black", [](const Pixel&) { return Pixel{}; }),
          colored("red alone 3/255 off",
                  [](const Pixel& it) {
                    return Pixel{more(it[0], 3), it[1], it[2]};
                  }),
          colored("2/255 brighter",
                  [](const Pixel& it) {
                    return Pixel{more(it[0], 2), more(it[1], 2), more(it[2], 2)};
                  }),
          colored("gamma twice",
                  [](const Pixel& it) {
                    return Pixel{curved(it[0], 1 / 2.2), curved(it[1], 1 / 2.2), curved(it[2], 1 / 2.2)};
                  }),
          colored("gamma 2 % off",
                  [](const Pixel& it) {
                    return Pixel{curved(it[0], 1.02), curved(it[1], 1.02), curved(it[2], 1.02)};
                  }),
          sized("a column narrower", kWidth - 1, kHeight),
          sized("a row higher", kWidth, kHeight + 1),
          sized("twice as large", 2 * kWidth, 2 * kHeight)};
}

std::vector<FilmMutation> files() {
  return {damaged("cut to half", [](std::string& it) { it.resize(it.size() / 2); }),
          damaged("the last byte is gone", [](std::string& it) { it.pop_back(); }),
          damaged("without its end", [](std::string& it) { it.resize(it.size() - 12); }),
          damaged("empty", [](std::string& it) { it.clear(); }),
          damaged("a bit of the pixels", [](std::string& it) { it[it.size() / 2] ^= 4; }),
          damaged("a bit of a checksum", [](std::string& it) { it[it.size() - 14] ^= 1; }),
          damaged("a bit of the signature", [](std::string& it) { it[1] ^= 1; }),
          damaged("the width", [](std::string& it) { it[19] ^= 1; }),
          damaged("no picture", [](std::string& it) { it = "a text\n"; })};
}

std::vector<FilmMutation> filmMutations() {
  std::vector<FilmMutation> all;
  for (std::vector<FilmMutation> (*const part)() : {orders, pictures, files}) {
    const std::vector<FilmMutation> list = part();
    all.insert(all.end(), list.begin(), list.end());
  }
  return all;
}

Comparison compared(const FilmMutation& mutation, const fs::path& expected, const std::string& tolerance) {
  const TemporaryFolder folder;
  std::vector<Picture> pictures = film();
  mutation.pictures(pictures);
  write(folder / "film", pictures);
  if (mutation.files) {
    mutation.files(folder / "film");
  }
  ComparisonSettings settings;
  settings.toleranceName = tolerance;
  settings.tolerance = toleranceOf(tolerance);
  return compareFolders(expected, folder / "film", settings, std::nullopt);
}

TEST(FilmMutations, areAnotherFilm) {
  const TemporaryFolder folder;
  write(folder / "film", film());
  ASSERT_EQ(compared({"nothing", [](std::vector<Picture>&) {}}, folder / "film", "exact").verdict,
            Verdict::kSame);
  std::size_t caught = 0;
  const std::vector<FilmMutation> mutations = filmMutations();
  for (const FilmMutation& mutation : mutations) {
    const Comparison comparison = compared(mutation, folder / "film", "same-picture");
    EXPECT_EQ(comparison.verdict, Verdict::kDifferent) << mutation.name;
    const FrameComparison* const first = comparison.firstDifferent();
    std::printf("%-40s %s\n", mutation.name,
                first == nullptr ? "" : (first->name + ": " + first->reasons.at(0)).c_str());
    caught += comparison.verdict == Verdict::kDifferent ? 1 : 0;
  }
  EXPECT_GE(mutations.size(), 40U);
  std::printf("caught %zu of %zu\n", caught, mutations.size());
}

// Faults that must not pass even between two renderers.
TEST(OtherRenderer, catchesLostFrames) {
  const TemporaryFolder folder;
  write(folder / "film", film());
  for (const FilmMutation& mutation : orders()) {
    EXPECT_EQ(compared(mutation, folder / "film", "other-renderer").verdict, Verdict::kDifferent)
        << mutation.name;
  }
}

void expectOtherRendererCatches(const Subject& changed, const Subject& unchanged, const std::string& name) {
  const PictureDifference difference = differenceOf(unchangedPicture(unchanged), pictureOf(changed));
  const Margin margin = marginOf(difference, toleranceOf("other-renderer"));
  EXPECT_EQ(judge(difference, toleranceOf("other-renderer")).verdict, Verdict::kDifferent) << name;
  std::printf("%-40s %-16s %.3g\n", name.c_str(), margin.criterion.c_str(), margin.ratio);
}

TEST(OtherRenderer, catchesMissingShadows) {
  for (Subject (*const of)() : {thrownCrate, stillLife, row}) {
    Subject subject = of();
    subject.look.lighting = lightingOf(Look::kStudio, *subject.scene.camera);
    subject.look.lighting->light->castsShadow = false;
    expectOtherRendererCatches(subject, of(), subject.name + " without shadows");
  }
}

TEST(OtherRenderer, catchesABoxTwoPixelsOff) {
  for (std::size_t i = 0; i < stillLife().scene.boxes.size(); ++i) {
    for (const Vec3& direction : {Vec3(1, 0, 0), Vec3(0, 0, 1)}) {
      Subject subject = stillLife();
      SceneBox& box = subject.scene.boxes.at(i);
      box.pose.position += 2 * pixelAt(subject, box.pose.position) * direction;
      expectOtherRendererCatches(subject, stillLife(),
                                 box.name + (direction.x() > 0 ? " two pixels aside" : " two pixels up"));
    }
  }
}

}  // namespace
}  // namespace careen
