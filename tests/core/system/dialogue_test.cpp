#include "core/system/dialogue.h"

#include <gtest/gtest.h>

#include <chrono>
#include <stop_token>
#include <string>
#include <thread>

#include "core/error.h"

namespace careen {
namespace {

const std::vector<std::string> kEcho = {"sh", "-c", "while read -r line; do echo \"$line!\"; done"};

std::string failureOf(Dialogue& dialogue) {
  try {
    return "answered " + dialogue.ask("one", {});
  } catch (const MachineError& error) {
    return error.what();
  }
}

TEST(Dialogue, answersLineByLine) {
  Dialogue dialogue(kEcho);
  EXPECT_EQ(dialogue.ask("one", {}), "one!");
  EXPECT_EQ(dialogue.ask("", {}), "!");
  EXPECT_EQ(dialogue.ask("three", {}), "three!");
}

TEST(Dialogue, takesLinesLongerThanAnyBuffer) {
  Dialogue dialogue(kEcho);
  const std::string line(1000000, 'x');
  EXPECT_EQ(dialogue.ask(line, {}), line + "!");
}

TEST(Dialogue, saysWhatCannotBeStarted) {
  try {
    const Dialogue dialogue({"no-such-program"});
    ADD_FAILURE() << "was started";
  } catch (const MachineError& error) {
    EXPECT_STREQ(error.what(), "cannot start no-such-program: No such file or directory");
  }
}

TEST(Dialogue, showsTheEndOfTheLogOfAProgramThatEnds) {
  Dialogue dialogue({"sh", "-c", "read -r line; echo 'the cause' >&2; exit 3"});
  EXPECT_EQ(failureOf(dialogue), "sh ended without an answer: the cause");
  EXPECT_EQ(failureOf(dialogue), "sh ended without an answer");
}

// A program that never answers, stopped from another thread.
TEST(Dialogue, endsTheProgramWhenStopped) {
  Dialogue dialogue({"sh", "-c", "read -r line; sleep 1000"});
  std::stop_source source;
  const std::jthread stops([&source] {
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
    source.request_stop();
  });
  EXPECT_THROW(dialogue.ask("one", source.get_token()), Interrupted);
}

// It computes until its own clock says that a fifth of a second has gone, and waits.
TEST(Dialogue, knowsTheTimeOfCoresThatTheProgramTook) {
  const std::string compute =
      "read -r line; i=0; while [ $i -lt 200000 ]; do i=$((i + 1)); done; echo done; read -r line; sleep "
      "1000";
  Dialogue dialogue({"sh", "-c", compute});
  const double before = dialogue.coreSeconds();
  dialogue.ask("one", {});
  const double taken = dialogue.coreSeconds();
  EXPECT_GT(taken, before + 0.01);
  std::this_thread::sleep_for(std::chrono::milliseconds(200));
  EXPECT_LT(dialogue.coreSeconds(), taken + 0.1);
  std::stop_source source;
  source.request_stop();
  EXPECT_THROW(dialogue.ask("two", source.get_token()), Interrupted);
  EXPECT_GE(dialogue.coreSeconds(), taken - 0.01);  // also after its end
}

}  // namespace
}  // namespace careen
