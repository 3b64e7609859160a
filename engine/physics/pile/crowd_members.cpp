#include "physics/pile/crowd_members.h"

#include <cmath>
#include <utility>

namespace careen {

CrowdMembers::CrowdMembers(const World& inWorld, double toTolerance, std::shared_ptr<Team> withTeam,
                           double from)
    : world(inWorld),
      team(std::move(withTeam)),
      tolerance(toTolerance),
      scale(std::sqrt(toTolerance / kUsualTolerance)),
      gravity(gravityScale(inWorld)),
      h(longestStep()),
      span(h) {
  for (std::size_t w = 0; w < world.walls.size(); ++w) {
    add(pileBody(world.walls[w], from), w);
  }
}

std::size_t CrowdMembers::add(const PileBody& body, std::size_t index) {
  if (free.empty()) {
    free.push_back(static_cast<int>(bodies.size()));
    bodies.emplace_back();
    start.emplace_back();
    ways.emplace_back();
    listed.emplace_back();
  }
  const std::size_t place = at(free.back());
  free.pop_back();
  bodies[place] = start[place] = body;
  ways[place] = {};
  listed[place] = index;
  if (body.isDriven()) {
    driven.push_back(place);
  }
  return place;
}

void CrowdMembers::drive() {
  for (const std::size_t place : driven) {
    PileBody& body = bodies[place];
    PileBody to = body;
    putDriven(body, time);
    putDriven(to, time + h);
    body.velocity = (to.position - body.position) / h;
    body.omega = body.attitude * spinBetween(body.attitude, to.attitude, h);
  }
}

void CrowdMembers::remove(std::size_t place) {
  bodies[place] = {};
  bodies[place].absent = true;
  start[place] = bodies[place];
  free.push_back(static_cast<int>(place));
}

void CrowdMembers::goBack() {
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    const bool woken = start[i].asleep && !bodies[i].asleep;
    const double path = bodies[i].path;
    const double turned = bodies[i].turned;
    bodies[i] = start[i];
    bodies[i].path = path;
    bodies[i].turned = turned;
    if (woken) {
      bodies[i].asleep = false;
      bodies[i].cluster = -1;
    }
  }
}

Pose CrowdMembers::between(std::size_t place, double part) const {
  const PileBody& from = start[place];
  const PileBody& to = bodies[place];
  if (part == 0 || to.stays()) {
    return {.position = from.position, .worldFromBody = from.axes};
  }
  if (part == 1) {
    return {.position = to.position, .worldFromBody = to.axes};
  }
  const double back = (1 - part) * (dot(to.attitude, from.attitude) < 0 ? -1 : 1);
  return {
      .position = (1 - part) * from.position + part * to.position,
      .worldFromBody =
          Quat(back * from.attitude.coeffs() + part * to.attitude.coeffs()).normalized().toRotationMatrix()};
}

}  // namespace careen
