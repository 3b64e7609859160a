#include "render/draw/renderer.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <filesystem>
#include <functional>
#include <iostream>
#include <set>
#include <string>
#include <vector>

#include "core/error.h"
#include "image/png.h"
#include "image/srgb.h"
#include "render/outline.h"
#include "render/stage.h"
#include "support/article_equations.h"
#include "support/process.h"
#include "view/materials.h"

namespace careen {
namespace {

constexpr int kFrameWidth = 320;
constexpr int kFrameHeight = 180;

Picture drawn(const Scene& scene, const RenderOptions& options = {}, int width = kFrameWidth,
              int height = kFrameHeight) {
  return Renderer(setupOf(scene, width, height), options).draw(posesOf(scene));
}

void expectColor(const std::array<int, 3>& found, const Vec3& linear, int tolerance) {
  for (int channel = 0; channel < 3; ++channel) {
    EXPECT_NEAR(found[static_cast<std::size_t>(channel)], srgbFromLinear(linear[channel]), tolerance)
        << channel;
  }
}

// A cube of side 2 m about the origin, seen straight on from 10 m in front of its −y face, 90° across: at the
// face, 9 m away, a picture of 180 rows has 10 pixels to the metre.
Scene cubeStraightOn() {
  Scene scene;
  scene.boxes.push_back(boxAt(Vec3::Zero(), Vec3(1, 1, 1), Color{180, 90, 60}));
  scene.camera = cameraAt(Vec3(0, -10, 0), Vec3::Zero(), 90);
  return scene;
}

// The term for gloss as the literature writes it: D of GGX, G in Karis's form of Smith's, F by Schlick, each
// over 4 (n·l)(n·v), for light that a white matte face would send back as 1.
double gloss(const Vec3& n, const Vec3& toEye, const Vec3& toLight) {
  constexpr double kRoughness = 0.42;  // of boxes
  const double alpha = kRoughness * kRoughness;
  const Vec3 h = (toEye + toLight).normalized();
  const double d =
      alpha * alpha / (std::numbers::pi * std::pow(n.dot(h) * n.dot(h) * (alpha * alpha - 1) + 1, 2));
  const double k = alpha / 2;
  const auto g1 = [&](const Vec3& v) { return n.dot(v) / (n.dot(v) * (1 - k) + k); };
  const double f = 0.04 + 0.96 * std::pow(1 - toEye.dot(h), 5);
  return std::numbers::pi * d * g1(toEye) * g1(toLight) * f / (4 * n.dot(toEye) * n.dot(toLight));
}

TEST(Renderer, faceSeenStraightOnHasTheColourOfItsLight) {
  const Scene scene = cubeStraightOn();
  // The −y face has five pips; beside the middle one, 0.44 m to the right, is plain paint.
  const Vec3 point(0.45, -1, 0.05);
  const Vec3 n(0, -1, 0);
  const Vec3 paint = linearFromSrgb(scene.boxes[0].color);
  for (const Vec3& towards : {Vec3(0, -1, 0), Vec3(-1, -1, 1), Vec3(2, -1, 0.5), Vec3(0, 1, 0)}) {
    Lighting lighting = evenLighting(Vec3::Constant(0.1));
    lighting.sky = Vec3(0.3, 0.4, 0.5);
    lighting.ground = Vec3(0.1, 0.2, 0.1);
    lighting.light = Light{.towards = towards, .color = Vec3(0.8, 0.6, 0.4), .castsShadow = false};
    const Vec3 toLight = towards.normalized();
    const double facing = std::max(0.0, n.dot(toLight));
    const Vec3 toEye = (Vec3(0, -10, 0) - point).normalized();
    Vec3 expected = paint.cwiseProduct(Vec3(0.2, 0.3, 0.3));  // level: half of sky, half of ground
    if (facing > 0) {
      const Vec3 sentBack = paint + Vec3::Constant(gloss(n, toEye, toLight));
      expected += facing * sentBack.cwiseProduct(lighting.light->color);
    }
    // Pixel (164, 89) has its middle 0.45 m right of the picture's middle and 0.05 m above.
    expectColor(pixelAt(drawn(scene, lit(lighting)), 164, 89), expected, 1);
  }
}

TEST(Renderer, pipsTellTheFacesApart) {
  // Which faces of the cube are at front when it is turned so, and how many pips a die has there.
  const std::vector<std::pair<Mat3, int>> turns = {
      {Mat3::Identity(), 5},
      {axisAngle(Vec3::UnitZ(), std::numbers::pi), 2},
      {axisAngle(Vec3::UnitZ(), std::numbers::pi / 2), 6},
      {axisAngle(Vec3::UnitZ(), -std::numbers::pi / 2), 1},
      {axisAngle(Vec3::UnitX(), std::numbers::pi / 2), 3},
      {axisAngle(Vec3::UnitX(), -std::numbers::pi / 2), 4},
  };
  for (const auto& [turn, pips] : turns) {
    Scene scene = cubeStraightOn();
    scene.boxes[0].pose.worldFromBody = turn;
    const Picture picture = drawn(scene, lit(evenLighting(Vec3::Constant(0.1))));
    int found = 0;
    for (const int row : {-1, 0, 1}) {  // 0.44 m from one another are 4.4 px
      for (const int column : {-1, 0, 1}) {
        const std::array<int, 3> pixel =
            pixelAt(picture, 160 + 5 * column - (column > 0 ? 1 : 0), 90 + 5 * row - (row > 0 ? 1 : 0));
        found += pixel[2] > 150 ? 1 : 0;  // ivory is bright in blue, the paint is not
      }
    }
    EXPECT_EQ(found, pips);
  }
}

// Corners by similar triangles, beside the engine's matrices: a pixel whose middle is half a pixel outside
// the corners' hull must be background, one that is half a pixel inside must be box.
TEST(Renderer, projectedCornersLieWithinHalfAPixel) {
  Scene scene;
  scene.boxes.push_back(boxAt(Vec3(0.3, 0.2, 0.4), Vec3(0.9, 0.5, 0.3), Color{255, 255, 255}));
  scene.boxes[0].pose.worldFromBody = Quat(0.5, -0.7, 0.3, 0.4).normalized().toRotationMatrix();
  const Vec3 eye(2, -4, 1.5);
  const Vec3 target(0.1, 0, 0.5);
  scene.camera = cameraAt(eye, target, 35);
  const RenderOptions options = lit(evenLighting(Vec3(1, 0, 0)));
  scene.picture.antialiasing = Antialiasing::kMultisampled;
  const Picture picture = drawn(scene, options);

  const Vec3 ahead = (target - eye).normalized();
  const Vec3 right = ahead.cross(Vec3::UnitZ()).normalized();
  const Vec3 above = right.cross(ahead);
  const double pixels = 0.5 * kFrameHeight / std::tan(0.5 * 35 * std::numbers::pi / 180);
  std::vector<Vec3> corners;
  for (int index = 0; index < kCorners; ++index) {
    const Vec3 to = scene.boxes[0].pose.worldPoint(corner(scene.boxes[0].halfExtents, index)) - eye;
    corners.emplace_back(0.5 * kFrameWidth + pixels * to.dot(right) / to.dot(ahead),
                         0.5 * kFrameHeight - pixels * to.dot(above) / to.dot(ahead), 0);
  }
  const std::vector<Vec3> outline = hull(corners);
  int inside = 0;
  for (int y = 0; y < kFrameHeight; ++y) {
    for (int x = 0; x < kFrameWidth; ++x) {
      const std::array<int, 3> pixel = pixelAt(picture, x, y);
      const bool isBackground = pixel == std::array<int, 3>{255, 0, 0};
      const double depth = depthInside(outline, Vec3(x + 0.5, y + 0.5, 0));
      if (depth < -0.5) {
        EXPECT_TRUE(isBackground) << x << ' ' << y << ' ' << depth;
      } else if (depth > 0.5) {
        EXPECT_LT(pixel[0] - pixel[1], 60) << x << ' ' << y << ' ' << depth;  // no background shines through
        ++inside;
      }
    }
  }
  EXPECT_GT(inside, 1000);
}

// White before black: an edge pixel with k of its 4 samples covered is k/4 of the light, not k/4 of the code.
TEST(Renderer, multisampledEdgesAreAveragesOfLight) {
  Scene scene;
  scene.boxes.push_back(boxAt(Vec3::Zero(), Vec3(1, 1e-4, 1)));
  scene.boxes[0].color = Color{0, 0, 0};
  scene.boxes[0].pose.worldFromBody = axisAngle(Vec3::UnitY(), 0.3);
  scene.camera = cameraAt(Vec3(0, -10, 0), Vec3::Zero(), 20);
  const RenderOptions options = lit(evenLighting(Vec3::Ones()));
  scene.picture.antialiasing = Antialiasing::kMultisampled;
  const Picture picture = drawn(scene, options);
  std::set<int> outer;
  for (int y = 0; y < kFrameHeight; ++y) {
    int x = 0;
    while (x < kFrameWidth && pixelAt(picture, x, y)[0] == 255) {
      ++x;
    }
    if (x < kFrameWidth) {
      outer.insert(pixelAt(picture, x, y)[0]);  // the first pixel in its row that is not all background
    }
  }
  const std::set<int> blends = {0, srgbFromLinear(0.25), srgbFromLinear(0.5), srgbFromLinear(0.75)};
  for (const int value : outer) {
    const bool isBlend =
        std::any_of(blends.begin(), blends.end(), [&](int blend) { return std::abs(blend - value) <= 1; });
    EXPECT_TRUE(isBlend) << value;  // blends of codes would be 64, 128, 191
  }
  EXPECT_GE(outer.size(), 3U);
}

TEST(Renderer, withoutCastingLightThereIsNoShadowPass) {
  const Scene scene = crateInRoom();
  const auto passes = [](const Scene& drawnScene, const RenderOptions& options) {
    Renderer renderer(setupOf(drawnScene, 32, 18), options);
    renderer.draw(posesOf(drawnScene));
    renderer.draw(posesOf(drawnScene));
    EXPECT_EQ(renderer.figures().frames, 2);
    return renderer.figures().shadowPasses;
  };
  EXPECT_EQ(passes(scene, {}), 2);
  EXPECT_EQ(passes(scene, lit(evenLighting())), 0);
  Lighting lighting = lightingOf(Look::kStudio, *scene.camera);
  lighting.light->castsShadow = false;
  EXPECT_EQ(passes(scene, lit(lighting)), 0);
  Scene empty = scene;
  empty.boxes.clear();
  EXPECT_EQ(passes(empty, {}), 0);
}

// A plate 1 m above the floor under a light straight above: dark below it, light beside it.
TEST(Renderer, boxesCastShadowsWhereTheyKeepTheLightOff) {
  Scene scene = crateInRoom();
  scene.boxes[0] = boxAt(Vec3(0, 0, 1), Vec3(0.5, 0.5, 0.05));
  scene.camera = cameraAt(Vec3(0, -6, 0.6), Vec3(0, 0, 0.6), 40);
  Lighting lighting = evenLighting(Vec3::Constant(0.1));
  lighting.sky = lighting.ground = Vec3::Constant(0.1);
  lighting.light = Light{.towards = Vec3::UnitZ(), .color = Vec3::Constant(0.8)};
  const Picture shaded = drawn(scene, lit(lighting));
  lighting.light->castsShadow = false;
  const Picture bare = drawn(scene, lit(lighting));
  const auto at = [&](const Picture& picture, const Vec3& point) {  // 90 / tan 20° = 247 px at 1 m
    const double scale = 0.5 * kFrameHeight / std::tan(20 * std::numbers::pi / 180) / (point.y() + 6);
    return pixelAt(picture, static_cast<int>(160 + scale * point.x()),
                   static_cast<int>(90 - scale * (point.z() - 0.6)))[0];
  };
  for (const double x : {-0.45, 0.0, 0.45}) {
    EXPECT_LT(at(shaded, Vec3(x, 0, 0)), 0.6 * at(bare, Vec3(x, 0, 0))) << x;
  }
  for (const double x : {-0.6, 0.6, 1.5}) {
    EXPECT_EQ(at(shaded, Vec3(x, 0, 0)), at(bare, Vec3(x, 0, 0))) << x;
  }
}

TEST(Renderer, samePosesGiveTheSameBytes) {
  const Scene scene = crateInRoom();
  Renderer renderer(setupOf(scene, kFrameWidth, kFrameHeight));
  const Picture first = renderer.draw(posesOf(scene));
  std::vector<Pose> elsewhere = posesOf(scene);
  elsewhere[0].position = Vec3(1, 1, 2);
  EXPECT_NE(renderer.draw(elsewhere).rgb, first.rgb);
  EXPECT_EQ(renderer.draw(posesOf(scene)).rgb, first.rgb);
  EXPECT_EQ(drawn(scene).rgb, first.rgb);
}

TEST(Renderer, orderOfBoxesDoesNotMatter) {
  Scene scene = crateInRoom();
  scene.boxes.push_back(boxAt(Vec3(0.7, -1, 0.6), Vec3(0.4, 0.2, 0.5), Color{60, 120, 200}));
  scene.boxes.push_back(boxAt(Vec3(-0.7, 1, 0.9), Vec3(0.3, 0.3, 0.3), Color{230, 180, 60}));
  const Picture forward = drawn(scene);
  std::reverse(scene.boxes.begin(), scene.boxes.end());
  EXPECT_EQ(drawn(scene).rgb, forward.rgb);
}

// 2^20 m away doubles still hold the scene exactly, and floats would hold it to 6 cm.
TEST(Renderer, placeInTheWorldDoesNotMatter) {
  Scene scene = crateInRoom();
  scene.camera = cameraAt(Vec3(-1.5, -7, 3), Vec3(0, 0, 1.25), 38);
  const RenderOptions options = lit(evenLighting(Vec3::Constant(0.1)));
  const Picture here = drawn(scene, options);
  const Vec3 far = Vec3(1, -1, 1) * 1048576;
  scene.room->min += far;
  scene.room->max += far;
  scene.boxes[0].pose.position += far;
  scene.camera->eye += far;
  scene.camera->target += far;
  EXPECT_EQ(drawn(scene, options).rgb, here.rgb);
}

// A child of this test draws under the environment it was given; see LP_NUM_THREADS in Mesa's documentation.
TEST(Renderer, numberOfThreadsDoesNotMatter) {
  const char* const path = std::getenv("CAREEN_TEST_PICTURE");
  if (path != nullptr) {
    writePng(path, drawn(crateInRoom()));
    return;
  }
  const TemporaryFolder folder;
  const std::string self = std::filesystem::read_symlink("/proc/self/exe");
  std::vector<std::string> pictures;
  for (const char* threads : {"0", "1", "2"}) {
    const std::string picture = folder / (std::string(threads) + ".png");
    const Ended ended =
        Process({"env", std::string("LP_NUM_THREADS=") + threads, "CAREEN_TEST_PICTURE=" + picture, self,
                 "--gtest_filter=Renderer.numberOfThreadsDoesNotMatter"},
                folder.path())
            .wait();
    ASSERT_EQ(ended.exitCode, 0) << ended.out << ended.err;
    pictures.push_back(textOf(picture));
    ASSERT_FALSE(pictures.back().empty());
  }
  EXPECT_EQ(pictures[0], pictures[1]);
  EXPECT_EQ(pictures[0], pictures[2]);
}

TEST(Renderer, frameThatComesOutBlankIsAnError) {
  const Scene scene = crateInRoom();
  const auto errorWith = [&](const std::string& background, const std::string& result) {
    const TemporaryFolder folder;
    folder.write("background.frag",
                 "#version 330 core\nout vec4 result;\nvoid main() { " + background + " }\n");
    if (!result.empty()) {
      for (const char* name : {"box.frag", "surface.frag"}) {
        folder.write(name, "#version 330 core\nout vec4 result;\nvoid main() { " + result + " }\n");
      }
    }
    RenderOptions options = lit(evenLighting());
    options.shaders = folder.path();
    try {
      drawn(scene, options);
    } catch (const MachineError& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  EXPECT_EQ(errorWith("result = vec4(1.0);", ""), "");
  EXPECT_NE(errorWith("discard;", "").find("blank"), std::string::npos);
  const std::string said =
      errorWith("result = vec4(0.0, 0.0, 0.0, 1.0);", "result = vec4(0.0, 0.0, 0.0, 1.0);");
  EXPECT_NE(said.find("black"), std::string::npos) << said;
  EXPECT_NE(said.find("Mesa"), std::string::npos) << said;
  EXPECT_NE(said.find("apt install"), std::string::npos) << said;
}

TEST(Renderer, missingLibraryIsAnError) {
  RenderOptions options;
  options.context = nowhereToDraw();
  EXPECT_THROW(Renderer(setupOf(crateInRoom(), 32, 18), options), MachineError);
}

TEST(Renderer, refusesSizesBeyondWhatGlCanDo) {
  for (const auto& [width, height] : {std::pair{100000, 100}, {100, 100000}, {0, 100}, {100, -1}}) {
    EXPECT_THROW(Renderer(setupOf(crateInRoom(), width, height)), InputError) << width << ' ' << height;
  }
}

TEST(Renderer, refusesPosesOfAnotherScene) {
  Renderer renderer(setupOf(crateInRoom(), 32, 18));
  EXPECT_THROW(renderer.draw(std::vector<Pose>()), InputError);
  Scene two = crateInRoom();
  two.boxes.push_back(two.boxes[0]);
  EXPECT_THROW(Renderer(setupOf(two, 32, 18)).draw(std::vector<Pose>(3)), InputError);
}

TEST(Renderer, tellsWhoDrawsAndHowLongItTook) {
  const Scene scene = crateInRoom();
  Renderer renderer(setupOf(scene, 32, 18));
  EXPECT_NE(renderer.rendererName().find("Mesa"), std::string::npos) << renderer.rendererName();
  EXPECT_EQ(renderer.figures().drawSeconds, 0);
  renderer.draw(posesOf(scene));
  EXPECT_GT(renderer.figures().drawSeconds, 0);
  EXPECT_GT(renderer.figures().readSeconds, 0);
}

// One looks through the front of a closed room: a wall seen from behind is glass, which gives 5 % of 0.9 to
// what is behind it and takes as much away, and at its outline half.
TEST(Renderer, wallsSeenFromBehindAreGlass) {
  Scene scene = crateInRoom();
  const RenderOptions options = lit(evenLighting(Vec3(1, 0, 1)));
  scene.camera = cameraAt(Vec3(0, -7, 1.5), Vec3(0, 0, 1.5), 40);
  scene.picture.antialiasing = Antialiasing::kOff;
  const auto pictureOf = [&](bool hasFront, bool hasBack) {
    scene.room->open = {true, true, !hasFront, !hasBack, true, true};
    return drawn(scene, options);
  };
  const auto middleOf = [&](const Picture& picture) { return pixelAt(picture, kFrameWidth / 2, 60); };
  const std::array<int, 3> background = {255, 0, 255};
  const Picture neither = pictureOf(false, false);
  EXPECT_EQ(middleOf(neither), background);
  EXPECT_NE(middleOf(pictureOf(false, true)), background);
  const Picture behindGlass = pictureOf(true, false);
  EXPECT_NEAR(middleOf(behindGlass)[0], srgbFromLinear(0.95 + 0.05 * 0.9), 1);
  EXPECT_NEAR(middleOf(behindGlass)[1], srgbFromLinear(0.05 * 0.9), 1);
  int brightest = 0;
  for (int y = 0; y < neither.height; ++y) {
    if (pixelAt(neither, kFrameWidth / 2, y) == background) {
      brightest = std::max(brightest, pixelAt(behindGlass, kFrameWidth / 2, y)[1]);
    }
  }
  EXPECT_GT(brightest, srgbFromLinear(0.25 * 0.9));  // measured 153; at most that of half
  EXPECT_LE(brightest, srgbFromLinear(0.5 * 0.9) + 1);
}

// Straight down on a floor of 0.5 m tiles, evenly lit: neighbours are 10 % above and below the floor's
// colour.
TEST(Renderer, floorHasTilesOfTwoShades) {
  Scene scene = crateInRoom();
  scene.boxes[0].pose.position = Vec3(2.5, 1.5, 0.5);
  scene.camera = Camera{.eye = Vec3(0, 0, 4), .target = Vec3::Zero(), .up = Vec3::UnitY(), .fovDegrees = 30};
  const Picture picture = drawn(scene, lit(evenLighting(Vec3::Constant(0.1))));
  const double pixels = 0.5 * kFrameHeight / std::tan(15 * std::numbers::pi / 180) / 4;  // 84 to the metre
  const int quarter = static_cast<int>(0.25 * pixels);
  const Vec3 floor(0.56, 0.51, 0.45);
  // Corners of the room shade the middle by less than 0.5 %, which the tolerance holds.
  expectColor(pixelAt(picture, kFrameWidth / 2 + quarter, kFrameHeight / 2 - quarter), 1.1 * floor, 1);
  expectColor(pixelAt(picture, kFrameWidth / 2 - quarter, kFrameHeight / 2 - quarter), 0.9 * floor, 1);
  expectColor(pixelAt(picture, kFrameWidth / 2 - quarter, kFrameHeight / 2 + quarter), 1.1 * floor, 1);
}

TEST(Renderer, springsAreDrawnFromEndToEnd) {
  Scene scene;
  scene.boxes.push_back(boxAt(Vec3(-2, 0, 0), Vec3(0.5, 0.5, 0.5)));
  Spring spring;
  spring.from = {.body = 0, .point = Vec3(0.5, 0, 0)};
  spring.to = {.body = std::nullopt, .point = Vec3(2, 0, 0)};
  scene.springs.push_back(spring);
  scene.camera = cameraAt(Vec3(0, -10, 0), Vec3::Zero(), 20);
  const Picture picture = drawn(scene, lit(evenLighting(Vec3(1, 0, 0))));
  const double pixels = 0.5 * kFrameHeight / std::tan(10 * std::numbers::pi / 180) / 10;  // 51 to the metre
  const auto onLine = [&](double x) {
    return pixelAt(picture, static_cast<int>(160 + pixels * x), kFrameHeight / 2)[1];
  };
  EXPECT_GT(onLine(-1.4), 30);
  EXPECT_GT(onLine(1.9), 30);
  EXPECT_EQ(onLine(2.1), 0);  // background
}

}  // namespace
}  // namespace careen
