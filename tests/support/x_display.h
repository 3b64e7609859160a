#pragma once

#include <memory>
#include <string>

#include "image/picture.h"

namespace careen {

/// A display for one test, by Xvfb, with simulated user input. At most one window at a time.
class XDisplay {
 public:
  /// Size of its screen [px].
  XDisplay(int width, int height);
  ~XDisplay();
  XDisplay(const XDisplay&) = delete;
  XDisplay& operator=(const XDisplay&) = delete;
  XDisplay(XDisplay&&) = delete;
  XDisplay& operator=(XDisplay&&) = delete;

  /// Value for the environment variable DISPLAY.
  const std::string& name() const;

  /// The window's title; empty if no window is visible.
  std::string title() const;
  /// Screenshot of the window; of size 0 if there is none.
  Picture screenshot() const;

  /// Presses and releases a key, by its X name.
  void press(const std::string& key) const;
  /// Drags with the left button from one place in the window to another [px].
  void drag(int fromX, int fromY, int toX, int toY) const;
  /// Turns the wheel one notch upward, over the middle of the window.
  void scroll() const;

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace careen
