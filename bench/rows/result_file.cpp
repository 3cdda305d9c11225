#include "bench/rows/result_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <map>
#include <string_view>
#include <unordered_set>
#include <utility>

#include "base/failure.hpp"
#include "base/files.hpp"
#include "bench/rows/counters.hpp"

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

// \param position  of the letter that is wrong, counted from 1
[[noreturn]] void refuse_broken(const std::string& text, const std::string& name, std::size_t position) {
    const std::size_t last = text.find_last_not_of(" \t\r\n");
    if (last == std::string::npos) {
        refuse(fmt::format("{}: expected a result file, found an empty one", name));
    }
    const std::size_t line = line_of(text, position - 1);
    if (position > last + 1) {
        refuse(
            fmt::format("{}:{}: the file ends in the middle; expected the rest of its JSON (a copy or a run that was "
                        "cut off?)",
                        name, line));
    }
    if (const std::string_view word = not_a_finite_number(text, position - 1); !word.empty()) {
        refuse(fmt::format("{}:{}: expected a finite number, found {}", name, line, word));
    }
    const std::size_t from = position < 12 ? 0 : position - 12;
    std::string near = text.substr(from, 24);
    std::replace_if(
        near.begin(), near.end(), [](char c) { return static_cast<unsigned char>(c) < 0x20 || c == 0x7f; }, ' ');
    refuse(fmt::format("{}:{}: expected JSON, found '{}'", name, line, near));
}

// What fields are, wherever they occur in a row: counters are numbers, others may be numbers, texts or booleans.
const std::map<std::string_view, Json::value_t> known_fields = {
    {"name", Json::value_t::string},          {"run_name", Json::value_t::string},
    {"run_type", Json::value_t::string},      {"aggregate_name", Json::value_t::string},
    {"label", Json::value_t::string},         {"time_unit", Json::value_t::string},
    {"error_message", Json::value_t::string}, {"error_occurred", Json::value_t::boolean},
};

// Of the context, what is more than shown and compared.
const std::map<std::string, Json::value_t> known_context = {{"commit", Json::value_t::string},
                                                            {"history", Json::value_t::array}};

// Builds rows as they come, and refuses a hostile file before it fills the memory.
class Reader : public nlohmann::json_sax<Json> {
public:
    explicit Reader(const std::string& name) : name_(name) {}

    bool null() override { return value(Json()); }
    bool boolean(bool found) override { return value(found); }
    bool number_integer(number_integer_t found) override { return value(found); }
    bool number_unsigned(number_unsigned_t found) override { return value(found); }
    bool number_float(number_float_t found, const string_t&) override { return value(found); }
    bool string(string_t& found) override {
        check_text(found);
        return value(std::move(found));
    }
    bool binary(binary_t&) override { return false; }  // JSON has none
    bool start_object(std::size_t) override { return open(Json::object()); }
    bool start_array(std::size_t) override { return open(Json::array()); }
    bool end_object() override { return close(); }
    bool end_array() override { return close(); }
    bool key(string_t& found) override {
        check_text(found);
        if (depth_ == 1) {
            part_ = found;
            if ((part_ == "context" && has_context_) || (part_ == "benchmarks" && has_rows_)) {
                refuse(fmt::format("{}: {} is there twice", name_, part_));
            }
        } else if (in_row() && ++fields_ > ResultLimits::fields) {
            refuse(fmt::format("{}: row {}: expected at most {} fields", name_, results_.rows.size() + 1,
                               ResultLimits::fields));
        }
        key_ = std::move(found);
        return true;
    }
    bool parse_error(std::size_t position, const std::string&, const nlohmann::detail::exception& error) override {
        position_ = position;
        out_of_range_ = error.id == 406;  // 1e999
        return false;
    }

    [[nodiscard]] std::size_t position() const { return position_; }
    [[nodiscard]] bool out_of_range() const { return out_of_range_; }

    /// \throws glsum::Failure when it was no result file.
    Results take() {
        if (!has_rows_) {
            refuse(fmt::format("{}: expected a result file with an array benchmarks, found other JSON", name_));
        }
        for (const auto& [field, type] : known_context) {
            const auto found = results_.context.find(field);
            if (found != results_.context.end() && found->type() != type) {
                refuse(fmt::format("{}: context: {}: expected {}, found {}", name_, field,
                                   type == Json::value_t::array ? "an array" : "a text", found->dump().substr(0, 60)));
            }
        }
        return std::move(results_);
    }

private:
    [[nodiscard]] bool in_row() const { return depth_ == 3 && part_ == "benchmarks"; }

    void check_text(const std::string& text) const {
        if (text.size() > ResultLimits::text) {
            refuse(fmt::format("{}: expected texts of at most {} bytes, found one of {}", name_, ResultLimits::text,
                               text.size()));
        }
    }

    // Where the next value belongs: into the row or the context that is being read.
    Json& place() {
        Json& parent = *open_.back();
        if (parent.is_array()) {
            return parent.emplace_back();
        }
        return parent[key_];
    }

    bool value(Json found) {
        if (depth_ == 0) {
            return true;  // `take` refuses it
        }
        if (depth_ == 1) {
            refuse_part(found);
        } else if (part_ == "benchmarks") {
            depth_ == 2 ? refuse_row(found) : add_field(std::move(found));
        } else if (part_ == "context") {
            count_in_context();
            place() = std::move(found);
        }
        return true;
    }

