#include "physics/motion/joined_steps.h"

#include <algorithm>

namespace careen {

StepEnd JoinedSteps::Step::at(double elapsed) const {
  return elapsed <= 0 ? from : elapsed >= length ? to : endWithin(cubicStep(from, to, length), elapsed);
}

JoinedSteps::Beside JoinedSteps::beside(double last, double next, double part) {
  const double time = part * (part < 0 ? std::min(0.5 * last, next) : std::min(0.5 * next, last));
  return {.time = time, .off = offAt(last, next, time)};
}

double JoinedSteps::offAt(double last, double next, double time) {
  const double b = std::min(0.5 * last, next);
  const double c = std::min(0.5 * next, last);
  if (!(time > -b && time < c)) {
    return 0;
  }
  const double whole = b + c;
  const double u = (time + b) / whole;
  return u * u * (c * (3 - 2 * u) + whole * (u - 1)) - std::max(0.0, time);
}

void JoinedSteps::add(Recorder& recorder, BodyIndex body, double time, const StepEnd& from, const StepEnd& to,
                      double length, double radius, Begin begin) {
  const Step next{.time = time, .length = length, .from = from, .to = to, .radius = radius};
  double begun = 0;
  StepEnd there = from;
  if (last_.length > 0 && last_.to.position == from.position && begin == Begin::kRounded) {
    const double before = std::min((ofOthers_ ? 1 : 0.5) * last_.length, length);
    begun = std::min(0.5 * length, (ofOthers_ ? 2 : 1) * last_.length);
    handOn(recorder, body, last_.length - before);
    there = next.at(begun);
    merged_.add(recorder, body, last_.time + done_, there_, there, before + begun, radius);
  } else {
    handOn(recorder, body, last_.length);
  }
  last_ = next;
  ofOthers_ = false;
  done_ = begun;
  there_ = there;
}

void JoinedSteps::follows(double time, const StepEnd& from, const StepEnd& to, double length) {
  last_ = {.time = time, .length = length, .from = from, .to = to};
  ofOthers_ = true;
}

// The last step until so long after its start [s].
void JoinedSteps::handOn(Recorder& recorder, BodyIndex body, double until) {
  if (ofOthers_ || until > done_) {
    const StepEnd there = last_.at(until);
    if (!ofOthers_) {
      merged_.add(recorder, body, last_.time + done_, there_, there, until - done_, last_.radius);
    }
    done_ = until;
    there_ = there;
  }
}

void JoinedSteps::flush(Recorder& recorder, BodyIndex body) {
  handOn(recorder, body, last_.length);
  last_ = {};
  ofOthers_ = false;
  done_ = 0;
  merged_.flush(recorder, body);
}

}  // namespace careen
