#include "physics/exact/next_contact.h"

#include <algorithm>
#include <cstddef>

#include "core/error.h"
#include "physics/search/driven_wall.h"
#include "physics/search/first_contact_search.h"
#include "physics/search/time_of_impact.h"
#include "physics/search/translating_contact.h"

namespace careen {
namespace {

// Of one flight: 10⁸ evaluations, some 20 s. Only a body that turns that often beside a wall needs as many.
constexpr int kMostSearches = 2000;

// Continues a search that ran out of evaluations.
template <class Search>
FirstContact searchUntil(double until, const Search& search) {
  FirstContact found;
  int searches = 0;
  do {
    if (++searches > kMostSearches) {
      throw NumericalError(
          "the search for the next impact found none in 100 million evaluations: a body turns too fast to be "
          "followed; expected slower ones, or a shorter run");
    }
    const double from = found.time;
    found = search(SearchWindow{.from = from, .until = until});
    if (found.kind == ContactKind::kNone && found.time < until && !(found.time > from)) {
      throw NumericalError("the search for the next impact made no progress");
    }
  } while (found.kind == ContactKind::kNone && found.time < until);
  return found;
}

EventKind kindOf(const FirstContact& contact) {
  return contact.kind == ContactKind::kImpact ? EventKind::kContact : EventKind::kTouching;
}

// Two bodies with the same uniform velocity and no rotation keep their gap: blocks that lie in a row.
bool moveAsOne(const Mover& a, const Mover& b) {
  return !a.steps() && !b.steps() && !a.isDriven() && !b.isDriven() && a.bounds.angularSpeed == 0 &&
         b.bounds.angularSpeed == 0 && a.flight.acceleration == b.flight.acceleration &&
         a.flight.velocity == b.flight.velocity && a.flight.acceleration.isZero(0) &&
         a.flight.jerk.isZero(0) && b.flight.jerk.isZero(0);
}

}  // namespace

namespace {

FirstContact meetPlane(const MovingBox& box, const WallPlane& plane, double until) {
  return box.angularSpeedBound == 0 && box.jerk.isZero(0)
             ? firstContactTranslating(box, plane.normal, plane.offset, until)
             : searchUntil(until, [&](const SearchWindow& window) {
                 return firstContactWithWall(box, plane.normal, plane.offset, window);
               });
}

FirstContact meetDriven(const MovingBox& box, const DrivenWall& wall, double until) {
  if (wall.isUniform()) {
    return meetPlane(seenFrom(wall, box), {wall.normalAt(0), wall.offsetAt(0)}, until);
  }
  return searchUntil(until,
                     [&](const SearchWindow& window) { return firstContactWithWall(box, wall, window); });
}

// Of one of its boxes with any wall, if it is before `until` [s] of the body's motion, which then is its
// time. What rests looks only for those that are driven.
void meetWalls(const Mover& body, int index, std::span<const Mover> walls, const Instant& foreseen,
               double& until, std::optional<Event>& first) {
  const MovingBox box = body.moving(body.start, index, foreseen);
  // The wall likely to be hit first, so that the others need not be searched beyond that time.
  std::size_t likely = 0;
  double soonest = kNever;
  for (std::size_t w = 0; w < walls.size(); ++w) {
    if (walls[w].isDriven()) {
      continue;
    }
    const WallPlane plane = planeOf(*walls[w].halfSpace, walls[w].pose);
    const double clear = sphereClearUntil(box, plane.normal, plane.offset);
    if (clear > 0 && clear < soonest) {
      soonest = clear;
      likely = w;
    }
  }
  const auto meet = [&](std::size_t w) {
    const Mover& wall = walls[w];
    if (!wall.isDriven() && !body.moves()) {
      return;
    }
    const FirstContact contact =
        wall.isDriven()
            ? meetDriven(box, {wall.halfSpace->normal, wall.drivenBy->motion, wall.elapsed(body.start)},
                         until)
            : meetPlane(box, planeOf(*wall.halfSpace, wall.pose), until);
    if (contact.kind != ContactKind::kNone && (!first || contact.time < until)) {
      until = contact.time;
      first = {.time = instantAfter(body.start, contact.time),
               .kind = kindOf(contact),
               .body = body.rank,
               .partner = wall.rank,
               .partnerMotion = wall.motion};
    }
  };
  for (std::size_t k = 0; k < walls.size(); ++k) {
    meet((likely + k) % walls.size());
  }
}

}  // namespace

std::optional<Event> firstWall(const Mover& body, std::span<const Mover> walls, const Instant& end) {
  std::optional<Event> first;
  double until = body.elapsed(end);
  for (int i = 0; i < body.body->partCount(); ++i) {
    meetWalls(body, i, walls, end, until, first);
  }
  return first;
}

std::optional<Event> firstMeeting(const Mover& body, const Mover& other, const Instant& foreseen,
                                  const Instant& until) {
  const Instant zero = later(body.start, other.start);
  Instant last = until;
  for (const Mover* each : {&body, &other}) {
    if (each->steps() && earlier(each->group->end(), last)) {
      last = each->group->end();
    }
  }
  double end = secondsBetween(zero, last);
  if (!(end >= 0) || moveAsOne(body, other)) {
    return std::nullopt;
  }
  std::optional<Event> first;
  for (int i = 0; i < body.body->partCount(); ++i) {
    for (int j = 0; j < other.body->partCount(); ++j) {
      if (body.steps() && body.group->seesTo(body.place, i, {other.rank, j})) {
        continue;
      }
      const FirstContact contact = searchUntil(end, [&](const SearchWindow& window) {
        return firstContactOfBoxes(body.moving(zero, i, foreseen), other.moving(zero, j, foreseen), window);
      });
      if (contact.kind != ContactKind::kNone && (!first || contact.time < end)) {
        end = contact.time;
        first = {.time = instantAfter(zero, contact.time),
                 .kind = kindOf(contact),
                 .body = body.rank,
                 .partner = other.rank,
                 .partnerMotion = other.motion};
      }
    }
  }
  return first;
}

}  // namespace careen
