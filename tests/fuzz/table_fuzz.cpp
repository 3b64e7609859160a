// Tables of poses: CSV, NPZ, and single arrays of NumPy, which the checksums of ZIP would keep from being
// mutated.

#include "audit/audit.h"
#include "fuzz/fuzz.h"
#include "scene/plan.h"
#include "scene/scene_reader.h"
#include "trajectory/given_run.h"
#include "trajectory/numpy_array.h"
#include "trajectory/pose_table.h"

namespace careen {
namespace {

RunSetup setup() {
  return setupOf(parseScene(R"({"careen": 1, "duration": 1, "gravity": [0, 0, -10],
    "walls": [{"point": [0, 0, 0], "normal": [0, 0, 1]}],
    "boxes": [{"name": "crate", "half_extents": [0.3, 0.2, 0.1], "mass": 1, "position": [0, 0, 1]},
              {"name": "table", "half_extents": [1, 1, 0.5], "fixed": true, "position": [0, 5, 0.5]}]})",
                            "scene"));
}

}  // namespace
}  // namespace careen

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace careen;
  const std::string bytes(fuzz::textOf(data, size));
  fuzz::refusesOrReads([&] {
    if (bytes.starts_with("\x93NUMPY")) {
      decodeNumpy(bytes, "array");
      return;
    }
    static_cast<void>(looksLikePoseTable(bytes, "table"));
    const PoseTable table = readPoseTable(bytes, "table");
    const Trajectory run = givenRun(setup(), table);
    for (int k = 0; k <= 4; ++k) {
      run.poses(run.settings.duration * k / 4);
    }
    audit(run, AuditDepth::kUsual);
  });
  return 0;
}
