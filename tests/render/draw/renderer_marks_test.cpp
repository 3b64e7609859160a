// The marks of boxes where a pixel is larger than they are.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "image/srgb.h"
#include "render/draw/renderer.h"
#include "render/stage.h"

namespace careen {
namespace {

constexpr int kWidthOfMarks = 160;
constexpr int kHeightOfMarks = 90;

// The same view at 16 times the size, averaged in light.
std::array<int, 3> truth(const Picture& large, int x, int y) {
  constexpr int kTimes = 16;
  const SrgbTables& srgb = SrgbTables::get();
  std::array<int, 3> color{};
  for (int channel = 0; channel < 3; ++channel) {
    std::uint32_t sum = 0;
    for (int row = 0; row < kTimes; ++row) {
      for (int column = 0; column < kTimes; ++column) {
        const int at = 3 * ((kTimes * y + row) * large.width + kTimes * x + column) + channel;
        sum += srgb.linear(large.rgb[static_cast<std::size_t>(at)]);
      }
    }
    color.at(static_cast<std::size_t>(channel)) =
        srgb.encoded(static_cast<std::uint16_t>(sum / (kTimes * kTimes)));
  }
  return color;
}

// The face above is 8 pixels deep and its pips a third of one; at 40 degrees to the picture's rows, too.
TEST(RendererMarks, pipsThinnerThanAPixelHaveTheirPartOfIt) {
  for (const double turn : {0.0, 0.7}) {
    Scene scene;
    scene.boxes.push_back(boxAt(Vec3::Zero(), Vec3(0.2, 0.6, 0.1), Color{40, 40, 45}));
    scene.boxes[0].pose.worldFromBody = Eigen::AngleAxisd(turn, Vec3::UnitZ()).toRotationMatrix();
    scene.camera = cameraAt(Vec3(0, -10, 0.75), Vec3::Zero(), 5.4);
    RenderOptions options;
    options.lighting = evenLighting(Vec3::Ones());
    const Picture small =
        Renderer(setupOf(scene, kWidthOfMarks, kHeightOfMarks), options).draw(posesOf(scene));
    const Picture large =
        Renderer(setupOf(scene, 16 * kWidthOfMarks, 16 * kHeightOfMarks), options).draw(posesOf(scene));
    double sum = 0;
    int count = 0;
    int brightest = 0;
    for (int y = 33; y < 38; ++y) {  // the middle of that face
      for (int x = 72; x < 88; ++x) {
        const std::array<int, 3> found = pixelAt(small, x, y);
        const std::array<int, 3> right = truth(large, x, y);
        for (std::size_t channel = 0; channel < 3; ++channel) {
          sum += std::abs(found.at(channel) - right.at(channel));
          brightest = std::max(brightest, right.at(channel));
          ++count;
        }
      }
    }
    EXPECT_LT(sum / count, 11) << turn;  // 5.8 and 9.2; 17 and 27 by the distance to the edge alone
    EXPECT_GT(brightest, 150) << "there is a pip in sight";
  }
}

}  // namespace
}  // namespace careen
