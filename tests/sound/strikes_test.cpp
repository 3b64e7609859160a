#include "sound/strikes.h"

#include <gtest/gtest.h>

#include "sound/film_clock.h"
#include "sound/heard.h"

namespace careen {
namespace {

std::vector<Strike> strikesOf(const Trajectory& run) {
  const TimeMap shown = run.stage.timeMap.within(run.settings.duration);
  return strikesOf(run, FilmClock(shown), CameraPath(run, shown, 1));
}

TEST(Strikes, areThoseOfImpactsAsTheBodyHasThem) {
  const Trajectory run = dropped(1);
  const std::vector<Strike> strikes = strikesOf(run);
  ASSERT_EQ(strikes.size(), run.impacts.size());
  ASSERT_FALSE(strikes.empty());
  EXPECT_EQ(strikes[0].time, run.impacts[0].time);
  EXPECT_LT((strikes[0].impulse - Vec3(0, 0, run.impacts[0].impulse)).norm(), 1e-12);
  EXPECT_NEAR(strikes[0].point.z(), -0.1, 1e-12);
  const Vec3 eye = CameraPath(run, run.stage.timeMap.within(1), 1).at(0).eye;
  EXPECT_NEAR(strikes[0].distance, (run.impacts[0].point - eye).norm(), 1e-12);
}

// τ = 2.87 (m²/(R E*² v))^⅕: with twice the speed it is 2^⅕ shorter, on soft ground longer.
TEST(Strikes, lastShorterIfFasterOrHarder) {
  const Trajectory slow = dropped(1);
  const Trajectory fast = dropped(4);
  const double contact = strikesOf(slow)[0].contact;
  EXPECT_NEAR(contact / strikesOf(fast)[0].contact, std::pow(2, 0.2), 0.01);
  const double stiff = (11e9 / 0.91) * (50e9 / 0.91) / ((11e9 + 50e9) / 0.91);
  const double speed = slow.impacts[0].approach;
  EXPECT_NEAR(contact, 2.87 * std::pow(4 / (0.05 * 0.1 * stiff * stiff * speed), 0.2), 1e-9 * contact);
  Trajectory metal = slow;
  metal.stage.boxSounds = {kSoundMaterials[2].material};
  EXPECT_LT(strikesOf(metal)[0].contact, contact);
}

TEST(Strikes, ofTwoBoxesAreOppositeAndThoseOfWhatIsHeldAreNone) {
  Scene scene = drop(1);
  scene.boxes.push_back(scene.boxes[0]);
  scene.boxes[1].name = "post";
  scene.boxes[1].fixed = true;
  scene.boxes[1].pose.position = Vec3(0, 0, 0.3);
  const std::vector<Strike> onPost = strikesOf(record(setupOf(scene)));
  ASSERT_FALSE(onPost.empty());
  for (const Strike& strike : onPost) {
    EXPECT_EQ(strike.body, 0U);
  }
  scene.boxes[1].fixed = false;
  scene.boxes[1].pose.position = Vec3(0, 0, 0.1);
  const std::vector<Strike> strikes = strikesOf(record(setupOf(scene)));
  ASSERT_GE(strikes.size(), 2U);
  EXPECT_EQ(strikes[0].body + strikes[1].body, 1U);
  EXPECT_LT((strikes[0].impulse + strikes[1].impulse).norm(), 1e-12);
}

}  // namespace
}  // namespace careen
