#include "physics/pile/solver.h"

namespace careen {

void PileSolver::begin(std::size_t bodies, Rows rows) {
  bodies_.assign(bodies, {});
  moving_.assign(bodies, {});
  if (rows == Rows::kAdded) {  // else all are overwritten
    list_.clear();
  }
}

void PileSolver::reserve(Extent all) {
  list_.reserve(all);
  firstBelt_ = static_cast<int>(bodies_.size());
  bodies_.resize(bodies_.size() + at(all.belts), {.isBelt = true});
  moving_.resize(bodies_.size());
}

int PileSolver::addBelt(const Moving& motion) {
  bodies_.push_back({.isBelt = true});
  moving_.push_back(motion);
  return static_cast<int>(bodies_.size()) - 1;
}

int PileSolver::setBelt(int belt, const Moving& motion) {
  moving_[at(firstBelt_ + belt)] = motion;
  return firstBelt_ + belt;
}

void PileSolver::setBlock(Extent index, int count, int a, int b, double friction, const ContactFrame& frame,
                          const Vec3& apart) {
  list_.setBlock(index.blocks, {.a = a,
                                .b = b,
                                .first = index.rows,
                                .count = count,
                                .friction = friction,
                                .frame = frame,
                                .apart = apart});
}

void PileSolver::link() {
  rows_.fill(list_, bodies_);
  sweep_.begin(rows_.groups());
  moving_.resize(rows_.groups().bodyCount());
}

void PileSolver::wakeAll() {
  for (std::size_t block = 0; block < blockCount(); ++block) {
    sweep_.wake(rows_.groups().placeOf(static_cast<int>(block)));
  }
}

PileSolver::RowView PileSolver::row(int row) const {
  const PileRow& listed = list_.rows()[at(row)];
  const RowBlock& block = list_.blocks()[at(list_.blockOf(row))];
  return {.a = block.a,
          .b = block.b,
          .armA = listed.arm,
          .armB = listed.arm + block.apart,
          .axes = block.frame.axes(),
          .friction = block.friction,
          .bound = rows_.of(row).bound[rows_.laneOf(row)],
          .impulse = {normalImpulse(row), tangential1(row), tangential2(row)}};
}

void PileSolver::setImpulse(int row, const std::array<double, 3>& impulse) {
  LaneRow& to = rows_.of(row);
  const int lane = rows_.laneOf(row);
  const RowBlock& block = list_.blocks()[at(list_.blockOf(row))];
  const bool changed = impulse[0] != to.normalImpulse[lane] || impulse[0] > 0;
  to.normalImpulse[lane] = impulse[0];
  to.tangential1[lane] = impulse[1];
  to.tangential2[lane] = impulse[2];
  for (const int body : {block.a, block.b}) {
    Moving& moving = moving_[at(body)];
    moving.pushed = changed && bodies_[at(body)].moves() ? 1 : moving.pushed;
  }
}

void PileSolver::warmStart() {
  if (rows_.workOfImpulses(moving_) > 0) {
    rows_.clearImpulses();
  } else {
    rows_.push(moving_);
  }
}

std::int64_t PileSolver::solve(int sweeps, Friction friction) {
  const auto kind =
      friction == Friction::kCoulomb ? LaneSweep::Kind::kFriction : LaneSweep::Kind::kFrictionless;
  return sweep_.run(kind, sweeps, rows_, moving_);
}

void PileSolver::beginShifts(double h) {
  shifts_.assign(moving_.size(), {});
  rows_.beginShifts(h, moving_);
}

}  // namespace careen
