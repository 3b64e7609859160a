#include "render/gl/shared_library.h"

#include <gtest/gtest.h>

#include <string>

#include "core/error.h"

namespace careen {
namespace {

template <class Action>
std::string machineErrorOf(Action action) {
  try {
    action();
  } catch (const MachineError& error) {
    return error.what();
  }
  return "no error";
}

TEST(SharedLibrary, isTheFirstThatCanBeLoaded) {
  const SharedLibrary library({"libNoSuchThing.so", "libm.so.6", "libc.so.6"}, "install it");
  EXPECT_EQ(library.name(), "libm.so.6");
  double (*const squareRoot)(double) = library.function<double (*)(double)>("sqrt");
  EXPECT_EQ(squareRoot(9), 3);
}

TEST(SharedLibrary, thatCannotBeLoadedSaysWhyAndWhatToDo) {
  const std::string message = machineErrorOf([] {
    SharedLibrary({"libNoSuchThing.so", "libNorThis.so"}, "install it");
  });
  EXPECT_TRUE(message.starts_with("libNorThis.so cannot be loaded; install it; ")) << message;
  EXPECT_NE(message.find("libNoSuchThing.so: cannot open"), std::string::npos) << message;
}

TEST(SharedLibrary, namesTheFunctionThatItLacks) {
  const SharedLibrary library({"libm.so.6"}, "install a newer one");
  EXPECT_EQ(machineErrorOf([&] { library.function<void (*)()>("noSuchFunction"); }),
            "libm.so.6 has no noSuchFunction; install a newer one");
}

}  // namespace
}  // namespace careen