    bool open(Json empty) {
        if (++depth_ > 6) {
            refuse(fmt::format("{}: expected a result file, found values nested {} deep", name_, depth_));
        }
        if (depth_ == 1) {
            if (!empty.is_object()) {
                refuse(fmt::format("{}: expected a result file with an array benchmarks, found other JSON", name_));
            }
        } else if (depth_ == 2) {
            if (empty.is_object() != (part_ != "benchmarks")) {
                refuse_part(empty);
            }
            has_rows_ = has_rows_ || part_ == "benchmarks";
            has_context_ = has_context_ || part_ == "context";
            open_ = {&results_.context};
        } else if (part_ == "benchmarks") {
            depth_ == 3 ? begin_row(empty) : add_field(empty);
        } else if (part_ == "context") {
            count_in_context();
            Json& container = place();
            container = std::move(empty);
            open_.push_back(&container);
        }
        return true;
    }

    bool close() {
        if (part_ == "benchmarks" && depth_ == 3) {
            end_row();
        } else if (part_ == "context" && depth_ >= 2) {
            open_.pop_back();
        }
        --depth_;
        return true;
    }

    void refuse_part(const Json& found) const {
        if (part_ == "benchmarks") {
            refuse(fmt::format("{}: expected a result file with an array benchmarks, found other JSON", name_));
        }
        if (part_ == "context") {
            refuse(fmt::format("{}: context: expected an object, found {}", name_, found.dump().substr(0, 60)));
        }
    }

    void count_in_context() {
        if (++context_values_ > ResultLimits::context_values) {
            refuse(fmt::format("{}: context: expected at most {} values", name_, ResultLimits::context_values));
        }
    }

    void begin_row(const Json& empty) {
        if (results_.rows.size() == ResultLimits::rows) {
            refuse(fmt::format("{}: expected at most {} rows", name_, ResultLimits::rows));
        }
        if (!empty.is_object()) {
            refuse_row(empty);
        }
        row_ = Json::object();
        fields_ = 0;
    }

    void add_field(Json found) {
        const auto known = known_fields.find(key_);
        const bool is_known = known != known_fields.end();
        const bool is_count = !is_known && find_counter(key_) != nullptr;
        const bool expected = is_known ? found.type() == known->second
                                       : found.is_number() || (!is_count && (found.is_string() || found.is_boolean()));
        if (!expected) {
            refuse(fmt::format("{} ({}): {}: expected {}, found {}", at(), row_.value("name", "without a name yet"),
                               key_,
                               is_count                                  ? "a finite number"
                               : !is_known                               ? "a finite number, a text or a boolean"
                               : known->second == Json::value_t::boolean ? "a boolean"
                                                                         : "a text",
                               found.dump().substr(0, 60)));
        }
        row_[key_] = std::move(found);
    }

    void end_row() {
        const auto name = row_.find("name");
        if (name == row_.end() || name->get_ref<const std::string&>().empty()) {
            refuse_row(row_);
        }
        if (!known_rows_.insert(identity(row_)).second) {
            refuse(fmt::format("{}: the name {} is there twice", at(), name->get_ref<const std::string&>()));
        }
        results_.rows.push_back(std::move(row_));
    }

    [[nodiscard]] std::string at() const {
        return fmt::format("{}: row {} of benchmarks", name_, results_.rows.size() + 1);
    }

    void refuse_row(const Json& found) const {
        refuse(at() + ": expected an object with a name, found " + found.dump().substr(0, 60));
    }

    // Of what one benchmark may have several: its repetitions and its aggregates.
    static std::string identity(const Json& row) {
        std::string text = row.find("name")->get_ref<const std::string&>();
        for (const char* key : {"aggregate_name", "repetition_index"}) {
            if (const auto found = row.find(key); found != row.end()) {
                text += '\n' + found->dump();
            }
        }
        return text;
    }

    std::string name_;
    Results results_{Json::object(), {}};
    std::size_t depth_ = 0;
    std::string part_;  // the key at the top
    std::string key_;
    std::vector<Json*> open_;  // in the context
    Json row_;
    std::size_t fields_ = 0;
    std::size_t context_values_ = 0;
    bool has_rows_ = false;
    bool has_context_ = false;
    std::unordered_set<std::string> known_rows_;
    std::size_t position_ = 0;
    bool out_of_range_ = false;
};

}  // namespace

Results parse_results(const std::string& text, const std::string& name) {
    Reader reader(name);
    if (!Json::sax_parse(text, &reader)) {
        if (reader.out_of_range()) {
            refuse(fmt::format("{}: expected finite numbers, found one beyond double precision", name));
        }
        refuse_broken(text, name, reader.position());
    }
    return reader.take();
}

Results read_results(const std::filesystem::path& path) {
    return parse_results(base::read_file(path, ResultLimits::bytes), path.string());
}

void write_results(const std::filesystem::path& path, const Json& context, const std::vector<Json>& rows) {
    Json file;
    file["context"] = context;
    file["benchmarks"] = rows;
    base::write_file(path, file.dump(2) + "\n");
}

}  // namespace bench
