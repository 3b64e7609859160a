#pragma once

#include <fcntl.h>
#include <poll.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "support/environment_variable.h"
#include "support/process.h"

namespace careen {

/// Debian's Chromium, headless, driven over a pipe by its DevTools protocol: real keys, real sizes, and
/// every error of the page.
class Browser {
 public:
  using Json = nlohmann::json;

  Browser() {
    std::array<int, 2> toBrowser{};
    std::array<int, 2> fromBrowser{};
    if (pipe2(toBrowser.data(), O_CLOEXEC) != 0 || pipe2(fromBrowser.data(), O_CLOEXEC) != 0) {
      throw std::runtime_error("no pipe");
    }
    in_ = toBrowser[1];
    out_ = fromBrowser[0];
    start(toBrowser[0], fromBrowser[1]);
    close(toBrowser[0]);
    close(fromBrowser[1]);
    const std::string target = call("Target.createTarget", {{"url", "about:blank"}}).at("targetId");
    session_ = call("Target.attachToTarget", {{"targetId", target}, {"flatten", true}}).at("sessionId");
    for (const char* domain : {"Page", "Runtime", "Log", "Network"}) {
      call(std::string(domain) + ".enable");
    }
  }
  ~Browser() {
    close(in_);  // it ends when the pipe is closed
    kill(pid_, SIGTERM);
    int status = 0;
    waitpid(pid_, &status, 0);
    close(out_);
  }
  Browser(const Browser&) = delete;
  Browser& operator=(const Browser&) = delete;

  void setSize(int width, int height) {
    call("Emulation.setDeviceMetricsOverride",
         {{"width", width}, {"height", height}, {"deviceScaleFactor", 1}, {"mobile", false}});
  }
  /// "prefers-color-scheme", "dark"; "prefers-reduced-motion", "reduce". Replaces what was set before.
  void setMedia(const std::string& name, const std::string& value) {
    call("Emulation.setEmulatedMedia", {{"features", {{{"name", name}, {"value", value}}}}});
  }
  void open(const std::filesystem::path& page, const std::string& fragment = "") {
    loaded_ = false;
    call("Page.navigate", {{"url", "about:blank"}});
    waitUntilLoaded();
    call("Page.navigate", {{"url", "file://" + page.string() + fragment}});
    waitUntilLoaded();
    settle();
  }
  /// Value of a JavaScript expression.
  Json evaluate(const std::string& expression) {
    const Json result = call("Runtime.evaluate",
                             {{"expression", expression}, {"returnByValue", true}, {"awaitPromise", true}});
    if (result.contains("exceptionDetails")) {
      throw std::runtime_error(expression + ": " + result.at("exceptionDetails").dump());
    }
    return result.at("result").value("value", Json());
  }
  /// Presses and releases a key, such as "ArrowRight" or "b".
  void press(const std::string& key, bool shift = false) {
    Json event = {{"type", "keyDown"}, {"key", key}, {"modifiers", shift ? 8 : 0}};
    if (key.size() == 1) {
      event["text"] = key;
    } else if (key == "Tab" || key == "Escape") {  // the browser identifies its own keys by number
      event["windowsVirtualKeyCode"] = key == "Tab" ? 9 : 27;
    }
    call("Input.dispatchKeyEvent", event);
    event["type"] = "keyUp";
    event.erase("text");
    call("Input.dispatchKeyEvent", event);
    settle();
  }
  void click(double x, double y) {
    for (const char* type : {"mousePressed", "mouseReleased"}) {
      call("Input.dispatchMouseEvent",
           {{"type", type}, {"x", x}, {"y", y}, {"button", "left"}, {"buttons", 1}, {"clickCount", 1}});
    }
    settle();
  }
  void wheel(double x, double y, double down) {
    call("Input.dispatchMouseEvent",
         {{"type", "mouseWheel"}, {"x", x}, {"y", y}, {"deltaX", 0}, {"deltaY", down}});
    settle();
  }
  /// Screenshot of the page as a PNG.
  std::string screenshot() { return fromBase64(call("Page.captureScreenshot").at("data")); }

  /// Exceptions, errors and warnings of pages, as text.
  const std::vector<std::string>& complaints() const { return complaints_; }
  /// Requests of pages, other than for files and data.
  const std::vector<std::string>& requests() const { return requests_; }

 private:
  static std::string fromBase64(const std::string& text) {
    constexpr std::string_view kDigits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string bytes;
    unsigned bits = 0;
    int count = 0;
    for (const char digit : text.substr(0, text.find('='))) {
      bits = bits << 6U | static_cast<unsigned>(kDigits.find(digit));
      count += 6;
      if (count >= 8) {
        count -= 8;
        bytes += static_cast<char>((bits >> static_cast<unsigned>(count)) & 0xFFU);
      }
    }
    return bytes;
  }

