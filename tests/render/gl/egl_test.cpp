#include "render/gl/egl.h"

#include <gtest/gtest.h>

#include <string>

#include "core/error.h"

namespace careen {
namespace {

std::string errorOf(const std::string& library) {
  try {
    const Egl egl(library);
  } catch (const MachineError& error) {
    return error.what();
  }
  return {};
}

TEST(Egl, missingLibraryIsNamedWithWhatToInstall) {
  const std::string said = errorOf("libNoSuchEgl.so.1");
  EXPECT_NE(said.find("libNoSuchEgl.so.1"), std::string::npos) << said;
  EXPECT_NE(said.find("apt install libegl1 libegl-mesa0 libgl1-mesa-dri"), std::string::npos) << said;
}

TEST(Egl, libraryOfSomethingElseIsToldSo) {
  const std::string said = errorOf("libm.so.6");
  EXPECT_NE(said.find("libm.so.6 has no eglQueryString"), std::string::npos) << said;
}

TEST(Egl, isFoundUnderItsUsualName) {
  const Egl egl("");
  EXPECT_EQ(egl.library(), "libEGL.so.1");
  EXPECT_NE(egl.function("glDrawArraysInstanced"), nullptr);
}

// One display serves all contexts: it must outlive the first of them.
TEST(Egl, contextsMayComeAndGo) {
  Egl first("");
  { const Egl second(""); }
  first.makeCurrent();
  const Egl third("");
  first.makeCurrent();
}

}  // namespace
}  // namespace careen
