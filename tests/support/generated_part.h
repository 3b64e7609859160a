#pragma once

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <string>

#include "core/system/file.h"

namespace careen {

/// Expects `text` in a document after the first `begin` and before the next `end`: a part of it that is made
/// from the program's own lists. With CAREEN_WRITE=1 in the environment it is written instead.
inline void expectGenerated(const std::filesystem::path& document, const std::string& begin,
                            const std::string& end, const std::string& text) {
  std::string all = readFile(document);
  const std::size_t found = all.find(begin);
  ASSERT_NE(found, std::string::npos) << document << " has no " << begin;
  const std::size_t from = found + begin.size();
  const std::size_t to = all.find(end, from);
  ASSERT_NE(to, std::string::npos) << document << " has no " << end;
  if (std::getenv("CAREEN_WRITE") != nullptr) {
    writeFile(document, all.replace(from, to - from, text));
  } else {
    EXPECT_EQ(all.substr(from, to - from), text) << document << "; with CAREEN_WRITE=1 it is written anew";
  }
}

}  // namespace careen
