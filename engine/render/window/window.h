#pragma once

#include <memory>
#include <string>
#include <vector>

#include "core/math/linear_algebra.h"
#include "image/picture.h"

namespace careen {

// Keys that write no character, after the last one of Unicode.
inline constexpr char32_t kKeyLeft = 0x110000;
inline constexpr char32_t kKeyRight = 0x110001;
inline constexpr char32_t kKeyHome = 0x110002;
inline constexpr char32_t kKeyEnd = 0x110003;
inline constexpr char32_t kKeyEscape = 0x110004;

/// The pointer with its button held, in pixels of the picture shown, from its upper left corner.
struct PointerDrag {
  Vec2 from = Vec2::Zero();  ///< where the button went down
  Vec2 to = Vec2::Zero();    ///< where the pointer is
  Vec2 by = Vec2::Zero();    ///< how far it came since the last one; none when the button goes down
};

/// What the user did, in order of each kind.
struct WindowEvents {
  std::vector<char32_t> keys;  ///< characters as the keyboard's layout has them, and kKey…; held ones repeat
  std::vector<PointerDrag> drags;
  double scrolled = 0;  ///< notches of the wheel, upward
};

/// A window that shows pictures, by GLFW, which is loaded at run time. One at a time, on the main thread.
class Window {
 public:
  /// Opened, but not to be seen before the first picture. MachineError if there is no display, or no GLFW
  /// or OpenGL 3.3 for it: says what is missing and what to install.
  explicit Window(const std::string& title);
  ~Window();
  Window(const Window&) = delete;
  Window& operator=(const Window&) = delete;
  Window(Window&&) = delete;
  Window& operator=(Window&&) = delete;

  void setTitle(const std::string& title);
  /// Shows a picture, its bytes as they are where the window is of its size, else scaled to fit. A picture of
  /// another size than the last sizes the window, as far as the screen goes.
  void show(const Picture& picture);
  /// Waits for something to happen, at most so long [s]; keeps the picture shown.
  WindowEvents wait(double seconds);
  /// Whether the user asked for its end.
  bool isClosing() const;

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace careen
