#include "trajectory/trajectory_file.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "core/error.h"
#include "core/hash.h"
#include "core/system/file.h"
#include "physics/world/method.h"
#include "support/exact_runs.h"
#include "support/trajectories.h"
#include "trajectory/compression.h"

namespace careen {
namespace {

std::string messageOf(const std::string& bytes) {
  try {
    decodeTrajectory(bytes, "run.careen");
  } catch (const InputError& error) {
    return error.what();
  }
  return "accepted";
}

// Where the packed record begins: behind the magic word, the version and the record's size.
constexpr std::size_t kRecord = 24;

std::uint64_t numberAt(const std::string& bytes, std::size_t at) {
  std::uint64_t number = 0;
  for (std::size_t i = 8; i-- > 0;) {
    number = number << 8U | static_cast<unsigned char>(bytes[at + i]);
  }
  return number;
}

std::string inBytes(std::uint64_t number) {
  std::string bytes;
  for (int shift = 0; shift < 64; shift += 8) {
    bytes.push_back(static_cast<char>(number >> shift));
  }
  return bytes;
}

// A file changed on purpose, with a checksum that is right again: what the checksum cannot find.
std::string withRightChecksum(std::string bytes) {
  bytes.resize(bytes.size() - 8);
  Hash hash;
  hash.add(bytes);
  return bytes + inBytes(hash.value());
}

std::string recordOf(const std::string& bytes) {
  return decompressed(bytes.substr(kRecord, bytes.size() - 8 - kRecord), numberAt(bytes, kRecord - 8))
      .value();
}

// The file with another record, and with size and checksum that fit it.
std::string withRecord(const std::string& bytes, const std::string& record) {
  return withRightChecksum(bytes.substr(0, kRecord - 8) + inBytes(record.size()) + compressed(record) +
                           "checksum");
}

TEST(TrajectoryFile, bringsBackARunOfEveryMethod) {
  for (const MethodTraits& method : kMethods) {
    const Trajectory run = record(elasticRoom(), {.method = method.method, .duration = 1}, "{}");
    const std::string bytes = encodeTrajectory(run);
    const Trajectory back = decodeTrajectory(bytes, "run.careen");
    EXPECT_EQ(encodeTrajectory(back), bytes) << method.name;
    EXPECT_EQ(back.settings.method, method.method);
    EXPECT_EQ(back.state(0, 0.7).pose.worldFromBody, run.state(0, 0.7).pose.worldFromBody) << method.name;
  }
}

// Methods are stored by name. This one came with earlier versions.
TEST(TrajectoryFile, refusesARunOfAMethodThatIsNoMore) {
  const std::string bytes =
      encodeTrajectory(record(elasticRoom(), {.method = Method::kStrang, .duration = 1}, "{}"));
  std::string record = recordOf(bytes);
  const std::string strang = inBytes(6) + "strang";
  const std::string former = inBytes(11) + "splitting-6";
  const std::size_t at = record.find(strang);
  ASSERT_NE(at, std::string::npos);
  record.replace(at, strang.size(), former);
  EXPECT_EQ(messageOf(withRecord(bytes, record)),
            "run.careen: this trajectory file was made by the method 'splitting-6', expected one of exact, "
            "listing1, strang, runge-kutta-4, taylor-8, moser-veselov-10");
}

TEST(TrajectoryFile, bringsBackEveryBit) {
  const Trajectory trajectory = driftAndReturn();
  const std::string bytes = encodeTrajectory(trajectory);
  const Trajectory back = decodeTrajectory(bytes, "run.careen");
  EXPECT_EQ(encodeTrajectory(back), bytes);
  EXPECT_EQ(back.sceneText, trajectory.sceneText);
  EXPECT_EQ(back.stateHash(), trajectory.stateHash());
  EXPECT_EQ(back.settings.dt, 0.5);
  EXPECT_EQ(back.figures.energyChange, 0.1);
  EXPECT_EQ(back.world.bodies[0].mass.inertiaBody, trajectory.world.bodies[0].mass.inertiaBody);
  EXPECT_EQ(back.world.bodies[1].name, "anchor");
  ASSERT_EQ(back.impacts.size(), 1U);
  EXPECT_EQ(back.impacts[0].b, Partner::ofWall(1));
  EXPECT_EQ(back.impacts[0].normal, Vec3(-1, 0, 0));
  EXPECT_EQ(back.state(0, 0.75).pose.position, Vec3(1.5, 0, 0));
}

// Every number another, so that none can stand in another's place.
Stage everyPart() {
  Stage stage;
  stage.name = "a stage";
  stage.room.emplace();
  stage.room->min = Vec3(-1, -2, -3);
  stage.room->max = Vec3(4, 5, 6);
  stage.room->open = {false, true, false, true, true, false};
  stage.planes = {{.normal = Vec3(0, 0.6, 0.8), .offset = 0.5}, {.normal = Vec3::UnitX(), .offset = -7}};
  stage.colors = {{1, 2, 3}, {4, 5, 6}};
  stage.camera =
      Camera{.eye = Vec3(1, -8, 2), .target = Vec3(0.5, 0, 1), .up = Vec3::UnitZ(), .fovDegrees = 33};
  stage.cameraMove.followed = 1;
  stage.cameraMove.keys = {{.time = 0, .eye = Vec3(1, -8, 2), .target = Vec3(0.5, 0, 1), .fovDegrees = 33},
                           {.time = 2, .eye = Vec3(2, -8, 3), .target = Vec3(0.5, 1, 1), .fovDegrees = 44}};
  stage.timeMap.keys = {{.film = 0, .scene = 0.25}, {.film = 3, .scene = 0.75}};
  stage.picture = {.width = 640,
                   .height = 360,
                   .rate = {.numerator = 24000, .denominator = 1001},
                   .look = Look::kClay,
                   .antialiasing = Antialiasing::kMultisampled,
                   .shutter = {.degrees = 123.456, .samples = 7},
                   .overlays = overlaysNamed("trail,energy")};
  return stage;
}

TEST(TrajectoryFile, bringsBackWorldStageAndPlan) {
  Trajectory run = driftAndReturn();
  run.stage = everyPart();
  run.plan.items = {{.what = "gravity", .modelled = true, .reason = "the scene sets it"},
                    {.what = "drag", .modelled = false, .reason = "the scene has none"}};
  run.world.gravity = Vec3(1, 2, -9);
  run.world.bodies[0].material = {.restitution = 0.25, .friction = 0.125};
  run.world.springs = {{.from = {.body = 1, .point = Vec3(1, 2, 3)},
                        .to = {.body = {}, .point = Vec3(4, 5, 6)},
                        .stiffness = 7,
                        .damping = 8,
                        .restLength = 9}};
  run.world.drag = Drag{.linear = 0.5, .angular = 0.75};
  const std::string bytes = encodeTrajectory(run);
  const Trajectory back = decodeTrajectory(bytes, "run.careen");
  EXPECT_EQ(encodeTrajectory(back), bytes);

  EXPECT_EQ(back.world.gravity, Vec3(1, 2, -9));
  EXPECT_EQ(back.world.bodies[0].halfExtents, Vec3(0.1, 0.2, 0.3));
  EXPECT_EQ(back.world.bodies[0].material.friction, 0.125);
  EXPECT_EQ(back.world.bodies[0].initial.velocity, Vec3(2, 0, 0));
  EXPECT_EQ(back.world.walls[1].name, "room+x");
  EXPECT_EQ(back.world.walls[1].offset, -2.1);
  ASSERT_EQ(back.world.springs.size(), 1U);
  EXPECT_EQ(back.world.springs[0].from.body, 1);
  EXPECT_FALSE(back.world.springs[0].to.body);
  EXPECT_EQ(back.world.springs[0].to.point, Vec3(4, 5, 6));
  EXPECT_EQ(back.world.springs[0].restLength, 9);
  EXPECT_EQ(back.world.drag->angular, 0.75);
  EXPECT_EQ(back.plan.modelled(), std::vector<std::string>{"gravity"});
  EXPECT_EQ(back.plan.items[1].reason, "the scene has none");

  const Stage& stage = back.stage;
  EXPECT_EQ(stage.name, "a stage");
  EXPECT_EQ(stage.room->max, Vec3(4, 5, 6));
  EXPECT_EQ(stage.room->open, run.stage.room->open);
  ASSERT_EQ(stage.planes.size(), 2U);
  EXPECT_EQ(stage.planes[1].offset, -7);
  EXPECT_EQ(stage.colors[1].blue, 6);
  EXPECT_EQ(stage.camera->fovDegrees, 33);
  EXPECT_EQ(stage.cameraMove.followed, 1);
  EXPECT_EQ(stage.cameraMove.keys[1].target, Vec3(0.5, 1, 1));
  EXPECT_EQ(stage.timeMap.keys[1].scene, 0.75);
  EXPECT_EQ(stage.picture.width, 640);
  EXPECT_EQ(stage.picture.height, 360);
  EXPECT_EQ(stage.picture.rate.text(), "24000/1001");
  EXPECT_EQ(stage.picture.look, Look::kClay);
  EXPECT_EQ(stage.picture.antialiasing, Antialiasing::kMultisampled);
  EXPECT_EQ(stage.picture.shutter.degrees, 123.456);
  EXPECT_EQ(stage.picture.shutter.samples, 7);
  EXPECT_EQ(stage.picture.overlays.text(), "trail,energy");
}

// ---- Version 3, which held no world and no stage. The file was made of falling-pair.json.

const std::filesystem::path kOldRun =
    std::filesystem::path(CAREEN_SOURCE_DIR) / "tests/scenes/falling-pair-3.careen";

// What that scene makes, by hand.
RunSetup fallingPair() {
  RunSetup setup;
  const Vec3 crate(0.4, 0.3, 0.2);
  const Vec3 post(0.1, 0.1, 0.5);
  setup.world.gravity = Vec3(0, 0, -9.81);
  setup.world.bodies = {
      {.name = "crate", .halfExtents = crate, .mass = solidBox(crate, 2), .material = {}, .initial = {}},
      {.name = "post", .halfExtents = post, .mass = immovable(), .material = {}, .initial = {}}};
  for (const char* wall : {"room-x", "room+x", "room+y", "room-z", "ramp"}) {
    setup.world.walls.push_back({.name = wall, .normal = Vec3::UnitZ(), .offset = 0, .material = {}});
  }
  setup.stage.colors.resize(2);
  return setup;
}

std::string messageOfOldRun(const std::function<void(RunSetup&)>& change) {
  RunSetup setup = fallingPair();
  change(setup);
  try {
    decodeTrajectory(readFile(kOldRun), "old.careen",
                     [&](const std::string&, const RunSettings&) { return setup; });
  } catch (const InputError& error) {
    return error.what();
  }
  return "accepted";
}

TEST(TrajectoryFile, completesARunOfVersion3FromItsScene) {
  RunSettings asked;
  std::string text;
  const auto setup = [&](const std::string& sceneText, const RunSettings& settings) {
    text = sceneText;
    asked = settings;
    return fallingPair();
  };
  const Trajectory run = decodeTrajectory(readFile(kOldRun), "old.careen", setup);
  EXPECT_NE(text.find("falling pair"), std::string::npos);
  EXPECT_EQ(asked.duration, 0.6);
  EXPECT_EQ(run.sceneText, text);
  EXPECT_EQ(run.stateHash(), "ec6b49ceb9cd0ff7");
  EXPECT_EQ(run.world.bodies[0].initial.pose.position, Vec3(0.5, 0, 0.7));  // as its track has it
  EXPECT_EQ(run.world.bodies[0].initial.velocity, Vec3(1, 0.5, -2));
  const std::string bytes = encodeTrajectory(run);
  EXPECT_EQ(encodeTrajectory(decodeTrajectory(bytes, "new.careen")), bytes);  // now it is whole
}

TEST(TrajectoryFile, refusesARunOfVersion3ThatItsSceneDoesNotFit) {
  EXPECT_EQ(messageOfOldRun([](RunSetup&) {}), "accepted");
  const std::string file = "old.careen: this trajectory file ";
  EXPECT_EQ(messageOfOldRun([](RunSetup& setup) { setup.world.bodies.pop_back(); }),
            file + "has 2 bodies, its scene 1");
  EXPECT_EQ(messageOfOldRun([](RunSetup& setup) { setup.world.bodies[1].name = "pole"; }),
            file + "has a body 'post' where its scene has 'pole'");
  EXPECT_EQ(messageOfOldRun(
                [](RunSetup& setup) { setup.world.bodies[0].mass = solidBox(Vec3(0.4, 0.3, 0.21), 2); }),
            file + "has another mass or inertia of body 'crate' than its scene gives that box");
  EXPECT_EQ(messageOfOldRun([](RunSetup& setup) { setup.world.walls.pop_back(); }),
            file + "has other walls than its scene");
  EXPECT_EQ(messageOfOldRun([](RunSetup& setup) { setup.stage.colors.clear(); }),
            file + "has 0 colours for 2 bodies");
}

TEST(TrajectoryFile, refusesARunOfVersion3WhereNobodyKnowsScenes) {
  EXPECT_NE(messageOf(readFile(kOldRun)).find("has format version 3"), std::string::npos);
}

TEST(TrajectoryFile, refusesAFileCutShortAnywhere) {
  const std::string bytes = encodeTrajectory(driftAndReturn());
  for (std::size_t size = 0; size < bytes.size(); ++size) {
    EXPECT_NE(messageOf(bytes.substr(0, size)), "accepted") << size;
  }
  EXPECT_NE(messageOf(bytes.substr(0, bytes.size() - 9)).find("cut short or damaged"), std::string::npos);
}

TEST(TrajectoryFile, refusesAnyChangedByte) {
  const std::string bytes = encodeTrajectory(driftAndReturn());
  for (std::size_t at = 0; at < bytes.size(); ++at) {
    std::string changed = bytes;
    changed[at] = static_cast<char>(changed[at] ^ 0x10);
    EXPECT_NE(messageOf(changed), "accepted") << at;
  }
}

// Whatever stands in it, reading ends in a message: no crash, no endless memory.
TEST(TrajectoryFile, survivesAnyChangedByteBehindARightChecksum) {
  const std::string bytes = encodeTrajectory(driftAndReturn());
  const std::string record = recordOf(bytes);
  int refused = 0;
  for (std::size_t at = 0; at < record.size(); ++at) {
    std::string changed = record;
    changed[at] = static_cast<char>(changed[at] ^ 0xff);
    refused += messageOf(withRecord(bytes, changed)) == "accepted" ? 0 : 1;
  }
  for (std::size_t at = 8; at + 8 < bytes.size(); ++at) {  // and of the packed record itself
    std::string changed = bytes;
    changed[at] = static_cast<char>(changed[at] ^ 0xff);
    EXPECT_NE(messageOf(withRightChecksum(changed)), "accepted") << at;
  }
  EXPECT_GT(refused, 400);  // measured 435; the other bytes turned numbers into other numbers
}

TEST(TrajectoryFile, aMinuteOfABouncingBoxTakesLessThan50kB) {
  const Trajectory trajectory = record(elasticRoom(), {.duration = 60}, "");
  EXPECT_GT(trajectory.impacts.size(), 200U);
  EXPECT_LT(encodeTrajectory(trajectory).size(), 50'000U);  // measured 34,101, with 241 impacts
}

TEST(TrajectoryFile, namesAnotherVersion) {
  std::string bytes = encodeTrajectory(driftAndReturn());
  bytes[8] = 77;
  EXPECT_EQ(messageOf(withRightChecksum(bytes)),
            "run.careen: this trajectory file has format version 77, expected 4");
}

TEST(TrajectoryFile, refusesAnotherKindOfFile) {
  EXPECT_FALSE(looksLikeTrajectory("{ \"careen\": 1 }"));
  EXPECT_NE(messageOf("{ \"careen\": 1 }").find("does not begin as one"), std::string::npos);
}

TEST(TrajectoryFile, saysWhichFileIsMissing) {
  EXPECT_THROW(readTrajectory("no/such/run.careen"), InputError);
}

}  // namespace
}  // namespace careen