  void start(int in, int out) {
    // Its sandbox needs what containers and root lack; it opens only our own pages.
    const std::string profile = "--user-data-dir=" + (folder_.path() / "profile").string();
    std::vector<std::string> command = {"chromium",
                                        "--headless",
                                        "--no-sandbox",
                                        "--disable-gpu",
                                        "--hide-scrollbars",
                                        "--no-first-run",
                                        "--disable-background-networking",
                                        "--disable-dev-shm-usage",
                                        "--remote-debugging-pipe",
                                        profile,
                                        "about:blank"};
    std::vector<char*> arguments;
    arguments.reserve(command.size() + 1);
    for (std::string& argument : command) {
      arguments.push_back(argument.data());
    }
    arguments.push_back(nullptr);
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    // The pipe's ends may have the numbers that it expects, even swapped.
    posix_spawn_file_actions_adddup2(&actions, in, 100);
    posix_spawn_file_actions_adddup2(&actions, out, 101);
    posix_spawn_file_actions_adddup2(&actions, 100, 3);
    posix_spawn_file_actions_adddup2(&actions, 101, 4);
    posix_spawn_file_actions_addclose(&actions, 100);
    posix_spawn_file_actions_addclose(&actions, 101);
    const std::string log = (folder_.path() / "log").string();
    posix_spawn_file_actions_addopen(&actions, 2, log.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600);
    posix_spawn_file_actions_addopen(&actions, 1, "/dev/null", O_WRONLY, 0);
    const EnvironmentVariable temporary("TMPDIR", folder_.path());  // it leaves things there
    const int error = posix_spawnp(&pid_, "chromium", &actions, nullptr, arguments.data(), environ);
    posix_spawn_file_actions_destroy(&actions);
    if (error != 0) {
      throw std::runtime_error("cannot start chromium; apt install chromium");
    }
  }

  Json call(const std::string& method, const Json& parameters = Json::object()) {
    const int id = ++lastId_;
    Json message = {{"id", id}, {"method", method}, {"params", parameters}};
    if (!session_.empty()) {
      message["sessionId"] = session_;
    }
    const std::string text = message.dump();
    for (std::size_t sent = 0; sent <= text.size();) {  // including the terminating zero
      const ssize_t count = write(in_, text.c_str() + sent, text.size() + 1 - sent);
      if (count < 0) {
        throw std::runtime_error("chromium has ended");
      }
      sent += static_cast<std::size_t>(count);
    }
    for (;;) {
      Json answer = receive();
      if (answer.value("id", 0) == id) {
        if (answer.contains("error")) {
          throw std::runtime_error(method + ": " + answer.at("error").dump());
        }
        return answer.at("result");
      }
      note(answer);
    }
  }

  Json receive() {
    for (std::size_t end = received_.find('\0');; end = received_.find('\0')) {
      if (end != std::string::npos) {
        Json message = Json::parse(received_.substr(0, end));
        received_.erase(0, end + 1);
        return message;
      }
      pollfd readable{.fd = out_, .events = POLLIN, .revents = 0};
      constexpr int kPatience = 60'000;  // [ms]
      std::array<char, 65536> bytes{};
      const ssize_t count = poll(&readable, 1, kPatience) > 0 ? read(out_, bytes.data(), bytes.size()) : 0;
      if (count <= 0) {
        throw std::runtime_error("chromium says nothing: " + textOf(folder_.path() / "log"));
      }
      received_.append(bytes.data(), static_cast<std::size_t>(count));
    }
  }

  void note(const Json& event) {
    const std::string method = event.value("method", "");
    if (method == "Page.loadEventFired") {
      loaded_ = true;
    } else if (method == "Runtime.exceptionThrown" || method == "Log.entryAdded" ||
               (method == "Runtime.consoleAPICalled" && event.at("params").at("type") != "log")) {
      complaints_.push_back(event.at("params").dump());
    } else if (method == "Network.requestWillBeSent") {
      const std::string url = event.at("params").at("request").at("url");
      if (!url.starts_with("file:") && !url.starts_with("data:") && !url.starts_with("about:")) {
        requests_.push_back(url);
      }
    }
  }

  void waitUntilLoaded() {
    while (!loaded_) {
      note(receive());
    }
    loaded_ = false;
  }

  /// Waits until the page is drawn.
  void settle() {
    evaluate("new Promise(done => requestAnimationFrame(() => requestAnimationFrame(() => done(1))))");
  }

  TemporaryFolder folder_;
  int in_ = -1;
  int out_ = -1;
  pid_t pid_ = 0;
  int lastId_ = 0;
  std::string session_;
  std::string received_;
  bool loaded_ = false;
  std::vector<std::string> complaints_;
  std::vector<std::string> requests_;
};

}  // namespace careen
