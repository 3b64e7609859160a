#include <GL/glcorearb.h>

#include "render/window/window.h"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>

#include "core/error.h"
#include "render/gl/gl.h"
#include "render/gl/gl_context.h"
#include "render/gl/shared_library.h"

// All GLFW functions used, from version 3.3.
#define CAREEN_GLFW_FUNCTIONS(X) \
  X(Init)                        \
  X(GetError)                    \
  X(WindowHint)                  \
  X(CreateWindow)                \
  X(DestroyWindow)               \
  X(ShowWindow)                  \
  X(SetWindowTitle)              \
  X(SetWindowSize)               \
  X(GetWindowSize)               \
  X(GetFramebufferSize)          \
  X(WindowShouldClose)           \
  X(SetKeyCallback)              \
  X(SetCharCallback)             \
  X(SetMouseButtonCallback)      \
  X(SetCursorPosCallback)        \
  X(SetScrollCallback)           \
  X(SetFramebufferSizeCallback)  \
  X(SetWindowRefreshCallback)    \
  X(GetPrimaryMonitor)           \
  X(GetMonitorWorkarea)          \
  X(MakeContextCurrent)          \
  X(GetProcAddress)              \
  X(SwapInterval)                \
  X(SwapBuffers)                 \
  X(PollEvents)                  \
  X(WaitEventsTimeout)

namespace careen {
namespace {

constexpr const char* kRemedy = "install it: apt install libglfw3";

/// GLFW. Never terminated before the process ends: that would unload the driver, which Mesa's do not support.
class Glfw {
 public:
  Glfw() : library_({"libglfw.so.3"}, kRemedy) {
#define CAREEN_GLFW_LOAD(name) name = library_.function<decltype(&glfw##name)>("glfw" #name);
    CAREEN_GLFW_FUNCTIONS(CAREEN_GLFW_LOAD)
#undef CAREEN_GLFW_LOAD
    if (Init() == GLFW_FALSE) {
      throw MachineError("no display: 'careen view' needs one for its window ('careen render' needs none): " +
                         failure());
    }
  }
  ~Glfw() = default;
  Glfw(const Glfw&) = delete;
  Glfw& operator=(const Glfw&) = delete;
  Glfw(Glfw&&) = delete;
  Glfw& operator=(Glfw&&) = delete;

  // NOLINTNEXTLINE(bugprone-macro-parentheses): a name, not a value
#define CAREEN_GLFW_MEMBER(name) decltype(&glfw##name) name = nullptr;
  CAREEN_GLFW_FUNCTIONS(CAREEN_GLFW_MEMBER)
#undef CAREEN_GLFW_MEMBER

  std::string failure() const {
    const char* words = nullptr;
    GetError(&words);
    return words == nullptr ? library_.name() + " does not say why" : words;
  }
  const std::string& name() const { return library_.name(); }

 private:
  SharedLibrary library_;
};

class HiddenWindow {
 public:
  HiddenWindow(const Glfw& glfw, const std::string& title) : glfw_(glfw) {
    constexpr int kSomeSize = 320;  // [px] until the first picture
    constexpr std::array<std::pair<int, int>, 6> kHints = {{{GLFW_VISIBLE, GLFW_FALSE},
                                                            {GLFW_CONTEXT_VERSION_MAJOR, 3},
                                                            {GLFW_CONTEXT_VERSION_MINOR, 3},
                                                            {GLFW_OPENGL_PROFILE, GLFW_OPENGL_CORE_PROFILE},
                                                            {GLFW_OPENGL_FORWARD_COMPAT, GLFW_TRUE},
                                                            {GLFW_DEPTH_BITS, 0}}};
    for (const auto& [hint, value] : kHints) {
      glfw.WindowHint(hint, value);
    }
    handle_ = glfw.CreateWindow(kSomeSize, kSomeSize, title.c_str(), nullptr, nullptr);
    if (handle_ == nullptr) {
      throw MachineError("no window can be opened: " + glfw.failure() +
                         "; OpenGL 3.3 for windows comes with: apt install libgl1 libgl1-mesa-dri");
    }
  }
  ~HiddenWindow() { glfw_.DestroyWindow(handle_); }
  HiddenWindow(const HiddenWindow&) = delete;
  HiddenWindow& operator=(const HiddenWindow&) = delete;
  HiddenWindow(HiddenWindow&&) = delete;
  HiddenWindow& operator=(HiddenWindow&&) = delete;

  GLFWwindow* handle() const { return handle_; }

