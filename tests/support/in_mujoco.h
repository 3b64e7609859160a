#pragma once

#include <mujoco/mujoco.h>

#include <array>
#include <filesystem>
#include <memory>
#include <stdexcept>
#include <string>

#include "core/math/linear_algebra.h"
#include "support/process.h"

namespace careen {

struct DeleteModel {
  void operator()(mjModel* model) const { mj_deleteModel(model); }
};
struct DeleteData {
  void operator()(mjData* data) const { mj_deleteData(data); }
};

/// A model as MuJoCo reads it, at its key frame "start" if it has one.
class InMujoco {
 public:
  explicit InMujoco(const std::string& text) {
    const TemporaryFolder folder;
    folder.write("scene.xml", text);
    load(folder / "scene.xml", text);
  }
  /// One in files of its own.
  static InMujoco in(const std::filesystem::path& path) {
    InMujoco other;
    other.load(path, "");
    return other;
  }

  int body(const std::string& name) const { return mj_name2id(model.get(), mjOBJ_BODY, name.c_str()); }
  Vec3 position(const std::string& name) const {
    const mjtNum* const at = data->xpos + 3 * body(name);
    return {at[0], at[1], at[2]};
  }
  Mat3 attitude(const std::string& name) const {
    const mjtNum* const m = data->xmat + 9 * body(name);
    Mat3 turn;
    turn << m[0], m[1], m[2], m[3], m[4], m[5], m[6], m[7], m[8];
    return turn;
  }
  void stepTo(double time) {
    while (data->time < time - 1e-9) {
      mj_step(model.get(), data.get());
    }
    mj_kinematics(model.get(), data.get());
  }

  std::unique_ptr<mjModel, DeleteModel> model;
  std::unique_ptr<mjData, DeleteData> data;

 private:
  InMujoco() = default;
  void load(const std::filesystem::path& path, const std::string& text) {
    std::array<char, 1000> error{};
    model.reset(mj_loadXML(path.c_str(), nullptr, error.data(), static_cast<int>(error.size())));
    if (!model) {
      throw std::runtime_error(std::string(error.data()) + "\n" + text);
    }
    data.reset(mj_makeData(model.get()));
    if (const int key = mj_name2id(model.get(), mjOBJ_KEY, "start"); key >= 0) {
      mj_resetDataKeyframe(model.get(), data.get(), key);
    }
  }
};

}  // namespace careen
