#include "study/program_peer.h"

#include <algorithm>
#include <cstddef>
#include <map>
#include <nlohmann/json.hpp>
#include <utility>

#include "core/error.h"
#include "core/system/file.h"
#include "study/peer.h"
#include "study/world_description.h"
#include "trajectory/pose_table.h"

namespace careen {
namespace {

// [time][body]. NumericalError if a box that can move has no row at one of the times.
std::vector<std::vector<BodyState>> statesIn(const PoseTable& table, const World& world,
                                             std::span<const double> times) {
  std::vector<BodyState> still;
  for (const Body& body : world.bodies) {
    still.push_back({.pose = body.initial.pose});
  }
  std::vector<std::vector<BodyState>> states(times.size(), still);
  std::size_t missing = times.size() * static_cast<std::size_t>(std::count_if(
                                           world.bodies.begin(), world.bodies.end(),
                                           [](const Body& body) { return !isImmovable(body.mass); }));
  std::map<std::string, std::size_t> places;
  for (std::size_t i = 0; i < world.bodies.size(); ++i) {
    places.emplace(world.bodies[i].name, i);
  }
  for (const PoseRow& row : table.rows) {
    const auto place = places.find(table.boxes[row.box]);
    const auto time = std::lower_bound(times.begin(), times.end(), row.time);
    if (place == places.end() || time == times.end() || *time != row.time) {
      table.fail(row, "a row that nobody asked for", "boxes of the world at the times of the question");
    }
    const Body& body = world.bodies[place->second];
    const Pose box{.position = row.position, .worldFromBody = row.worldFromBody.toRotationMatrix()};
    BodyState& state = states[static_cast<std::size_t>(time - times.begin())][place->second];
    state.pose = bodyPose(body, box);
    state.velocity = bodyVelocity(body, state.pose.worldFromBody, row.velocity, row.angularVelocity);
    state.angularMomentum = angularMomentum(body.mass, state.pose.worldFromBody, row.angularVelocity);
    --missing;
  }
  if (missing > 0) {
    throw NumericalError(table.name + ": its table lacks " + std::to_string(missing) + " rows");
  }
  return states;
}

}  // namespace

ProgramPeer::ProgramPeer(std::string name, std::string settings, std::vector<std::string> command)
    : name_(std::move(name)), settings_(std::move(settings)), command_(std::move(command)) {}

std::string ProgramPeer::refuses(const World& world) const {
  const bool isAnyOfSeveral = std::any_of(world.bodies.begin(), world.bodies.end(),
                                          [](const Body& body) { return !body.parts.empty(); });
  return isAnyOfSeveral         ? "no bodies of several boxes"
         : world.joints.empty() ? refusalOfPeers(world)
                                : "no joints";
}

double ProgramPeer::secondsTaken() const {
  const std::lock_guard lock(time_.mutex);
  return time_.ended + (time_.asked != nullptr ? time_.asked->coreSeconds() - time_.begun : 0);
}

std::vector<std::vector<BodyState>> ProgramPeer::run(const World& world, double dt,
                                                     std::span<const double> times,
                                                     const std::stop_token& stop) const {
  if (stop.stop_requested()) {
    throw Interrupted();
  }
  const std::string table = (folder_ / "poses.csv").string();
  nlohmann::ordered_json question;
  question["table"] = table;
  question["step"] = dt;
  question["times"] = std::vector<double>(times.begin(), times.end());
  question["world"] = descriptionOf(world);
  const auto said = nlohmann::json::parse(answer(question.dump(), stop), nullptr, false);
  if (said.is_object() && said.contains("failure") && said["failure"].is_string()) {
    throw NumericalError(name_ + ": " + said["failure"].get<std::string>());
  }
  return statesIn(readPoseTable(readFile(table), name_), world, times);
}

std::string ProgramPeer::answer(const std::string& question, const std::stop_token& stop) const {
  if (!program_) {
    program_ = std::make_unique<Dialogue>(command_);
    program_->ask("{}", stop);  // once it is loaded: no part of a run
  }
  {
    const std::lock_guard lock(time_.mutex);
    time_.asked = program_.get();
    time_.begun = program_->coreSeconds();
  }
  const auto end = [this](double seconds) {
    const std::lock_guard lock(time_.mutex);
    time_.asked = nullptr;
    time_.ended += seconds;
  };
  try {
    const std::string line = program_->ask(question, stop);
    const auto said = nlohmann::json::parse(line, nullptr, false);
    const bool isTimed = said.is_object() && said.contains("seconds") && said["seconds"].is_number();
    end(isTimed ? said["seconds"].get<double>() : program_->coreSeconds() - time_.begun);
    return line;
  } catch (...) {
    end(program_->coreSeconds() - time_.begun);
    program_.reset();
    throw;
  }
}

}  // namespace careen
