#include "bench/report/difference.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <unordered_map>
#include <unordered_set>

#include "bench/rows/counters.hpp"
#include "bench/rows/csv.hpp"
#include "bench/rows/key.hpp"
#include "bench/rows/median.hpp"

namespace bench::report {
namespace {

// Of the two times of a sample the wall's, where one was taken: elsewhere it is made from modelled cycles.
bool is_compared(const std::string& field, bool timed) {
    const CounterFacts* facts = find_counter(field);
    return is_measured(field) || (facts == &facts_of(Counter::real_time) && timed);
}

struct Row {
    std::map<std::string, std::vector<double>> counters;
    bool wrong = false;
};

using Rows = std::vector<std::pair<std::string, Row>>;  // in the order of the file

Rows rows_by_name(const std::vector<Json>& rows) {
    Rows named;
    std::unordered_map<std::string, std::size_t> at;
    for (const Json& row : rows) {
        if (row.value("run_type", "iteration") != "iteration") {
            continue;
        }
        const std::string name = row.value("name", "");
        const auto [found, is_new] = at.try_emplace(name, named.size());
        if (is_new) {
            named.emplace_back(name, Row{});
        }
        Row& into = named[found->second].second;
        into.wrong = into.wrong || is_wrong(row);
        const auto key = parse_key(name);
        const bool timed = !key || key->is_host();
        for (const auto& [field, value] : row.items()) {
            if (value.is_number() && is_compared(field, timed)) {
                into.counters[field].push_back(value.get<double>());
            }
        }
    }
    return named;
}

}  // namespace

double Difference::size() const {
    const double ratio = a && b ? *b / *a : 0.0;
    return ratio > 0.0 && std::isfinite(ratio) ? std::fabs(std::log(ratio)) : std::numeric_limits<double>::infinity();
}

std::vector<Difference> differences(const std::vector<Json>& a, const std::vector<Json>& b) {
    const Rows rows_a = rows_by_name(a);
    const Rows rows_b = rows_by_name(b);
    std::unordered_map<std::string, const Row*> of_b;
    for (const auto& [name, row] : rows_b) {
        of_b[name] = &row;
    }
    std::vector<Difference> found;
    std::unordered_set<std::string> in_a;
    for (const auto& [name, row] : rows_a) {
        in_a.insert(name);
        const auto other = of_b.find(name);
        if (other == of_b.end()) {
            found.push_back({name, "", {}, {}, "only in A"});
            continue;
        }
        if (row.wrong != other->second->wrong) {
            found.push_back({name, "", {}, {}, row.wrong ? "wrong in A" : "wrong in B"});
        }
        for (const auto& [counter, values] : row.counters) {
            const auto same = other->second->counters.find(counter);
            if (same != other->second->counters.end()) {
                const double one = median_of(values);
                const double two = median_of(same->second);
                if (one != two) {
                    found.push_back({name, counter, one, two, ""});
                }
            }
        }
    }
    for (const auto& [name, row] : rows_b) {
        if (!in_a.contains(name)) {
            found.push_back({name, "", {}, {}, "only in B"});
        }
    }
    std::stable_sort(found.begin(), found.end(),
                     [](const Difference& one, const Difference& other) { return one.size() > other.size(); });
    return found;
}

std::string to_csv(const std::vector<Difference>& differences) {
    std::string text = "name,counter,a,b,ratio,note\n";
    for (const Difference& one : differences) {
        const auto number = [](std::optional<double> value) { return value ? fmt::format("{}", *value) : ""; };
        const bool finite = one.a && one.b && std::isfinite(*one.b / *one.a);
        text += fmt::format("{},{},{},{},{},{}\n", csv_field(one.name), csv_field(one.counter), number(one.a),
                            number(one.b), finite ? fmt::format("{:.6g}", *one.b / *one.a) : "", one.note);
    }
    return text;
}

}  // namespace bench::report
