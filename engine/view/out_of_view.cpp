#include "view/out_of_view.h"

#include <algorithm>
#include <cmath>
#include <ostream>
#include <string>
#include <vector>

#include "core/brief.h"
#include "core/characters.h"
#include "stage/time_map.h"
#include "view/camera.h"
#include "view/camera_path.h"
#include "view/scene_extent.h"

namespace careen {

OutOfView outOfView(const Trajectory& run, std::span<const double> moments) {
  const TimeMap clock = run.stage.timeMap.within(run.settings.duration);
  const double aspect = run.stage.picture.aspect();
  const CameraPath path(run, clock, aspect);
  const Extent extent = extentOf(run);
  OutOfView found;
  std::vector<bool> isOut(run.world.bodies.size());
  for (const double moment : moments) {
    const View view = viewOf(path.at(moment), extent, aspect);
    const std::vector<Pose> poses = run.poses(clock.sceneTime(moment));
    for (std::size_t box = 0; box < poses.size(); ++box) {
      const Vec4 clip = view.clipFromWorld(poses[box].position);
      const bool isIn = std::abs(clip.x()) <= clip.w() && std::abs(clip.y()) <= clip.w();
      if (!isIn && !isOut[box]) {
        isOut[box] = true;
        found.first = found.boxes == 0 ? box : found.first;
        found.moment = found.boxes == 0 ? moment : found.moment;
        ++found.boxes;
      }
    }
  }
  return found;
}

OutOfView outOfView(const Trajectory& run) {
  constexpr std::size_t kMostPoses = 200'000;  // evaluated in a fraction of a second
  const double duration = run.stage.timeMap.within(run.settings.duration).duration();
  const std::size_t bodies = std::max<std::size_t>(run.world.bodies.size(), 1);
  std::vector<double> moments(std::clamp<std::size_t>(kMostPoses / bodies, 60, 600));
  for (std::size_t i = 0; i < moments.size(); ++i) {
    moments[i] = duration * static_cast<double>(i) / static_cast<double>(moments.size() - 1);
  }
  return outOfView(run, moments);
}

void print(std::ostream& out, const OutOfView& found, const Trajectory& run) {
  if (found.boxes > 0) {
    const std::string name = printableName(run.world.bodies[found.first].name);
    out << "out of view  " << found.boxes << " of " << run.world.bodies.size()
        << (run.world.bodies.size() == 1 ? " box" : " boxes") << " at some moment: " << name << " at "
        << brief(found.moment) << " s" << (found.boxes == 1 ? "" : " first") << '\n';
  }
}

}  // namespace careen
