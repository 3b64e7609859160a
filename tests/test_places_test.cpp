// Which test is of which source: tests know their sources, and sources their tests.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <iostream>
#include <map>
#include <string>

#include "support/layout.h"
#include "support/source_text.h"

namespace careen {
namespace {

namespace fs = std::filesystem;
using layout::kMayInclude;
using layout::kRooms;
using layout::Names;
using source_text::kRoot;
using source_text::sourcesIn;
using source_text::textOf;

Names stemsIn(const fs::path& folder, bool tests) {
  Names stems;
  if (!fs::exists(folder)) {
    return stems;
  }
  for (const fs::directory_entry& entry : fs::directory_iterator(folder)) {
    const std::string stem = entry.path().stem().string();
    const bool isSource = entry.path().extension() == ".h" || entry.path().extension() == ".cpp";
    if (isSource && stem.ends_with("_test") == tests) {
      stems.insert(stem);
    }
  }
  return stems;
}

/// Which of the sources a test is of: <file>_test.cpp, or <file>_<aspect>_test.cpp where one has several. The
/// longest name counts: folder_lock_test is of folder_lock, not of folder. "" if it is of none.
std::string sourceOf(const std::string& test, const Names& sources) {
  std::string longest;
  for (const std::string& source : sources) {
    if (test.starts_with(source + "_") && source.size() > longest.size()) {
      longest = source;
    }
  }
  return longest;
}

// The source may be the tests' own.
TEST(TestPlaces, everyTestLiesWhereItsSourceDoes) {
  std::size_t checked = 0;
  for (const auto& [folder, mayInclude] : kMayInclude) {
    Names places = {""};
    if (kRooms.contains(folder)) {
      for (const auto& [room, others] : kRooms.at(folder)) {
        places.insert(room);
      }
    }
    for (const fs::path& test : sourcesIn(kRoot / "tests" / folder)) {
      const fs::path place = fs::relative(test.parent_path(), kRoot / "tests" / folder);
      EXPECT_TRUE(places.contains(place == "." ? "" : place.string())) << test << " lies in no room";
      if (test.stem().string().ends_with("_test")) {
        Names sources = stemsIn(kRoot / "engine" / folder / place, false);
        sources.merge(stemsIn(test.parent_path(), false));
        EXPECT_NE(sourceOf(test.stem().string(), sources), "") << test << " has no source of its name";
        ++checked;
      }
    }
  }
  EXPECT_GT(checked, 100U);
}

// Sources that have no test of their name, and why.
const std::map<std::string, std::string> kWithoutTest = {
    {"audit/kinds", "names only"},
    {"compare/approval", "replaces films; tested by app/render_reference_test"},
    {"compare/films", "reads manifests beside compareFolders(); tested by app/compare_films_test"},
    {"compare/reference", "keeps what differs of films; tested by app/render_reference_test"},
    {"core/math/linear_algebra", "aliases only"},
    {"core/math/pose", "data and one sum, tested through everything that moves"},
    {"library/run_data", "tested through the header, careen"},
    {"library/scene_in_code", "tested through the header, careen"},
    {"library/translated", "tested through the header, careen"},
    {"physics/contact/contact_forces", "tested through island"},
    {"physics/contact/contact_system", "tested through island"},
    {"physics/exact/contact_group", "an interface"},
    {"physics/exact/crowd_motors", "tested through pile/crowd_articulations"},
    {"physics/exact/crowd_paths", "a part of crowd_group, tested through it"},
    {"physics/geometry/box_at", "data and one sum, tested through separation and exact_world_center"},
    {"physics/geometry/contact_manifold", "a part of contact_points, tested through it"},
    {"physics/geometry/feature_overlap", "a part of contact_points, tested through it"},
    {"physics/geometry/support_feature", "a part of contact_points, tested through it"},
    {"physics/impact/simultaneous_impact",
     "what resolveImpact does once it knows who takes part: impact_law"},
    {"physics/impact/single_impact", "tested through impact_law"},
    {"physics/motion/recorder", "data and an interface"},
    {"physics/pile/crowd_problem", "tested through crowd_direct and crowd_articulations"},
    {"physics/pile/index", "one cast"},
    {"physics/search/time_of_impact_boxes",
     "the half of time_of_impact.h for two boxes, tested through time_of_impact"},
    {"physics/world/contact_residuals",
     "data, and the larger of two; filled in tests of solver/residual_sum"},
    {"physics/world/plan", "data and look-ups, tested through scene/plan"},
    {"physics/world/run_settings", "data only"},
    {"render/draw/background", "a triangle; tested through renderer"},
    {"render/draw/box_batch", "sends face_records; tested through renderer"},
    {"render/draw/face_records",
     "lists what drawn_box, neighbors and shadow_pairs find; tested through renderer"},
    {"render/gl/texture_units", "names only"},
    {"render/draw/occlusion_map", "sends what decals find; tested through renderer"},
    {"render/draw/shadow_batch", "sends what decals find; tested through renderer"},
    {"render/draw/surface_batch", "sends what surfaces and renderer test"},
    {"render/overlay/frame", "data, and functions of arrows, impacts and panels"},
    {"render/overlay/shapes", "data only"},
    {"render/window/window", "needs a display; tested by app/view_test"},
    {"physics/solver/contact_problem", "data only"},
    {"stage/camera", "data only"},
    {"stage/color", "data only"},
    {"stage/run_setup", "data only"},
    {"stage/light_part", "names only"},
    {"stage/scenery", "data only"},
    {"stage/sound_material", "data only"},
    {"stage/name_set", "tested with its names through overlay"},
    {"stage/stage", "data only"},
    {"stage/triangle_mesh", "data only"},
    {"study/contestant", "an interface"},
    {"study/validation_run", "writes what validation finds; tested by app/validate_test"},
    {"trajectory/motion_format", "a part of the record, tested whole by trajectory_format"},
    {"trajectory/stage_format", "a part of the record, tested whole by trajectory_format"},
    {"trajectory/world_format", "a part of the record, tested whole by trajectory_format"},
    {"trajectory/exporter", "data only; tested through exchange/exporters"},
    {"study/peer_bullet", "behind peers.h, tested with the other peers by peers_test"},
    {"study/peer_mujoco", "behind peers.h, tested with the other peers by peers_test"},
    {"study/peer_ode", "behind peers.h, tested with the other peers by peers_test"},
};

std::ptrdiff_t linesOf(const fs::path& source) {
  const std::string text = textOf(source);
  return std::count(text.begin(), text.end(), '\n');
}

TEST(TestPlaces, everySourceHasATestOrAReason) {
  struct Lines {
    std::ptrdiff_t tested = 0;
    std::ptrdiff_t all = 0;
  };
  std::map<std::string, Lines> lines;  // of a folder
  Names untested;
  for (const fs::path& file : sourcesIn(kRoot / "engine")) {
    const fs::path place = fs::relative(file.parent_path(), kRoot / "engine");
    const std::string source = file.stem().string();
    const Names sources = stemsIn(file.parent_path(), false);
    const Names tests = stemsIn(kRoot / "tests" / place, true);
    const bool tested = std::any_of(tests.begin(), tests.end(), [&](const std::string& test) {
      return sourceOf(test, sources) == source;
    });
    if (!tested) {
      untested.insert((place / source).string());
    }
    Lines& ofFolder = lines[place.begin()->string()];
    ofFolder.all += linesOf(file);
    ofFolder.tested += tested ? linesOf(file) : 0;
  }
  for (const std::string& source : untested) {
    EXPECT_TRUE(kWithoutTest.contains(source)) << source << " has neither a test nor a reason";
  }
  for (const auto& [source, reason] : kWithoutTest) {
    EXPECT_TRUE(untested.contains(source)) << source << " has a test, or is no source";
  }
  for (const auto& [folder, count] : lines) {
    std::cout << folder << ": " << 100 * count.tested / count.all << " % of " << count.all
              << " lines have a test of their source's name\n";
  }
}

}  // namespace
}  // namespace careen
