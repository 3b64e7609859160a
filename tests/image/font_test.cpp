#include "image/font.h"

#include <gtest/gtest.h>

#include <array>
#include <filesystem>
#include <numeric>
#include <string>

#include "core/error.h"
#include "support/process.h"

namespace careen {
namespace {

// DejaVu's em square has 2048 units. Advances from its own table: H 1540, i 569, digits of the plain face
// 1303; all characters of the monospaced face 1233.
constexpr double kEm = 2048;

TEST(Font, widthIsTheSumOfAdvances) {
  const Font font = findFont(kPlainFont);
  EXPECT_NEAR(font.width("Hi", 20), 20 * (1540 + 569) / kEm, 1e-5);
  EXPECT_NEAR(font.width("0123456789", 20), 20 * 10 * 1303 / kEm, 1e-4);
  EXPECT_NEAR(findFont(kMonospacedFont).width("00:00:01.234", 20), 20 * 12 * 1233 / kEm, 1e-4);
  EXPECT_EQ(font.width("", 20), 0);
}

TEST(Font, widthGrowsWithTheSize) {
  const Font font = findFont(kPlainFont);
  EXPECT_NEAR(font.width("kinetic", 36), 3 * font.width("kinetic", 12), 1e-4);
}

TEST(Font, charactersBeyondAsciiHaveShapesOfTheirOwn) {
  const Font font = findFont(kPlainFont);
  const Glyph unknown = font.draw(0xE000, 24, 0);  // private use area: the font has no such glyph
  for (const char32_t character : {U'é', U'ß', U'²', U'Ω', U'Ж', U'→'}) {
    const Glyph glyph = font.draw(character, 24, 0);
    EXPECT_NE(glyph.coverage, unknown.coverage) << static_cast<unsigned>(character);
    EXPECT_FALSE(glyph.coverage.empty());
  }
}

// After a shift by half a pixel the glyph covers as much, at another place.
TEST(Font, shiftMovesTheShape) {
  const Font font = findFont(kPlainFont);
  const Glyph here = font.draw(U'l', 20, 0);
  const Glyph there = font.draw(U'l', 20, 0.5);
  const auto total = [](const Glyph& glyph) {
    return std::accumulate(glyph.coverage.begin(), glyph.coverage.end(), 0);
  };
  EXPECT_NE(here.coverage, there.coverage);
  EXPECT_NEAR(total(here), total(there), 0.02 * total(here));
}

TEST(Font, missingFontIsNamedWithWhatToInstall) {
  const std::array<std::filesystem::path, 2> folders = {"/nowhere", "/elsewhere"};
  try {
    findFont(kPlainFont, folders);
    FAIL();
  } catch (const MachineError& error) {
    const std::string said = error.what();
    EXPECT_EQ(error.code(), ExitCode::kMachineFailed);
    for (const char* part : {"DejaVuSans.ttf", "/nowhere, /elsewhere", "apt install fonts-dejavu-core"}) {
      EXPECT_NE(said.find(part), std::string::npos) << said;
    }
  }
}

TEST(Font, fileThatIsNoFontIsTold) {
  const TemporaryFolder folder;
  for (const std::string& bytes : {std::string(), std::string("not a font at all"), std::string(100, '\0')}) {
    folder.write(kPlainFont, bytes);
    EXPECT_THROW(Font(folder / kPlainFont), MachineError) << bytes.size();
  }
  EXPECT_THROW(Font(folder / "none.ttf"), MachineError);
}

}  // namespace
}  // namespace careen
