#pragma once

#include <cstddef>
#include <functional>
#include <nlohmann/json_fwd.hpp>
#include <vector>

#include "core/math/linear_algebra.h"
#include "exchange/animation_keys.h"
#include "exchange/gltf_buffer.h"
#include "stage/time_map.h"
#include "trajectory/trajectory.h"

namespace careen {

/// The animation of a film in glTF 2.0: channels and samplers, whose keys lie in a buffer. Its time is the
/// film's. Each function moves one node and gives it, as members, the place where it starts.
class GltfAnimation {
 public:
  /// `run` and `buffer` must outlive it. `within`: bound of errors [m, rad].
  GltfAnimation(const Trajectory& run, double within, GltfBuffer& buffer);

  /// As a body of the run: translation and rotation.
  void moveWithBody(std::size_t index, nlohmann::ordered_json& node, std::size_t body);
  /// As the line between two points of bodies or the world: translation, rotation and scale.
  void moveWithLine(std::size_t index, nlohmann::ordered_json& node, const SpringEnd& from,
                    const SpringEnd& to);
  /// As the frame of a wall that moves by itself.
  void moveWithCourse(std::size_t index, nlohmann::ordered_json& node, const Course& course);
  /// As functions of film time [s] say, whose only kinks are those of the time map.
  void moveBy(std::size_t index, nlohmann::ordered_json& node, const std::function<Vec3(double)>& position,
              const std::function<Quat(double)>& attitude);

  /// The member "animations" of the document; null if nothing moves.
  nlohmann::ordered_json json() const;

  std::size_t keys() const { return keys_; }               ///< of all channels
  double positionError() const { return positionError_; }  ///< [m] the largest found
  double attitudeError() const { return attitudeError_; }  ///< [rad] likewise

 private:
  struct Channel {
    std::size_t node = 0;
    const char* path = nullptr;
    std::size_t times = 0;  // accessors
    std::size_t values = 0;
  };
  double sceneTime(double filmTime) const { return clock_.sceneTime(filmTime); }
  std::vector<double> filmTimes(const std::vector<double>& sceneTimes) const;
  AnimatedSpan span(std::vector<double> sceneKinks, const std::vector<double>& sceneSeams) const;
  void addTurns(std::size_t body, std::vector<double>& seams) const;
  static void addTurns(double spin, double from, double end, std::vector<double>& seams);
  void addKinks(std::size_t body, std::vector<double>& kinks, std::vector<double>& seams) const;
  std::size_t timesAccessor(const std::vector<float>& times);
  void animate(std::size_t index, nlohmann::ordered_json& node, const AnimationKeys<Vec3>& keys);
  void animate(std::size_t index, nlohmann::ordered_json& node, const AnimationKeys<Quat>& keys);
  void animate(std::size_t index, nlohmann::ordered_json& node, const AnimationKeys<LinePlacement>& keys);

  const Trajectory& run_;
  double within_;
  GltfBuffer& buffer_;
  TimeMap clock_;
  std::vector<std::vector<double>> impactsOf_;  // times, of each body
  std::vector<Channel> channels_;
  std::size_t keys_ = 0;
  double positionError_ = 0;
  double attitudeError_ = 0;
};

}  // namespace careen
