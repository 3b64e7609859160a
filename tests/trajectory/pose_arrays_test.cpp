#include "trajectory/pose_arrays.h"

#include <gtest/gtest.h>

#include <map>
#include <string>

#include "support/input_error.h"
#include "trajectory/numpy_array.h"
#include "trajectory/zip_archive.h"

namespace careen {
namespace {

using Arrays = std::map<std::string, NumpyArray>;

// Two boxes at three times: box b is 10 m beside box a.
Arrays wide() {
  Arrays arrays;
  arrays["time"] = NumpyArray::of(std::vector<double>{0, 1, 2}, {3});
  arrays["box"] = NumpyArray::of(std::vector<std::string>{"a", "b"}, {2});
  for (const char* const name : {"y", "z", "qx", "qy", "qz"}) {
    arrays[name] = NumpyArray::of(std::vector<double>(6, 0), {3, 2});
  }
  arrays["x"] = NumpyArray::of(std::vector<double>{0, 10, 1, 11, 2, 12}, {3, 2});
  arrays["qw"] = NumpyArray::of(std::vector<double>{1, 1, -1, 1, 1, -1}, {3, 2});
  return arrays;
}

std::string npzOf(const Arrays& arrays) {
  std::vector<ZipEntry> entries;
  for (const auto& [name, array] : arrays) {
    entries.emplace_back(name + ".npy", encodeNumpy(array));
  }
  return zipOf(entries);
}

std::string refusalOf(const Arrays& arrays) {
  return inputErrorOf([&] { readPoseArrays(npzOf(arrays), "t.npz"); });
}

TEST(PoseArrays, timesAndBoxesMakeRows) {
  const PoseTable table = readPoseArrays(npzOf(wide()), "t.npz");
  EXPECT_EQ(table.boxes, (std::vector<std::string>{"a", "b"}));
  ASSERT_EQ(table.rows.size(), 6U);
  for (std::size_t k = 0; k < 6; ++k) {
    const double time = static_cast<double>(k / 2);
    EXPECT_EQ(table.rows[k].time, time);
    EXPECT_EQ(table.boxes[table.rows[k].box], k % 2 == 0 ? "a" : "b");
    EXPECT_EQ(table.rows[k].position, Vec3(time + (k % 2 == 0 ? 0 : 10), 0, 0));
  }
  EXPECT_FALSE(table.hasVelocities);
}

TEST(PoseArrays, arraysOfRowsAreReadToo) {
  Arrays arrays = wide();
  for (auto& [name, array] : arrays) {
    array.shape = {array.size()};
  }
  arrays["time"] = NumpyArray::of(std::vector<double>{0, 0, 1, 1, 2, 2}, {6});
  arrays["box"] = NumpyArray::of(std::vector<std::string>{"a", "b", "a", "b", "a", "b"}, {6});
  const PoseTable table = readPoseArrays(npzOf(arrays), "t.npz");
  ASSERT_EQ(table.rows.size(), 6U);
  EXPECT_EQ(table.rows[5].position, Vec3(12, 0, 0));
  EXPECT_EQ(table.boxes[table.rows[5].box], "b");
}

TEST(PoseArrays, whatStandsBesideThemIsNotRead) {
  Arrays arrays = wide();
  for (const char* const name : {"energy_total", "joint", "joint_rate"}) {
    arrays[name] = NumpyArray::of(std::vector<double>{1}, {1});
  }
  arrays["impact_time"] = NumpyArray::of(std::vector<double>{1}, {1});
  arrays["units"] = NumpyArray::of(std::vector<std::string>{"time", "s"}, {1, 2});
  EXPECT_EQ(refusalOf(arrays), "no error");
  arrays["colour"] = NumpyArray::of(std::vector<double>{1}, {1});
  EXPECT_EQ(refusalOf(arrays).substr(0, 43), "t.npz: found the unknown column 'colour', e");
}

TEST(PoseArrays, badArraysAreTold) {
  Arrays arrays = wide();
  arrays["y"].numbers.resize(4);
  arrays["y"].shape = {2, 2};
  EXPECT_EQ(refusalOf(arrays), "t.npz: array y: found numbers, 2 x 2, expected numbers in the shape of x");
  arrays = wide();
  arrays["time"].numbers.pop_back();
  arrays["time"].shape = {2};
  EXPECT_EQ(refusalOf(arrays).substr(0, 41), "t.npz: array time: found numbers, 2, expe");
  arrays = wide();
  arrays["z"].numbers[3] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(refusalOf(arrays), "t.npz: row 1: found nan for z, expected a finite number within 1e60");
  arrays = wide();
  arrays.erase("box");
  EXPECT_EQ(refusalOf(arrays), "t.npz: found no array box, expected the names of 2 boxes");
  arrays = wide();
  arrays.erase("qz");
  EXPECT_EQ(refusalOf(arrays), "t.npz: found no column qz, expected it: a pose is x, y, z, qw, qx, qy, qz");
  arrays = wide();
  arrays["box"] = NumpyArray::of(std::vector<double>{1, 2}, {2});
  EXPECT_EQ(refusalOf(arrays).substr(0, 37), "t.npz: array box: found numbers, 2, e");
}

}  // namespace
}  // namespace careen
