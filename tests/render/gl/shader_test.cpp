#include "render/gl/shader.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <string>

#include "core/error.h"
#include "render/draw/renderer.h"
#include "render/stage.h"
#include "support/environment_variable.h"
#include "support/process.h"

namespace careen {
namespace {

std::string errorOfDrawingWith(const std::filesystem::path& shaders) {
  RenderOptions options;
  options.shaders = shaders;
  try {
    const Renderer renderer(setupOf(crateInRoom(), 32, 18), options);
  } catch (const MachineError& error) {
    return error.what();
  }
  return {};
}

TEST(Shader, everyFileIsBuiltIntoTheProgramToo) {
  int files = 0;
  for (const auto& entry : std::filesystem::directory_iterator(CAREEN_SOURCE_DIR "/shaders")) {
    EXPECT_EQ(embeddedShader(entry.path().filename().string()), textOf(entry.path())) << entry.path();
    ++files;
  }
  EXPECT_GT(files, 10);
}

TEST(Shader, fileComesFirstAndTheProgramsOwnWhereThereIsNone) {
  const TemporaryFolder folder;
  folder.write("black.frag", "changed\n");
  EXPECT_EQ(shaderText(folder.path(), "black.frag"), "changed\n");
  EXPECT_EQ(shaderText(folder.path(), "write_lit.frag"), embeddedShader("write_lit.frag"));
  EXPECT_THROW(shaderText(folder.path(), "none.frag"), MachineError);
}

TEST(Shader, filesOfTheEnvironmentsDataAreDrawnWith) {
  const TemporaryFolder folder;
  std::filesystem::create_directories(folder / "shaders");
  folder.write("shaders/box.frag", "not GLSL\n");
  const EnvironmentVariable data("CAREEN_DATA", folder.path().string());
  const std::string said = errorOfDrawingWith("");
  EXPECT_TRUE(said.starts_with((folder / "shaders/box.frag").string() + " cannot be compiled")) << said;
}

TEST(Shader, includedFileStandsInItsPlaceAndLinesKeepTheirNumbers) {
  const TemporaryFolder folder;
  folder.write("a.frag", "one\n#include \"b.glsl\"\nthree\n");
  folder.write("b.glsl", "two\nmore\n");
  EXPECT_EQ(shaderText(folder.path(), "a.frag"), "one\ntwo\nmore\n#line 3\nthree\n");
}

TEST(Shader, programDrawsWithoutAnyFile) {
  const TemporaryFolder folder;
  EXPECT_EQ(errorOfDrawingWith(folder.path()), "");
}

TEST(Shader, compilersWordsComeWithTheFilesName) {
  const TemporaryFolder folder;
  folder.write("box.frag", "#version 330 core\nvoid main() { undeclared = 1; }\n");
  const std::string said = errorOfDrawingWith(folder.path());
  EXPECT_NE(said.find((folder / "box.frag").string()), std::string::npos) << said;
  EXPECT_NE(said.find("undeclared"), std::string::npos) << said;
  EXPECT_NE(said.find("Mesa"), std::string::npos) << said;
}

TEST(Shader, linkersWordsComeWithTheFilesNames) {
  const TemporaryFolder folder;
  folder.write("light.frag", "#version 330 core\nvoid other() {}\n");
  const std::string said = errorOfDrawingWith(folder.path());
  EXPECT_NE(said.find("light.frag"), std::string::npos) << said;
  EXPECT_NE(said.find("lit"), std::string::npos) << said;
}

}  // namespace
}  // namespace careen
