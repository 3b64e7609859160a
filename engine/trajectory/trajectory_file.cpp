#include "trajectory/trajectory_file.h"

#include <cstdint>
#include <optional>
#include <string_view>
#include <utility>

#include "core/error.h"
#include "core/hash.h"
#include "core/system/file.h"
#include "trajectory/archive.h"
#include "trajectory/compression.h"
#include "trajectory/joint_format.h"
#include "trajectory/packed_steps.h"
#include "trajectory/run_check.h"
#include "trajectory/scenery_format.h"
#include "trajectory/trajectory_format.h"

namespace careen {
namespace {

// The line ends in the magic word reveal a transfer in text mode.
constexpr std::string_view kFileMagic = "careen\r\n";
constexpr std::uint64_t kVersion = 17;
constexpr std::uint64_t kVersionWithoutCrowds = 4;  // the oldest that is read
constexpr std::uint64_t kVersionWithoutLight = 5;
constexpr std::uint64_t kVersionWithoutPlacement = 6;
constexpr std::uint64_t kVersionWithoutResiduals = 7;
constexpr std::uint64_t kVersionInOnePiece = 8;
constexpr std::uint64_t kVersionWithoutJoints = 9;
constexpr std::uint64_t kVersionWithoutGrips = 10;
constexpr std::uint64_t kVersionOfOneGravity = 11;  // and of surfaces that are still
constexpr std::uint64_t kVersionOfOneBox = 12;      // for each body
constexpr std::uint64_t kVersionWithoutCourses = 13;
constexpr std::uint64_t kVersionWithoutScenery = 14;
constexpr std::uint64_t kVersionOfStillWalls = 15;
constexpr std::uint64_t kVersionOfSteps = 16;  // in gravity

// A run since format version 9.
template <class Archive>
void visitPacked(Archive& archive, Visited<Archive, Trajectory> run) {
  visitStart(archive, run);
  std::uint64_t count = run.tracks.size();
  archive.visit(count);
  for (std::uint64_t k = 0; k < count; ++k) {
    if constexpr (Archive::kReads) {
      run.tracks.emplace_back();
    }
    visitPacked(archive, run.tracks[k]);
  }
  visitAll(archive, run.impacts);
}

// Flights have a jerk where gravity slopes.
template <class Archive>
void visitSlopes(Archive& archive, Visited<Archive, Trajectory> run) {
  if constexpr (Archive::kReads) {
    run.world.gravityPath = GravityPath::kLinear;
  }
  for (auto& track : run.tracks) {
    const auto visitJerk = [&](auto& segment) {
      if (auto* flight = std::get_if<Flight>(&segment.motion)) {
        visit(archive, flight->jerk);
      }
    };
    if constexpr (Archive::kReads) {
      for (Segment& segment : track.segments.open()) {
        visitJerk(segment);
      }
    } else {
      for (const Segment& segment : track.segments) {
        visitJerk(segment);
      }
    }
  }
}

// All but the hash of the last state, as that version has it.
template <class Archive>
void visitRecord(Archive& archive, Visited<Archive, Trajectory> run, std::uint64_t version) {
  if (version > kVersionInOnePiece) {
    visitPacked(archive, run);
  } else {
    visit(archive, run);
  }
  if (version > kVersionWithoutCrowds) {
    visit(archive, run.settings.crowds);
  }
  if (version > kVersionWithoutLight) {
    visitNames(archive, run.stage.picture.light);
  }
  if (version > kVersionWithoutPlacement) {
    for (auto& body : run.world.bodies) {
      visitPlacement(archive, body);
    }
    visitAll(archive, run.stage.parts);
  }
  if (version > kVersionWithoutResiduals) {
    visitResiduals(archive, run.figures);
  }
  if (version > kVersionInOnePiece) {
    visitTime(archive, run.figures.horizon);
  }
  if (version > kVersionWithoutJoints) {
    visitAll(archive, run.world.joints);
    visitAll(archive, run.world.apart);
    visitAll(archive, run.jointImpulses);
    visitAll(archive, run.jointEfforts);
  }
  if (version > kVersionWithoutGrips) {
    for (auto& joint : run.world.joints) {
      visitGrip(archive, joint);
    }
  }
  if (version > kVersionOfOneGravity) {
    visitAll(archive, run.world.gravityChanges);
    for (auto& body : run.world.bodies) {
      visitSurface(archive, body.material);
    }
    for (auto& wall : run.world.walls) {
      visitSurface(archive, wall.material);
    }
  }
  if (version > kVersionOfOneBox) {
    for (auto& body : run.world.bodies) {
      visitParts(archive, body);
    }
  }
  if (version > kVersionWithoutCourses) {
    for (auto& body : run.world.bodies) {
      visitAll(archive, body.course);
    }
  }
  if (version > kVersionWithoutScenery) {
    visitScenery(archive, run.stage);
  }
  if (version > kVersionOfStillWalls) {
    for (auto& wall : run.world.walls) {
      visitAll(archive, wall.course);
    }
    for (auto& plane : run.stage.planes) {
      visitAll(archive, plane.course);
    }
  }
  if (version > kVersionOfSteps) {
    visitSlopes(archive, run);
  }
}

// Older programs read runs without what they do not know.
std::uint64_t versionOf(const Trajectory& run) {
  if (run.world.gravityPath == GravityPath::kLinear) {
    return kVersion;
  }
  const auto moves = [](const auto& each) { return !each.course.empty(); };
  return std::any_of(run.world.walls.begin(), run.world.walls.end(), moves) ||
                 std::any_of(run.stage.planes.begin(), run.stage.planes.end(), moves)
             ? kVersionOfSteps
             : kVersionOfStillWalls;
}

/// What the file wraps: the record, packed, and the version of its format.
struct Unwrapped {
  std::uint64_t version = 0;
  std::string_view packed;
};

Unwrapped unwrapped(const std::string& bytes, const std::string& name) {
  ArchiveReader reader(bytes, name);
  if (!looksLikeTrajectory(bytes)) {
    reader.fail("has the wrong first bytes, expected a file written by 'careen simulate'");
  }
  if (bytes.size() < kFileMagic.size() + 3 * sizeof(std::uint64_t)) {
    reader.fail("is cut short");
  }
  const std::string_view body = std::string_view(bytes).substr(0, bytes.size() - sizeof(std::uint64_t));
  reader = ArchiveReader(body.substr(kFileMagic.size()), name);
  Unwrapped file;
  reader.visit(file.version);
  if (file.version < kVersionWithoutCrowds || file.version > kVersion) {
    reader.fail("has format version " + std::to_string(file.version) + ", expected " +
                std::to_string(kVersionWithoutCrowds) + " to " + std::to_string(kVersion) +
                (file.version > kVersion ? ": a newer careen wrote it" : ": simulate its scene again"));
  }
  std::uint64_t expected = 0;
  ArchiveReader(std::string_view(bytes).substr(body.size()), name).visit(expected);
  Hash checksum;
  checksum.add(body);
  if (checksum.value() != expected) {
    reader.fail("is cut short or damaged: its checksum does not match");
  }
  file.packed = reader.rest();
  return file;
}

/// Unpacks a record piece by piece.
class RecordPieces {
 public:
  RecordPieces(const Unwrapped& file, const std::string& name)
      : reader_(file.packed, name), inOnePiece_(file.version <= kVersionInOnePiece) {}

