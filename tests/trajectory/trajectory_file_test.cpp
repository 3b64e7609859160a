#include "trajectory/trajectory_file.h"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <string>
#include <utility>
#include <variant>

#include "core/error.h"
#include "core/hash.h"
#include "core/system/file.h"
#include "physics/world/given_inertia.h"
#include "physics/world/method.h"
#include "support/exact_runs.h"
#include "support/trajectories.h"
#include "trajectory/compression.h"
#include "trajectory/trajectory_format.h"

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

// Where the first piece of the record begins: behind the magic word and the version.
constexpr std::size_t kRecord = 16;
constexpr std::size_t kSizes = 16;  // before each piece

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

// Of a run that is one piece.
std::string recordOf(const std::string& bytes) {
  return decompressed(bytes.substr(kRecord + kSizes, bytes.size() - 8 - kRecord - kSizes),
                      numberAt(bytes, kRecord))
      .value();
}

std::string pieceOf(const std::string& record) {
  const std::string packed = compressed(record);
  return inBytes(record.size()) + inBytes(packed.size()) + packed;
}

// The file with another record, and with sizes and a checksum that fit it.
std::string withRecord(const std::string& bytes, const std::string& record) {
  return withRightChecksum(bytes.substr(0, kRecord) + pieceOf(record) + "checksum");
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

TEST(TrajectoryFile, bringsBackTheResidualsOfContact) {
  Trajectory run = driftAndReturn();
  run.figures.contact = {.problems = 7, .primal = 1e-15, .dual = 2e-16, .complementarity = 3e-17};
  run.figures.crowds = {.problems = 5'000'000'000, .primal = 1e-3, .dual = 0, .complementarity = 0.25};
  const Trajectory back = decodeTrajectory(encodeTrajectory(run), "run.careen");
  EXPECT_EQ(back.figures.contact.problems, 7);
  EXPECT_EQ(back.figures.contact.primal, 1e-15);
  EXPECT_EQ(back.figures.contact.dual, 2e-16);
  EXPECT_EQ(back.figures.contact.complementarity, 3e-17);
  EXPECT_EQ(back.figures.crowds.problems, 5'000'000'000);
  EXPECT_EQ(back.figures.crowds.primal, 1e-3);
  EXPECT_EQ(back.figures.crowds.complementarity, 0.25);
}

TEST(TrajectoryFile, bringsBackUntilWhenPlacesMeanSomething) {
  Trajectory run = driftAndReturn();
  EXPECT_FALSE(decodeTrajectory(encodeTrajectory(run), "run.careen").figures.horizon);
  run.figures.horizon = 0.75;
  EXPECT_EQ(decodeTrajectory(encodeTrajectory(run), "run.careen").figures.horizon, 0.75);
}

TEST(TrajectoryFile, bringsBackHowSurfacesMove) {
  Trajectory run = driftAndReturn();
  run.world.bodies[0].material.surface.velocity = Vec3(1, 2, 3);
  run.world.walls[0].material.surface.spin = Vec3(4, 5, 6);
  const Trajectory back = decodeTrajectory(encodeTrajectory(run), "run.careen");
  EXPECT_EQ(back.world.bodies[0].material.surface.velocity, Vec3(1, 2, 3));
  EXPECT_EQ(back.world.walls[0].material.surface.spin, Vec3(4, 5, 6));
}

TEST(TrajectoryFile, bringsBackHowGravityChanges) {
  Trajectory run = driftAndReturn();
  run.world.gravityChanges = {{.time = 0.25, .gravity = Vec3(1, 2, 3)},
                              {.time = 0.5, .gravity = Vec3(4, 5, 6)}};
  const Trajectory back = decodeTrajectory(encodeTrajectory(run), "run.careen");
  ASSERT_EQ(back.world.gravityChanges.size(), 2U);
  EXPECT_EQ(back.world.gravityChanges[1].time, 0.5);
  EXPECT_EQ(back.world.gravityChanges[1].gravity, Vec3(4, 5, 6));
}

// Runs in which it does not are of an earlier version.
TEST(TrajectoryFile, bringsBackHowGravitySlopes) {
  World world = elasticRoom();
  world.gravityChanges = {{.time = 0.5, .gravity = Vec3(1, 2, 3)}};
  const auto versionOf = [](const std::string& bytes) { return static_cast<int>(bytes[8]); };
  EXPECT_EQ(versionOf(encodeTrajectory(record(world, {.duration = 0.7}, ""))), 15);
  world.gravityPath = GravityPath::kLinear;
  const Trajectory run = record(world, {.duration = 0.7}, "");
  const std::string bytes = encodeTrajectory(run);
  EXPECT_EQ(versionOf(bytes), 17);
  const Trajectory back = decodeTrajectory(bytes, "run.careen");
  EXPECT_EQ(back.world.gravityPath, GravityPath::kLinear);
  const Segment first = back.tracks[0].segments.front();
  EXPECT_EQ(std::get<Flight>(first.motion).jerk, gravitySlope(world));
  EXPECT_EQ(back.state(0, 0.3).pose.position, run.state(0, 0.3).pose.position);
  EXPECT_EQ(encodeTrajectory(back), bytes);
}

TEST(TrajectoryFile, bringsBackWhereTheCentreOfMassLiesAndItsAxes) {
  World world = elasticRoom();
  world.bodies[0].boxCenter = Vec3(0.1, -0.05, 0.02);
  Mat3 tensor = world.bodies[0].mass.inertiaTensor();
  tensor(0, 1) = tensor(1, 0) = 0.01;
  world.bodies[0].mass = massWithTensor(1, tensor);
  const Trajectory run = record(world, {.duration = 1}, "{}");
  const Trajectory back = decodeTrajectory(encodeTrajectory(run), "run.careen");
  EXPECT_EQ(back.world.bodies[0].boxCenter, world.bodies[0].boxCenter);
  EXPECT_EQ(back.world.bodies[0].mass, world.bodies[0].mass);
  EXPECT_EQ(back.poses(0.7)[0].position, run.poses(0.7)[0].position);
}

TEST(TrajectoryFile, bringsBackTheMeshesThatAreDrawn) {
  Trajectory run = record(elasticRoom(), {.duration = 1}, "{}");
  const TriangleMesh mesh{.points = {Vec3::Zero(), Vec3::UnitX(), Vec3::UnitY()}, .triangles = {{0, 2, 1}}};
  run.stage.parts = {{.body = 0, .mesh = mesh}};
  const Trajectory back = decodeTrajectory(encodeTrajectory(run), "run.careen");
  ASSERT_EQ(back.stage.parts.size(), 1U);
  EXPECT_EQ(back.stage.parts[0].mesh.points, mesh.points);
  EXPECT_EQ(back.stage.parts[0].mesh.triangles, mesh.triangles);
  run.stage.parts[0].mesh.triangles[0][1] = 3;
  EXPECT_NE(messageOf(encodeTrajectory(run)).find("a mesh to be drawn"), std::string::npos);
  run.stage.parts[0].body = 7;
  EXPECT_NE(messageOf(encodeTrajectory(run)).find("an unknown body"), std::string::npos);
}

// Steps of a crowd's member that go on from each other; one of them is on no grid.
TEST(TrajectoryFile, bringsBackStepsOfCrowds) {
  Trajectory run = driftAndReturn();
  run.tracks[1].segments.open().clear();
  for (int k = 0; k < 4; ++k) {
    CrowdStep step{.duration = 0.25};
    step.position = {Vec3(0, 5, 0), Vec3(0, 0, k == 2 ? 0.1 : 0x1p-30), Vec3::Zero(), Vec3(0, 0, -0.0)};
    step.worldFromBody.fill(Vec4::Zero());
    step.worldFromBody[0] = Vec4(0, 0, 0, 1);
    run.tracks[1].segments.open().push_back({.start = 0.25 * k, .motion = step});
  }
  const std::string bytes = encodeTrajectory(run);
  const Trajectory back = decodeTrajectory(bytes, "run.careen");
  EXPECT_EQ(encodeTrajectory(back), bytes);
  ASSERT_EQ(back.tracks[1].segments.size(), 4U);
  for (std::size_t k = 0; k < 4; ++k) {
    const auto step = std::get<CrowdStep>(back.tracks[1].segments[k].motion);
    EXPECT_EQ(step.position, std::get<CrowdStep>(run.tracks[1].segments[k].motion).position);
    EXPECT_TRUE(std::signbit(step.position[3].z()));
    EXPECT_EQ(back.tracks[1].segments[k].start, 0.25 * static_cast<double>(k));
  }
}

// 12,001 impacts of 89 bytes are more than a piece of 1 MiB has.
TEST(TrajectoryFile, bringsBackARunOfManyPieces) {
  Trajectory run = driftAndReturn();
  run.impacts.resize(12'001, run.impacts.front());
  for (std::size_t k = 0; k < run.impacts.size(); ++k) {
    run.impacts[k].impulse = std::sqrt(static_cast<double>(k));
  }
  const std::string bytes = encodeTrajectory(run);
  EXPECT_GE(numberAt(bytes, kRecord), std::size_t{1} << 20U);
  EXPECT_LT(numberAt(bytes, kRecord), (std::size_t{1} << 20U) + 8);
  const Trajectory back = decodeTrajectory(bytes, "run.careen");
  ASSERT_EQ(back.impacts.size(), run.impacts.size());
  EXPECT_EQ(back.impacts.back().impulse, run.impacts.back().impulse);
  EXPECT_EQ(encodeTrajectory(back), bytes);
}

// Before the length and the hash of the last state, what format version 14 has not: how the camera goes from
// key to key, by name, eight things that a scene need not say of how it is shown, and lists of titles and of
// the materials of boxes and walls.
constexpr std::size_t kSinceVersion14 = 8 + 6 + 8 + 3 * 8;

// The run in bytes as an earlier version has it, which lacks so many more, all of them 0.
std::string withoutLast(const Trajectory& run, std::uint64_t version, std::size_t more) {
  std::string record = recordOf(encodeTrajectory(run));
  const std::size_t end = record.size() - 8 - run.stateHash().size() - kSinceVersion14;
  EXPECT_EQ(record.substr(end, 14), inBytes(6) + "smooth");
  EXPECT_EQ(record.substr(end + 14, kSinceVersion14 - 14), std::string(kSinceVersion14 - 14, '\0'));
  EXPECT_EQ(record.substr(end - more, more), std::string(more, '\0'));
  record.erase(end - more, more + kSinceVersion14);
  return withRightChecksum("careen\r\n" + inBytes(version) + pieceOf(record) + "checksum");
}

// Format version 12: without two lists for each body, its boxes and the parts of its course; version 13:
// without the latter.
std::size_t sinceVersion13(const Trajectory& run) { return 8 * run.world.bodies.size(); }
std::size_t sinceVersion12(const Trajectory& run) { return 16 * run.world.bodies.size(); }

TEST(TrajectoryFile, readsWhatVersions12To14Wrote) {
  const Trajectory run = driftAndReturn();
  for (const auto& [version, more] : {std::pair(12, sinceVersion12(run)), std::pair(13, sinceVersion13(run)),
                                      std::pair(14, std::size_t{0})}) {
    const std::string bytes = withoutLast(run, static_cast<std::uint64_t>(version), more);
    EXPECT_EQ(encodeTrajectory(decodeTrajectory(bytes, "run.careen")), encodeTrajectory(run));
  }
}

TEST(TrajectoryFile, keepsTheBoxesOfABody) {
  Trajectory run = driftAndReturn();
  Body& body = run.world.bodies[0];
  const Mat3 turned = Quat(Eigen::AngleAxisd(0.5, Vec3::UnitY())).toRotationMatrix();
  setParts(body, {{.halfExtents = Vec3(0.5, 0.5, 0.1)},
                  {.halfExtents = Vec3(0.1, 0.1, 0.5),
                   .center = Vec3(0.1, 0.2, 0.3),
                   .turned = true,
                   .bodyFromPart = turned}});
  const Trajectory back = decodeTrajectory(encodeTrajectory(run), "run.careen");
  EXPECT_EQ(back.world.bodies[0].parts, body.parts);
  EXPECT_EQ(back.world.bodies[0].partCorners, body.partCorners);
  EXPECT_EQ(back.world.bodies[0].halfExtents, body.halfExtents);
}

TEST(TrajectoryFile, keepsHowFixedBoxesMove) {
  Trajectory run = driftAndReturn();
  Body door;
  door.name = "door";
  door.halfExtents = Vec3::Ones();
  door.course = courseOf({.path = {{0, Vec3::Zero()}, {0.5, Vec3::UnitX()}},
                          .angularVelocity = Vec3(0, 0, 2),
                          .about = Vec3(50, 1, 0),
                          .amplitude = Vec3(0, 0.5, 0),
                          .rate = 3,
                          .phase = 1},
                         {.position = Vec3(50, 0, 0)});
  door.initial = stateOf(door.course.front().at(0));
  run.world.bodies.push_back(door);
  run.stage.colors.emplace_back();
  run.tracks.emplace_back();
  run.tracks.back().segments = {{.start = 0, .motion = door.course[0].motion},
                                {.start = 0.5, .motion = door.course[1].motion}};
  const std::string bytes = encodeTrajectory(run);
  const Trajectory back = decodeTrajectory(bytes, "run.careen");
  EXPECT_EQ(back.world.bodies.back().course, door.course);
  EXPECT_EQ(back.stateHash(), run.stateHash());
  EXPECT_EQ(encodeTrajectory(back), bytes);
}

// Format version 11: without changes of gravity too, a list, and six numbers for each body and wall, how
// their surfaces move.
std::size_t sinceVersion11(const Trajectory& run) {
  return 8 + 48 * (run.world.bodies.size() + run.world.walls.size()) + sinceVersion12(run);
}

TEST(TrajectoryFile, readsWhatVersion11Wrote) {
  const Trajectory run = driftAndReturn();
  const std::string bytes = withoutLast(run, 11, sinceVersion11(run));
  EXPECT_EQ(encodeTrajectory(decodeTrajectory(bytes, "run.careen")), encodeTrajectory(run));
}

// Format version 10: without dry friction too, two numbers for each joint before that list.
TEST(TrajectoryFile, readsWhatVersion10Wrote) {
  Trajectory run = driftAndReturn();
  run.world.joints = {{.name = "pin", .kind = Joint::Kind::kBall, .from = {.body = 0}, .to = {}}};
  const std::string bytes = withoutLast(run, 10, 16 + sinceVersion11(run));
  EXPECT_EQ(encodeTrajectory(decodeTrajectory(bytes, "run.careen")), encodeTrajectory(run));
}

// Format version 9: without joints too, which are four lists before that one.
TEST(TrajectoryFile, readsWhatVersion9Wrote) {
  const Trajectory run = driftAndReturn();
  const std::string bytes = withoutLast(run, 9, 32 + sinceVersion11(run));
  EXPECT_EQ(encodeTrajectory(decodeTrajectory(bytes, "run.careen")), encodeTrajectory(run));
}

// Format version 8: the record in one piece without its packed size, and all segments in full.
TEST(TrajectoryFile, readsWhatVersion8Wrote) {
  const Trajectory run = driftAndReturn();
  ArchiveWriter record;
  visit(record, run);
  visit(record, run.settings.crowds);
  visitNames(record, run.stage.picture.light);
  for (const Body& body : run.world.bodies) {
    visitPlacement(record, body);
  }
  visitAll(record, run.stage.parts);
  visitResiduals(record, run.figures);
  record.visit(run.stateHash());
  const std::string bytes = withRightChecksum("careen\r\n" + inBytes(8) + inBytes(record.bytes().size()) +
                                              compressed(record.bytes()) + "checksum");
  EXPECT_EQ(encodeTrajectory(decodeTrajectory(bytes, "run.careen")), encodeTrajectory(run));
}

TEST(TrajectoryFile, savesWhatCanBeReadAgain) {
  const std::filesystem::path path = std::filesystem::path(testing::TempDir()) / "saved.careen";
  saveTrajectory(driftAndReturn(), path);
  EXPECT_EQ(readFile(path), encodeTrajectory(driftAndReturn()));
  EXPECT_EQ(readTrajectory(path).stateHash(), driftAndReturn().stateHash());
  std::filesystem::remove(path);
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

// And only a run that has such walls is of the version that knows them.
TEST(TrajectoryFile, keepsHowWallsMove) {
  Trajectory run = driftAndReturn();
  EXPECT_EQ(encodeTrajectory(run)[8], 15);
  const Course course = courseOf({.path = {{0, Vec3::Zero()}, {0.5, Vec3::UnitX()}},
                                  .angularVelocity = Vec3(0, 0, 2),
                                  .about = Vec3(50, 1, 0)},
                                 {.position = Vec3(50, 0, 0)});
  run.world.walls.push_back({.name = "door", .normal = Vec3::UnitX(), .material = {}, .course = course});
  run.stage.planes.push_back({.normal = Vec3::UnitX(), .course = course});
  const std::string bytes = encodeTrajectory(run);
  EXPECT_EQ(bytes[8], 16);
  const Trajectory back = decodeTrajectory(bytes, "run.careen");
  EXPECT_EQ(back.world.walls.back().course, course);
  EXPECT_EQ(back.stage.planes.back().course, course);
  EXPECT_EQ(encodeTrajectory(back), bytes);
}

TEST(TrajectoryFile, namesAnotherVersion) {
  std::string bytes = encodeTrajectory(driftAndReturn());
  for (const auto& [version, remedy] : {std::pair('M', "77, expected 4 to 17: a newer careen wrote it"),
                                        std::pair('\3', "3, expected 4 to 17: simulate its scene again")}) {
    bytes[8] = version;
    EXPECT_EQ(messageOf(withRightChecksum(bytes)),
              "run.careen: this trajectory file has format version " + std::string(remedy));
  }
}

TEST(TrajectoryFile, refusesAnotherKindOfFile) {
  EXPECT_FALSE(looksLikeTrajectory("{ \"careen\": 1 }"));
  EXPECT_NE(messageOf("{ \"careen\": 1 }").find("has the wrong first bytes"), std::string::npos);
}

TEST(TrajectoryFile, saysWhichFileIsMissing) {
  EXPECT_THROW(readTrajectory("no/such/run.careen"), InputError);
}

}  // namespace
}  // namespace careen
