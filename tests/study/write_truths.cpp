// Recomputes the truths of the hard cases and writes them: careen_truths DIR, one file per case.
#include <exception>
#include <filesystem>
#include <fstream>
#include <iostream>

#include "study/truths.h"

int main(int argc, char** argv) {
  if (argc != 2) {
    std::cerr << "usage: careen_truths DIR\n";
    return 2;
  }
  try {
    const std::filesystem::path folder = argv[1];
    for (const std::string& name : careen::study::truthNames()) {
      std::ofstream file(folder / (name + ".json"));
      file << careen::study::toText(careen::study::computeTruth(name));
      if (!file.flush()) {
        std::cerr << "cannot write " << folder / (name + ".json") << '\n';
        return 3;
      }
    }
  } catch (const std::exception& error) {
    std::cerr << error.what() << '\n';
    return 3;
  }
  return 0;
}
