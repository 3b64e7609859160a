#include "compare/report.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "comparisons.h"
#include "core/error.h"
#include "support/process.h"

namespace careen {
namespace {

TEST(Report, writesThreeWholeFilesAndNothingElse) {
  const TemporaryFolder folder;
  writeReport(folder / "new/report", filmComparison(folder.path(), 2, 1, 1));
  EXPECT_EQ(textOf(folder / "new/report/report.json").substr(0, 2), "{\n");
  std::vector<std::string> written;
  for (const std::string& file : folder.files()) {
    if (file.starts_with("new/report/")) {
      written.push_back(file.substr(11));
    }
  }
  EXPECT_EQ(written, (std::vector<std::string>{"index.html", "junit.xml", "report.json"}));
}

TEST(Report, failsWhereItCannotBeWritten) {
  const TemporaryFolder folder;
  folder.write("file", "");
  EXPECT_THROW(writeReport(folder / "file/report", filmComparison(folder.path(), 1, 1, 1)), MachineError);
}

}  // namespace
}  // namespace careen
