#include "exchange/mjcf_tree.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <set>

#include "core/disjoint_sets.h"
#include "exchange/xml_tree.h"

namespace careen {
namespace {

using JointKind = Joint::Kind;

constexpr int kDeepestMjcfBody = kDeepestXml - 3;  // in <mujoco> and <worldbody>, with a <geom> in it

class TreeBuilder {
 public:
  explicit TreeBuilder(const World& world)
      : world_(world), joints_(world.bodies.size() + 1), depth_(world.bodies.size(), 1) {
    tree_.parent.resize(world.bodies.size());
    tree_.joint.resize(world.bodies.size());
    tree_.oneWith.resize(world.bodies.size());
    if (world.control) {
      for (const Motor& motor : world.control->motors) {
        driven_.insert(static_cast<std::size_t>(motor.joint));
      }
    }
  }

  MjcfTree build() {
    choose();
    std::vector<bool> isHeld(world_.bodies.size() + 1);
    hang(ground(), isHeld);
    for (std::size_t i = 0; i < world_.bodies.size(); ++i) {
      if (!isHeld[i] && !isImmovable(world_.bodies[i].mass)) {
        hang(i, isHeld);
      }
    }
    std::sort(tree_.closing.begin(), tree_.closing.end());
    sort();
    return std::move(tree_);
  }

 private:
  std::size_t ground() const { return world_.bodies.size(); }
  std::size_t nodeOf(const JointEnd& end) const {
    const auto body = static_cast<std::size_t>(end.body.value_or(0));
    return !end.body || isImmovable(world_.bodies[body].mass) ? ground() : body;
  }

  int rankOf(std::size_t index) const {
    const Joint& joint = world_.joints[index];
    switch (joint.kind) {
      case JointKind::kSlider:
        return 0;
      case JointKind::kHinge:
        return joint.isLoaded() || std::isfinite(joint.lowest) || driven_.contains(index) ? 1 : 3;
      case JointKind::kFixed:
        return 2;
      default:
        return 4;
    }
  }

  void choose() {
    std::vector<std::size_t> candidates;
    for (std::size_t i = 0; i < world_.joints.size(); ++i) {
      if (world_.joints[i].kind != JointKind::kRod && world_.joints[i].kind != JointKind::kRope) {
        candidates.push_back(i);
      }
    }
    std::stable_sort(candidates.begin(), candidates.end(),
                     [this](std::size_t a, std::size_t b) { return rankOf(a) < rankOf(b); });
    DisjointSets sets(world_.bodies.size() + 1);
    for (const std::size_t each : candidates) {
      const std::size_t one = nodeOf(world_.joints[each].from);
      const std::size_t other = nodeOf(world_.joints[each].to);
      if (sets.root(one) == sets.root(other)) {
        tree_.closing.push_back(each);
      } else {
        sets.join(one, other);
        joints_[one].push_back(each);
        joints_[other].push_back(each);
      }
    }
  }

  // What hangs on a node.
  void hang(std::size_t root, std::vector<bool>& isHeld) {
    std::vector<std::size_t> open = {root};
    isHeld[root] = true;
    if (root != ground()) {
      tree_.oneWith[root] = static_cast<int>(root);
    }
    while (!open.empty()) {
      const std::size_t node = open.back();
      open.pop_back();
      for (const std::size_t each : joints_[node]) {
        const Joint& joint = world_.joints[each];
        const bool isFrom = nodeOf(joint.from) != node;
        const std::size_t body = nodeOf(isFrom ? joint.from : joint.to);
        const std::optional<int> holder = (isFrom ? joint.to : joint.from).body;
        const int depth = holder ? depth_[static_cast<std::size_t>(*holder)] + 1 : 1;
        if (isHeld[body]) {
          continue;
        }
        if (depth > kDeepestMjcfBody) {
          tree_.closing.push_back(each);  // the body is free, or held by what hangs on it
        } else {
          isHeld[body] = true;
          depth_[body] = depth;
          tree_.parent[body] = holder;
          tree_.joint[body] = each;
          const bool isOne = joint.kind == JointKind::kFixed;
          tree_.oneWith[body] = !isOne             ? static_cast<int>(body)
                                : node == ground() ? std::nullopt
                                                   : tree_.oneWith[node];
          open.push_back(body);
        }
      }
    }
  }

  void sort() {
    std::vector<std::vector<int>> inside(world_.bodies.size() + 1);
    for (std::size_t i = world_.bodies.size(); i-- > 0;) {  // the last first, as they are taken from a stack
      inside[tree_.parent[i] ? static_cast<std::size_t>(*tree_.parent[i]) : ground()].push_back(
          static_cast<int>(i));
    }
    std::vector<int> open = inside[ground()];
    while (!open.empty()) {
      const int body = open.back();
      open.pop_back();
      tree_.order.push_back(body);
      const std::vector<int>& next = inside[static_cast<std::size_t>(body)];
      open.insert(open.end(), next.begin(), next.end());
    }
  }

  const World& world_;
  MjcfTree tree_;
  std::vector<std::vector<std::size_t>> joints_;  // of the tree, by node: a body, or all that is fixed
  std::set<std::size_t> driven_;
  std::vector<int> depth_;  // of each body, 1 in the world
};

}  // namespace

bool MjcfTree::areJoined(int a, int b) const {
  const std::optional<int> one = oneWith[static_cast<std::size_t>(a)];
  const std::optional<int> other = oneWith[static_cast<std::size_t>(b)];
  const auto isIn = [this](int group, int outer) {
    const std::optional<int> holder = parent[static_cast<std::size_t>(group)];
    return holder && oneWith[static_cast<std::size_t>(*holder)] == outer;
  };
  return one == other || (one && other && (isIn(*one, *other) || isIn(*other, *one)));
}

MjcfTree treeOf(const World& world) { return TreeBuilder(world).build(); }

}  // namespace careen
