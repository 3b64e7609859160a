// Thousands of problems of the kinds that scenes make: tosses, rods, stacks, walls, rows of dominoes,
// grooves, squeezes. Where all targets are 0, impulses exist (V. Acary, F. Cadoux, in: Recent Advances in
// Contact Mechanics, 2013: some velocities, here 0, keep every contact from approaching). Every claim is
// checked in quadruple precision, by code that shares nothing with the solver.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <iostream>
#include <random>
#include <string>
#include <vector>

#include "physics/solver/contact_scene.h"
#include "physics/solver/contact_solver.h"

namespace careen {
namespace {

using Vector = std::array<double, 3>;
Vector sum(const Vector& a, double factor, const Vector& b) {
  return {a[0] + factor * b[0], a[1] + factor * b[1], a[2] + factor * b[2]};
}
Vector cross(const Vector& a, const Vector& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
double dot(const Vector& a, const Vector& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
Vector unit(const Vector& a) { return sum({}, 1 / std::sqrt(dot(a, a)), a); }

/// Turned boxes that touch: ContactScene for any direction. Made of +, −, ×, ÷ and √ alone, so that the
/// problems are the same everywhere.
class Turned {
 public:
  using Frame = std::array<Vector, 3>;  // the body's axes in the world
  ContactProblem problem;

  int add(double mass, const Vector& half, const Vector& place, const Frame& frame, const Vector& velocity,
          const Vector& spin) {
    for (int k = 0; k < 3; ++k) {
      problem.inverseMass.push_back(1 / mass);
    }
    for (std::size_t k = 0; k < 3; ++k) {
      const double x = half[(k + 1) % 3];
      const double y = half[(k + 2) % 3];
      problem.inverseMass.push_back(3 / (mass * (x * x + y * y)));
    }
    problem.free.insert(problem.free.end(), velocity.begin(), velocity.end());
    for (const Vector& axis : frame) {
      problem.free.push_back(dot(axis, spin));
    }
    places_.push_back(place);
    frames_.push_back(frame);
    halves_.push_back(half);
    return static_cast<int>(places_.size()) - 1;
  }

  Vector corner(int body, int which) const {
    const auto i = static_cast<std::size_t>(body);
    Vector point = places_[i];
    for (std::size_t k = 0; k < 3; ++k) {
      point = sum(point, (which >> k) % 2 == 0 ? -halves_[i][k] : halves_[i][k], frames_[i][k]);
    }
    return point;
  }

  /// The normal points from b to a.
  void touch(int a, int b, const Vector& point, const Vector& normal, double friction) {
    ContactProblem::Contact contact;
    contact.a = a;
    contact.b = b;
    contact.friction = friction;
    const Vector n = unit(normal);
    const Vector other = std::fabs(n[0]) < 0.6 ? Vector{1, 0, 0} : Vector{0, 1, 0};
    const Vector t = unit(cross(n, other));
    const std::array<Vector, 3> directions{n, t, cross(n, t)};
    for (std::size_t row = 0; row < 3; ++row) {
      fill(contact.rows[row], 0, a, point, directions[row], 1);
      fill(contact.rows[row], 6, b, point, directions[row], -1);
    }
    problem.contacts.push_back(contact);
  }

  /// Every corner of the body that is within `depth` [m] of its lowest along the normal.
  void touchPlane(int body, const Vector& normal, double depth, double friction) {
    double lowest = dot(corner(body, 0), normal);
    for (int k = 1; k < 8; ++k) {
      lowest = std::min(lowest, dot(corner(body, k), normal));
    }
    for (int k = 0; k < 8; ++k) {
      if (dot(corner(body, k), normal) <= lowest + depth) {
        touch(body, kNobody, corner(body, k), normal, friction);
      }
    }
  }

 private:
  void fill(ContactProblem::Row& row, std::size_t first, int body, const Vector& point,
            const Vector& direction, double sign) const {
    if (body == kNobody) {
      return;
    }
    const auto i = static_cast<std::size_t>(body);
    const Vector turning = cross(sum(point, -1, places_[i]), direction);
    for (std::size_t k = 0; k < 3; ++k) {
      row[first + k] = sign * direction[k];
      row[first + 3 + k] = sign * dot(frames_[i][k], turning);
    }
  }

  std::vector<Vector> places_;
  std::vector<Frame> frames_;
  std::vector<Vector> halves_;
};

class Dice {
 public:
  explicit Dice(unsigned seed) : generator_(seed) {}
  double between(double least, double most) {
    return least + (most - least) * (static_cast<double>(generator_()) * 0x1p-32);
  }
  int upTo(int n) { return static_cast<int>(generator_() % static_cast<unsigned>(n)); }
  template <std::size_t n>
  double of(const std::array<double, n>& values) {
    return values[generator_() % n];
  }
  Vector inCube(double half) {
    const double x = between(-half, half);
    const double y = between(-half, half);
    return {x, y, between(-half, half)};
  }
  Vector halves(double least, double most) {
    const double x = between(least, most);
    const double y = between(least, most);
    return {x, y, between(least, most)};
  }
  Turned::Frame frame() {
    const Vector x = unit(sum(inCube(1), 0x1p-10, {1, 1, 1}));
    const Vector y = unit(cross(sum(inCube(1), 0x1p-10, {1, -1, 1}), x));
    return {x, y, cross(x, y)};
  }
  /// Powers of ten from 1 to 10^most, and what is between them.
  double ratio(int most) {
    double result = between(1, 10);
    for (int k = upTo(most); k > 0; --k) {
      result *= 10;
    }
    return result;
  }
  double friction() { return of<8>({0, 0.1, 0.3, 0.5, 0.7, 1, 1.5, 2}); }

 private:
  std::mt19937 generator_;
};

constexpr Turned::Frame kUpright{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};

/// A frame turned about y by the angle whose half has tangent t.
Turned::Frame leaning(double t) {
  const double c = (1 - t * t) / (1 + t * t);
  const double s = 2 * t / (1 + t * t);
  return {{{c, 0, -s}, {0, 1, 0}, {s, 0, c}}};
}

// One box that lands on a corner, an edge or a face.
ContactProblem toss(Dice& dice) {
  Turned scene;
  const Turned::Frame frame = dice.upTo(3) == 0   ? kUpright
                              : dice.upTo(2) == 0 ? leaning(dice.between(-0.5, 0.5))
                                                  : dice.frame();
  Vector velocity = dice.inCube(1);
  velocity[2] -= 1;
  const int body = scene.add(dice.ratio(3), dice.halves(0.05, 0.5), {}, frame, velocity, dice.inCube(5));
  scene.touchPlane(body, {0, 0, 1}, dice.upTo(2) == 0 ? 1e-9 : 0.02, dice.friction());
  return scene.problem;
}

// A slender box whose end is driven into the floor (Painlevé's rod), or that lies between floor and wall.
ContactProblem rod(Dice& dice) {
  Turned scene;
  const Vector half{dice.between(0.5, 2), 0.01, dice.between(0.005, 0.02)};
  const double t = dice.between(0.1, 0.6);
  const int body = scene.add(1, half, {}, leaning(t), {dice.between(-3, 3), 0, dice.between(-1, 0)},
                             {0, dice.between(-2, 2), dice.upTo(2) == 0 ? 0 : dice.between(-1, 1)});
  const double friction = dice.friction();
  scene.touchPlane(body, {0, 0, 1}, 1e-9, friction);
  if (dice.upTo(2) == 0) {
    scene.touchPlane(body, {1, 0, 0}, 1e-9, friction);
  }
  return scene.problem;
}

// Cubes on each other, some heavier by up to 1e6, that fall for a moment or are struck.
ContactProblem stack(Dice& dice) {
  ContactScene scene;
  const int count = 2 + dice.upTo(20);
  const double friction = dice.friction();
  const double speed = dice.between(0.001, 0.1);
  const int heavy = dice.upTo(2 * count);
  const int struck = dice.upTo(2 * count);
  double x = 0;
  double y = 0;
  for (int k = 0; k < count; ++k) {
    const double stepX = k == 0 ? 0 : dice.between(-0.2, 0.2);
    const double stepY = k == 0 ? 0 : dice.between(-0.2, 0.2);
    const Vector hit = k == struck ? dice.inCube(3) : Vector{};
    scene.add(k == heavy ? dice.ratio(6) : 1, {0.5, 0.5, 0.5}, {x + stepX, y + stepY, k + 0.5},
              sum({0, 0, -speed}, 1, hit));
    scene.touchFlat(k, k - 1, x + stepX / 2, y + stepY / 2, 0.5 - std::fabs(stepX) / 2,
                    0.5 - std::fabs(stepY) / 2, k, friction);
    x += stepX;
    y += stepY;
  }
  return scene.problem;
}

ContactProblem wall(Dice& dice) {
  ContactScene scene =
      brickWall(2 + dice.upTo(5), 2 + dice.upTo(4), dice.between(0.001, 0.1), dice.friction());
  if (dice.upTo(2) == 0) {
    const auto brick = static_cast<std::size_t>(dice.upTo(static_cast<int>(scene.problem.free.size() / 6)));
    for (std::size_t k = 0; k < 6; ++k) {
      scene.problem.free[6 * brick + k] += dice.between(-2, 2);
    }
  }
  return scene.problem;
}

// Each leans on the next: lower edge on the floor, upper edge on the next one's face.
ContactProblem dominoes(Dice& dice) {
  Turned scene;
  const int count = 2 + dice.upTo(15);
  const Vector half{dice.between(0.02, 0.06), dice.between(0.1, 0.25), dice.between(0.25, 0.5)};
  const double friction = dice.friction();
  const double gap = dice.between(0.3, 0.8) * half[2];
  double t = dice.between(0.3, 0.5);
  for (int k = 0; k < count; ++k) {
    Turned::Frame frame = leaning(t);
    const double spin = dice.between(0, 3) * t;
    const Vector foot{k * (gap + 2 * half[0]), 0, 0};  // of the edge it turns about
    const Vector centre = sum(sum(foot, -half[0], frame[0]), half[2], frame[2]);
    Vector velocity = cross({0, spin, 0}, sum(centre, -1, foot));
    velocity[2] -= 0.01;
    velocity[1] = dice.upTo(3) == 0 ? dice.between(-0.1, 0.1) : 0;
    scene.add(1, half, centre, frame, velocity, {0, spin, 0});
    scene.touch(k, kNobody, scene.corner(k, 1), {0, 0, 1}, friction);
    scene.touch(k, kNobody, scene.corner(k, 3), {0, 0, 1}, friction);
    const double next = k + 2 == count ? 0 : t * dice.between(0.5, 0.95);
    if (k > 0) {
      const Vector normal = sum({}, -1, frame[0]);  // of this one's face, to the one before
      scene.touch(k - 1, k, scene.corner(k - 1, 5), normal, friction);
      scene.touch(k - 1, k, scene.corner(k - 1, 7), normal, friction);
    }
    t = next;
  }
  return scene.problem;
}

// One to three boxes, masses up to 1:1000, wedged between two slopes.
ContactProblem groove(Dice& dice) {
  Turned scene;
  const double t = dice.between(0.2, 0.8);
  const Turned::Frame slope = leaning(t);
  const Vector left = slope[2];
  const Vector right{-left[0], 0, left[2]};
  const double friction = dice.friction();
  const int count = 1 + dice.upTo(3);
  for (int k = 0; k < count; ++k) {
    const double mass = k % 2 == 0 ? 1 : dice.ratio(3);
    const Turned::Frame frame = dice.upTo(2) == 0 ? dice.frame() : slope;
    const int body = scene.add(mass, dice.halves(0.05, 0.2), {0, 0, 0.4 * k}, frame,
                               sum(dice.inCube(0.3), 1, {0, 0, -0.5}), dice.inCube(1));
    if (k == 0 || dice.upTo(2) == 0) {
      scene.touchPlane(body, left, 0.01, friction);
      scene.touchPlane(body, right, 0.01, friction);
    }
    if (k > 0) {
      scene.touch(body, body - 1, sum(dice.inCube(0.05), 1, {0, 0, 0.4 * k - 0.2}),
                  sum(dice.inCube(0.5), 1, {0, 0, 1}), friction);
    }
  }
  return scene.problem;
}

// A light box between two heavy ones that come together, or already roll it between them: then the normal
// speeds are tiny, and the impulses that a jam takes are not.
ContactProblem squeeze(Dice& dice) {
  Turned scene;
  const double heavy = dice.ratio(dice.upTo(2) == 0 ? 4 : 6);
  const double friction = dice.between(0, 2);
  const bool rolls = dice.upTo(2) == 0;
  for (const int at : {-1, 0, 1}) {
    const Vector approach{-static_cast<double>(at), 0, 0};
    scene.add(at == 0 ? 1 : heavy, dice.halves(0.16, 0.3), {0.45 * at, 0.05 * at, -0.03 * at}, dice.frame(),
              rolls ? Vector{-1e-7 * at, at * dice.between(-1, 1), at * dice.between(-1, 1)} : approach,
              rolls ? Vector{} : dice.inCube(2));
  }
  for (const int at : {-1, 1}) {
    const int points = 1 + dice.upTo(rolls ? 1 : 3);
    for (int k = 0; k < points; ++k) {
      const Vector normal{static_cast<double>(at), dice.between(-0.4, 0.4), dice.between(-0.4, 0.4)};
      scene.touch(at + 1, 1, sum(dice.inCube(0.1), 0.22 * at, {1, 0, 0}),
                  rolls ? Vector{1.0 * at, 0, 0} : normal, friction);
    }
  }
  return scene.problem;
}

struct Tally {
  int count = 0;
  int tight = 0;  // to 1e-12 V
  int failed = 0;
  int largest = 0;  // factorisations
};

void solveMany(Tally& all, const std::string& name, ContactProblem (*make)(Dice&), int times) {
  Dice dice(static_cast<unsigned>(name.size()) * 7919);
  Tally tally;
  ContactSolver solver;
  for (int k = 0; k < times; ++k) {
    const ContactProblem problem = make(dice);
    ContactSolution solution;
    solver.solve(problem, solution);
    {
      SCOPED_TRACE(name + " " + std::to_string(k));
      expectHonest(problem, solution);
    }
    ++tally.count;
    tally.failed += solution.solved ? 0 : 1;
    tally.tight += solution.residual <= 1e-12 * solution.scale ? 1 : 0;
    tally.largest = std::max(tally.largest, solution.factorisations);
    if (!solution.solved) {
      std::cout << name << " " << k << " not solved: " << problem.free.size() / 6 << " bodies, "
                << problem.contacts.size() << " contacts, residual " << solution.residual / solution.scale
                << " V\n";
    }
  }
  std::cout << name << ": " << tally.count << " problems, " << tally.tight << " solved to 1e-12, "
            << tally.failed << " not solved, at most " << tally.largest << " factorisations\n";
  all.count += tally.count;
  all.failed += tally.failed;
  all.tight += tally.tight;
}

TEST(ContactSolverFamilies, allButVeryFewAreSolvedAndNoneSilentlyWrong) {
  Tally all;
  solveMany(all, "tosses", toss, 1000);
  solveMany(all, "rods", rod, 1000);
  solveMany(all, "stacks", stack, 500);
  solveMany(all, "walls", wall, 200);
  solveMany(all, "dominoes", dominoes, 500);
  solveMany(all, "grooves", groove, 1000);
  solveMany(all, "squeezes", squeeze, 1000);
  std::cout << all.count << " problems, " << all.tight << " solved to 1e-12, " << all.failed
            << " not solved\n";
  EXPECT_LE(all.failed, all.count / 200);
}

}  // namespace
}  // namespace careen
