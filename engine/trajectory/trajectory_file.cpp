#include "trajectory/trajectory_file.h"

#include <algorithm>
#include <array>
#include <bit>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

#include "core/error.h"
#include "core/hash.h"
#include "core/names.h"
#include "core/system/file.h"
#include "physics/world/method.h"
#include "physics/world/run_settings.h"
#include "trajectory/compression.h"
#include "trajectory/run_check.h"

namespace careen {
namespace {

// The line ends in the magic word reveal a transfer in text mode.
constexpr std::string_view kMagic = "careen\r\n";
constexpr std::uint64_t kVersion = 4;
constexpr std::uint64_t kWithoutSetup = 3;  // stored only names and masses of world and stage

// Writer and Reader have the same interface, so that one description of the format, `visit` below, serves
// both and they cannot disagree.
class Writer {
 public:
  static constexpr bool kReads = false;

  template <std::unsigned_integral Integer>
  void visit(const Integer& value) {
    for (std::size_t i = 0; i < sizeof(Integer); ++i) {
      bytes_.push_back(static_cast<char>(value >> (8 * i)));
    }
  }
  void visit(const double& value) { visit(std::bit_cast<std::uint64_t>(value)); }
  void visit(const std::string& text) {
    visit(static_cast<std::uint64_t>(text.size()));
    bytes_ += text;
  }
  std::string& bytes() { return bytes_; }

 private:
  std::string bytes_;
};

class Reader {
 public:
  static constexpr bool kReads = true;

  Reader(std::string_view bytes, std::string_view name) : rest_(bytes), name_(name) {}

  template <std::unsigned_integral Integer>
  void visit(Integer& value) {
    const std::string_view bytes = take(sizeof(Integer));
    std::uint64_t bits = 0;
    for (std::size_t i = 0; i < sizeof(Integer); ++i) {
      bits |= static_cast<std::uint64_t>(static_cast<unsigned char>(bytes[i])) << (8 * i);
    }
    value = static_cast<Integer>(bits);
  }
  void visit(double& value) {
    std::uint64_t bits = 0;
    visit(bits);
    value = std::bit_cast<double>(bits);
  }
  void visit(std::string& text) {
    std::uint64_t size = 0;
    visit(size);
    text = std::string(take(size));
  }
  std::string_view rest() const { return rest_; }
  bool atEnd() const { return rest_.empty(); }
  [[noreturn]] void fail(const std::string& what) const {
    throw InputError(std::string(name_) + ": this trajectory file " + what);
  }

 private:
  std::string_view take(std::uint64_t count) {
    if (count > rest_.size()) {
      fail("is cut short");
    }
    const std::string_view taken = rest_.substr(0, count);
    rest_.remove_prefix(count);
    return taken;
  }

