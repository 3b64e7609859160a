#include "support/x_display.h"

#include <X11/Xlib.h>
#include <X11/Xutil.h>
#include <X11/extensions/XTest.h>

#include <bit>
#include <chrono>
#include <stdexcept>
#include <thread>

#include "support/process.h"

namespace careen {
namespace {

using Clock = std::chrono::steady_clock;

// A window that disappears during a query is not an error.
int ignore(Display*, XErrorEvent*) { return 0; }

std::uint8_t channel(unsigned long pixel, unsigned long mask) {
  return static_cast<std::uint8_t>((pixel & mask) >> std::countr_zero(mask));
}

}  // namespace

struct XDisplay::Parts {
  Parts(int width, int height)
      : server({"Xvfb", "-displayfd", "1", "-nolisten", "tcp", "-noreset", "-screen", "0",
                std::to_string(width) + "x" + std::to_string(height) + "x24"},
               "/") {
    for (const auto end = Clock::now() + std::chrono::seconds(30); !printed.ends_with('\n');) {
      if (Clock::now() > end) {
        throw std::runtime_error("Xvfb does not start: " + server.errSoFar());
      }
      std::this_thread::sleep_for(std::chrono::milliseconds(5));
      printed = server.outSoFar();
    }
    name = ":" + printed.substr(0, printed.size() - 1);
    XSetErrorHandler(ignore);
    display = XOpenDisplay(name.c_str());
    if (display == nullptr) {
      throw std::runtime_error("Xvfb lets nobody in: " + server.errSoFar());
    }
  }
  ~Parts() {
    if (display != nullptr) {
      XCloseDisplay(display);
    }
    server.send(SIGTERM);
    server.wait();
  }
  Parts(const Parts&) = delete;
  Parts& operator=(const Parts&) = delete;
  Parts(Parts&&) = delete;
  Parts& operator=(Parts&&) = delete;

  // Returns 0 if there is no window.
  Window window(XWindowAttributes& attributes) const {
    Window root = 0;
    Window parent = 0;
    Window* children = nullptr;
    unsigned count = 0;
    Window found = 0;
    XQueryTree(display, DefaultRootWindow(display), &root, &parent, &children, &count);
    for (unsigned i = 0; i < count; ++i) {
      if (XGetWindowAttributes(display, children[i], &attributes) != 0 &&
          attributes.map_state == IsViewable) {
        found = children[i];
        break;
      }
    }
    XFree(children);
    return found;
  }
  void movePointer(int x, int y) const {
    XWindowAttributes attributes{};
    window(attributes);
    XTestFakeMotionEvent(display, -1, attributes.x + x, attributes.y + y, CurrentTime);
  }

  Process server;
  std::string printed;
  std::string name;
  Display* display = nullptr;
};

XDisplay::XDisplay(int width, int height) : parts_(std::make_unique<Parts>(width, height)) {}

XDisplay::~XDisplay() = default;

const std::string& XDisplay::name() const { return parts_->name; }

std::string XDisplay::title() const {
  XWindowAttributes attributes{};
  char* name = nullptr;
  const Window window = parts_->window(attributes);
  if (window == 0 || XFetchName(parts_->display, window, &name) == 0 || name == nullptr) {
    return {};
  }
  std::string title = name;
  XFree(name);
  return title;
}

Picture XDisplay::screenshot() const {
  XWindowAttributes at{};
  const Window window = parts_->window(at);
  XImage* const image = window == 0
                            ? nullptr
                            : XGetImage(parts_->display, window, 0, 0, static_cast<unsigned>(at.width),
                                        static_cast<unsigned>(at.height), AllPlanes, ZPixmap);
  if (image == nullptr) {
    return {};
  }
  Picture picture{.width = at.width, .height = at.height, .rgb = {}};
  for (int y = 0; y < at.height; ++y) {
    for (int x = 0; x < at.width; ++x) {
      const unsigned long pixel = XGetPixel(image, x, y);
      picture.rgb.insert(picture.rgb.end(),
                         {channel(pixel, at.visual->red_mask), channel(pixel, at.visual->green_mask),
                          channel(pixel, at.visual->blue_mask)});
    }
  }
  XDestroyImage(image);
  return picture;
}

void XDisplay::press(const std::string& key) const {
  const KeyCode code = XKeysymToKeycode(parts_->display, XStringToKeysym(key.c_str()));
  if (code == 0) {
    throw std::runtime_error("the keyboard has no key " + key);
  }
  XTestFakeKeyEvent(parts_->display, code, True, CurrentTime);
  XTestFakeKeyEvent(parts_->display, code, False, CurrentTime);
  XFlush(parts_->display);
}

void XDisplay::drag(int fromX, int fromY, int toX, int toY) const {
  parts_->movePointer(fromX, fromY);
  XTestFakeButtonEvent(parts_->display, Button1, True, CurrentTime);
  parts_->movePointer(toX, toY);
  XTestFakeButtonEvent(parts_->display, Button1, False, CurrentTime);
  XFlush(parts_->display);
}

void XDisplay::scroll() const {
  XWindowAttributes at{};
  parts_->window(at);
  parts_->movePointer(at.width / 2, at.height / 2);
  XTestFakeButtonEvent(parts_->display, Button4, True, CurrentTime);
  XTestFakeButtonEvent(parts_->display, Button4, False, CurrentTime);
  XFlush(parts_->display);
}

}  // namespace careen
