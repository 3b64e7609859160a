#include "render/gl/osmesa.h"

#include <gtest/gtest.h>

#include <string>

#include "core/error.h"
#include "core/system/release.h"
#include "render/stage.h"

namespace careen {
namespace {

std::string osmesaErrorOf(const std::string& library) {
  try {
    const OsMesa osMesa(library);
  } catch (const MachineError& error) {
    return error.what();
  }
  return {};
}

TEST(OsMesa, missingLibraryIsNamedWithWhatToInstall) {
  const std::string said = osmesaErrorOf("libNoSuchMesa.so.8");
  EXPECT_NE(said.find("libNoSuchMesa.so.8"), std::string::npos) << said;
  EXPECT_NE(said.find("apt install " + std::string(drawingPackages())), std::string::npos) << said;
}

TEST(OsMesa, libraryOfSomethingElseIsToldSo) {
  const std::string said = osmesaErrorOf("libm.so.6");
  EXPECT_NE(said.find("libm.so.6 has no OSMesaCreateContextAttribs"), std::string::npos) << said;
}

TEST(OsMesa, isFoundUnderItsUsualName) {
  if (!releaseHasOsMesa()) {
    GTEST_SKIP() << "no OSMesa in this release";
  }
  const OsMesa osMesa("");
  EXPECT_EQ(osMesa.library().substr(0, 12), "libOSMesa.so");
  EXPECT_NE(osMesa.function("glDrawArraysInstanced"), nullptr);
}

}  // namespace
}  // namespace careen