  std::string_view rest_;
  std::string_view name_;
};

template <class Archive, class T>
using Visited = std::conditional_t<Archive::kReads, T&, const T&>;

template <class Archive>
void visit(Archive& archive, Visited<Archive, bool> value) {
  std::uint8_t byte = value ? 1 : 0;
  archive.visit(byte);
  if constexpr (Archive::kReads) {
    value = byte != 0;
  }
}

template <class Archive>
void visit(Archive& archive, Visited<Archive, double> value) {
  archive.visit(value);
}

template <class Archive>
void visit(Archive& archive, Visited<Archive, std::string> text) {
  archive.visit(text);
}

template <class Archive>
void visitIndex(Archive& archive, Visited<Archive, int> index) {
  auto value = static_cast<std::uint32_t>(index);
  archive.visit(value);
  if constexpr (Archive::kReads) {
    index = static_cast<int>(value);
  }
}

// By name: the enumerators' values may change.
template <class Archive, class Enum, std::size_t kCount>
void visitNamed(Archive& archive, Enum& value, const std::array<std::string_view, kCount>& names) {
  std::string name;
  if constexpr (!Archive::kReads) {
    name = names.at(static_cast<std::size_t>(value));
  }
  archive.visit(name);
  if constexpr (Archive::kReads) {
    const auto known = std::find(names.begin(), names.end(), name);
    if (known == names.end()) {
      archive.fail("has '" + name + "', which this version does not know, where it expects one of " +
                   listed(names));
    }
    value = static_cast<Enum>(known - names.begin());
  }
}

// Presence flag, then the value.
template <class Archive, class T>
void visitOptional(Archive& archive, T& optional) {
  bool isThere = optional.has_value();
  visit(archive, isThere);
  if constexpr (Archive::kReads) {
    optional.reset();
    if (isThere) {
      optional.emplace();
    }
  }
  if (isThere) {
    visit(archive, *optional);
  }
}

// Count, then the elements. Read one by one, so that a corrupted count allocates no memory for missing
// elements.
template <class Archive, class T>
void visitAll(Archive& archive, T& list) {
  std::uint64_t count = list.size();
  archive.visit(count);
  if constexpr (Archive::kReads) {
    list.clear();
    for (std::uint64_t i = 0; i < count; ++i) {
      visit(archive, list.emplace_back());
    }
  } else {
    for (const auto& item : list) {
      visit(archive, item);
    }
  }
}

template <class Archive>
void visit(Archive& archive, Visited<Archive, Vec3> vector) {
  for (int i = 0; i < 3; ++i) {
    archive.visit(vector[i]);
  }
}

template <class Archive>
void visit(Archive& archive, Visited<Archive, Pose> pose) {
  visit(archive, pose.position);
  for (int column = 0; column < 3; ++column) {
    for (int row = 0; row < 3; ++row) {
      archive.visit(pose.worldFromBody(row, column));
    }
  }
}

template <class Archive>
void visit(Archive& archive, Visited<Archive, BodyState> state) {
  visit(archive, state.pose);
  visit(archive, state.velocity);
  visit(archive, state.angularMomentum);
}

template <class Archive>
void visit(Archive& archive, Visited<Archive, Rest> rest) {
  visit(archive, rest.pose);
}

template <class Archive>
void visit(Archive& archive, Visited<Archive, EulerStep> step) {
  visit(archive, step.start);
  visit(archive, step.force);
  visit(archive, step.torque);
}

template <class Archive>
void visit(Archive& archive, Visited<Archive, Flight> flight) {
  visit(archive, flight.position);
  visit(archive, flight.velocity);
  visit(archive, flight.acceleration);
  for (int i = 0; i < 4; ++i) {
    archive.visit(flight.worldFromBody.coeffs()[i]);
  }
  visit(archive, flight.angularMomentum);
}

// By name: the methods' values may change.
template <class Archive>
void visit(Archive& archive, Visited<Archive, Method> method) {
  std::string name;
  if constexpr (!Archive::kReads) {
    name = traitsOf(method).name;
  }
  archive.visit(name);
  if constexpr (Archive::kReads) {
    const std::optional<Method> known = methodNamed(name);
    if (!known) {
      archive.fail("was made by the method '" + name + "', expected one of " + listed(kMethodNames));
    }
    method = *known;
  }
}

template <class Archive>
void visit(Archive& archive, Visited<Archive, SteppedFlight> stepped) {
  visit(archive, stepped.method);
  archive.visit(stepped.dt);
  visit(archive, stepped.start);
}

template <class Archive>
void visit(Archive& archive, Visited<Archive, ContactStep> step) {
  archive.visit(step.duration);
  for (std::size_t k = 0; k < step.position.size(); ++k) {
    visit(archive, step.position[k]);
    for (int i = 0; i < 4; ++i) {
      archive.visit(step.worldFromBody[k][i]);
    }
  }
}

template <class Archive>
void visit(Archive& archive, Visited<Archive, MassProperties> mass) {
  archive.visit(mass.mass);
  archive.visit(mass.inverseMass);
  visit(archive, mass.inertiaBody);
  visit(archive, mass.inverseInertiaBody);
}

// Sets a variant to its alternative number `index`; false if there is none.
template <std::size_t kIndex = 0, class Variant>
bool emplaceAlternative(Variant& variant, std::uint64_t index) {
  if constexpr (kIndex == std::variant_size_v<Variant>) {
    return false;
  } else if (index == kIndex) {
    variant.template emplace<kIndex>();
    return true;
  } else {
    return emplaceAlternative<kIndex + 1>(variant, index);
  }
}

// Index of a variant's alternative, then its value. Indices are part of the format: append only.
template <class Archive, class Variant>
void visitVariant(Archive& archive, Variant& variant) {
  auto index = static_cast<std::uint8_t>(variant.index());
  archive.visit(index);
  if constexpr (Archive::kReads) {
    if (!emplaceAlternative(variant, index)) {
      archive.fail("holds a kind of record this version does not know");
    }
  }
  std::visit([&archive](auto& held) { visit(archive, held); }, variant);
}

template <class Archive>
void visit(Archive& archive, Visited<Archive, Motion> motion) {
  visitVariant(archive, motion);
}

template <class Archive>
void visit(Archive& archive, Visited<Archive, Segment> segment) {
  archive.visit(segment.start);
  visit(archive, segment.motion);
}

template <class Archive>
void visit(Archive& archive, Visited<Archive, BodyIndex> body) {
  visitIndex(archive, body.value);
}

// 0 for a wall or 1 for a body, then its index.
template <class Archive>
void visit(Archive& archive, Visited<Archive, Partner> partner) {
  auto kind = static_cast<std::uint8_t>(partner.isWall() ? 0 : 1);
  archive.visit(kind);
  int index = partner.isWall() ? static_cast<int>(partner.wall()) : partner.body();
  visitIndex(archive, index);
  if constexpr (Archive::kReads) {
    if (kind > 1) {
      archive.fail("holds a kind of record this version does not know");
    }
    if (index < 0) {
      archive.fail("names a body or wall it does not hold");
    }
    partner = kind == 0 ? Partner::ofWall(static_cast<std::size_t>(index)) : Partner::ofBody(index);
  }
}

template <class Archive>
void visit(Archive& archive, Visited<Archive, Impact> impact) {
  archive.visit(impact.time);
  visit(archive, impact.a);
  visit(archive, impact.b);
  visit(archive, impact.point);
  visit(archive, impact.normal);
  archive.visit(impact.approach);
  archive.visit(impact.impulse);
  archive.visit(impact.tangential);
}

template <class Archive>
void visit(Archive& archive, Visited<Archive, Material> material) {
  archive.visit(material.restitution);
  archive.visit(material.friction);
}

template <class Archive>
void visit(Archive& archive, Visited<Archive, Body> body) {
  archive.visit(body.name);
  visit(archive, body.halfExtents);
  visit(archive, body.mass);
  visit(archive, body.material);
  visit(archive, body.initial);
}

template <class Archive>
void visit(Archive& archive, Visited<Archive, Wall> wall) {
  archive.visit(wall.name);
  visit(archive, wall.normal);
  archive.visit(wall.offset);
  visit(archive, wall.material);
}

template <class Archive>
void visit(Archive& archive, Visited<Archive, int> index) {
  visitIndex(archive, index);
}

template <class Archive>
void visit(Archive& archive, Visited<Archive, SpringEnd> end) {
  visitOptional(archive, end.body);
  visit(archive, end.point);
}

template <class Archive>
void visit(Archive& archive, Visited<Archive, Spring> spring) {
  visit(archive, spring.from);
  visit(archive, spring.to);
  archive.visit(spring.stiffness);
  archive.visit(spring.damping);
  archive.visit(spring.restLength);
}

template <class Archive>
void visit(Archive& archive, Visited<Archive, Drag> drag) {
  archive.visit(drag.linear);
  archive.visit(drag.angular);
}

template <class Archive>
void visit(Archive& archive, Visited<Archive, World> world) {
  visit(archive, world.gravity);
  visitAll(archive, world.bodies);
  visitAll(archive, world.walls);
  visitAll(archive, world.springs);
  visitOptional(archive, world.drag);
}

template <class Archive>
void visit(Archive& archive, Visited<Archive, RoomShape> room) {
  visit(archive, room.min);
  visit(archive, room.max);
  for (std::size_t side = 0; side < room.open.size(); ++side) {
    visit(archive, room.open[side]);
  }
}

template <class Archive>
void visit(Archive& archive, Visited<Archive, Plane> plane) {
  visit(archive, plane.normal);
  archive.visit(plane.offset);
}

template <class Archive>
void visit(Archive& archive, Visited<Archive, Color> color) {
  archive.visit(color.red);
  archive.visit(color.green);
  archive.visit(color.blue);
}

template <class Archive>
void visit(Archive& archive, Visited<Archive, Camera> camera) {
  visit(archive, camera.eye);
  visit(archive, camera.target);
  visit(archive, camera.up);
  archive.visit(camera.fovDegrees);
}

template <class Archive>
void visit(Archive& archive, Visited<Archive, CameraKey> key) {
  archive.visit(key.time);
  visit(archive, key.eye);
  visit(archive, key.target);
  archive.visit(key.fovDegrees);
}

template <class Archive>
void visit(Archive& archive, Visited<Archive, std::size_t> index) {
  archive.visit(index);
}

template <class Archive>
void visit(Archive& archive, Visited<Archive, CameraMove> move) {
  archive.visit(move.orbitDegrees);
  visitOptional(archive, move.followed);
  visitAll(archive, move.keys);
}

template <class Archive>
void visit(Archive& archive, Visited<Archive, TimeKey> key) {
  archive.visit(key.film);
  archive.visit(key.scene);
}

template <class Archive>
void visit(Archive& archive, Visited<Archive, FrameRate> rate) {
  std::string text = rate.text();
  archive.visit(text);
  if constexpr (Archive::kReads) {
    rate = parseFrameRate(text);
  }
}

template <class Archive>
void visit(Archive& archive, Visited<Archive, OverlaySet> overlays) {
  std::string text = overlays.text();
  archive.visit(text);
  if constexpr (Archive::kReads) {
    overlays = overlaysNamed(text);
  }
}

template <class Archive>
void visit(Archive& archive, Visited<Archive, PictureSettings> picture) {
  visitIndex(archive, picture.width);
  visitIndex(archive, picture.height);
  visit(archive, picture.rate);
  visitNamed(archive, picture.look, kLooks);
  visitNamed(archive, picture.antialiasing, kAntialiasings);
  archive.visit(picture.shutter.degrees);
  visitIndex(archive, picture.shutter.samples);
  visit(archive, picture.overlays);
}

template <class Archive>
void visit(Archive& archive, Visited<Archive, Stage> stage) {
  archive.visit(stage.name);
  visitOptional(archive, stage.room);
  visitAll(archive, stage.planes);
  visitAll(archive, stage.colors);
  visitOptional(archive, stage.camera);
  visit(archive, stage.cameraMove);
  visitAll(archive, stage.timeMap.keys);
  visit(archive, stage.picture);
}

template <class Archive>
void visit(Archive& archive, Visited<Archive, PlanItem> item) {
  archive.visit(item.what);
  visit(archive, item.modelled);
  archive.visit(item.reason);
}

template <class Archive>
void visit(Archive& archive, Visited<Archive, Track> track) {
  visitAll(archive, track.segments);
}

template <class Archive>
void visit(Archive& archive, Visited<Archive, RunFigures> figures) {
  archive.visit(figures.energyChange);
  archive.visit(figures.momentumChange);
  archive.visit(figures.orthogonality);
  archive.visit(figures.deepestPenetration);
  constexpr double kNever = -1;
  double boundedFrom = figures.boundedFrom.value_or(kNever);
  archive.visit(boundedFrom);
  if constexpr (Archive::kReads) {
    figures.boundedFrom = boundedFrom >= 0 ? std::optional(boundedFrom) : std::nullopt;
  }
}

template <class Archive>
void visit(Archive& archive, Visited<Archive, RunSettings> settings) {
  visit(archive, settings.method);
  archive.visit(settings.dt);
  archive.visit(settings.tolerance);
  archive.visit(settings.duration);
}

template <class Archive>
void visitBeginning(Archive& archive, Visited<Archive, Trajectory> run) {
  archive.visit(run.sceneText);
  std::string sceneHash = run.sceneHash();
  archive.visit(sceneHash);
  visit(archive, run.settings);
  visit(archive, run.figures);
}

template <class Archive>
void visit(Archive& archive, Visited<Archive, Trajectory> run) {
  visitBeginning(archive, run);
  visit(archive, run.world);
  visit(archive, run.stage);
  visitAll(archive, run.plan.items);
  visitAll(archive, run.tracks);
  visitAll(archive, run.impacts);
}

bool isSame(const MassProperties& a, const MassProperties& b) {
  return a.mass == b.mass && a.inverseMass == b.inverseMass && a.inertiaBody == b.inertiaBody &&
         a.inverseInertiaBody == b.inverseInertiaBody;
}

// An old file's bodies and walls must match its scene. Initial positions come from the tracks alone:
// overlapping boxes had been moved apart.
void takeSetup(const Reader& reader, RunSetup setup, const std::vector<std::string>& wallNames,
               const std::vector<Body>& bodies, Trajectory& run) {
  if (setup.world.bodies.size() != bodies.size()) {
    reader.fail("has " + std::to_string(bodies.size()) + " bodies, its scene " +
                std::to_string(setup.world.bodies.size()));
  }
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    Body& body = setup.world.bodies[i];
    if (body.name != bodies[i].name) {
      reader.fail("has a body '" + bodies[i].name + "' where its scene has '" + body.name + "'");
    }
    if (!isSame(body.mass, bodies[i].mass)) {
      reader.fail("has another mass or inertia of body '" + body.name + "' than its scene gives that box");
    }
  }
  const bool sameWalls =
      std::equal(wallNames.begin(), wallNames.end(), setup.world.walls.begin(), setup.world.walls.end(),
                 [](const std::string& name, const Wall& wall) { return name == wall.name; });
  if (!sameWalls) {
    reader.fail("has other walls than its scene");
  }
  run.world = std::move(setup.world);
  run.stage = std::move(setup.stage);
  run.plan = std::move(setup.plan);
}

void startWhereTracksDo(Trajectory& run) {
  checkMotions(run);
  for (std::size_t body = 0; body < run.tracks.size(); ++body) {
    run.world.bodies[body].initial = run.state(body, 0);
  }
}

void readWithoutSetup(Reader& reader, const SetupReader& setupOf, Trajectory& run) {
  visitBeginning(reader, run);
  std::vector<std::string> wallNames;
  visitAll(reader, wallNames);
  std::vector<Body> bodies;
  std::uint64_t count = 0;
  reader.visit(count);
  for (std::uint64_t i = 0; i < count; ++i) {
    Body& body = bodies.emplace_back();
    reader.visit(body.name);
    visit(reader, body.mass);
    visitAll(reader, run.tracks.emplace_back().segments);
  }
  visitAll(reader, run.impacts);
  if (!setupOf) {
    reader.fail("has format version " + std::to_string(kWithoutSetup) +
                ", which takes its scene to complete it; expected " + std::to_string(kVersion));
  }
  takeSetup(reader, setupOf(run.sceneText, run.settings), wallNames, bodies, run);
}

std::uint64_t checksum(std::string_view bytes) {
  Hash hash;
  hash.add(bytes);
  return hash.value();
}

}  // namespace

