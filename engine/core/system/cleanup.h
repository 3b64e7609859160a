#pragma once

#include <functional>
#include <list>

namespace careen {

/// What has to be undone if the process must end before this object's scope does: a partial file, a program
/// that was started, a folder that was made. The object's owner does it in its own destructor otherwise.
class Cleanup {
 public:
  explicit Cleanup(std::function<void()> undo);
  /// Forgets it.
  ~Cleanup();
  Cleanup(const Cleanup&) = delete;
  Cleanup& operator=(const Cleanup&) = delete;
  Cleanup(Cleanup&&) = delete;
  Cleanup& operator=(Cleanup&&) = delete;

 private:
  std::list<std::function<void()>>::iterator place_;
};

/// Does what all living Cleanups say, the latest first, and keeps every other thread from making or ending
/// one: the process must end now. May be called while other threads work.
void cleanUpToEnd();

}  // namespace careen
