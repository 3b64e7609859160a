#include <GL/glcorearb.h>

#include "render/gl/gl.h"

#include <gtest/gtest.h>

#include <memory>
#include <string>

#include "core/error.h"
#include "render/gl/rendering_backend.h"

namespace careen {
namespace {

class GlTest : public testing::Test {
 protected:
  std::unique_ptr<GlContext> context_ = openContext({});
  Gl gl_{*context_};
};

TEST_F(GlTest, saysWhoDraws) {
  EXPECT_NE(gl_.description.find(", OpenGL "), std::string::npos) << gl_.description;
  EXPECT_TRUE(gl_.description.ends_with(context_->library())) << gl_.description;
}

TEST_F(GlTest, answersWithANumberEvenWhereGlHasSeveral) {
  EXPECT_GE(gl_.integer(GL_MAX_TEXTURE_SIZE), 1024);
  gl_.Viewport(3, 5, 7, 11);
  EXPECT_EQ(gl_.integer(GL_VIEWPORT), 3);
}

TEST_F(GlTest, tellsAnErrorOnceWithWhatWasDone) {
  EXPECT_NO_THROW(checkGl(gl_, "nothing"));
  gl_.Enable(0xffff);  // no such thing: GL_INVALID_ENUM, 0x0500
  try {
    checkGl(gl_, "enabling");
    ADD_FAILURE() << "no error";
  } catch (const MachineError& error) {
    EXPECT_EQ(error.what(), "enabling: GL error 0x0500 (" + gl_.description + ")");
  }
  EXPECT_NO_THROW(checkGl(gl_, "nothing"));
}

}  // namespace
}  // namespace careen
