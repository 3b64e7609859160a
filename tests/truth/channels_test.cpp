#include "truth/channels.h"

#include <gtest/gtest.h>

#include "core/error.h"

namespace careen {
namespace {

TEST(Channels, areReadAndWritten) {
  const ChannelSet set = channelsNamed("flow,depth");
  EXPECT_TRUE(set.has(TruthChannel::kFlow));
  EXPECT_FALSE(set.has(TruthChannel::kNormal));
  EXPECT_EQ(set.text(), "depth,flow");
  EXPECT_EQ(channelsNamed(channelsNamed("all").text()), channelsNamed("all"));
}

TEST(Channels, unknownOnesAreRefused) {
  for (const char* bad : {"", "deep", "depth,", "depth,,flow", "all,depth", "Depth"}) {
    EXPECT_THROW(channelsNamed(bad), InputError) << bad;
  }
}

}  // namespace
}  // namespace careen