 private:
  const Glfw& glfw_;
  GLFWwindow* handle_ = nullptr;
};

/// The GL context of a GLFW window.
class WindowContext final : public GlContext {
 public:
  WindowContext(const Glfw& glfw, GLFWwindow* window) : glfw_(glfw), window_(window) { makeCurrent(); }
  ~WindowContext() override { release(); }
  WindowContext(const WindowContext&) = delete;
  WindowContext& operator=(const WindowContext&) = delete;
  WindowContext(WindowContext&&) = delete;
  WindowContext& operator=(WindowContext&&) = delete;

  void* function(const char* name) const override {
    void* const found = reinterpret_cast<void*>(glfw_.GetProcAddress(name));
    if (found == nullptr) {
      throw MachineError("the window's OpenGL has no " + std::string(name));
    }
    return found;
  }
  const std::string& library() const override { return glfw_.name(); }

 private:
  void bind() override { glfw_.MakeContextCurrent(window_); }
  void unbind() override { glfw_.MakeContextCurrent(nullptr); }

  const Glfw& glfw_;
  GLFWwindow* window_;
};

char32_t keyOf(int key) {
  switch (key) {
    case GLFW_KEY_LEFT:
      return kKeyLeft;
    case GLFW_KEY_RIGHT:
      return kKeyRight;
    case GLFW_KEY_HOME:
      return kKeyHome;
    case GLFW_KEY_END:
      return kKeyEnd;
    case GLFW_KEY_ESCAPE:
      return kKeyEscape;
    default:
      return 0;  // a character key, or ignored
  }
}

// Scales a picture to fit a space of another size, centred.
struct Fit {
  Fit(const Vec2& picture, const Vec2& space)
      : scale((space.array() / picture.array()).minCoeff()), corner(0.5 * (space - scale * picture)) {}

  double scale;
  Vec2 corner;  // upper left, in space coordinates
};

}  // namespace

struct Window::Parts {
  explicit Parts(const std::string& title);
  ~Parts();
  Parts(const Parts&) = delete;
  Parts& operator=(const Parts&) = delete;
  Parts(Parts&&) = delete;
  Parts& operator=(Parts&&) = delete;

  void listen() const;
  void press(bool down);
  void movePointer(double x, double y);
  void upload(const Picture& picture);
  void resize() const;
  void present();

  Glfw glfw;
  HiddenWindow window;
  WindowContext context;
  Gl gl;
  unsigned texture = 0;
  unsigned framebuffer = 0;
  Vec2 size = Vec2::Zero();  // [px] of the picture; zero: none yet
  bool lost = false;         // whether the picture must be redrawn
  Vec2 pointer = Vec2::Zero();
  std::optional<PointerDrag> drag;
  WindowEvents events;

