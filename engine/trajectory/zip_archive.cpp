#include "trajectory/zip_archive.h"

#include <zip.h>

#include <cstdint>
#include <memory>

#include "core/error.h"
#include "trajectory/compression.h"

namespace careen {
namespace {

constexpr std::size_t kAlwaysAllowed = 16 << 20;  // [bytes]
constexpr zip_uint16_t kFirstDay = 0x21;          // 1980-01-01, where DOS begins to count

struct Discard {
  void operator()(zip_t* archive) const { zip_discard(archive); }
};
using Archive = std::unique_ptr<zip_t, Discard>;

struct CloseFile {
  void operator()(zip_file_t* file) const { zip_fclose(file); }
};

struct FreeSource {
  void operator()(zip_source_t* source) const { zip_source_free(source); }
};
using Source = std::unique_ptr<zip_source_t, FreeSource>;

std::string textOf(zip_error_t& error) {
  std::string text = zip_error_strerror(&error);
  zip_error_fini(&error);
  return text;
}

[[noreturn]] void failToWrite(const std::string& why) {
  throw MachineError("a ZIP archive cannot be made: " + why);
}

std::string readEntry(zip_t* archive, zip_uint64_t index, std::size_t most, const std::string& name) {
  const std::unique_ptr<zip_file_t, CloseFile> file(zip_fopen_index(archive, index, 0));
  if (!file) {
    throw InputError(name + ": is damaged: " + zip_strerror(archive));
  }
  std::string bytes;
  constexpr std::size_t kPiece = 1 << 16;
  while (true) {
    const std::size_t before = bytes.size();
    bytes.resize(before + kPiece);
    const zip_int64_t read = zip_fread(file.get(), bytes.data() + before, kPiece);
    if (read < 0) {
      throw InputError(name + ": is damaged: " + zip_file_strerror(file.get()));
    }
    bytes.resize(before + static_cast<std::size_t>(read));
    if (bytes.size() > most) {
      throw InputError(name + ": unpacks to more than 64 times its size, expected a table of poses");
    }
    if (read == 0) {
      return bytes;
    }
  }
}

}  // namespace

bool looksLikeZip(std::string_view bytes) {
  // The second is that of an archive without entries.
  return bytes.starts_with("PK\x03\x04") || bytes.starts_with("PK\x05\x06");
}

std::string zipOf(const std::vector<ZipEntry>& entries) {
  zip_error_t error;
  zip_error_init(&error);
  const Source target(zip_source_buffer_create(nullptr, 0, 0, &error));
  if (!target) {
    failToWrite(textOf(error));
  }
  zip_source_keep(target.get());  // for reading it after the archive, which frees its own, is closed
  Archive archive(zip_open_from_source(target.get(), ZIP_TRUNCATE, &error));
  if (!archive) {
    zip_source_free(target.get());
    failToWrite(textOf(error));
  }
  for (const auto& [name, bytes] : entries) {
    zip_source_t* const source = zip_source_buffer(archive.get(), bytes.data(), bytes.size(), 0);
    const zip_int64_t index =
        source == nullptr ? -1 : zip_file_add(archive.get(), name.c_str(), source, ZIP_FL_ENC_UTF_8);
    if (index < 0) {
      zip_source_free(source);
      failToWrite(zip_strerror(archive.get()));
    }
    const auto place = static_cast<zip_uint64_t>(index);
    if (zip_set_file_compression(archive.get(), place, ZIP_CM_STORE, 0) != 0 ||
        zip_file_set_dostime(archive.get(), place, 0, kFirstDay, 0) != 0) {
      failToWrite(zip_strerror(archive.get()));
    }
  }
  if (zip_close(archive.get()) != 0) {
    failToWrite(zip_strerror(archive.get()));
  }
  archive.release();  // NOLINT(bugprone-unused-return-value): zip_close has freed it
  zip_stat_t stat;
  zip_stat_init(&stat);
  if (zip_source_stat(target.get(), &stat) != 0 || zip_source_open(target.get()) != 0) {
    failToWrite(zip_error_strerror(zip_source_error(target.get())));
  }
  std::string bytes(stat.size, '\0');
  const zip_int64_t read = zip_source_read(target.get(), bytes.data(), bytes.size());
  zip_source_close(target.get());
  if (read != static_cast<zip_int64_t>(bytes.size())) {
    failToWrite("it cannot be read back");
  }
  return bytes;
}

std::vector<ZipEntry> unzipped(std::string_view bytes, const std::string& name) {
  zip_error_t error;
  zip_error_init(&error);
  if (bytes.empty()) {  // to libzip an archive without entries
    throw InputError(name + ": is empty, expected a ZIP archive");
  }
  zip_source_t* const source = zip_source_buffer_create(bytes.data(), bytes.size(), 0, &error);
  if (source == nullptr) {
    throw MachineError(name + ": cannot be unpacked: " + textOf(error));
  }
  const Archive archive(zip_open_from_source(source, ZIP_RDONLY | ZIP_CHECKCONS, &error));
  if (!archive) {
    zip_source_free(source);
    throw InputError(name + ": is no whole ZIP archive: " + textOf(error) + "; the file may be cut short");
  }
  std::size_t left = kMostRatio * bytes.size() + kAlwaysAllowed;
  std::vector<ZipEntry> entries;
  const zip_int64_t count = zip_get_num_entries(archive.get(), 0);
  for (zip_int64_t k = 0; k < count; ++k) {
    const auto index = static_cast<zip_uint64_t>(k);
    const char* const entry = zip_get_name(archive.get(), index, ZIP_FL_ENC_GUESS);
    if (entry == nullptr) {
      throw InputError(name + ": is damaged: " + zip_strerror(archive.get()));
    }
    std::string content = readEntry(archive.get(), index, left, name);
    left -= content.size();
    entries.emplace_back(entry, std::move(content));
  }
  return entries;
}

}  // namespace careen
