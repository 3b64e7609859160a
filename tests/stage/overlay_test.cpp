#include "stage/overlay.h"

#include <gtest/gtest.h>

#include <string>

#include "support/input_error.h"

namespace careen {
namespace {

TEST(Overlay, everyNameIsReadAndWrittenBack) {
  std::string all;
  for (std::size_t i = 0; i < kOverlayNames.size(); ++i) {
    const OverlaySet set = OverlaySet::named(kOverlayNames.at(i));
    EXPECT_TRUE(set.has(static_cast<Overlay>(i)));
    EXPECT_TRUE(set.any());
    EXPECT_EQ(set.text(), kOverlayNames.at(i));
    all.append(all.empty() ? "" : ",").append(kOverlayNames.at(i));
  }
  EXPECT_EQ(OverlaySet::named(all).text(), all);
  EXPECT_EQ(OverlaySet::named("time,names"), OverlaySet::named("names,time"));
}

TEST(Overlay, noneIsNone) {
  EXPECT_FALSE(OverlaySet::named("none").any());
  EXPECT_EQ(OverlaySet().text(), "none");
}

TEST(Overlay, unknownNamesAreToldWithThoseThereAre) {
  for (const char* text : {"", "enrgy", "time,", "time,none", "Time", "time, names"}) {
    const std::string said = inputErrorOf([&] { OverlaySet::named(text); });
    EXPECT_NE(said.find("expected one or more of: none, contacts, impulses"), std::string::npos) << said;
  }
  EXPECT_TRUE(inputErrorOf([] { OverlaySet::named("time,wind"); }).starts_with("found 'wind'"));
}

}  // namespace
}  // namespace careen
