#include "trajectory/export_npz.h"

#include <gtest/gtest.h>

#include <map>

#include "core/error.h"
#include "support/jointed.h"
#include "support/trajectories.h"
#include "trajectory/energy_samples.h"
#include "trajectory/numpy_array.h"
#include "trajectory/pose_arrays.h"
#include "trajectory/zip_archive.h"

namespace careen {
namespace {

std::map<std::string, NumpyArray> arraysOf(const Trajectory& run, double every) {
  std::map<std::string, NumpyArray> arrays;
  for (const auto& [name, bytes] : unzipped(encodeNpz(run, every), "t")) {
    arrays[name] = decodeNumpy(bytes, name);
  }
  return arrays;
}

TEST(ExportNpz, posesAreTimesByBoxes) {
  const auto arrays = arraysOf(driftAndReturn(), 0.25);
  EXPECT_EQ(arrays.at("time.npy").numbers, (std::vector<double>{0, 0.25, 0.5, 0.75, 1}));
  EXPECT_EQ(arrays.at("box.npy").texts, (std::vector<std::string>{"drifter", "anchor"}));
  EXPECT_EQ(arrays.at("x.npy").shape, (std::vector<std::size_t>{5, 2}));
  EXPECT_EQ(arrays.at("x.npy").numbers, (std::vector<double>{1, 0, 1.5, 0, 2, 0, 1.5, 0, 1, 0}));
  EXPECT_EQ(arrays.at("vx.npy").numbers, (std::vector<double>{2, 0, 2, 0, -2, 0, -2, 0, -2, 0}));
  EXPECT_NEAR(arrays.at("wz.npy").numbers[4], 10, 1e-14);
  EXPECT_EQ(arrays.at("qw.npy").numbers[0], 1);
}

TEST(ExportNpz, impactsAndUnitsAreThere) {
  const auto arrays = arraysOf(driftAndReturn(), 0.25);
  EXPECT_EQ(arrays.at("impact_time.npy").numbers, std::vector<double>{0.5});
  EXPECT_EQ(arrays.at("impact_a.npy").texts, std::vector<std::string>{"drifter"});
  EXPECT_EQ(arrays.at("impact_b.npy").texts, std::vector<std::string>{"room+x"});
  EXPECT_EQ(arrays.at("impact_nx.npy").numbers, std::vector<double>{-1});
  EXPECT_EQ(arrays.at("impact_impulse.npy").numbers, std::vector<double>{8});
  // A unit for each array but that of the units.
  const NumpyArray& units = arrays.at("units.npy");
  EXPECT_EQ(units.shape, (std::vector<std::size_t>{arrays.size() - 1, 2}));
  for (std::size_t k = 0; k + 1 < units.texts.size(); k += 2) {
    EXPECT_TRUE(arrays.contains(units.texts[k] + ".npy")) << units.texts[k];
  }
  EXPECT_EQ(units.texts[1], "s");
}

// 2 kg on the floor: four rows of 5 N for each moment.
TEST(ExportNpz, forcesAreRows) {
  World world;
  world.gravity = Vec3(0, 0, -10);
  world.walls = {wall("floor", Vec3::UnitZ(), 0, 0)};
  world.bodies = {box("box", Vec3::Constant(0.5), 2, Vec3(0, 0, 0.5), Vec3::Zero(), Vec3::Zero(), 0)};
  const Trajectory run = record(world, {.duration = 1}, "");
  std::map<std::string, NumpyArray> arrays;
  for (const auto& [name, bytes] : unzipped(encodeForcesNpz(run, 0.5), "t")) {
    arrays[name] = decodeNumpy(bytes, name);
  }
  EXPECT_EQ(arrays.at("time.npy").numbers, (std::vector<double>{0, 0, 0, 0, 0.5, 0.5, 0.5, 0.5, 1, 1, 1, 1}));
  EXPECT_EQ(arrays.at("a.npy").texts, std::vector<std::string>(12, "box"));
  EXPECT_EQ(arrays.at("b.npy").texts, std::vector<std::string>(12, "floor"));
  EXPECT_EQ(arrays.at("units.npy").shape, (std::vector<std::size_t>{arrays.size() - 1, 2}));
  for (const double force : arrays.at("fz.npy").numbers) {
    EXPECT_NEAR(force, 5, 1e-12);
  }
}

// What encodeNpz() writes is read as a table again, joints and energies beside the poses.
TEST(ExportNpz, energiesStandBesideThePoses) {
  Trajectory run = driftAndReturn();
  test::join(run.world, Joint::Kind::kSlider, 0, {}, Vec3::Zero(), Vec3::UnitX());
  const auto arrays = arraysOf(run, 0.25);
  EnergySamples samples(run);
  for (std::size_t k = 0; k < 5; ++k) {
    const RunEnergies now = samples.at(0.25 * static_cast<double>(k));
    EXPECT_EQ(arrays.at("energy_total.npy").numbers[k], now.shares.sum());
    EXPECT_EQ(arrays.at("energy_px.npy").numbers[k], now.momentum.x());
  }
  EXPECT_EQ(readPoseArrays(encodeNpz(run, 0.25), "t.npz").rows.size(), 10U);
}

TEST(ExportNpz, refusesWhatNobodyCouldLoad) {
  EXPECT_THROW(encodeNpz(driftAndReturn(), 1e-8), InputError);
  EXPECT_THROW(encodeNpz(driftAndReturn(), 0), InputError);
}

}  // namespace
}  // namespace careen
