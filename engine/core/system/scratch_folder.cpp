#include "core/system/scratch_folder.h"

#include <stdlib.h>  // mkdtemp

#include <cerrno>
#include <cstring>
#include <string>
#include <system_error>

#include "core/error.h"

namespace careen {

ScratchFolder::ScratchFolder() {
  std::error_code error;
  const std::filesystem::path all = std::filesystem::temp_directory_path(error);
  std::string name = (all / "careen-XXXXXX").string();
  if (error || mkdtemp(name.data()) == nullptr) {
    throw MachineError("no folder for temporary files can be made: " +
                       (error ? error.message() : std::strerror(errno)));
  }
  path_ = name;
}

ScratchFolder::~ScratchFolder() {
  std::error_code ignored;
  std::filesystem::remove_all(path_, ignored);
}

}  // namespace careen
