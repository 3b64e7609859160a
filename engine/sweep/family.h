#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "scene/json_tree.h"
#include "scene/scene.h"
#include "sweep/random_stream.h"

namespace careen {

/// Something of a family that varies.
struct Varying {
  std::string path;   ///< "boxes[0].position[2]", "film.fps"
  std::string range;  ///< "uniform 0.1 to 0.4", as people read it
  bool inBoxes = false;
};

/// A scene in which values may be distributions, and its run number k for any k.
///
/// A distribution is an object with one key, where the scene has a value:
///   {"uniform": [a, b]}            a number from a to b
///   {"uniform_integer": [a, b]}    a whole number, both included
///   {"normal": [mean, deviation]}
///   {"log_uniform": [a, b]}        a number whose logarithm is uniform; 0 < a
///   {"choice": [value, …]}         one of these values, whatever they are; each may hold distributions
///   {"unit_vector": length}        [x, y, z] of that length, in any direction
///   {"rotation": "uniform"}        [w, x, y, z], any orientation
/// A box may have a "count", a whole number or a distribution of one: so many boxes, whose values are drawn
/// one by one, named NAME-1, NAME-2 … . `"sweep": {"seed": 1, "tries": 1000}` at the top are the defaults.
/// Boxes that overlap, or are behind walls, at the start are drawn again, all values of the run, up to that
/// many times, and as long as these are
/// not more than 200,000 boxes.
class Family {
 public:
  /// InputError "file:line:column: found …, expected …" for what is no distribution, and if run 0 cannot be
  /// made.
  Family(std::string text, std::string name);

  const std::string& name() const { return name_; }
  const std::vector<Varying>& varying() const { return varying_; }
  std::uint64_t seed() const { return seed_; }
  int tries() const { return tries_; }

  struct Member {
    Scene scene;
    int attempts = 1;
    std::vector<double> drawn;  ///< the numbers drawn outside boxes, in the order of columns()
  };
  /// Run k: the same on every machine. InputError if no start without overlap is found, and if what was drawn
  /// is no scene; the message says "family.json (run 17)", and lines are those of the scene's text.
  Member member(std::uint64_t run) const;
  /// Paths of the numbers that vary outside boxes.
  std::vector<std::string> columns() const;

 private:
  friend class FamilyWriter;
  void readSettings();

  JsonTree tree_;
  std::string name_;
  std::uint64_t seed_ = 1;
  int tries_ = 1000;
  std::vector<Varying> varying_;
};

/// Whether the text is that of a family: a scene with a distribution, a count or "sweep". False if it is no
/// JSON.
bool looksLikeFamily(const std::string& text);

}  // namespace careen
