#include "bench/rows/key.hpp"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <span>
#include <system_error>

#include "glsum/catalogue.hpp"

namespace bench {
namespace {

// Names come from files, and go to terminals and into gnuplot's scripts: only what our own names are made of.
bool has_only(std::string_view text, std::string_view marks) {
    return !text.empty() && text.size() <= 64 && std::all_of(text.begin(), text.end(), [&](char c) {
        const auto letter = static_cast<unsigned char>(c);
        return letter < 0x80 && (std::isalnum(letter) != 0 || marks.find(c) != marks.npos);
    });
}

bool is_word(std::string_view text) { return has_only(text, "_"); }

bool is_aspect(std::string_view text) { return has_only(text, "_:-."); }

bool is_targets_aspect(std::string_view text) { return is_aspect(text) && text.find(':') != text.npos; }

bool is_number(std::string_view text) {
    double value = 0.0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    return error == std::errc{} && end == text.data() + text.size() && std::isfinite(value);
}

// "600", "full" or "2+7".
bool is_length(std::string_view text) {
    return text == "full" ||
           (!text.empty() && text.size() <= 18 && text.find_first_not_of("0123456789+") == text.npos &&
            text.front() != '+' && text.back() != '+' && text.find("++") == text.npos);
}

// "0.05..80": two numbers, and two dots between.
bool is_band(std::string_view text) {
    const std::size_t dots = text.find("..");
    return dots != text.npos && text.find("...") == text.npos && is_number(text.substr(0, dots)) &&
           is_number(text.substr(dots + 2));
}

// A part of a name: where it stands in the key, what is written before it, what it may be.
struct Part {
    std::string RowKey::*where;
    std::string_view before;
    bool (*is_good)(std::string_view);
    bool may_lack = false;
};

namespace part {
constexpr Part model{&RowKey::model, "", is_word};
constexpr Part kernel{&RowKey::kernel, "", is_word};
constexpr Part order{&RowKey::order, "order:", is_number};
constexpr Part taps{&RowKey::taps, "taps:", is_length};
constexpr Part error{&RowKey::error, "error:", is_number};
constexpr Part samples{&RowKey::samples, "samples:", is_number};
constexpr Part poles{&RowKey::poles, "poles:", is_number};
constexpr Part hz{&RowKey::hz, "hz:", is_band};
constexpr Part hz_if_any{&RowKey::hz, "hz:", is_band, true};
constexpr Part until_if_any{&RowKey::until, "until:", is_number, true};
constexpr Part aspect{&RowKey::aspect, "", is_aspect};
constexpr Part targets_aspect_if_any{&RowKey::aspect, "", is_targets_aspect, true};
constexpr Part signal{&RowKey::signal, "signal:", is_word};
constexpr Part signal_if_any{&RowKey::signal, "signal:", is_word, true};
constexpr Part amplitude_if_any{&RowKey::amplitude, "amplitude:", is_number, true};
}  // namespace part

constexpr Part parts_of_sum[] = {part::kernel, part::order,         part::taps,
                                 part::aspect, part::signal_if_any, part::amplitude_if_any};
constexpr Part parts_of_model[] = {part::model, part::kernel, part::taps, part::aspect};
constexpr Part parts_of_record[] = {part::kernel, part::order, part::samples, part::aspect};
constexpr Part parts_of_horizon[] = {part::kernel, part::order, part::error, part::samples,
                                     part::targets_aspect_if_any};
constexpr Part parts_of_filter[] = {part::kernel, part::order, part::poles, part::aspect, part::signal};
constexpr Part parts_of_band[] = {part::kernel, part::order, part::taps, part::hz};
constexpr Part parts_of_derivative[] = {part::kernel, part::order,     part::taps,
                                        part::aspect, part::hz_if_any, part::until_if_any};

struct Form {
    RowKind kind;
    std::string_view word;
    std::span<const Part> parts;
};

constexpr Form forms[] = {
    {RowKind::sum, "gl", parts_of_sum},
    {RowKind::model, "drive", parts_of_model},
    {RowKind::record, "record", parts_of_record},
    {RowKind::horizon, "horizon", parts_of_horizon},
    {RowKind::filter, "filter", parts_of_filter},
    {RowKind::band, "band", parts_of_band},
    {RowKind::derivative, "derivative", parts_of_derivative},
};

std::string written(const RowKey& key, std::size_t most_parts) {
    const Form& form = *std::ranges::find(forms, key.kind, &Form::kind);
    std::string name(form.word);
    for (const Part& part : form.parts.first(std::min(most_parts, form.parts.size()))) {
        const std::string& text = key.*part.where;
        if (!part.may_lack || !text.empty()) {
            name += '/';
            name += part.before;
            name += text;
        }
    }
    return name;
}

// The text up to the next slash, which goes too.
std::string_view take(std::string_view& rest) {
    const std::size_t end = rest.find('/');
    const std::string_view part = rest.substr(0, end);
    rest.remove_prefix(end == rest.npos ? rest.size() : end + 1);
    return part;
}

}  // namespace

std::string on_target(const base::Machine& machine, const std::string& core) {
    return std::string(machine.word) + ':' + core;
}

std::string to_name(const RowKey& key) { return written(key, SIZE_MAX); }

std::string subject_of(const RowKey& key) { return written(key, 3); }

std::string rows_of(const std::string& kernel) { return "gl/" + kernel + "/*"; }

std::optional<RowKey> parse_any_key(std::string_view name) {
    std::string_view rest = name;
    const auto form = std::ranges::find(forms, take(rest), &Form::word);
    if (form == std::end(forms)) {
        return std::nullopt;
    }
    RowKey key;
    key.kind = form->kind;
    for (const Part& part : form->parts) {
        if (part.may_lack && (rest.empty() || !rest.starts_with(part.before))) {
            continue;
        }
        std::string_view text = take(rest);
        if (!text.starts_with(part.before)) {
            return std::nullopt;
        }
        text.remove_prefix(part.before.size());
        if (!part.is_good(text)) {
            return std::nullopt;
        }
        key.*part.where = text;
    }
    // Nothing may be left over that another row's name lacks.
    return to_name(key) == name ? std::optional(key) : std::nullopt;
}

std::optional<RowKey> parse_key(std::string_view name) {
    auto key = parse_any_key(name);
    return key && key->kind == RowKind::sum ? key : std::nullopt;
}

std::string number_format_of(const std::string& kernel) {
    const glsum::CatalogueEntry* const entry = glsum::find_kernel(kernel);
    return entry != nullptr && !entry->format.empty() ? std::string(entry->format) : "unknown";
}

bool is_window(std::string_view taps) { return taps.find('+') == taps.npos; }

std::optional<double> taps_number(const std::string& taps) {
    double sum = 0.0;
    const char* at = taps.data();
    const char* const end = at + taps.size();
    for (;;) {
        std::uint32_t part = 0;
        const auto [behind, error] = std::from_chars(at, end, part);
        if (error != std::errc{}) {
            return std::nullopt;
        }
        sum += part;
        if (behind == end) {
            return sum > 0.0 ? std::optional(sum) : std::nullopt;
        }
        if (*behind != '+') {
            return std::nullopt;
        }
        at = behind + 1;
    }
}

}  // namespace bench
