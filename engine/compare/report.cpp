#include "compare/report.h"

#include <system_error>

#include "core/error.h"
#include "core/system/file.h"

namespace careen {

void writeReport(const std::filesystem::path& folder, const Comparison& comparison) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error) {
    throw MachineError(folder.string() + ": cannot make this folder: " + error.message());
  }
  const std::string page = reportPage(comparison);
  writeFile(folder / "report.json", reportJson(comparison) + "\n");
  writeFile(folder / kJunitName, reportJunit(comparison));
  writeFile(folder / "index.html", page);
}

}  // namespace careen
