#include "stage/overlay.h"

#include <gtest/gtest.h>

#include <string>

#include "support/input_error.h"

namespace careen {
namespace {

TEST(Overlay, everyNameIsReadAndWrittenBack) {
  std::string all;
  for (std::size_t i = 0; i < kOverlayNames.size(); ++i) {
    const OverlaySet set = overlaysNamed(kOverlayNames.at(i));
    EXPECT_TRUE(set.has(static_cast<Overlay>(i)));
    EXPECT_TRUE(set.any());
    EXPECT_EQ(set.text(), kOverlayNames.at(i));
    all.append(all.empty() ? "" : ",").append(kOverlayNames.at(i));
  }
  EXPECT_EQ(overlaysNamed(all).text(), all);
  EXPECT_EQ(overlaysNamed("time,names"), overlaysNamed("names,time"));
}

TEST(Overlay, noneIsNone) {
  EXPECT_FALSE(overlaysNamed("none").any());
  EXPECT_EQ(OverlaySet().text(), "none");
}

TEST(Overlay, unknownNamesAreToldWithThoseThereAre) {
  for (const char* text : {"", "enrgy", "time,", "time,none", "Time", "time, names"}) {
    const std::string said = inputErrorOf([&] { overlaysNamed(text); });
    EXPECT_NE(said.find("expected one or more of: none, contacts, impulses"), std::string::npos) << said;
  }
  EXPECT_TRUE(inputErrorOf([] { overlaysNamed("time,wind"); }).starts_with("found 'wind'"));
}

}  // namespace
}  // namespace careen
