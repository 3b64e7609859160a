#include "render/gl/gl_context.h"

#include <gtest/gtest.h>

#include <string>

#include "core/error.h"

namespace careen {
namespace {

/// Writes down what it is told to do.
class Written : public GlContext {
 public:
  Written(std::string name, std::string& log) : name_(std::move(name)), log_(log) {}
  ~Written() override { release(); }
  Written(const Written&) = delete;
  Written& operator=(const Written&) = delete;
  Written(Written&&) = delete;
  Written& operator=(Written&&) = delete;

  void* function(const char* /*name*/) const override { return nullptr; }
  const std::string& library() const override { return name_; }

  bool fails = false;

 private:
  void bind() override {
    if (fails) {
      throw MachineError("cannot");
    }
    log_ += "+" + name_;
  }
  void unbind() override { log_ += "-" + name_; }

  std::string name_;
  std::string& log_;
};

TEST(GlContext, isBoundOnceHoweverOftenItIsMadeCurrent) {
  std::string log;
  Written a("a", log);
  a.makeCurrent();
  a.makeCurrent();
  EXPECT_EQ(log, "+a");
}

// Each library knows of its own context only: the other one's must have let go first.
TEST(GlContext, ofAnotherLibraryLetsGoBeforeTheNextIsBound) {
  std::string log;
  Written a("a", log);
  Written b("b", log);
  a.makeCurrent();
  b.makeCurrent();
  a.makeCurrent();
  EXPECT_EQ(log, "+a-a+b-b+a");
}

TEST(GlContext, letsGoWhenItEndsIfItIsCurrent) {
  std::string log;
  Written a("a", log);
  {
    Written b("b", log);
    b.makeCurrent();
    Written c("c", log);
    c.makeCurrent();
  }
  EXPECT_EQ(log, "+b-b+c-c");
  a.makeCurrent();
  EXPECT_EQ(log, "+b-b+c-c+a");
}

TEST(GlContext, thatCannotBeBoundIsNotCurrent) {
  std::string log;
  Written a("a", log);
  Written b("b", log);
  a.makeCurrent();
  b.fails = true;
  EXPECT_THROW(b.makeCurrent(), MachineError);
  b.fails = false;
  b.makeCurrent();
  EXPECT_EQ(log, "+a-a+b");
}

}  // namespace
}  // namespace careen