  std::string_view next() {
    if (reader_.atEnd()) {
      return {};
    }
    std::uint64_t size = 0;
    std::uint64_t packedSize = 0;
    reader_.visit(size);
    if (inOnePiece_) {
      packedSize = reader_.rest().size();
    } else {
      reader_.visit(packedSize);
    }
    std::optional<std::string> piece = decompressed(reader_.take(packedSize), size);
    if (!piece || piece->empty()) {
      reader_.fail("is damaged: its record cannot be unpacked");
    }
    piece_ = std::move(*piece);
    return piece_;
  }

 private:
  ArchiveReader reader_;
  bool inOnePiece_;
  std::string piece_;
};

}  // namespace

void writeTrajectory(const Trajectory& trajectory, const TextSink& sink) {
  Hash checksum;
  ArchiveWriter file([&](std::string_view bytes) {
    checksum.add(bytes);
    sink(bytes);
  });
  file.bytes() += kFileMagic;
  const std::uint64_t version = versionOf(trajectory);
  file.visit(version);
  ArchiveWriter record([&](std::string_view piece) {
    file.visit(static_cast<std::uint64_t>(piece.size()));
    file.visit(compressed(piece));
  });
  visitRecord(record, trajectory, version);
  record.visit(trajectory.stateHash());
  record.handOn();
  file.handOn();
  ArchiveWriter last;
  last.visit(checksum.value());
  sink(last.bytes());
}

std::string encodeTrajectory(const Trajectory& trajectory) {
  std::string bytes;
  writeTrajectory(trajectory, [&](std::string_view piece) { bytes += piece; });
  return bytes;
}

bool looksLikeTrajectory(const std::string& bytes) { return bytes.starts_with(kFileMagic); }

Trajectory decodeTrajectory(const std::string& bytes, const std::string& name) {
  const Unwrapped file = unwrapped(bytes, name);
  RecordPieces pieces(file, name);
  ArchiveReader reader([&] { return pieces.next(); }, name);
  Trajectory trajectory;
  visitRecord(reader, trajectory, file.version);
  std::string stateHash;
  reader.visit(stateHash);
  if (!reader.atEnd()) {
    reader.fail("has bytes after its end");
  }
  try {
    checkRun(trajectory);
  } catch (const InputError& error) {
    reader.fail(error.what());
  }
  if (stateHash != trajectory.stateHash()) {
    reader.fail(
        "ends in a state that does not match its hash: another version of the program computed its motion");
  }
  return trajectory;
}

Trajectory readTrajectory(const std::filesystem::path& path) {
  return decodeTrajectory(readFile(path), path.string());
}

void saveTrajectory(const Trajectory& trajectory, const std::filesystem::path& path) {
  AtomicFile file(path);
  writeTrajectory(trajectory, [&](std::string_view bytes) { file.write(bytes); });
  file.commit();
}

}  // namespace careen