  static Parts* open;  // GLFW callbacks get only a handle
};

Window::Parts* Window::Parts::open = nullptr;

Window::Parts::Parts(const std::string& title)
    : window(glfw, title), context(glfw, window.handle()), gl(context) {
  glfw.SwapInterval(0);  // no vsync: some compositors block hidden windows
  gl.GenTextures(1, &texture);
  gl.BindTexture(GL_TEXTURE_2D, texture);
  gl.GenFramebuffers(1, &framebuffer);
  open = this;
  listen();
}

Window::Parts::~Parts() { open = nullptr; }

void Window::Parts::listen() const {
  GLFWwindow* const handle = window.handle();
  glfw.SetKeyCallback(handle, [](GLFWwindow*, int key, int, int action, int) {
    if (action != GLFW_RELEASE && keyOf(key) != 0) {
      open->events.keys.push_back(keyOf(key));
    }
  });
  glfw.SetCharCallback(handle,
                       [](GLFWwindow*, unsigned character) { open->events.keys.push_back(character); });
  glfw.SetMouseButtonCallback(handle, [](GLFWwindow*, int button, int action, int) {
    if (button == GLFW_MOUSE_BUTTON_LEFT) {
      open->press(action == GLFW_PRESS);
    }
  });
  glfw.SetCursorPosCallback(handle, [](GLFWwindow*, double x, double y) { open->movePointer(x, y); });
  glfw.SetScrollCallback(handle, [](GLFWwindow*, double, double y) { open->events.scrolled += y; });
  glfw.SetFramebufferSizeCallback(handle, [](GLFWwindow*, int, int) { open->lost = true; });
  glfw.SetWindowRefreshCallback(handle, [](GLFWwindow*) { open->lost = true; });
}

void Window::Parts::press(bool down) {
  drag.reset();
  if (down) {
    drag = PointerDrag{.from = pointer, .to = pointer};
    events.drags.push_back(*drag);
  }
}

void Window::Parts::movePointer(double x, double y) {
  int width = 0;
  int height = 0;
  glfw.GetWindowSize(window.handle(), &width, &height);
  if (size.isZero() || width < 1 || height < 1) {
    return;
  }
  const Fit fit(size, Vec2(width, height));
  pointer = (Vec2(x, y) - fit.corner) / fit.scale;
  if (drag) {
    drag->by = pointer - drag->to;
    drag->to = pointer;
    events.drags.push_back(*drag);
  }
}

void Window::Parts::upload(const Picture& picture) {
  context.makeCurrent();
  gl.BindTexture(GL_TEXTURE_2D, texture);
  gl.PixelStorei(GL_UNPACK_ALIGNMENT, 1);
  gl.TexImage2D(GL_TEXTURE_2D, 0, GL_RGBA8, picture.width, picture.height, 0, GL_RGB, GL_UNSIGNED_BYTE,
                picture.rgb.data());
  gl.BindFramebuffer(GL_READ_FRAMEBUFFER, framebuffer);
  gl.FramebufferTexture2D(GL_READ_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, texture, 0);
  checkGl(gl, "showing a picture");
}

void Window::Parts::resize() const {
  Vec2 shown = size;
  int x = 0;
  int y = 0;
  int width = 0;
  int height = 0;
  GLFWmonitor* const monitor = glfw.GetPrimaryMonitor();
  if (monitor != nullptr) {
    glfw.GetMonitorWorkarea(monitor, &x, &y, &width, &height);
  }
  if (width > 0 && height > 0) {
    shown *= std::min(1.0, Fit(size, Vec2(width, height)).scale);
  }
  glfw.SetWindowSize(window.handle(), static_cast<int>(std::lround(shown.x())),
                     static_cast<int>(std::lround(shown.y())));
}

void Window::Parts::present() {
  lost = false;
  int width = 0;
  int height = 0;
  glfw.GetFramebufferSize(window.handle(), &width, &height);
  if (size.isZero() || width < 1 || height < 1) {
    return;
  }
  const Fit fit(size, Vec2(width, height));
  const auto left = static_cast<int>(std::lround(fit.corner.x()));
  const auto below = static_cast<int>(std::lround(fit.corner.y()));
  const auto pictureWidth = static_cast<int>(size.x());
  const auto pictureHeight = static_cast<int>(size.y());
  const bool sameSize = pictureWidth == width && pictureHeight == height;
  context.makeCurrent();
  gl.BindFramebuffer(GL_READ_FRAMEBUFFER, framebuffer);
  gl.BindFramebuffer(GL_DRAW_FRAMEBUFFER, 0);
  gl.ClearColor(0, 0, 0, 1);
  gl.Clear(GL_COLOR_BUFFER_BIT);
  // Flipped, because picture rows go downward.
  gl.BlitFramebuffer(0, 0, pictureWidth, pictureHeight, left, height - below, width - left, below,
                     GL_COLOR_BUFFER_BIT, sameSize ? GL_NEAREST : GL_LINEAR);
  checkGl(gl, "showing a picture");
  glfw.SwapBuffers(window.handle());
}

Window::Window(const std::string& title) : parts_(std::make_unique<Parts>(title)) {}

Window::~Window() = default;

void Window::setTitle(const std::string& title) {
  parts_->glfw.SetWindowTitle(parts_->window.handle(), title.c_str());
}

void Window::show(const Picture& picture) {
  Parts& parts = *parts_;
  const Vec2 size(picture.width, picture.height);
  const bool first = parts.size.isZero();
  parts.upload(picture);
  if (size != parts.size) {
    parts.size = size;
    parts.resize();
  }
  if (first) {
    parts.glfw.ShowWindow(parts.window.handle());
  }
  parts.present();
}

WindowEvents Window::wait(double seconds) {
  Parts& parts = *parts_;
  if (seconds > 0) {
    parts.glfw.WaitEventsTimeout(seconds);
  } else {
    parts.glfw.PollEvents();
  }
  if (parts.lost) {
    parts.present();
  }
  return std::exchange(parts.events, {});
}

bool Window::isClosing() const { return parts_->glfw.WindowShouldClose(parts_->window.handle()) != 0; }

}  // namespace careen
