#include "trajectory/trajectory_file.h"

#include <bit>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>
#include <type_traits>
#include <utility>
#include <variant>

#include "core/error.h"
#include "core/hash.h"
#include "core/system/file.h"
#include "trajectory/compression.h"

namespace careen {
namespace {

// The line ends in the magic word show a transfer that took the file for text.
constexpr std::string_view kMagic = "careen\r\n";
constexpr std::uint64_t kVersion = 3;

// Writer and Reader have the same calls, so that one description of the format, `visit` below, serves both
// and the two cannot disagree.
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
  /// A count of things of at least `bytesEach` bytes: a damaged one must not ask for all the memory there is.
  std::size_t checkedCount(std::uint64_t count, std::uint64_t bytesEach) const {
    if (count > rest_.size() / bytesEach) {
      fail("is cut short");
    }
    return count;
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

// By name: the numbers of the methods may change.
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
      archive.fail("was made by the method '" + name + "', which this version does not know");
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

// Makes a variant hold its alternative number `index`; false if it has none such.
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

// Which alternative a variant holds, then that alternative. The numbers are part of the format: append only.
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
void visitIndex(Archive& archive, Visited<Archive, int> index) {
  auto value = static_cast<std::uint32_t>(index);
  archive.visit(value);
  if constexpr (Archive::kReads) {
    index = static_cast<int>(value);
  }
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
void visit(Archive& archive, Visited<Archive, std::string> text) {
  archive.visit(text);
}

// A count, then the things. The smallest of them takes 8 bytes.
template <class Archive, class T>
void visitAll(Archive& archive, T& list) {
  std::uint64_t count = list.size();
  archive.visit(count);
  if constexpr (Archive::kReads) {
    list.resize(archive.checkedCount(count, sizeof(std::uint64_t)));
  }
  for (auto& item : list) {
    visit(archive, item);
  }
}

template <class Archive>
void visit(Archive& archive, Visited<Archive, Track> track) {
  archive.visit(track.name);
  visit(archive, track.mass);
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
void visit(Archive& archive, Visited<Archive, Trajectory> trajectory) {
  archive.visit(trajectory.sceneText);
  std::string sceneHash = trajectory.sceneHash();
  archive.visit(sceneHash);
  visit(archive, trajectory.settings);
  visit(archive, trajectory.figures);
  visitAll(archive, trajectory.wallNames);
  visitAll(archive, trajectory.tracks);
  visitAll(archive, trajectory.impacts);
}

std::uint64_t checksum(std::string_view bytes) {
  Hash hash;
  hash.add(bytes);
  return hash.value();
}

// A file can be whole and yet make no sense; nothing later should have to ask.
void checkIndices(const Trajectory& trajectory, const Reader& reader) {
  const auto within = [](int index, std::size_t size) {
    return index >= 0 && static_cast<std::size_t>(index) < size;
  };
  for (const Impact& impact : trajectory.impacts) {
    const bool partner = impact.b.isWall() ? impact.b.wall() < trajectory.wallNames.size()
                                           : within(impact.b.body(), trajectory.tracks.size());
    if (!partner || !within(impact.a.value, trajectory.tracks.size())) {
      reader.fail("names a body or wall it does not hold");
    }
  }
  for (const Track& track : trajectory.tracks) {
    if (track.segments.empty() || track.segments.front().start > 0) {
      reader.fail("does not tell where body '" + track.name + "' begins");
    }
  }
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

Trajectory decodeTrajectory(const std::string& bytes, const std::string& name) {
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
  if (version != kVersion) {
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
  visit(reader, trajectory);
  reader.visit(stateHash);
  if (!reader.atEnd()) {
    reader.fail("goes on after its end");
  }
  checkIndices(trajectory, reader);
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
