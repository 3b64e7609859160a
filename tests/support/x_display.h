#pragma once

#include <memory>
#include <string>

#include "image/picture.h"

namespace careen {

/// A display of its own for one test, by Xvfb, and somebody who sits at it. There is one window at a time.
class XDisplay {
 public:
  /// Size of its screen [px].
  XDisplay(int width, int height);
  ~XDisplay();
  XDisplay(const XDisplay&) = delete;
  XDisplay& operator=(const XDisplay&) = delete;
  XDisplay(XDisplay&&) = delete;
  XDisplay& operator=(XDisplay&&) = delete;

  /// As the environment variable DISPLAY has it.
  const std::string& name() const;

  /// The window's title; empty while none is to be seen.
  std::string title() const;
  /// What is to be seen of the window; of no size while there is none.
  Picture screenshot() const;

  /// A key by X's name for it, pressed and let go.
  void press(const std::string& key) const;
  /// The left button from one place in the window to another [px].
  void drag(int fromX, int fromY, int toX, int toY) const;
  /// The wheel, a notch upward, over the middle of the window.
  void scroll() const;

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace careen
