#include "bench/result_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <string_view>
#include <tuple>
#include <unordered_set>

#include "bench/files.hpp"
#include "qemu/failure.hpp"

namespace bench {
namespace {

[[noreturn]] void refuse(const std::string& what) { throw glsum::Failure(glsum::Exit::bad_input, what); }

std::size_t line_of(std::string_view text, std::size_t position) {
    const auto end = text.begin() + static_cast<std::ptrdiff_t>(std::min(position, text.size()));
    return 1 + static_cast<std::size_t>(std::count(text.begin(), end, '\n'));
}

// A bare NaN, Infinity or -Infinity at or just before `position`, as some programs write them; empty if none.
std::string_view not_a_finite_number(std::string_view text, std::size_t position) {
    std::size_t begin = std::min(position, text.size());
    while (begin > 0 && (std::isalpha(static_cast<unsigned char>(text[begin - 1])) != 0 || text[begin - 1] == '-')) {
        --begin;
    }
    for (const std::string_view word : {"NaN", "nan", "-nan", "-NaN", "Infinity", "-Infinity", "inf", "-inf"}) {
        const std::string_view found = text.substr(begin, word.size());
        const std::size_t behind = begin + word.size();
        if (found == word && (behind >= text.size() || std::isalpha(static_cast<unsigned char>(text[behind])) == 0)) {
            return found;
        }
    }
    return {};
}

[[noreturn]] void refuse_broken(const std::string& text, const std::string& name, std::size_t position) {
    const std::size_t last = text.find_last_not_of(" \t\r\n");
    if (last == std::string::npos) {
        refuse(fmt::format("{}: expected a result file, found an empty one", name));
    }
    const std::size_t line = line_of(text, position == 0 ? 0 : position - 1);
    if (position > last + 1) {
        refuse(
            fmt::format("{}:{}: the file ends in the middle; expected the rest of its JSON (a copy or a run that was "
                        "cut off?)",
                        name, line));
    }
    if (const std::string_view word = not_a_finite_number(text, position == 0 ? 0 : position - 1); !word.empty()) {
        refuse(fmt::format("{}:{}: expected a finite number, found {}", name, line, word));
    }
    const std::size_t from = position < 12 ? 0 : position - 12;
    std::string near = text.substr(from, 24);
    std::replace_if(
        near.begin(), near.end(), [](char c) { return static_cast<unsigned char>(c) < 0x20 || c == 0x7f; }, ' ');
    refuse(fmt::format("{}:{}: expected JSON, found '{}'", name, line, near));
}

// Counts while it parses, so that a hostile file is refused before it fills the memory.
class Bounds {
public:
    Bounds(const std::string& name) : name_(name) {}
    bool operator()(int depth, Json::parse_event_t event, const Json& value) {
        if (depth > 6) {
            refuse(fmt::format("{}: expected a result file, found values nested {} deep", name_, depth));
        }
        const bool begins_row = event == Json::parse_event_t::object_start && depth == 2;
        rows_ += begins_row ? 1 : 0;
        if (rows_ > ResultLimits::rows) {
            refuse(fmt::format("{}: expected at most {} rows", name_, ResultLimits::rows));
        }
        if (event == Json::parse_event_t::key) {
            fields_ = begins_row || depth != 3 ? 0 : fields_ + 1;
        } else if (begins_row) {
            fields_ = 0;
        }
        const bool text =
            event == Json::parse_event_t::key || (event == Json::parse_event_t::value && value.is_string());
        if (fields_ > ResultLimits::fields) {
            refuse(fmt::format("{}: row {}: expected at most {} fields", name_, rows_, ResultLimits::fields));
        }
        if (text && value.get_ref<const std::string&>().size() > ResultLimits::text) {
            refuse(fmt::format("{}: expected texts of at most {} bytes, found one of {}", name_, ResultLimits::text,
                               value.get_ref<const std::string&>().size()));
        }
        return true;
    }

private:
    std::string name_;
    std::size_t rows_ = 0;
    std::size_t fields_ = 0;
};

void check_row(const Json& row, std::size_t index, const std::string& name) {
    const auto at = [&] { return fmt::format("{}: row {} of benchmarks", name, index + 1); };
    if (!row.is_object() || !row.contains("name") || !row["name"].is_string() ||
        row["name"].get_ref<const std::string&>().empty()) {
        refuse(at() + ": expected an object with a name, found " + row.dump().substr(0, 60));
    }
    for (const auto& [key, value] : row.items()) {
        const bool finite = !value.is_number() || std::isfinite(value.get<double>());
        if (!finite || !(value.is_number() || value.is_string() || value.is_boolean())) {
            refuse(fmt::format("{} ({}): {}: expected a finite number, a text or a boolean, found {}", at(),
                               row["name"].get_ref<const std::string&>(), key, value.dump().substr(0, 60)));
        }
    }
}

// Of what one benchmark may have several: its repetitions and its aggregates.
std::string identity(const Json& row) {
    const auto text = [&](const char* key) {
        const auto found = row.find(key);
        return found == row.end() ? std::string() : found->dump();
    };
    return fmt::format("{}\n{}\n{}", text("name"), text("aggregate_name"), text("repetition_index"));
}

}  // namespace

Results parse_results(const std::string& text, const std::string& name) {
    Json file;
    try {
        file = Json::parse(text, Bounds(name));
    } catch (const Json::parse_error& error) {
        refuse_broken(text, name, error.byte);
    } catch (const Json::out_of_range&) {  // 1e999
        refuse(fmt::format("{}: expected finite numbers, found one beyond double precision", name));
    }
    if (!file.is_object() || !file.contains("benchmarks") || !file["benchmarks"].is_array()) {
        refuse(fmt::format("{}: expected a result file with an array benchmarks, found other JSON", name));
    }
    Results results;
    results.context = file.value("context", Json::object());
    if (!results.context.is_object()) {
        refuse(fmt::format("{}: context: expected an object", name));
    }
    std::unordered_set<std::string> known;
    for (Json& row : file["benchmarks"]) {
        check_row(row, results.rows.size(), name);
        if (!known.insert(identity(row)).second) {
            refuse(fmt::format("{}: row {} of benchmarks: the name {} is there twice", name, results.rows.size() + 1,
                               row["name"].get_ref<const std::string&>()));
        }
        results.rows.push_back(std::move(row));
    }
    return results;
}

Results read_results(const std::filesystem::path& path) {
    return parse_results(read_file(path, ResultLimits::bytes), path.string());
}

void write_results(const std::filesystem::path& path, const Json& context, const std::vector<Json>& rows) {
    Json file;
    file["context"] = context;
    file["benchmarks"] = rows;
    write_file(path, file.dump(2) + "\n");
}

}  // namespace bench
