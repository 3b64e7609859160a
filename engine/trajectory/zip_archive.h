#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace careen {

/// Name and bytes of a file in a ZIP archive.
using ZipEntry = std::pair<std::string, std::string>;

/// Whether the bytes begin as a ZIP archive does.
bool looksLikeZip(std::string_view bytes);

/// A ZIP archive with these entries, stored without compression and without the time of day: the same
/// entries make the same bytes. MachineError if libzip fails.
std::string zipOf(const std::vector<ZipEntry>& entries);

/// The entries of an archive, in its order. InputError, which names the file, if it is damaged or cut short,
/// or would take more than 64 times its own size and 16 MiB when unpacked.
std::vector<ZipEntry> unzipped(std::string_view bytes, const std::string& name);

}  // namespace careen
