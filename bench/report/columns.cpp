#include "bench/report/columns.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <boost/archive/iterators/base64_from_binary.hpp>
#include <boost/archive/iterators/transform_width.hpp>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>
#include <map>
#include <optional>
#include <string_view>
#include <unordered_map>

#include "base/failure.hpp"
#include "bench/rows/counters.hpp"
#include "bench/rows/key.hpp"

namespace bench::report {
namespace {

constexpr std::size_t most_of_a_family = 64;
constexpr std::size_t longest_text = 300;

// Little-endian bytes of each value, as base64.
template <class T>
std::string to_base64(const std::vector<T>& values) {
    static_assert(std::endian::native == std::endian::little);
    std::string bytes(values.size() * sizeof(T), '\0');
    std::memcpy(bytes.data(), values.data(), bytes.size());
    const std::size_t padding = (3 - bytes.size() % 3) % 3;
    bytes.append(padding, '\0');
    namespace it = boost::archive::iterators;
    using Base64 = it::base64_from_binary<it::transform_width<std::string::const_iterator, 6, 8>>;
    std::string text(Base64(bytes.cbegin()), Base64(bytes.cend()));
    return text.replace(text.size() - padding, padding, padding, '=');
}

template <class T>
std::string indices(const std::vector<std::uint32_t>& at) {
    return to_base64(std::vector<T>(at.begin(), at.end()));
}

// Of at most 64 values each index is a letter: a quarter less than as a byte, in base64 four letters for three.
std::string letters(const std::vector<std::uint32_t>& at) {
    constexpr std::string_view alphabet = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string text;
    text.reserve(at.size());
    for (const std::uint32_t index : at) {
        text += alphabet[index];
    }
    return text;
}

Json with_indices(Json values, const std::vector<std::uint32_t>& at) {
    Json column;
    const std::size_t distinct = values.size();
    column["values"] = std::move(values);
    if (distinct > 1) {
        const int bits = distinct <= 64 ? 6 : distinct <= 0x100 ? 8 : distinct <= 0x10000 ? 16 : 32;
        column["bits"] = bits;
        column["at"] = bits == 6    ? letters(at)
                       : bits == 8  ? indices<std::uint8_t>(at)
                       : bits == 16 ? indices<std::uint16_t>(at)
                                    : indices<std::uint32_t>(at);
    }
    return column;
}

// The rows of one aspect.
struct Table {
    std::size_t rows = 0;
    std::map<std::string, std::vector<std::string>> texts;
    std::map<std::string, std::vector<double>> numbers;
    std::unordered_map<std::string, std::vector<double>*> known;  // of each field met: its column, null if it has none
    void set_text(const std::string& column, const std::string& text) {
        auto& cells = texts[column];
        cells.resize(rows);
        cells.back() = text;
    }
    void set_number(const std::string& field, double number) {
        const auto [found, is_new] = known.try_emplace(field, nullptr);
        if (const CounterFacts* facts = is_new ? find_counter(field) : nullptr;
            facts != nullptr && facts->shown != Shown::nowhere) {
            found->second = &numbers[field];
        }
        if (found->second != nullptr) {
            found->second->resize(rows, std::numeric_limits<double>::quiet_NaN());
            found->second->back() = number;
        }
    }
};

std::string shortened(std::string text) {
    if (text.size() > longest_text) {
        std::size_t end = longest_text;
        while ((static_cast<unsigned char>(text[end]) & 0xC0U) == 0x80U) {  // not inside a character
            --end;
        }
        text = text.substr(0, end) + " ...";
    }
    return text;
}

void add_row(Table& table, const std::string& name, const std::optional<RowKey>& key, const Json& row) {
    ++table.rows;
    if (key) {
        table.set_text("kernel", key->kernel);
        table.set_text("order", key->order);
        table.set_text("taps", key->taps);
        table.set_text("signal", key->amplitude.empty() ? key->signal : key->signal + ", amplitude " + key->amplitude);
    } else {
        table.set_text("name", name);
    }
    for (const auto& [field, value] : row.items()) {
        if (value.is_number()) {
            table.set_number(field, value.get<double>());
        }
    }
    if (const auto label = row.find("label"); label != row.end() && label->is_string()) {
        table.set_text("label", shortened(label->get<std::string>()));
    }
    if (const auto wrong = row.find("error_occurred"); wrong != row.end() && *wrong == true) {
        const auto reason = row.find("error_message");
        table.set_text("fault", shortened(reason != row.end() && reason->is_string() ? reason->get<std::string>()
                                                                                     : "no reason given"));
    }
}

}  // namespace

Json encode_texts(const std::vector<std::string>& column) {
    std::unordered_map<std::string, std::uint32_t> known;
    Json values = Json::array();
    std::vector<std::uint32_t> at;
    for (const std::string& text : column) {
        const auto [found, is_new] = known.try_emplace(text, static_cast<std::uint32_t>(known.size()));
        if (is_new) {
            values.push_back(text);
        }
        at.push_back(found->second);
    }
    return with_indices(std::move(values), at);
}

Json encode_numbers(const std::vector<double>& column) {
    std::unordered_map<std::uint32_t, std::uint32_t> known;  // by the float's bits
    std::vector<float> distinct;
    std::vector<std::uint32_t> at;
    std::vector<float> floats;
    for (const double number : column) {
        constexpr double most = std::numeric_limits<float>::max();
        // Beyond a float's range: as far as it goes. A NaN has one pattern of bits.
        const float rounded = std::isnan(number) ? std::numeric_limits<float>::quiet_NaN()
                                                 : static_cast<float>(std::fmin(std::fmax(number, -most), most));
        floats.push_back(rounded);
        const auto [found, is_new] =
            known.try_emplace(std::bit_cast<std::uint32_t>(rounded), static_cast<std::uint32_t>(known.size()));
        if (is_new) {
            distinct.push_back(rounded);
        }
        at.push_back(found->second);
    }
    if (distinct.size() > 0x100 && distinct.size() * 2 > column.size()) {
        Json encoded;
        encoded["float32"] = to_base64(floats);
        return encoded;
    }
    Json values = Json::array();
    for (const float number : distinct) {
        // Read back from the shortest text that gives the same float: 7 digits at most go into the page.
        values.push_back(std::isnan(number) ? Json() : Json(std::stod(fmt::format("{}", number))));
    }
    return with_indices(std::move(values), at);
}

Json encode_errors(const std::vector<double>& column) {
    constexpr std::size_t few = 4096;
    Json encoded = encode_numbers(column);
    if (!encoded.contains("float32") && encoded["values"].size() <= few) {
        return encoded;
    }
    std::string bytes;
    for (const double number : column) {
        constexpr double most = 0x1p127;
        const float held = std::isnan(number) ? std::numeric_limits<float>::quiet_NaN()
                                              : static_cast<float>(std::fmin(std::fmax(number, -most), most));
        const std::uint32_t bits = std::bit_cast<std::uint32_t>(held) + (std::isnan(held) ? 0U : 0x80U);
        for (int shift = 8; shift < 32; shift += 8) {
            bytes.push_back(static_cast<char>(bits >> shift & 0xFFU));
        }
    }
    return {{"float24", to_base64(std::vector<char>(bytes.begin(), bytes.end()))}};
}

Json to_tables(const std::vector<Json>& rows) {
    std::map<std::string, Table> tables;
    for (const Json& row : rows) {
        if (const auto type = row.find("run_type"); type != row.end() && *type != "iteration") {
            continue;
        }
        const auto name = row.value("name", "");
        const auto key = parse_key(name);
        add_row(tables[key ? key->aspect : "other"], name, key, row);
    }
    Json all = Json::array();
    for (auto& [aspect, table] : tables) {
        Json encoded;
        encoded["aspect"] = aspect;
        encoded["rows"] = table.rows;
        encoded["texts"] = Json::object();
        encoded["numbers"] = Json::object();
        for (auto& [name, cells] : table.texts) {
            cells.resize(table.rows);
            encoded["texts"][name] = encode_texts(cells);
        }
        for (const CounterFacts& facts : counter_table()) {  // in this order they are read
            std::size_t members = 0;
            for (auto& [name, cells] : table.numbers) {
                if (find_counter(name) == &facts) {
                    ++members;
                    cells.resize(table.rows, std::numeric_limits<double>::quiet_NaN());
                    encoded["numbers"][name] =
                        facts.digits == Digits::four ? encode_errors(cells) : encode_numbers(cells);
                }
            }
            if (members > most_of_a_family) {
                throw glsum::Failure(glsum::Exit::bad_input,
                                     fmt::format("rows of aspect {}: expected at most {} counters {}<cause>, found {}",
                                                 aspect, most_of_a_family, facts.name, members));
            }
        }
        all.push_back(std::move(encoded));
    }
    return all;
}

}  // namespace bench::report
