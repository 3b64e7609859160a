#include "render/film/film_pictures.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "core/error.h"
#include "render/stage.h"

namespace careen {
namespace {

constexpr int kWide = 96;
constexpr int kHigh = 72;

class FilmPicturesTest : public testing::Test {
 protected:
  Trajectory run(const Vec3& velocity, double duration = 1) {
    Trajectory run = drifting(scene_, velocity);
    run.stage = setupOf(scene_, kWide, kHigh).stage;
    run.settings.duration = duration;
    return run;
  }
  static Picture drawn(const Trajectory& first, const std::vector<const Trajectory*>& beside, double time) {
    FilmPictures pictures(first, {.beside = beside});
    pictures.makeOverlays();
    pictures.open({});
    return pictures.draw(time);
  }

  Scene scene_ = crateInRoom();
};

// Column by column: the left half is the first run's picture, the right half the other's.
TEST_F(FilmPicturesTest, besideEachOtherAreThoseOfEach) {
  Trajectory first = run(Vec3(1, 0, 0));
  Trajectory other = run(Vec3(-1, 0, 1));
  showFirst(first, "one");
  showBeside(other, first, "two");
  const Picture both = drawn(first, {&other}, 0.5);
  ASSERT_EQ(both.width, 2 * kWide);
  ASSERT_EQ(both.height, kHigh);
  const Picture left = drawn(first, {}, 0.5);
  const Picture right = drawn(other, {}, 0.5);
  EXPECT_NE(left.rgb, right.rgb);
  for (std::size_t row = 0; row < kHigh; ++row) {
    const std::uint8_t* const begin = both.rgb.data() + row * both.rowBytes();
    EXPECT_TRUE(std::equal(begin, begin + left.rowBytes(), left.rgb.data() + row * left.rowBytes())) << row;
    EXPECT_TRUE(std::equal(begin + left.rowBytes(), begin + both.rowBytes(),
                           right.rgb.data() + row * left.rowBytes()))
        << row;
  }
  FilmPictures pictures(first, {.beside = {&other}});
  EXPECT_EQ(pictures.settings().width, 2 * kWide);
}

TEST_F(FilmPicturesTest, whatIsBesideIsSeenAsTheFirstIs) {
  scene_.camera.reset();  // one that sees the first run
  Trajectory first = run(Vec3(3, 0, 0));
  scene_.picture.look = Look::kClay;
  scene_.scenery.titles = {{.from = 0, .to = 1, .text = "other"}};
  Trajectory other = run(Vec3(-3, 0, 1));
  const Camera own = Filming(first).camera(0);
  showFirst(first, "one");
  showBeside(other, first, "two");
  EXPECT_EQ(Filming(other).camera(0).eye, own.eye);
  EXPECT_EQ(Filming(first).camera(0).eye, own.eye);
  EXPECT_EQ(other.stage.picture.look, Look::kStudio);
  ASSERT_EQ(other.stage.scenery.titles.size(), 1U);
  EXPECT_EQ(other.stage.scenery.titles[0].text, "two");
  EXPECT_TRUE(first.stage.picture.overlays.has(Overlay::kTime));
  EXPECT_FALSE(other.stage.picture.overlays.has(Overlay::kTime)) << "one clock is enough";
}

TEST_F(FilmPicturesTest, theCameraFollowsTheBoxOfThatName) {
  Trajectory first = run(Vec3(3, 0, 0));
  first.stage.cameraMove.followed = 0;
  Trajectory other = run(Vec3(-3, 0, 1));
  other.world.bodies.insert(other.world.bodies.begin(),
                            Body{.name = "before", .mass = {}, .material = {}, .initial = {}});
  showBeside(other, first, "two");
  EXPECT_EQ(other.stage.cameraMove.followed, 1U);
  other.world.bodies[1].name = "renamed";
  EXPECT_THROW(showBeside(other, first, "two"), InputError);
}

TEST_F(FilmPicturesTest, theFilmIsAsLongAsTheLongest) {
  const Trajectory first = run(Vec3(1, 0, 0), 0.5);
  const Trajectory other = run(Vec3(1, 0, 0), 0.75);
  EXPECT_EQ(FilmPictures(first, {.beside = {&other}}).duration(), 0.75);
}

// Text of pictures of two sizes, in turns.
TEST_F(FilmPicturesTest, aPlotDoesNotMixUpItsTextWithThatAbove) {
  Trajectory first = run(Vec3(1, 0, 0));
  showFirst(first, "first");
  const auto drawnAfter = [&](const std::vector<double>& before) {
    FilmPictures pictures(first, {.plot = PlotQuantity::kSpeed});
    pictures.makeOverlays();
    pictures.open({});
    for (const double time : before) {
      pictures.draw(time);
    }
    return pictures.draw(0.5).rgb;
  };
  EXPECT_EQ(drawnAfter({0.1, 0.9}), drawnAfter({}));
}

TEST_F(FilmPicturesTest, aPlotStandsBelowAndChangesNoPixelAbove) {
  const Trajectory first = run(Vec3(1, 0, 0));
  const Trajectory other = run(Vec3(1, 0, 1));
  const Picture above = drawn(first, {&other}, 0.5);
  FilmPictures pictures(first, {.beside = {&other}, .plot = PlotQuantity::kDistance});
  pictures.makeOverlays();
  pictures.open({});
  const Picture early = pictures.draw(0.2);
  const Picture whole = pictures.draw(0.5);
  ASSERT_EQ(whole.width, 2 * kWide);
  ASSERT_EQ(whole.height, kHigh + plotHeight(kHigh));
  EXPECT_EQ(pictures.settings().height, whole.height);
  EXPECT_TRUE(std::equal(above.rgb.begin(), above.rgb.end(), whole.rgb.begin()));
  const auto plotOf = [&](const Picture& picture) {
    return std::vector<std::uint8_t>(picture.rgb.begin() + static_cast<std::ptrdiff_t>(above.rgb.size()),
                                     picture.rgb.end());
  };
  EXPECT_NE(plotOf(early), plotOf(whole)) << "it grows";
  EXPECT_EQ(plotOf(pictures.draw(0.2)), plotOf(early));
  EXPECT_THROW(FilmPictures(first, {.plot = PlotQuantity::kDistance}), InputError);
}

}  // namespace
}  // namespace careen
