#include "core/characters.h"

#include <gtest/gtest.h>

namespace careen {
namespace {

TEST(Characters, areReadFromUtf8) {
  EXPECT_EQ(charactersOf("aé→𝄞"), U"aé→𝄞");
  EXPECT_EQ(charactersOf("a\xC3"), U"a�");            // truncated
  EXPECT_EQ(charactersOf("\xC3\x28z"), U"�(z");       // no continuation byte
  EXPECT_EQ(charactersOf("\xC0\xAF"), U"��");         // overlong encoding
  EXPECT_EQ(charactersOf("\xED\xA0\x80x"), U"���x");  // half of a UTF-16 surrogate pair
  EXPECT_EQ(charactersOf("\xF8"), U"�");
}

TEST(Characters, areWrittenAsTheyWereRead) {
  const std::string text = "aé→𝄞\u07ff\u0800\uffff";
  std::string again;
  for (const char32_t character : charactersOf(text)) {
    again += utf8Of(character);
  }
  EXPECT_EQ(again, text);
}

TEST(Characters, thatMeanSomethingInMarkupAreEscaped) {
  EXPECT_EQ(escapedForMarkup("<b a=\"1\" b='2'>&amp;é"), "&lt;b a=&quot;1&quot; b=&#39;2&#39;&gt;&amp;amp;é");
}

TEST(Characters, thatSteerATerminalAreEscaped) {
  EXPECT_EQ(printableName("\x1B]0;OWNED\x07\x1B[2J\nfake\tline"),
            "\\x1b]0;OWNED\\x07\\x1b[2J\\x0afake\\x09line");
  EXPECT_EQ(printableName("\u009b31mred\u202egnp\u2028"), "\\x9b31mred\\u202egnp\\u2028");
  EXPECT_EQ(printableName("é→𝄞 \x9B"), "é→𝄞 \uFFFD");
}

TEST(Characters, ofAMessageMayEndALine) {
  EXPECT_EQ(printableMessage("ffmpeg failed: a\n\tb\x1B[m\ncareen: done"),
            "ffmpeg failed: a\n  \tb\\x1b[m\n  careen: done");
}

TEST(Characters, onlyThoseFromAToZAreLowered) { EXPECT_EQ(lowered("Film.MP4 @[`{ É"), "film.mp4 @[`{ É"); }

TEST(Characters, thatMayNotBeInMarkupAreReplaced) {
  EXPECT_EQ(escapedForMarkup("a\tb\nc\r"), "a\tb\nc\r");
  EXPECT_EQ(escapedForMarkup(std::string_view("a\0b\x1B[m\x7F", 7)), "a\uFFFDb\uFFFD[m\uFFFD");
  EXPECT_EQ(escapedForMarkup("\u0085\u00a0\uffff\uffee"), "\uFFFD\u00a0\uFFFD\uffee");
  EXPECT_EQ(escapedForMarkup("a\xC3z\xFF"), "a\uFFFDz\uFFFD");
}

}  // namespace
}  // namespace careen
