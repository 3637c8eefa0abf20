#pragma once

#include <gtest/gtest.h>
#include <httplib.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "tests/support/await.h"
#include "tests/support/process.h"

namespace trailcast::test {

// This is Debian's Chromium, driven over WebDriver (HTTP and JSON), with a profile of its own in
// `folder`.
class Browser {
 public:
  using Json = nlohmann::json;

  [[nodiscard]] static bool IsThere() {
    return std::filesystem::exists("/usr/bin/chromedriver") &&
           std::filesystem::exists("/usr/bin/chromium");
  }

  explicit Browser(const std::filesystem::path& folder) {
    const std::string profile = (folder / "profile").string();
    std::filesystem::create_directory(profile);
    driver_ = std::make_unique<Process>(
        std::vector<std::string>{"/usr/bin/chromedriver", "--port=0"}, folder / "chromedriver.log");
    const std::string said = "was started successfully on port ";
    if (!driver_->WaitForOutput(said)) return;
    const std::string output = driver_->output();
    const int port = std::stoi(output.substr(output.find(said) + said.size()));
    client_ = std::make_unique<httplib::Client>("127.0.0.1", port);
    client_->set_read_timeout(60);
    const Json args{"--headless=new",
                    "--no-sandbox",
                    "--disable-gpu",
                    "--disable-quic",
                    "--no-first-run",
                    "--disable-background-networking",
                    "--disable-component-update",
                    "--disable-sync",
                    "--disable-dev-shm-usage",
                    "--user-data-dir=" + profile};
    const Json made = Ask("POST", "/session",
                          {{"capabilities",
                            {{"alwaysMatch",
                              {{"browserName", "chrome"},
                               {"acceptInsecureCerts", true},  // tests sign their own
                               {"goog:chromeOptions", {{"args", args}}}}}}}});
    if (made.contains("sessionId")) session_ = "/session/" + made["sessionId"].get<std::string>();
  }
  ~Browser() {
    if (runs()) (void)Ask("DELETE", session_, nullptr);
  }
  Browser(const Browser&) = delete;
  Browser& operator=(const Browser&) = delete;

  [[nodiscard]] bool runs() const { return !session_.empty(); }
  [[nodiscard]] std::string log() const { return driver_->output(); }

  void Open(const std::string& url) { (void)Ask("POST", session_ + "/url", {{"url", url}}); }
  // Shows the page as on a screen of this size. `dark` is the person's preference.
  void Look(int width_px, int height_px, bool dark = false) {
    (void)DevTools("Emulation.setDeviceMetricsOverride", {{"width", width_px},
                                                          {"height", height_px},
                                                          {"deviceScaleFactor", 1},
                                                          {"mobile", width_px < 600}});
    (void)DevTools(
        "Emulation.setEmulatedMedia",
        {{"features", {{{"name", "prefers-color-scheme"}, {"value", dark ? "dark" : "light"}}}}});
  }
  // From now on, requests for such addresses ('*' is anything) fail.
  void Block(const std::vector<std::string>& addresses) {
    DevTools("Network.enable", Json::object());
    DevTools("Network.setBlockedURLs", {{"urls", addresses}});
  }
  // Returns what a script returns.
  Json Run(const std::string& script) {
    return Ask("POST", session_ + "/execute/sync", {{"script", script}, {"args", Json::array()}});
  }
  [[nodiscard]] std::string Text() {
    const Json text = Run("return document.body.innerText");
    return text.is_string() ? text.get<std::string>() : text.dump();
  }
  [[nodiscard]] bool WaitForText(const std::string& text) {
    return WaitUntil([&] { return Text().find(text) != std::string::npos; });
  }
  // Clicks as a person does: where the element is, if nothing lies above it. Until then, and while
  // it moves away under the pointer, the click is repeated.
  [[nodiscard]] bool Click(const std::string& xpath) {
    const auto gives_up = std::chrono::steady_clock::now() + test::kLongEnough;
    std::string why;
    do {
      const std::string element = Find(xpath);
      why = "there is no such element";
      if (element.empty()) continue;
      (void)Ask("POST", session_ + "/execute/sync",
                {{"script", "arguments[0].scrollIntoView({block: 'center', behavior: 'instant'})"},
                 {"args", Json::array({{{kElement, element}}})}});
      const Json none = Json::object();
      const Json answer = Ask("POST", session_ + "/element/" + element + "/click", none);
      if (answer.is_null()) return true;
      why = answer.dump();
    } while (std::chrono::steady_clock::now() < gives_up);
    ADD_FAILURE() << xpath << " cannot be clicked: " << why;
    return false;
  }
  // Returns the element once it is there.
  [[nodiscard]] bool Type(const std::string& xpath, const std::string& keys) {
    std::string element;
    if (!WaitUntil([&] { return !(element = Find(xpath)).empty(); })) return false;
    return Ask("POST", session_ + "/element/" + element + "/value", {{"text", keys}}).is_null();
  }
  // Presses the key on whatever has the focus, and releases it after so long.
  [[nodiscard]] bool HoldKey(const std::string& key, int ms) {
    const Json held = {{{"type", "keyDown"}, {"value", key}},
                       {{"type", "pause"}, {"duration", ms}},
                       {{"type", "keyUp"}, {"value", key}}};
    const Json keyboard = {{"type", "key"}, {"id", "keyboard"}, {"actions", held}};
    return Ask("POST", session_ + "/actions", {{"actions", Json::array({keyboard})}}).is_null();
  }
  void Screenshot(const std::filesystem::path& file) {
    const Json shot = Ask("GET", session_ + "/screenshot", nullptr);
    std::ofstream(file, std::ios::binary) << Decoded(shot.get<std::string>());
  }

  // Sends a command of the DevTools protocol.
  Json DevTools(const std::string& command, const Json& parameters = Json::object()) {
    return Ask("POST", session_ + "/goog/cdp/execute", {{"cmd", command}, {"params", parameters}});
  }

 private:
  // This is what the standard calls an element in a script's arguments.
  static constexpr const char* kElement = "element-6066-11e4-a52e-4f735466cecf";

  std::string Find(const std::string& xpath) {
    const Json found = Ask("POST", session_ + "/element", {{"using", "xpath"}, {"value", xpath}});
    if (!found.is_object() || found.contains("error")) return "";
    return found.begin()->get<std::string>();
  }
  // Returns its value, or an object with an error if that failed.
  Json Ask(const std::string& method, const std::string& path, const Json& body) {
    const auto reply = method == "POST"  ? client_->Post(path, body.dump(), "application/json")
                       : method == "GET" ? client_->Get(path)
                                         : client_->Delete(path);
    if (!reply) return {{"error", "chromedriver does not answer"}};
    const Json json = Json::parse(reply->body, nullptr, false);
    return json.is_object() ? json.value("value", Json()) : Json{{"error", reply->body}};
  }
  static std::string Decoded(const std::string& base64) {
    const std::string digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string bytes;
    unsigned held = 0;
    int bits = 0;
    for (const char c : base64) {
      const std::size_t digit = digits.find(c);
      if (digit == std::string::npos) break;
      held = held << 6U | static_cast<unsigned>(digit);
      bits += 6;
      if (bits < 8) continue;
      bits -= 8;
      bytes += static_cast<char>(held >> static_cast<unsigned>(bits) & 0xFFU);
    }
    return bytes;
  }

  std::unique_ptr<Process> driver_;
  std::unique_ptr<httplib::Client> client_;
  std::string session_;
};

}  // namespace trailcast::test