std::string encodeTrajectory(const Trajectory& trajectory) {
  Writer record;
  visit(record, trajectory);
  record.visit(trajectory.stateHash());
  Writer file;
  file.bytes() += kMagic;
  file.visit(kVersion);
  file.visit(static_cast<std::uint64_t>(record.bytes().size()));
  file.bytes() += compressed(record.bytes());
  file.visit(checksum(file.bytes()));
  return std::move(file.bytes());
}

bool looksLikeTrajectory(const std::string& bytes) { return bytes.starts_with(kMagic); }

Trajectory decodeTrajectory(const std::string& bytes, const std::string& name, const SetupReader& setupOf) {
  Reader reader(bytes, name);
  if (!looksLikeTrajectory(bytes)) {
    reader.fail("does not begin as one: expected a file written by 'careen simulate'");
  }
  if (bytes.size() < kMagic.size() + 3 * sizeof(std::uint64_t)) {
    reader.fail("is cut short");
  }
  const std::string_view body = std::string_view(bytes).substr(0, bytes.size() - sizeof(std::uint64_t));
  reader = Reader(body.substr(kMagic.size()), name);
  std::uint64_t version = 0;
  reader.visit(version);
  if (version != kVersion && version != kWithoutSetup) {
    reader.fail("has format version " + std::to_string(version) + ", expected " + std::to_string(kVersion));
  }
  std::uint64_t expected = 0;
  Reader(std::string_view(bytes).substr(body.size()), name).visit(expected);
  if (checksum(body) != expected) {
    reader.fail("is cut short or damaged: its checksum does not match");
  }
  std::uint64_t size = 0;
  reader.visit(size);
  const std::optional<std::string> record = decompressed(reader.rest(), size);
  if (!record) {
    reader.fail("is damaged: its record cannot be unpacked");
  }
  reader = Reader(*record, name);
  Trajectory trajectory;
  std::string stateHash;
  if (version == kWithoutSetup) {
    readWithoutSetup(reader, setupOf, trajectory);
  } else {
    visit(reader, trajectory);
  }
  reader.visit(stateHash);
  if (!reader.atEnd()) {
    reader.fail("goes on after its end");
  }
  try {
    if (version == kWithoutSetup) {
      startWhereTracksDo(trajectory);
    }
    checkRun(trajectory);
  } catch (const InputError& error) {
    reader.fail(error.what());
  }
  if (stateHash != trajectory.stateHash()) {
    reader.fail(
        "ends in another state than its hash says: it was made by a version that moves bodies otherwise");
  }
  return trajectory;
}

Trajectory readTrajectory(const std::filesystem::path& path) {
  return decodeTrajectory(readFile(path), path.string());
}

}  // namespace careen
