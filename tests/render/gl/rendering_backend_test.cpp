#include "render/gl/rendering_backend.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "core/error.h"
#include "core/system/release.h"
#include "render/draw/renderer.h"
#include "render/stage.h"
#include "support/environment_variable.h"
#include "support/process.h"

namespace careen {
namespace {

RenderOptions by(RenderingBackend backend) {
  RenderOptions options;
  options.context.backend = backend;
  return options;
}

// A crate among a hundred others, with shadow and tiles: edges and small faces enough for a difference to
// show.
Scene manyBoxes() {
  Scene scene = crateInRoom();
  for (int i = 0; i < 100; ++i) {
    scene.boxes.push_back(boxAt(Vec3(-2.5 + 0.5 * (i % 10), -1.5 + 0.03 * i, 0.2 + 0.02 * i),
                                Vec3(0.1, 0.07, 0.05), Color{200, 85, 61}));
    scene.boxes.back().pose.worldFromBody =
        Quat(1, 0.3 * (i % 7), 0.2 * (i % 5), 0.1 * (i % 3)).normalized().toRotationMatrix();
  }
  return scene;
}

class RenderingBackendPixels : public testing::Test {
 private:
  EnvironmentVariable software_{"LIBGL_ALWAYS_SOFTWARE", "1"};  // a GPU has pixels of its own
};

TEST_F(RenderingBackendPixels, areTheSameFromEveryBackend) {
  if (!releaseHasOsMesa()) {
    GTEST_SKIP() << "no OSMesa in this release";
  }
  const Scene scene = manyBoxes();
  Renderer osMesa(setupOf(scene, 320, 180), by(RenderingBackend::kOsMesa));
  Renderer egl(setupOf(scene, 320, 180), by(RenderingBackend::kEgl));
  EXPECT_TRUE(egl.rendererName().ends_with("libEGL.so.1")) << egl.rendererName();
  for (const Renderer* each : {&osMesa, &egl}) {
    ASSERT_NE(each->rendererName().find("llvmpipe"), std::string::npos) << each->rendererName();
  }
  std::vector<Pose> poses = posesOf(scene);
  for (int frame = 0; frame < 3; ++frame) {
    EXPECT_EQ(egl.draw(poses).rgb, osMesa.draw(poses).rgb) << frame;
    poses[0].position.x() += 0.25;
  }
}

// Of two sizes: contexts that draw the same picture hold the same objects by the same names, and one could
// pass for the other.
TEST_F(RenderingBackendPixels, areTheSameWhenContextsTakeTurns) {
  if (!releaseHasOsMesa()) {
    GTEST_SKIP() << "no OSMesa in this release";
  }
  const Scene scene = manyBoxes();
  const auto large = [&scene](RenderingBackend backend) {
    return std::make_unique<Renderer>(setupOf(scene, 320, 180), by(backend));
  };
  const auto small = [&scene](RenderingBackend backend) {
    return std::make_unique<Renderer>(setupOf(scene, 128, 96), by(backend));
  };
  const auto drawn = [&scene](const std::unique_ptr<Renderer>& renderer) {
    return renderer->draw(posesOf(scene)).rgb;
  };
  const std::vector<std::uint8_t> expectedLarge = drawn(large(RenderingBackend::kOsMesa));
  const std::vector<std::uint8_t> expectedSmall = drawn(small(RenderingBackend::kEgl));

  const std::unique_ptr<Renderer> egl = large(RenderingBackend::kEgl);
  std::unique_ptr<Renderer> osMesa = small(RenderingBackend::kOsMesa);
  for (int turn = 0; turn < 2; ++turn) {
    EXPECT_EQ(drawn(egl), expectedLarge) << turn;
    EXPECT_EQ(drawn(osMesa), expectedSmall) << turn;
  }
  osMesa.reset();
  EXPECT_EQ(drawn(egl), expectedLarge);
}

TEST(RenderingBackend, autoTakesOsMesaWhereItIs) {
  if (!releaseHasOsMesa()) {
    GTEST_SKIP() << "no OSMesa in this release";
  }
  EXPECT_EQ(openContext({})->library().substr(0, 12), "libOSMesa.so");
}

TEST(RenderingBackend, autoTakesEglWhereThereIsNoOsMesa) {
  ContextOptions options;
  options.osMesaLibrary = "libNoSuchMesa.so";
  EXPECT_EQ(openContext(options)->library(), "libEGL.so.1");
  options.osMesaLibrary = "libm.so.6";
  EXPECT_EQ(openContext(options)->library(), "libEGL.so.1");
}

TEST(RenderingBackend, whatIsAskedForIsNotReplaced) {
  ContextOptions options = nowhereToDraw();
  options.osMesaLibrary.clear();
  options.backend = RenderingBackend::kEgl;
  EXPECT_THROW(openContext(options), MachineError);
  options = nowhereToDraw();
  options.eglLibrary.clear();
  options.backend = RenderingBackend::kOsMesa;
  EXPECT_THROW(openContext(options), MachineError);
}

TEST(RenderingBackend, saysOfEachWhyThereIsNone) {
  try {
    openContext(nowhereToDraw());
    FAIL();
  } catch (const MachineError& error) {
    const std::string said = error.what();
    for (const std::string& part :
         {std::string("osmesa: libNoSuchMesa.so"), "apt install " + std::string(drawingPackages()),
          std::string("egl: libNoSuchEgl.so"), std::string("apt install libegl1")}) {
      EXPECT_NE(said.find(part), std::string::npos) << said;
    }
  }
}

TEST(RenderingBackend, tellsOfEachWhetherItIsThere) {
  std::vector<BackendFound> found = findRenderingBackends({});
  ASSERT_EQ(found.size(), 2U);
  EXPECT_EQ(found[0].name, "osmesa");
  EXPECT_EQ(found[1].name, "egl");
  for (const BackendFound& each : found) {
    if (each.name == "osmesa" && !releaseHasOsMesa()) {
      EXPECT_FALSE(each.available) << each.description;
      continue;
    }
    EXPECT_TRUE(each.available) << each.description;
    EXPECT_NE(each.description.find("OpenGL"), std::string::npos) << each.description;
  }
  found = findRenderingBackends(nowhereToDraw());
  ASSERT_EQ(found.size(), 2U);
  EXPECT_FALSE(found[0].available);
  EXPECT_FALSE(found[1].available);
  EXPECT_NE(found[0].description.find("libNoSuchMesa.so"), std::string::npos) << found[0].description;
  EXPECT_NE(found[1].description.find("libNoSuchEgl.so"), std::string::npos) << found[1].description;
}

TEST(RenderingBackend, isFoundByItsName) {
  EXPECT_EQ(renderingBackendNamed("auto"), RenderingBackend::kAuto);
  EXPECT_EQ(renderingBackendNamed("osmesa"), RenderingBackend::kOsMesa);
  EXPECT_EQ(renderingBackendNamed("egl"), RenderingBackend::kEgl);
  try {
    renderingBackendNamed("OSMesa");
    FAIL();
  } catch (const InputError& error) {
    EXPECT_STREQ(error.what(), "found 'OSMesa', expected one of: auto, osmesa, egl");
  }
}

TEST(RenderingBackend, refusesAnImpossibleNumberOfThreads) {
  for (const int threads : {-1, 1000}) {
    ContextOptions options;
    options.threads = threads;
    EXPECT_THROW(openContext(options), InputError) << threads;
  }
}

int threadsOfLlvmpipe() {
  int count = 0;
  for (const auto& thread : std::filesystem::directory_iterator("/proc/self/task")) {
    count += textOf(thread.path() / "comm").starts_with("llvmpipe-") ? 1 : 0;
  }
  return count;
}

// Each in a child of this test: the first context of a process decides. A frame is done when every thread has
// done its part of it, so by then all have their names.
TEST(RenderingBackend, everyBackendDrawsWithTheThreadsAskedFor) {
  const char* const backend = std::getenv("CAREEN_TEST_BACKEND");
  if (backend != nullptr) {
    RenderOptions options = by(renderingBackendNamed(backend));
    options.context.threads = 3;
    const Scene scene = crateInRoom();
    Renderer renderer(setupOf(scene, 64, 36), options);
    renderer.draw(posesOf(scene));
    EXPECT_EQ(threadsOfLlvmpipe(), 3);
    return;
  }
  const TemporaryFolder folder;
  const std::string self = std::filesystem::read_symlink("/proc/self/exe");
  for (const std::string each : {"osmesa", "egl"}) {
    if (each == "osmesa" && !releaseHasOsMesa()) {
      continue;
    }
    const Ended ended = Process({"env", "LIBGL_ALWAYS_SOFTWARE=1", "CAREEN_TEST_BACKEND=" + each, self,
                                 "--gtest_filter=RenderingBackend.everyBackendDrawsWithTheThreadsAskedFor"},
                                folder.path())
                            .wait();
    EXPECT_EQ(ended.exitCode, 0) << each << ended.out << ended.err;
  }
}

}  // namespace
}  // namespace careen
