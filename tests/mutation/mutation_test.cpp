// Small changes, each visible to a person or to a hash, and whether the comparison catches them.
#include <gtest/gtest.h>

#include <array>
#include <cstdio>
#include <limits>
#include <map>
#include <ostream>
#include <set>
#include <string>

#include "compare/run_difference.h"
#include "mutation/subject.h"
#include "render/stage.h"

namespace careen {
namespace {

struct NamedTable {
  const char* name;
  Mutations (*list)();
};
// Name in gtest's output, which would otherwise be its bytes.
std::ostream& operator<<(std::ostream& out, const NamedTable& table) { return out << table.name; }

const std::array kSeen = {NamedTable{"scenes", sceneMutations},
                          NamedTable{"camera", cameraMutations},
                          NamedTable{"light", lightMutations},
                          NamedTable{"materials", materialMutations},
                          NamedTable{"boxShaders", boxShaderMutations},
                          NamedTable{"surfaceShaders", surfaceShaderMutations},
                          NamedTable{"lightShaders", lightShaderMutations}};

Subject changed(const Mutation& mutation) {
  Subject subject = mutation.subject();
  mutation.change(subject);
  return subject;
}

PictureDifference differenceBy(const Mutation& mutation) {
  return differenceOf(unchangedPicture(mutation.subject()), pictureOf(changed(mutation)));
}

class SeenMutations : public testing::TestWithParam<NamedTable> {};

TEST_P(SeenMutations, areNotTheSamePicture) {
  const Tolerance tolerance = toleranceOf("same-picture");
  Margin nearest{.ratio = std::numeric_limits<double>::infinity(), .criterion = {}};
  std::string nearestName;
  std::size_t caught = 0;
  const Mutations mutations = GetParam().list();
  for (const Mutation& mutation : mutations) {
    const PictureDifference difference = differenceBy(mutation);
    const bool differs = judge(difference, tolerance).verdict == Verdict::kDifferent;
    const Margin margin = marginOf(difference, tolerance);
    EXPECT_EQ(differs, margin.ratio > 1) << mutation.name << ": the margin is not what is judged by";
    EXPECT_TRUE(differs) << mutation.name << ": largest difference " << 255 * difference.largest << "/255, "
                         << difference.pixelsOver(1.001 / 255) << " pixels by more than 1/255, "
                         << difference.changed << " of another colour, SSIM of a window "
                         << difference.worstSsim;
    std::printf("%-58s %-16s %10.3g\n", mutation.name.c_str(), margin.criterion.c_str(), margin.ratio);
    caught += differs ? 1 : 0;
    if (margin.ratio < nearest.ratio) {
      nearest = margin;
      nearestName = mutation.name;
    }
  }
  std::printf("caught %zu of %zu; nearest: %s, %s, %.3g times what is allowed\n", caught, mutations.size(),
              nearestName.c_str(), nearest.criterion.c_str(), nearest.ratio);
}

INSTANTIATE_TEST_SUITE_P(Of, SeenMutations, testing::ValuesIn(kSeen),
                         [](const auto& table) { return std::string(table.param.name); });

TEST(MotionMutations, areAnotherRun) {
  std::map<std::string, Trajectory> unchanged;
  std::size_t caught = 0;
  const Mutations mutations = motionMutations();
  for (const Mutation& mutation : mutations) {
    const Subject subject = mutation.subject();
    if (!unchanged.contains(subject.name)) {
      unchanged.emplace(subject.name, runOf(subject.scene));
      ASSERT_TRUE(differenceOf(unchanged.at(subject.name), runOf(subject.scene)).sameBits) << subject.name;
    }
    const Trajectory& before = unchanged.at(subject.name);
    const Trajectory after = runOf(changed(mutation).scene);
    const RunDifference difference = differenceOf(before, after);
    const bool hash = before.stateHash() != after.stateHash();
    EXPECT_FALSE(difference.sameBits) << mutation.name;
    std::printf("%-50s %s%s", mutation.name.c_str(), hash ? "hash" : "no hash",
                difference.incomparable.empty() ? "" : ", other bodies");
    if (difference.firstTime) {
      std::printf(", state from %.6g s", *difference.firstTime);
    }
    if (difference.firstImpact) {
      std::printf(", impact %zu", difference.firstImpact->index + 1);
    }
    std::printf(", farthest apart %.3g\n", difference.worst.difference.relative);
    caught += difference.sameBits ? 0 : 1;
  }
  std::printf("caught %zu of %zu\n", caught, mutations.size());
}

// The changes left out above, and why.
TEST(UnseenMutations, areOnesThatNobodySees) {
  for (const Mutation& mutation : unseenMutations()) {
    const PictureDifference difference = differenceBy(mutation);
    const Margin margin = marginOf(difference, toleranceOf("same-picture"));
    EXPECT_GT(difference.differing, 0U) << mutation.name << " changes nothing at all";
    // Where another edge becomes a pixel's nearest, a box that hardly moved changes it by up to 4 / 255.
    EXPECT_LE(difference.largest, 4.001 / 255) << mutation.name;
    std::printf("%-40s largest %.0f/255, %zu of %zu pixels, %.3g of what same-picture allows\n",
                mutation.name.c_str(), 255 * difference.largest, difference.differing, difference.pixels,
                margin.ratio);
  }
}

TEST(AllMutations, areTwoHundredOfDifferentNames) {
  std::set<std::string> names;
  std::size_t count = 0;
  const auto take = [&](const Mutations& mutations) {
    for (const Mutation& mutation : mutations) {
      names.insert(mutation.name);
      ++count;
    }
  };
  take(motionMutations());
  for (const NamedTable& table : kSeen) {
    take(table.list());
  }
  EXPECT_EQ(names.size(), count);
  EXPECT_GE(count, 200U);
  std::printf("%zu mutations\n", count);
}

}  // namespace
}  // namespace careen
