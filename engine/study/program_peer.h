#pragma once

#include <memory>
#include <mutex>

#include "core/system/dialogue.h"
#include "core/system/scratch_folder.h"
#include "study/contestant.h"

namespace careen {

/// Another engine in a program of its own, which this one keeps running from its first run on. It asks by a
/// line of JSON and is told, likewise, that a table of poses has been written, and what time of cores the
/// run took by the program's own clock. tests/peers/runner.mjs describes both.
class ProgramPeer : public Contestant {
 public:
  ProgramPeer(std::string name, std::string settings, std::vector<std::string> command);

  std::string name() const override { return name_; }
  std::string settings() const override { return settings_; }
  bool steps() const override { return true; }
  std::string refuses(const World& world) const override;
  std::vector<std::vector<BodyState>> run(const World& world, double dt, std::span<const double> times,
                                          const std::stop_token& stop) const override;
  double secondsTaken() const override;

 private:
  /// What runs have taken. Beginning and the end of one meet with secondsTaken() of another thread.
  struct Time {
    mutable std::mutex mutex;
    double ended = 0;                 // [s] of runs that have ended, by the program's own clock
    const Dialogue* asked = nullptr;  // during a run
    double begun = 0;                 // [s] of cores that the program had taken at its beginning
  };

  std::string answer(const std::string& question, const std::stop_token& stop) const;

  std::string name_;
  std::string settings_;
  std::vector<std::string> command_;
  ScratchFolder folder_;
  mutable std::unique_ptr<Dialogue> program_;
  mutable Time time_;
};

}  // namespace careen
