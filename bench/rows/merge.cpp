#include "bench/rows/merge.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <utility>

#include "base/failure.hpp"
#include "bench/rows/shard.hpp"

namespace bench {
namespace {

using glsum::Exit;
using glsum::Failure;

// What tells of the moment and the machine, not of the numbers; all other fields must agree.
const std::set<std::string> of_the_machine = {"date",
                                              "host_name",
                                              "executable",
                                              "num_cpus",
                                              "mhz_per_cpu",
                                              "cpu_scaling_enabled",
                                              "aslr_enabled",
                                              "caches",
                                              "load_avg",
                                              "library_version",
                                              "library_build_type",
                                              "json_schema_version",
                                              "cycle_counter",
                                              "host_timing_order",
                                              "cpu",
                                              "shard"};

// A shard as its context describes it.
struct Described {
    NamedResults* file;
    Shard shard;
    std::size_t pieces;
    std::vector<std::pair<std::size_t, std::size_t>> rows_of_pieces;  // piece, number of rows
};

Described describe(NamedResults& file) {
    const auto refuse = [&](const std::string& what) {
        return Failure(Exit::bad_input, fmt::format("{}: {}", file.name, what));
    };
    const auto found = file.results.context.find("shard");
    if (found == file.results.context.end()) {
        throw refuse("expected a shard (of bench --shard I/N), found a result file without context.shard");
    }
    const auto number = [&](const Json& value, const char* what) {
        if (!value.is_number_integer() || value < 0) {
            throw refuse(fmt::format("context.shard: expected a whole number as {}, found {}", what,
                                     value.dump().substr(0, 60)));
        }
        return value.get<std::size_t>();
    };
    const auto field = [&](const char* key) {
        return number(found->is_object() ? found->value(key, Json()) : Json(), key);
    };
    Described described{&file, {field("index"), field("count")}, field("pieces"), {}};
    const Shard& shard = described.shard;
    if (shard.index < 1 || shard.index > shard.count || shard.count > Shard::most) {
        throw refuse(fmt::format("context.shard: expected one of at most {}, found {}/{}", Shard::most, shard.index,
                                 shard.count));
    }
    std::size_t rows = 0;
    for (const Json& pair : found->value("rows_of_pieces", Json::array())) {
        if (!pair.is_array() || pair.size() != 2) {
            throw refuse("context.shard.rows_of_pieces: expected pairs of a piece and its number of rows, found " +
                         pair.dump().substr(0, 60));
        }
        described.rows_of_pieces.emplace_back(number(pair[0], "a piece"), number(pair[1], "a number of rows"));
        const std::size_t more = described.rows_of_pieces.back().second;
        if (more > ResultLimits::rows - rows) {
            throw refuse(fmt::format("context.shard: expected at most {} rows, found more", ResultLimits::rows));
        }
        rows += more;
    }
    if (rows != file.results.rows.size()) {
        throw refuse(
            fmt::format("expected the {} rows that context.shard lists, found {}", rows, file.results.rows.size()));
    }
    return described;
}

[[noreturn]] void refuse_difference(const std::string& field, const NamedResults& one, const Json& value,
                                    const NamedResults& other, const Json& other_value, const char* hint = "") {
    const auto text = [](const Json& json) { return json.is_null() ? "nothing" : json.dump().substr(0, 200); };
    throw Failure(Exit::not_comparable, fmt::format("{} differs: {} in {}, {} in {}{}", field, text(value), one.name,
                                                    text(other_value), other.name, hint));
}

void compare_field(const std::string& field, const Json& one, const Json& other, const NamedResults& one_file,
                   const NamedResults& other_file) {
    if (one == other) {
        return;
    }
    if (one.is_object() && other.is_object()) {  // name what differs inside
        for (const Json* keys : {&one, &other}) {
            for (const auto& [key, unused] : keys->items()) {
                compare_field(field + '.' + key, one.value(key, Json()), other.value(key, Json()), one_file,
                              other_file);
            }
        }
    }
    refuse_difference(field, one_file, one, other_file, other);
}

void check_comparable(const Described& first, const Described& other, bool allow_mixed_hosts) {
    const Json& one = first.file->results.context;
    const Json& two = other.file->results.context;
    for (const Json* keys : {&one, &two}) {
        for (const auto& [key, unused] : keys->items()) {
            if (!of_the_machine.contains(key)) {
                compare_field(key, one.value(key, Json()), two.value(key, Json()), *first.file, *other.file);
            }
        }
    }
    if (first.shard.count != other.shard.count || first.pieces != other.pieces) {
        refuse_difference("the number of shards or pieces", *first.file, {first.shard.count, first.pieces}, *other.file,
                          {other.shard.count, other.pieces});
    }
    if (!allow_mixed_hosts && one.value("cpu", Json()) != two.value("cpu", Json())) {
        refuse_difference("cpu", *first.file, one.value("cpu", Json()), *other.file, two.value("cpu", Json()),
                          "; --allow-mixed-hosts takes them all the same, and marks the context");
    }
}

// By index, all there, none twice.
std::map<std::size_t, const Described*> in_order(const std::vector<Described>& shards) {
    std::map<std::size_t, const Described*> by_index;
    for (const Described& shard : shards) {
        const auto [found, is_new] = by_index.try_emplace(shard.shard.index, &shard);
        if (!is_new) {
            throw Failure(Exit::bad_input, fmt::format("shard {}/{} is there twice: {} and {}", shard.shard.index,
                                                       shard.shard.count, found->second->file->name, shard.file->name));
        }
    }
    const std::size_t count = shards.front().shard.count;
    std::vector<std::string> missing;
    for (std::size_t index = 1; index <= count; ++index) {
        if (!by_index.contains(index)) {
            missing.push_back(fmt::format("{}/{}", index, count));
        }
    }
    if (!missing.empty()) {
        const std::size_t shown = std::min<std::size_t>(missing.size(), 10);
        throw Failure(
            Exit::bad_input,
            fmt::format("missing: shard {}{}",
                        fmt::join(missing.begin(), missing.begin() + static_cast<std::ptrdiff_t>(shown), ", "),
                        missing.size() > shown ? ", ..." : ""));
    }
    return by_index;
}

Json merged_context(const std::map<std::size_t, const Described*>& shards) {
    const NamedResults* base = nullptr;
    Json origins = Json::array();
    std::set<std::string> cpus;
    for (const auto& [index, shard] : shards) {
        const Json& context = shard->file->results.context;
        base = base == nullptr || context.contains("host_timing_order") ? shard->file : base;
        origins.push_back({{"index", index}});
        for (const char* key : {"date", "host_name", "cpu"}) {
            origins.back()[key] = context.value(key, Json("unknown"));
        }
        cpus.insert(context.value("cpu", Json()).dump());
    }
    Json merged = base->results.context;
    merged.erase("shard");
    merged["shards"] = std::move(origins);
    if (cpus.size() > 1) {
        merged["mixed_hosts"] = "true";
    }
    return merged;
}

}  // namespace

Results merge(std::vector<NamedResults> files, bool allow_mixed_hosts) {
    std::vector<Described> shards;
    for (NamedResults& file : files) {
        shards.push_back(describe(file));
        check_comparable(shards.front(), shards.back(), allow_mixed_hosts);
    }
    if (shards.empty()) {
        throw Failure(Exit::bad_input, "expected at least one shard");
    }
    const auto by_index = in_order(shards);

    Results merged;
    merged.context = merged_context(by_index);
    struct Rows {
        NamedResults* file;
        std::size_t first;
        std::size_t count;
    };
    std::map<std::size_t, Rows> of_piece;
    for (const auto& [index, shard] : by_index) {
        std::size_t row = 0;
        for (const auto& [piece, count] : shard->rows_of_pieces) {
            const auto [found, is_new] = of_piece.try_emplace(piece, Rows{shard->file, row, count});
            if (!is_new) {
                throw Failure(Exit::bad_input, fmt::format("piece {} of the sweep is there twice: in {} and {}", piece,
                                                           found->second.file->name, shard->file->name));
            }
            row += count;
        }
    }
    const std::size_t pieces = shards.front().pieces;
    if (of_piece.size() != pieces || (pieces > 0 && of_piece.rbegin()->first != pieces - 1)) {
        throw Failure(Exit::bad_input,
                      fmt::format("expected the {} pieces of the sweep, found {} in the shards, the last numbered {}",
                                  pieces, of_piece.size(), of_piece.empty() ? 0 : of_piece.rbegin()->first));
    }
    for (const auto& [piece, rows] : of_piece) {
        for (std::size_t i = 0; i < rows.count; ++i) {
            merged.rows.push_back(std::move(rows.file->results.rows[rows.first + i]));
        }
    }
    return merged;
}

}  // namespace bench
