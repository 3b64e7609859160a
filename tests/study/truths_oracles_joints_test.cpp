// Truths of joints that can be computed in two independent ways must agree to far more digits than a double
// has.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>

#include "study/truths.h"
#include "support/jointed_oracles.h"
#include "support/quad_scene_file.h"

namespace careen::study {
namespace {

using oracle::QuadPoses;
using oracle::Quads;
using oracle::QuadScene;

// The chain assumes neither a plane nor an axis.
TEST(TruthsOfJoints, ofAChainOfOneAreEllipticFunctions) {
  const QuadScene scene = oracle::sceneIn(scenePath("pendulum"));
  const std::array<double, 3> times = {1, 2.5, 4};
  EXPECT_LT(oracle::furthestApart(oracle::QuadChain(scene).poses(times, 1.0 / 64)[0],
                                  oracle::swungFromRest(scene, times)),
            1e-25);
}

// A loop has no chain: the sum of what its cranks and its bridge need, against Lagrange's equation.
TEST(TruthsOfJoints, ofALoopAreThoseOfItsEquation) {
  const QuadScene scene = oracle::sceneIn(scenePath("parallelogram"));
  const std::array<double, 1> times = {3};
  const Quad moment = 2 * (Quad(0.05 * 0.05 + 0.25) / 3 + Quad(1) / 4) + 2;
  const Quads at = oracle::advanced(
      {Quad(0.9), Quad(0)},
      [&](const Quads& y) {
        return Quads{y[1], -Quad(9.81) * 3 / moment * sin(y[0])};
      },
      3, 1.0 / 32);
  const oracle::QuadPose left = oracle::parallelogram(scene, times)[0][0];
  // The file has seventeen digits of where it starts.
  EXPECT_NEAR(static_cast<double>(left.position[0] + Quad(0.3) + sin(at[0]) / 2), 0, 1e-14);
  EXPECT_NEAR(static_cast<double>(left.position[2] + cos(at[0]) / 2), 0, 1e-14);
}

// Bounces one by one, at roots of the angle.
TEST(TruthsOfJoints, ofALimitAreThoseOfEachBounce) {
  const QuadScene scene = oracle::sceneIn(scenePath("limit-half"));
  const std::array<double, 1> times = {3};
  const oracle::RateOf rate = [w = oracle::pendulumOf(scene).frequency](const Quads& y) {
    return Quads{y[1], -w * w * sin(y[0])};
  };
  Quads state{oracle::angleFromHanging(scene.joints[0].at, scene.boxes[0].position), Quad(0)};
  Quad now = 0;
  int bounces = 0;
  for (Quad h = 1.0 / 32; now < 3; h = Quad(3) - now < Quad(1) / 32 ? Quad(3) - now : Quad(1) / 32) {
    Quads next = oracle::advanced(state, rate, h, 1);
    if (next[0] < 0) {
      for (int k = 0; k < 8; ++k) {
        h -= next[0] / next[1];
        next = oracle::advanced(state, rate, h, 1);
      }
      next = {Quad(0), -next[1] / 2};
      ++bounces;
    }
    state = next;
    now += h;
  }
  EXPECT_EQ(bounces, 4);
  const oracle::QuadPose pose = oracle::swungAtLimit(scene, times)[0];
  EXPECT_LT(std::fabs(static_cast<double>(pose.position[0] + sin(state[0]) / 2)), 1e-15);
}

// Half of the step changes nothing that a double shows.
TEST(TruthsOfJoints, ofChainsDependOnNoStep) {
  for (const char* const name : {"double-pendulum", "triple-pendulum", "heavy-top"}) {
    const QuadScene scene = oracle::sceneIn(scenePath(name));
    const std::array<double, 1> times = {1};
    const oracle::QuadChain chain(scene);
    const auto one = chain.poses(times, 1.0 / 64);
    const auto other = chain.poses(times, 1.0 / 128);
    for (std::size_t k = 0; k < one.size(); ++k) {
      EXPECT_LT(oracle::furthestApart(one[k], other[k]), 1e-20) << name;
    }
  }
}

// Energy and momenta of ten links that are thrown, from the places of the truth alone: the angular momentum
// needs rates, so that the middle of all is asked.
TEST(TruthsOfJoints, ofTheFreeChainFallAsOneBody) {
  const QuadScene scene = oracle::sceneIn(scenePath("chain-free"));
  const std::array<double, 1> times = {0.125};
  const auto boxes = oracle::QuadChain(scene).poses(times, 1.0 / 16);
  oracle::QuadVector off = oracle::QuadVector::Zero();
  for (std::size_t k = 0; k < boxes.size(); ++k) {
    const oracle::QuadBox& box = scene.boxes[k];
    off +=
        boxes[k][0].position - box.position - Quad(0.125) * (box.velocity + Quad(0.125) / 2 * scene.gravity);
  }
  EXPECT_LT(static_cast<double>(off.norm()), 1e-30);
}

}  // namespace
}  // namespace careen::study
