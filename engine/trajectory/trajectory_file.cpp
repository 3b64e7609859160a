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
#include "trajectory/run_check.h"
#include "trajectory/trajectory_format.h"

namespace careen {
namespace {

// The line ends in the magic word reveal a transfer in text mode.
constexpr std::string_view kFileMagic = "careen\r\n";
constexpr std::uint64_t kVersion = 9;
constexpr std::uint64_t kVersionWithoutCrowds = 4;  // the oldest that is read
constexpr std::uint64_t kVersionWithoutLight = 5;
constexpr std::uint64_t kVersionWithoutPlacement = 6;
constexpr std::uint64_t kVersionWithoutResiduals = 7;
constexpr std::uint64_t kVersionWithoutHorizon = 8;

std::uint64_t checksum(std::string_view bytes) {
  Hash hash;
  hash.add(bytes);
  return hash.value();
}

/// What the file wraps: the record and the version of its format.
struct Unwrapped {
  std::uint64_t version = 0;
  std::string record;
};

std::string unpacked(ArchiveReader& reader) {
  std::uint64_t size = 0;
  reader.visit(size);
  std::optional<std::string> record = decompressed(reader.rest(), size);
  if (!record) {
    reader.fail("is damaged: its record cannot be unpacked");
  }
  return std::move(*record);
}

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
  if (checksum(body) != expected) {
    reader.fail("is cut short or damaged: its checksum does not match");
  }
  file.record = unpacked(reader);
  return file;
}

}  // namespace

std::string encodeTrajectory(const Trajectory& trajectory) {
  ArchiveWriter record;
  visit(record, trajectory);
  visit(record, trajectory.settings.crowds);
  visitNames(record, trajectory.stage.picture.light);
  for (const Body& body : trajectory.world.bodies) {
    visitPlacement(record, body);
  }
  visitAll(record, trajectory.stage.parts);
  visitResiduals(record, trajectory.figures);
  visitHorizon(record, trajectory.figures);
  record.visit(trajectory.stateHash());
  ArchiveWriter file;
  file.bytes() += kFileMagic;
  file.visit(kVersion);
  file.visit(static_cast<std::uint64_t>(record.bytes().size()));
  file.bytes() += compressed(record.bytes());
  file.visit(checksum(file.bytes()));
  return std::move(file.bytes());
}

bool looksLikeTrajectory(const std::string& bytes) { return bytes.starts_with(kFileMagic); }

Trajectory decodeTrajectory(const std::string& bytes, const std::string& name) {
  const Unwrapped file = unwrapped(bytes, name);
  ArchiveReader reader(file.record, name);
  Trajectory trajectory;
  visit(reader, trajectory);
  if (file.version > kVersionWithoutCrowds) {
    visit(reader, trajectory.settings.crowds);
  }
  if (file.version > kVersionWithoutLight) {
    visitNames(reader, trajectory.stage.picture.light);
  }
  if (file.version > kVersionWithoutPlacement) {
    for (Body& body : trajectory.world.bodies) {
      visitPlacement(reader, body);
    }
    visitAll(reader, trajectory.stage.parts);
  }
  if (file.version > kVersionWithoutResiduals) {
    visitResiduals(reader, trajectory.figures);
  }
  if (file.version > kVersionWithoutHorizon) {
    visitHorizon(reader, trajectory.figures);
  }
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

}  // namespace careen
