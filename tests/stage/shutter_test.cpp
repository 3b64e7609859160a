#include "stage/shutter.h"

#include <gtest/gtest.h>

#include "core/error.h"

namespace careen {
namespace {

TEST(Shutter, isReadAsItIsWritten) {
  for (const char* text : {"180:8", "0.1:1", "360:256", "172.8:16"}) {
    EXPECT_EQ(parseShutter(text).text(), text);
  }
  EXPECT_EQ(parseShutter("90").text(), "90:8");
  EXPECT_EQ(parseShutter("0").text(), "none");
  EXPECT_EQ(Shutter{}.text(), "none");
}

TEST(Shutter, refusesWhatIsNone) {
  for (const char* text :
       {"", "x", "-1", "360.1", "180:", "180:0", "180:257", "180:8:2", ":8", "nan", "180 "}) {
    EXPECT_THROW(parseShutter(text), InputError) << text;
  }
}

}  // namespace
}  // namespace careen
