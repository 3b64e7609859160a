#include <algorithm>

#include "core/error.h"
#include "physics/exact/exact_world.h"
#include "physics/pile/pile.h"

namespace careen {
namespace {

/// [s] Frame of a pile. A film of another frame rate interpolates between two of them.
constexpr double kFrame = 1.0 / 60;

/// Linear interpolation from one frame to the next.
ContactStep between(const BodyState& from, const BodyState& to) {
  ContactStep step{.duration = kFrame};
  const Quat start(from.pose.worldFromBody);
  Quat end(to.pose.worldFromBody);
  if (start.dot(end) < 0) {
    end.coeffs() = -end.coeffs();
  }
  step.position.fill(Vec3::Zero());
  step.worldFromBody.fill(Vec4::Zero());
  step.position[0] = from.pose.position;
  step.position[1] = to.pose.position - from.pose.position;
  step.worldFromBody[0] = start.coeffs();
  step.worldFromBody[1] = end.coeffs() - start.coeffs();
  return step;
}

}  // namespace

// Asked of an encounter that begins Contact: of all bodies that touch and move, wherever they are.
bool ExactWorld::needsPile(const Encounter& encounter) const {
  return canPile() && !encounter.islands.empty() &&
         std::count_if(movers_.begin(), movers_.end(), [](const Mover& body) { return body.touches(); }) >
             kMostInContact;
}

// From here on all bodies advance together, frame by frame.
void ExactWorld::runAsPile(const std::stop_token& stop) {
  const Instant start = *pileFrom_;
  account_.bounds(start.hi);
  std::vector<BodyState> states(movers_.size());
  for (const Mover& body : movers_) {
    const BodyState here = body.stateAt(start);
    states[static_cast<std::size_t>(body.listed.value)] = here;
    if (body.flies) {
      arrive(body, start, here);
    } else if (body.touches()) {
      account_.departs(static_cast<std::size_t>(body.listed.value), here);
    }
  }
  Pile pile(world_, states, kFrame);
  std::vector<char> slept(movers_.size(), 0);
  for (std::int64_t frame = 0; !pile.atRest(); ++frame) {
    // By multiplication: a running sum would drift from the frames of a film.
    const auto frameStart = [&](std::int64_t k) {
      return instantAfter(start, static_cast<double>(k) * kFrame);
    };
    const Instant time = frameStart(frame);
    if (!earlier(time, end_)) {
      break;
    }
    if (stop.stop_requested()) {
      throw Interrupted();
    }
    pile.step();
    account_.strikes(true);
    for (const Mover& body : movers_) {
      const auto i = static_cast<std::size_t>(body.listed.value);
      const BodyState& next = pile.states()[i];
      const bool sleeps = pile.sleeps(body.listed.value);
      if (body.isHeld() || (sleeps && slept[i] != 0)) {
        continue;
      }
      recorder_.moves(body.listed, time.hi, between(states[i], next));
      if (sleeps) {
        recorder_.moves(body.listed, frameStart(frame + 1).hi, Rest{next.pose});
      }
      slept[i] = sleeps ? 1 : 0;
      account_.departs(i, next);
      states[i] = next;
    }
    account_.parted();
    account_.penetrates(pile.deepest());
  }
}

}  // namespace careen
