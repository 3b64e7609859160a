#include "render/overlay/titles.h"

#include "render/overlay/overlay_pictures.h"

namespace careen {
namespace {

class Titles : public OverlayPictures {
 protected:
  std::vector<Label> labelsAt(double time) { return only<Label>(shapesAt("none", time)); }
};

TEST_F(Titles, areThereWithinTheirTimeAndFade) {
  scene_.scenery.titles = {{.from = 0.25, .to = 1.25, .text = "Hecker"}};
  EXPECT_TRUE(labelsAt(0.25).empty());
  ASSERT_EQ(labelsAt(0.75).size(), 1U);
  EXPECT_EQ(labelsAt(0.75)[0].text, "Hecker");
  EXPECT_EQ(labelsAt(0.75)[0].ink.alpha, 1);
  EXPECT_NEAR(labelsAt(0.375)[0].ink.alpha, 0.5, 1e-12);  // half of the quarter of a second
  EXPECT_NEAR(labelsAt(1.125)[0].ink.alpha, 0.5, 1e-12);
  EXPECT_TRUE(labelsAt(1.25).empty());
}

TEST_F(Titles, haveTheirPlacesLinesAndOrder) {
  scene_.scenery.titles = {{.from = 0, .to = 1, .text = "above", .place = TitlePlace::kTop},
                           {.from = 0, .to = 1, .text = "one\ntwo"},
                           {.from = 0, .to = 1, .text = "three"},
                           {.from = 0, .to = 1, .text = "half way", .place = TitlePlace::kMiddle}};
  const std::vector<Label> labels = labelsAt(0.5);
  ASSERT_EQ(labels.size(), 5U);
  EXPECT_EQ(labels[0].text, "above");
  EXPECT_LT(labels[0].at.y(), 0.2 * kHeight);
  EXPECT_EQ(labels[1].text, "half way");
  EXPECT_NEAR(labels[1].at.y(), 0.5 * kHeight + 0.36 * labels[1].size, 2);  // capitals of DejaVu: 0.729 em
  EXPECT_EQ(labels[2].text, "one");
  EXPECT_EQ(labels[3].text, "two");
  EXPECT_EQ(labels[4].text, "three");
  EXPECT_GT(labels[2].at.y(), 0.7 * kHeight);
  EXPECT_GT(labels[3].at.y(), labels[2].at.y() + labels[2].size);
  EXPECT_GT(labels[4].at.y(), labels[3].at.y() + labels[3].size);
  EXPECT_LT(labels[4].at.y(), kHeight);
  const std::vector<Plate> plates = only<Plate>(shapesAt("none", 0.5));
  ASSERT_EQ(plates.size(), 4U) << "one for each title, however many lines it has";
  for (const Plate& plate : plates) {
    EXPECT_NEAR(plate.min.x() + plate.max.x(), kWidth, 2);
  }
}

TEST_F(Titles, ofOneLineThatIsTooLongAreSmaller) {
  scene_.scenery.titles = {{.from = 0, .to = 1, .text = std::string(300, 'm')}};
  const std::vector<Plate> plates = only<Plate>(shapesAt("none", 0.5));
  ASSERT_EQ(plates.size(), 1U);
  EXPECT_GT(plates[0].min.x(), -2);
  EXPECT_LT(plates[0].max.x(), kWidth + 2);
}

}  // namespace
}  // namespace careen
