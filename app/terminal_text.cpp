#include "terminal_text.h"

#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <csignal>
#include <cstdlib>
#include <iostream>
#include <sstream>
#include <vector>

namespace careen {
namespace {

// Letters, not bytes: what begins with the bits 10 continues one of UTF-8.
std::size_t lettersOf(std::string_view text) {
  return static_cast<std::size_t>(std::count_if(text.begin(), text.end(), [](char byte) {
    return (static_cast<unsigned char>(byte) & 0xc0U) != 0x80U;
  }));
}

// The cells of "| a | b |"; "\|" is part of one.
std::vector<std::string> cellsOf(std::string_view row) {
  std::vector<std::string> cells;
  std::string cell;
  for (std::size_t i = 1; i < row.size(); ++i) {
    if (row[i] == '\\' && i + 1 < row.size() && row[i + 1] == '|') {
      cell += '|';
      ++i;
    } else if (row[i] == '|') {
      const std::size_t begin = cell.find_first_not_of(' ');
      cells.push_back(
          begin == std::string::npos ? "" : cell.substr(begin, cell.find_last_not_of(' ') + 1 - begin));
      cell.clear();
    } else {
      cell += row[i];
    }
  }
  return cells;
}

using Rows = std::vector<std::vector<std::string>>;

// Lines of columns under each other, or nothing if they are too wide.
std::string inColumns(const Rows& rows, std::size_t columns) {
  std::vector<std::size_t> widths;
  for (const std::vector<std::string>& row : rows) {
    widths.resize(std::max(widths.size(), row.size()));
    for (std::size_t i = 0; i < row.size(); ++i) {
      widths[i] = std::max(widths[i], lettersOf(row[i]));
    }
  }
  constexpr std::size_t kBetween = 2;
  std::size_t width = 0;
  for (const std::size_t each : widths) {
    width += each + kBetween;
  }
  if (width > columns + kBetween) {
    return "";
  }
  std::string text;
  for (const std::vector<std::string>& row : rows) {
    std::string line;
    for (std::size_t i = 0; i < row.size(); ++i) {
      line += row[i];
      line.append(widths[i] - lettersOf(row[i]) + kBetween, ' ');
    }
    text += line.substr(0, line.find_last_not_of(' ') + 1);
    text += '\n';
  }
  return text;
}

// A row as its first cell and, under it, the others after their columns' heads.
std::string asList(const Rows& rows, std::size_t columns) {
  std::string text;
  for (std::size_t r = 1; r < rows.size(); ++r) {
    text += wrapped(rows[r].empty() ? "" : rows[r][0], columns, 4);
    for (std::size_t i = 1; i < rows[r].size(); ++i) {
      if (!rows[r][i].empty()) {
        const std::string head = i < rows[0].size() && !rows[0][i].empty() ? rows[0][i] + ": " : "";
        text += wrapped("    " + head + rows[r][i], columns, 2);
      }
    }
    text += r + 1 < rows.size() ? "\n" : "";
  }
  return text;
}

// The table that begins with `line`; `line` is what follows it in the end.
std::string table(std::istream& lines, std::string& line, std::size_t columns) {
  Rows rows;
  bool more = true;
  for (; more && line.starts_with('|'); more = static_cast<bool>(std::getline(lines, line))) {
    if (line.find_first_not_of("|-: ") != std::string::npos || rows.empty()) {
      rows.push_back(cellsOf(line));
    }
  }
  line = more ? line : "";
  const std::string text = inColumns(rows, columns);
  return text.empty() ? asList(rows, columns) : text;
}

// How far the lines after the first of a list's entry are indented.
std::size_t indentOf(std::string_view line) {
  const std::size_t begin = std::min(line.find_first_not_of(' '), line.size());
  const std::size_t digits = std::min(line.find_first_not_of("0123456789", begin), line.size());
  if (digits > begin && line.substr(digits, 2) == ". ") {
    return digits + 2 - begin;
  }
  return line.substr(begin, 2) == "* " || line.substr(begin, 2) == "- " ? 2 : 0;
}

// This process goes on as the pager, which so has the terminal and its signals to itself; another one writes
// the text. Returns if that fails.
void becomePager(const std::string& text) {
  const char* const asked = std::getenv("PAGER");
  const char* const pager = asked != nullptr && *asked != '\0'
                                ? asked
                                : "if command -v less >/dev/null; then exec less -FRX; fi; exec cat";
  std::array<int, 2> ends = {};
  if (pipe(ends.data()) != 0) {
    return;
  }
  const pid_t writer = fork();
  if (writer == 0) {
    close(ends[0]);
    for (std::size_t done = 0; done < text.size();) {
      const ssize_t now = write(ends[1], text.data() + done, text.size() - done);
      if (now <= 0) {
        break;
      }
      done += static_cast<std::size_t>(now);
    }
    _exit(0);
  }
  close(ends[1]);
  if (writer > 0 && dup2(ends[0], STDIN_FILENO) == STDIN_FILENO) {
    sigset_t none;
    sigemptyset(&none);
    pthread_sigmask(SIG_SETMASK, &none, nullptr);  // those that the program takes by a thread of its own
    execl("/bin/sh", "sh", "-c", pager, nullptr);
  }
}

}  // namespace

std::size_t terminalColumns(int descriptor, std::size_t usual) {
  winsize size = {};
  return ioctl(descriptor, TIOCGWINSZ, &size) == 0 && size.ws_col > 1 ? size.ws_col : usual;
}

std::string wrapped(std::string_view text, std::size_t columns, std::size_t indent) {
  const std::size_t begin = std::min(text.find_first_not_of(' '), text.size());
  std::istringstream words{std::string(text)};
  std::string all;
  std::string line(begin, ' ');
  std::size_t blank = begin;  // of the line, before its words
  for (std::string word; words >> word;) {
    if (line.size() > blank && lettersOf(line) + 1 + lettersOf(word) > columns) {
      all += line;
      all += '\n';
      blank = begin + indent;
      line.assign(blank, ' ');
    }
    line += line.size() > blank ? " " : "";
    line += word;
  }
  all += line.size() > blank ? line : "";
  all += '\n';
  return all;
}

std::string wrappedMarkdown(std::string_view page, std::size_t columns) {
  std::istringstream lines{std::string(page)};
  std::string text;
  bool asIs = false;
  for (std::string line; std::getline(lines, line);) {
    if (!asIs && line.starts_with('|')) {
      text += table(lines, line, columns);
      if (!lines) {
        break;
      }
    }
    asIs = asIs != line.starts_with("```");
    text += asIs || line.starts_with("```") ? line + '\n' : wrapped(line, columns, indentOf(line));
  }
  return text;
}

std::string wrappedOptions(std::string_view help, std::size_t columns) {
  std::istringstream lines{std::string(help)};
  std::string text;
  for (std::string line; std::getline(lines, line);) {
    // CLI11 begins with what it tells 28 letters after a name, or on a line of its own if the name is longer.
    constexpr std::size_t kAfterName = 28;
    const std::size_t name = std::min(line.find_first_not_of(' '), line.size());
    const std::size_t told = name + kAfterName;
    if (lettersOf(line) <= columns || name == 0 || name >= kAfterName || line.size() <= told ||
        line[told - 1] != ' ' || told + kAfterName > columns) {
      text += wrapped(line, columns, name == 0 ? 2 : 0);
    } else {
      const std::string more = wrapped(std::string(told, ' ') + line.substr(told), columns);
      text += line.substr(0, told) + more.substr(told);
    }
  }
  return text;
}

std::optional<std::size_t> readingColumns() {
  constexpr std::size_t kMost = 100;
  return isatty(STDOUT_FILENO) == 0 ? std::nullopt
                                    : std::optional(std::min(terminalColumns(STDOUT_FILENO, kMost), kMost));
}

void showText(const std::string& text) {
  winsize size = {};
  if (ioctl(STDOUT_FILENO, TIOCGWINSZ, &size) == 0 &&
      std::count(text.begin(), text.end(), '\n') >= size.ws_row) {
    becomePager(text);
  }
  std::cout << text << std::flush;
}

}  // namespace careen
