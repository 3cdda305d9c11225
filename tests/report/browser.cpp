#include "tests/report/browser.hpp"

#include <fcntl.h>
#include <signal.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <boost/asio/connect.hpp>
#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/beast/core/flat_buffer.hpp>
#include <boost/beast/core/tcp_stream.hpp>
#include <boost/beast/http.hpp>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <sstream>
#include <stdexcept>
#include <thread>

namespace test {
namespace {

bool on_path(const std::string& program) {
    const char* path = std::getenv("PATH");
    std::istringstream folders(path == nullptr ? "" : path);
    for (std::string folder; std::getline(folders, folder, ':');) {
        if (access((folder + "/" + program).c_str(), X_OK) == 0) {
            return true;
        }
    }
    return false;
}

// "... successfully on port 12345." as soon as the driver has said it.
std::string port_in(const std::filesystem::path& log) {
    for (int attempt = 0; attempt < 1200; ++attempt) {
        std::ifstream file(log);
        for (std::string line; std::getline(file, line);) {
            const std::string words = "successfully on port ";
            if (const auto at = line.find(words); at != std::string::npos) {
                const std::string rest = line.substr(at + words.size());
                return rest.substr(0, rest.find_first_not_of("0123456789"));
            }
        }
        std::this_thread::sleep_for(std::chrono::milliseconds(50));
    }
    throw std::runtime_error("chromedriver did not start within 60 s");
}

}  // namespace

bool Browser::installed() { return on_path("chromium") && on_path("chromedriver"); }

Browser::Browser(const std::filesystem::path& folder) {
    const std::filesystem::path log = folder / "chromedriver.log";
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, log.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600);
    posix_spawn_file_actions_adddup2(&actions, STDOUT_FILENO, STDERR_FILENO);
    std::string program = "chromedriver";
    std::string port = "--port=0";
    char* arguments[] = {program.data(), port.data(), nullptr};
    const int failed = posix_spawnp(&driver_, "chromedriver", &actions, nullptr, arguments, environ);
    posix_spawn_file_actions_destroy(&actions);
    if (failed != 0) {
        throw std::runtime_error("chromedriver does not start");
    }
    port_ = port_in(log);
    const Json flags = {"--headless",
                        "--no-sandbox",
                        "--disable-gpu",
                        "--disable-quic",
                        "--no-first-run",
                        "--disable-background-networking",
                        "--disable-component-update",
                        "--disable-sync",
                        "--disable-dev-shm-usage",
                        "--window-size=1400,1000",
                        "--user-data-dir=" + (folder / "profile").string()};
    const Json capabilities = {{"browserName", "chrome"},
                               {"goog:chromeOptions", {{"args", flags}}},
                               {"goog:loggingPrefs", {{"browser", "ALL"}, {"performance", "ALL"}}}};
    session_ =
        "/session/" + call("POST", "/session", Json{{"capabilities", {{"alwaysMatch", capabilities}}}})["sessionId"]
                          .get<std::string>();
}

Browser::~Browser() {
    if (!session_.empty()) {
        try {
            call("DELETE", session_, std::nullopt);
        } catch (const std::exception&) {  // it ends with its driver
        }
    }
    if (driver_ > 0) {
        kill(driver_, SIGTERM);
        waitpid(driver_, nullptr, 0);
    }
}

Browser::Json Browser::call(const std::string& method, const std::string& path, const std::optional<Json>& body) {
    namespace http = boost::beast::http;
    boost::asio::io_context context;
    boost::beast::tcp_stream stream(context);
    stream.expires_after(std::chrono::seconds(120));
    stream.connect(boost::asio::ip::tcp::resolver(context).resolve("127.0.0.1", port_));
    http::request<http::string_body> request(http::string_to_verb(method), path, 11);
    request.set(http::field::host, "127.0.0.1");
    request.set(http::field::content_type, "application/json");
    request.body() = body ? body->dump() : "";
    request.prepare_payload();
    http::write(stream, request);
    boost::beast::flat_buffer buffer;
    http::response_parser<http::string_body> parser;
    parser.body_limit(256u << 20);
    http::read(stream, buffer, parser);
    const Json answer = Json::parse(parser.get().body());
    if (parser.get().result() != http::status::ok) {
        throw std::runtime_error(method + " " + path + ": " + answer["value"].value("message", "?").substr(0, 400));
    }
    return answer["value"];
}

void Browser::open(const std::string& url) { post("/url", {{"url", url}}); }

Browser::Json Browser::run(const std::string& script, const Json& arguments) {
    return post("/execute/sync", {{"script", script}, {"args", arguments}});
}

void Browser::act(const std::string& type, const Json& steps) {
    Json device;
    device["type"] = type;
    device["id"] = type;
    device["actions"] = steps;
    Json body;
    body["actions"] = Json::array({device});
    post("/actions", body);
}

void Browser::move_to(double x, double y) {
    Json move;
    move["type"] = "pointerMove";
    move["duration"] = 0;
    move["x"] = std::lround(x);
    move["y"] = std::lround(y);
    act("pointer", Json::array({move}));
}

void Browser::click(const std::string& selector) {
    const Json element = post("/element", {{"using", "css selector"}, {"value", selector}});
    post("/element/" + element.begin().value().get<std::string>() + "/click", Json::object());
}

void Browser::press(const std::string& key) {
    Json steps = Json::array();
    for (const char* type : {"keyDown", "keyUp"}) {
        Json step;
        step["type"] = type;
        step["value"] = key;
        steps.push_back(step);
    }
    act("key", steps);
}

Browser::Json Browser::devtools(const std::string& command, const Json& parameters) {
    return post("/goog/cdp/execute", {{"cmd", command}, {"params", parameters}});
}

std::vector<std::string> Browser::console() {
    std::vector<std::string> said;
    for (const Json& entry : post("/se/log", {{"type", "browser"}})) {
        said.push_back(entry.value("level", "") + ": " + entry.value("message", ""));
    }
    return said;
}

std::vector<std::string> Browser::requests() {
    std::vector<std::string> asked;
    for (const Json& entry : post("/se/log", {{"type", "performance"}})) {
        const Json message = Json::parse(entry.value("message", "{}"))["message"];
        if (message.value("method", "") == "Network.requestWillBeSent") {
            asked.push_back(message["params"]["request"]["url"]);
        }
    }
    return asked;
}

}  // namespace test
