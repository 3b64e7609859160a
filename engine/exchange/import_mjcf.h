#pragma once

#include <string>
#include <vector>

namespace careen {

struct ImportedScene {
  std::string text;                ///< a scene file
  std::vector<std::string> notes;  ///< what was ignored, left open or renamed, in words
};

inline constexpr double kImportedDuration = 10;  ///< [s] MJCF has none

/// A model of MuJoCo (MJCF) as a scene: planes as walls, boxes without joint as fixed boxes, bodies that move
/// as boxes of one or several parts that collide, with their joints to the bodies that they are in and those
/// of <equality>, with the masses, inertias, poses and classes of defaults that MuJoCo gives them, in frames,
/// copies (exchange/mjcf_replicate.h) and included files (exchange/mjcf_include.h) too; tendons between two
/// sites as springs, ropes and rods, actuators that follow something as motors (exchange/mjcf_links.h),
/// damping of free joints as drag, and the start of the key frame "start" if there is one. Coefficients of
/// friction are such that each pair has the friction that it has in MuJoCo (exchange/friction_fit.h). There
/// is no restitution in MJCF. Anything else that would change the motion is refused: InputError
/// "file:line:column: found …, expected …". What only tells MuJoCo how to compute or draw is noted. `name` is
/// the file's name in messages, beside which included files are looked for.
ImportedScene importMjcf(const std::string& text, const std::string& name);

}  // namespace careen
