// A headless Chromium, driven by chromedriver over the WebDriver protocol (https://www.w3.org/TR/webdriver2/).
#pragma once

#include <sys/types.h>

#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

namespace test {

class Browser {
public:
    using Json = nlohmann::json;

    /// Whether chromium and chromedriver are on the PATH.
    [[nodiscard]] static bool installed();

    /// Starts both, with a profile below `folder`. \throws std::runtime_error
    explicit Browser(const std::filesystem::path& folder);
    Browser(const Browser&) = delete;
    Browser& operator=(const Browser&) = delete;
    ~Browser();

    void open(const std::string& url);
    /// The value of `return ...` in a function body. \param arguments  its `arguments`
    Json run(const std::string& script, const Json& arguments = Json::array());
    /// Moves the pointer to a place of the window, in CSS pixels.
    void move_to(double x, double y);
    /// A click on the first element that the CSS selector finds, as a person does it: it must be visible.
    void click(const std::string& selector);
    /// One key, to the element that has the focus. Special keys: `key::` below.
    void press(const std::string& key);
    /// A command of the DevTools protocol.
    Json devtools(const std::string& command, const Json& parameters);
    /// What the console said, and each network request, since the last call.
    std::vector<std::string> console();
    std::vector<std::string> requests();

private:
    Json call(const std::string& method, const std::string& path, const std::optional<Json>& body);
    void act(const std::string& type, const Json& steps);
    Json post(const std::string& path, const Json& body) { return call("POST", session_ + path, body); }

    pid_t driver_ = 0;
    std::string port_;
    std::string session_;
};

namespace key {
inline const std::string tab = "\uE004", enter = "\uE007", escape = "\uE00C", space = " ", end = "\uE010",
                         home = "\uE011", left = "\uE012", up = "\uE013", right = "\uE014", down = "\uE015";
}  // namespace key

}  // namespace test
