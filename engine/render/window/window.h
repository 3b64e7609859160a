#pragma once

#include <memory>
#include <string>
#include <vector>

#include "core/math/linear_algebra.h"
#include "image/picture.h"

namespace careen {

// Keys without a character, numbered after the last Unicode code point.
inline constexpr char32_t kKeyLeft = 0x110000;
inline constexpr char32_t kKeyRight = 0x110001;
inline constexpr char32_t kKeyHome = 0x110002;
inline constexpr char32_t kKeyEnd = 0x110003;
inline constexpr char32_t kKeyEscape = 0x110004;

/// A drag with the button held, in pixels of the picture shown, from its upper left corner.
struct PointerDrag {
  Vec2 from = Vec2::Zero();  ///< where the button was pressed
  Vec2 to = Vec2::Zero();    ///< current position
  Vec2 by = Vec2::Zero();    ///< movement since the last event; zero when the button is pressed
};

/// User input, in order within each kind.
struct WindowEvents {
  std::vector<char32_t> keys;  ///< characters of the keyboard layout, and kKey…; held keys repeat
  std::vector<PointerDrag> drags;
  double scrolled = 0;  ///< wheel notches, upward
};

/// A window that shows pictures, using GLFW loaded at run time. One at a time, on the main thread.
class Window {
 public:
  /// Opens the window, hidden until the first picture. MachineError, saying what is missing and what to
  /// install, if there is no display, GLFW or OpenGL 3.3.
  explicit Window(const std::string& title);
  ~Window();
  Window(const Window&) = delete;
  Window& operator=(const Window&) = delete;
  Window(Window&&) = delete;
  Window& operator=(Window&&) = delete;

  void setTitle(const std::string& title);
  /// Shows a picture, unscaled if the window has its size, else scaled to fit. A picture of another size than
  /// the last resizes the window, limited by the screen.
  void show(const Picture& picture);
  /// Waits for events, at most `seconds` [s]; redraws the picture if needed.
  WindowEvents wait(double seconds);
  /// Whether the user has closed the window.
  bool isClosing() const;

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace careen
