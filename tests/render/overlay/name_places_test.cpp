#include "render/overlay/name_places.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "support/stages.h"
#include "view/camera.h"

namespace careen {
namespace {

constexpr std::size_t kRight = kPlacesOnBox;  // the first place at each side
constexpr std::size_t kLeft = kRight + 4;
constexpr std::size_t kAbove = kLeft + 4;

// Flat boxes seen straight on: a metre is 72 px, the picture's middle the origin.
class NamePlacesTest : public testing::Test {
 protected:
  void add(const std::string& name, const Vec3& at, double half) {
    Body body;
    body.name = name;
    body.halfExtents = Vec3(half, 1e-6, half);
    body.initial.pose.position = at;
    run_.world.bodies.push_back(body);
    states_.push_back(body.initial);
    named_.push_back(named_.size());
  }
  FreeNamePlaces free(const std::vector<Plate>& panels = {}) {
    std::vector<Vec3> centres;
    for (const BodyState& state : states_) {
      centres.push_back(state.pose.position);
    }
    order_ = farthestFirst(screen_, centres);
    const OverlayFrame frame{.trajectory = run_,
                             .states = states_,
                             .farthestFirst = order_,
                             .fonts = &fonts_,
                             .screen = screen_,
                             .style = OverlayStyle(720)};
    return freeNamePlaces(frame, named_, panels);
  }
  static std::size_t firstFree(const NamePlaces& name) {
    const auto found =
        std::find_if(name.at.begin(), name.at.end(), [](const NamePlace& each) { return each.isFree; });
    return static_cast<std::size_t>(found - name.at.begin());
  }

  Trajectory run_;
  std::vector<BodyState> states_;
  std::vector<std::size_t> named_;
  std::vector<std::size_t> order_;
  OverlayFonts fonts_{.plain = findFont(kPlainFont), .monospaced = findFont(kMonospacedFont)};
  Screen screen_{viewOf(cameraAt(Vec3(0, -5, 0), Vec3::Zero(), 90),
                        {.min = Vec3(-5, -5, -5), .max = Vec3(5, 5, 5)}, 16.0 / 9),
                 1280, 720};
};

TEST_F(NamePlacesTest, aNameStandsInTheMiddleOfALargeBox) {
  add("crate", Vec3(1, 0, 0), 1);
  const NamePlaces name = free().of.at(0);
  EXPECT_EQ(firstFree(name), 0U);
  const Plate plate = name.plate(0);
  EXPECT_LT((0.5 * (plate.min + plate.max) - Vec2(640 + 72, 360)).norm(), 1e-3);
  EXPECT_GT(name.size.x(), fonts_.plain.width("crate", nameSize(OverlayStyle(720))));
}

// A box of 29 px is less than this name; its right edge is at 640 + 14.4.
TEST_F(NamePlacesTest, aNameStandsBesideASmallBoxWithALineIntoIt) {
  add("crate", Vec3::Zero(), 0.2);
  const NamePlaces name = free().of.at(0);
  EXPECT_EQ(firstFree(name), kRight);
  const Plate plate = name.plate(kRight);
  EXPECT_GT(plate.min.x(), 640 + 14.4);
  EXPECT_LT(plate.min.x(), 640 + 14.4 + 20);
  EXPECT_NEAR(0.5 * (plate.min.y() + plate.max.y()), 360, 1e-3);
  EXPECT_LT((name.at[kRight].end - Vec2(640 + 7.2, 360)).norm(), 1e-3);
  EXPECT_TRUE(name.at[kLeft].isFree);
  EXPECT_TRUE(name.at[kAbove].isFree);
}

TEST_F(NamePlacesTest, aNameCoversNoOtherBox) {
  add("crate", Vec3::Zero(), 0.2);
  add("other", Vec3(0.6, 0.5, 0), 0.3);  // behind it, and to the right
  EXPECT_EQ(firstFree(free().of.at(0)), kLeft);
  add("third", Vec3(-0.6, 0.5, 0), 0.3);
  EXPECT_EQ(firstFree(free().of.at(0)), kAbove);
}

// What is hidden in the middle but seen at the right half has its name there.
TEST_F(NamePlacesTest, aNameStandsOnWhatIsSeenOfItsBox) {
  add("crate", Vec3::Zero(), 1.2);
  add("near", Vec3(-0.6, -1, 0), 0.5);
  const NamePlaces name = free().of.at(0);
  const std::size_t place = firstFree(name);
  ASSERT_LT(place, kPlacesOnBox);
  EXPECT_GT(name.plate(place).min.x(), 640 - 0.1 * 90);
}

TEST_F(NamePlacesTest, nothingIsFreeForABoxThatIsHiddenOrOutOfThePicture) {
  add("hidden", Vec3::Zero(), 0.1);
  add("before", Vec3(0, -1, 0), 0.5);
  add("outside", Vec3(50, 0, 0), 0.1);
  add("behind", Vec3(0, -9, 0), 0.1);
  const FreeNamePlaces found = free();
  EXPECT_EQ(firstFree(found.of.at(0)), kNamePlaces);
  EXPECT_EQ(firstFree(found.of.at(1)), 0U);
  EXPECT_EQ(firstFree(found.of.at(2)), kNamePlaces);
  EXPECT_EQ(firstFree(found.of.at(3)), kNamePlaces);
  EXPECT_LT(std::find(found.nearestFirst.begin(), found.nearestFirst.end(), 1U),
            std::find(found.nearestFirst.begin(), found.nearestFirst.end(), 0U));
}

TEST_F(NamePlacesTest, panelsAreAvoided) {
  add("crate", Vec3::Zero(), 0.2);
  const Plate panel{.min = Vec2(660, 300), .max = Vec2(900, 420), .ink = {}};
  EXPECT_EQ(firstFree(free({panel}).of.at(0)), kLeft);
}

// Two names on the same spot, names far apart, and the line of one across the other.
TEST_F(NamePlacesTest, namesCollideIfOneOrItsLineLiesOnTheOther) {
  add("a", Vec3::Zero(), 0.1);
  add("b", Vec3(0, 0, 2), 0.1);
  const FreeNamePlaces found = free();
  EXPECT_TRUE(collide(found.of[0], 0, found.of[0], 0));
  EXPECT_FALSE(collide(found.of[0], 0, found.of[1], 0));
  NamePlaces across = found.of[1];
  across.at[kAbove].min = Vec2(640, 100);
  across.at[kAbove].end = Vec2(640, 600);
  EXPECT_TRUE(collide(found.of[0], 0, across, kAbove));
  EXPECT_TRUE(collide(across, kAbove, found.of[0], 0));
}

}  // namespace
}  // namespace careen
