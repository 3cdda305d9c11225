// Dealing a sweep in shards, and putting shards together.
#include "bench/rows/merge.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <functional>
#include <numeric>
#include <set>

#include "bench/run/pieces.hpp"
#include "bench/run/run.hpp"
#include "bench/sweep/signals.hpp"
#include "bench/target/target_plan.hpp"
#include "tests/refusal.hpp"

namespace {

using testing::HasSubstr;

bench::Sweep sweep() {
    bench::Sweep sweep;
    sweep.kernels = {"null",          "shift_plain_f64",  "shift_plain_f32", "ring_plain_f32", "mirror_simd_f32",
                     "shift_fir_q31", "mirror_smlald_q15"};
    sweep.orders = {0.5, 0.7, 1.9909, -0.5};
    sweep.lengths = {{50}, {600}, {1000}, {1000, true}};
    sweep.signals.assign(std::begin(bench::signal_names), std::end(bench::signal_names));
    sweep.samples = 1000;
    return sweep;
}

TEST(Pieces, EveryPieceIsOneShardsAndTheLastTimesTheHost) {
    const std::vector<bench::Piece> pieces = bench::make_pieces(sweep());
    ASSERT_EQ(pieces.size(), 4U * 7 + 6U * 4 + 1);
    for (const std::size_t count : {1U, 2U, 3U, 7U, 100U}) {
        std::vector<std::size_t> all;
        for (std::size_t index = 1; index <= count; ++index) {
            const auto share = bench::pieces_of(pieces, {index, count});
            EXPECT_TRUE(std::is_sorted(share.begin(), share.end()));
            const bool host = std::any_of(share.begin(), share.end(), [&](std::size_t piece) {
                return pieces[piece].kind == bench::Piece::Kind::host;
            });
            EXPECT_EQ(host, index == count);
            all.insert(all.end(), share.begin(), share.end());
        }
        std::sort(all.begin(), all.end());
        std::vector<std::size_t> expected(pieces.size());
        std::iota(expected.begin(), expected.end(), std::size_t{0});
        EXPECT_EQ(all, expected) << count;
    }
}

TEST(Pieces, ShardsCostAboutTheSame) {
    const std::vector<bench::Piece> pieces = bench::make_pieces(sweep());
    double costliest = 0.0;  // never divided
    for (const bench::Piece& piece : pieces) {
        costliest = std::max(costliest, piece.cost);
    }
    for (const std::size_t count : {2U, 3U, 5U}) {
        std::vector<double> costs;
        for (std::size_t index = 1; index <= count; ++index) {
            double cost = 0.0;
            for (const std::size_t piece : bench::pieces_of(pieces, {index, count})) {
                cost += pieces[piece].cost;
            }
            costs.push_back(cost);
        }
        const auto [least, most] = std::minmax_element(costs.begin(), costs.end());
        EXPECT_LE(*most - *least, costliest) << count;
        // A share of nothing but the costliest piece may be larger than the others.
        EXPECT_LT(*most, std::max((count < 5 ? 1.1 : 1.5) * *least, 1.001 * costliest)) << count;
    }
}

TEST(Pieces, OnlyOfTheTargetsThatAreWanted) {
    bench::Sweep only = sweep();
    only.targets = {"m7"};
    EXPECT_EQ(bench::make_pieces(only).size(), 4U * 7 + 6U * 4);
    only.targets = {"host"};
    EXPECT_EQ(bench::make_pieces(only).size(), 4U * 7 + 1);
}

// The exact sums go with the square of the record; a kernel's own with the record, its lengths and how many there are.
TEST(Pieces, OfAccuracyCostTheExactSumsAndEachKernelsTaps) {
    bench::Sweep one = sweep();
    one.targets = {};
    const auto cost = [&](std::size_t samples, std::size_t kernels, std::size_t taps) {
        one.samples = samples;
        one.kernels.assign(kernels, "ring_plain_f32");
        one.lengths = {{taps}, {3 * taps}};
        return bench::make_pieces(one).front().cost;
    };
    const double exact = cost(1000, 0, 100);
    EXPECT_GT(exact, 0.0);
    EXPECT_NEAR(cost(3000, 0, 100), 9.0 * exact, 1e-12 * exact);
    const double kernels = cost(1000, 2, 100) - exact;
    EXPECT_GT(kernels, 0.0);
    EXPECT_NEAR(cost(1000, 6, 100), exact + 3.0 * kernels, 1e-9 * exact);
    EXPECT_NEAR(cost(1000, 2, 500), exact + 5.0 * kernels, 1e-9 * exact);
    EXPECT_NEAR(cost(3000, 2, 100), 9.0 * exact + 3.0 * kernels, 1e-9 * exact);
    for (const bench::Piece& piece : bench::make_pieces(one)) {
        EXPECT_EQ(piece.cost, bench::make_pieces(one).front().cost) << piece.number;
    }
}

TEST(Pieces, OfATargetCostWhatThePlanSays) {
    bench::Sweep one = sweep();
    one.targets = {"m7"};
    const std::vector<bench::Piece> pieces = bench::make_pieces(one);
    const std::vector<double> costs = bench::piece_costs(bench::make_target_plan(one));
    const std::size_t first = pieces.size() - costs.size();
    for (std::size_t i = 0; i < costs.size(); ++i) {
        const bench::Piece& piece = pieces.at(first + i);
        EXPECT_EQ(piece.kind, bench::Piece::Kind::target);
        EXPECT_EQ(piece.number, i);
        EXPECT_EQ(piece.machine, base::machine_called("m7"));
        EXPECT_NEAR(piece.cost / pieces[first].cost, costs[i] / costs[0], 1e-12 * costs[i] / costs[0]) << i;
    }
}

// A timing for each kernel or peer and each length; of repetitions each takes its part.
TEST(Pieces, OfTheHostCostItsTimings) {
    bench::Sweep one = sweep();
    one.targets = {"host"};
    const auto cost = [&](std::size_t kernels, std::size_t peers, std::size_t lengths, unsigned repetitions) {
        one.kernels.assign(kernels, "ring_plain_f32");
        one.peers.assign(peers, "peer_std_f32");
        one.lengths.assign(lengths, {50});
        one.repetitions = repetitions;
        return bench::make_pieces(one).back().cost;
    };
    const double single = cost(1, 0, 1, 1);
    EXPECT_GT(single, 0.0);
    EXPECT_NEAR(cost(3, 2, 4, 1), 20.0 * single, 1e-12 * single);
    const double twice = cost(1, 0, 1, 2);
    EXPECT_GT(twice, 0.0);
    EXPECT_NEAR(cost(1, 0, 1, 10), 5.0 * twice, 1e-12 * single);
    EXPECT_NEAR(cost(3, 2, 4, 2), 20.0 * twice, 1e-12 * single);
    EXPECT_LT(twice, single);  // of a single one Google Benchmark looks for the number of iterations
}

TEST(Pieces, PartsOfAPlanAreThePlan) {
    const bench::TargetPlan whole = bench::make_target_plan(sweep());
    const std::size_t pieces = bench::piece_costs(whole).size();
    std::multiset<std::string> expected;
    std::multiset<std::string> found;
    const auto describe = [](const bench::TargetPlan& plan, std::multiset<std::string>& into) {
        const auto text = [](const qemu::PlannedRow& row) {
            return row.kernel + ' ' + std::to_string(row.order) + ' ' + std::to_string(row.taps) + ' ' +
                   std::to_string(row.signal) + ' ' + std::to_string(row.calls);
        };
        for (const auto& row : plan.rows) {
            into.insert("row " + row.kernel + ' ' + std::to_string(row.order) + ' ' + row.length.text() +
                        " counted as " + text(plan.counts.at(row.count)));
        }
        for (const auto& replay : plan.replays) {
            into.insert("replay of " + plan.rows.at(replay.row).length.text() + ' ' + text(replay.planned));
        }
    };
    describe(whole, expected);
    for (std::size_t piece = 0; piece < pieces; ++piece) {
        const bench::TargetPlan part = bench::part_of(whole, {piece});
        EXPECT_EQ(part.rows.size(), 4U);
        for (std::size_t row = 0; row < part.rows.size(); ++row) {
            EXPECT_EQ(part.rows[row].kernel, part.rows[0].kernel);
            EXPECT_EQ(part.rows[row].length.text(), part.rows[0].length.text());
            EXPECT_EQ(part.rows[row].order, sweep().orders[row]);
        }
        for (const auto& count : part.counts) {
            EXPECT_EQ(count.kernel, part.rows[0].kernel);
        }
        describe(part, found);
    }
    EXPECT_EQ(found, expected);
}

TEST(Shard, IsReadOrRefused) {
    EXPECT_EQ(bench::parse_shard("2/3").index, 2U);
    EXPECT_EQ(bench::parse_shard("2/3").count, 3U);
    EXPECT_EQ(bench::parse_shard("10000/10000").index, 10'000U);
    for (const char* bad : {"", "/", "1", "1/", "/1", "0/1", "2/1", "1/10001", "1/2/3", "1/2 ", " 1/2", "-1/2", "1/-2",
                            "99999999999999999999/1", "1.5/2"}) {
        EXPECT_THROW((void)bench::parse_shard(bad), glsum::Failure) << bad;
    }
}

// Three pieces of two, one and no rows in two shards.
std::vector<bench::NamedResults> two_shards() {
    const auto context = [](std::size_t index, const bench::Json& rows_of_pieces) {
        return bench::Json{
            {"date", "day " + std::to_string(index)},
            {"cpu", "x"},
            {"commit", "c"},
            {"sweep", {{"orders", {0.5}}, {"taps", {"50"}}}},
            {"shard", {{"index", index}, {"count", 2}, {"pieces", 3}, {"rows_of_pieces", rows_of_pieces}}}};
    };
    std::vector<bench::NamedResults> shards{
        {"first.json", {context(1, {{1, 1}}), {bench::make_row("c", 1)}}},
        {"second.json", {context(2, {{0, 2}, {2, 0}}), {bench::make_row("a", 1), bench::make_row("b", 1)}}}};
    shards[1].results.context["host_timing_order"] = "0.5";
    return shards;
}

TEST(Merge, PutsPiecesInTheirOrderWhateverThatOfTheShards) {
    for (const bool turned : {false, true}) {
        std::vector<bench::NamedResults> shards = two_shards();
        if (turned) {
            std::swap(shards[0], shards[1]);
        }
        const bench::Results merged = bench::merge(std::move(shards), false);
        ASSERT_EQ(merged.rows.size(), 3U);
        EXPECT_EQ(merged.rows[0]["name"], "a");
        EXPECT_EQ(merged.rows[1]["name"], "b");
        EXPECT_EQ(merged.rows[2]["name"], "c");
        EXPECT_EQ(merged.context["date"], "day 2");  // of the shard that timed the host
        EXPECT_FALSE(merged.context.contains("shard"));
        EXPECT_FALSE(merged.context.contains("mixed_hosts"));
        ASSERT_EQ(merged.context["shards"].size(), 2U);
        EXPECT_EQ(merged.context["shards"][0]["date"], "day 1");
    }
}

// Its date and machine are the whole's.
TEST(Merge, WhereNoHostWasTimedTheFirstSpeaksForAll) {
    for (const bool turned : {false, true}) {
        std::vector<bench::NamedResults> shards = two_shards();
        shards[1].results.context.erase("host_timing_order");
        if (turned) {
            std::swap(shards[0], shards[1]);
        }
        EXPECT_EQ(bench::merge(std::move(shards), false).context["date"], "day 1");
    }
}

TEST(Merge, OfNothingIsNothing) {
    std::vector<bench::NamedResults> shards = two_shards();
    for (auto& shard : shards) {
        shard.results.context["shard"]["pieces"] = 0;
        shard.results.context["shard"]["rows_of_pieces"] = bench::Json::array();
        shard.results.rows.clear();
    }
    EXPECT_TRUE(bench::merge(std::move(shards), false).rows.empty());
}

using Change = std::function<void(std::vector<bench::NamedResults>&)>;

std::string refusal_of(const Change& change, glsum::Exit status) {
    std::vector<bench::NamedResults> shards = two_shards();
    change(shards);
    return test::refusal(status, [&] { (void)bench::merge(std::move(shards), false); });
}

void expect_refused(const Change& change, glsum::Exit status, const std::string& words) {
    EXPECT_THAT(refusal_of(change, status), HasSubstr(words));
}

TEST(Merge, RefusesWhatIsNotAllOfOneSweep) {
    using Shards = std::vector<bench::NamedResults>;
    using glsum::Exit;
    expect_refused([](Shards& s) { s.clear(); }, Exit::bad_input, "at least one shard");
    expect_refused([](Shards& s) { s.pop_back(); }, Exit::bad_input, "missing: shard 2/2");
    expect_refused([](Shards& s) { s.erase(s.begin()); }, Exit::bad_input, "missing: shard 1/2");
    expect_refused([](Shards& s) { s.push_back(s[0]); }, Exit::bad_input,
                   "shard 1/2 is there twice: first.json and first.json");
    expect_refused([](Shards& s) { s[1].results.context.erase("shard"); }, Exit::bad_input,
                   "second.json: expected a shard");
    expect_refused([](Shards& s) { s[1].results.rows.pop_back(); }, Exit::bad_input,
                   "second.json: expected the 2 rows that context.shard lists, found 1");
    expect_refused(
        [](Shards& s) {
            s[1].results.context["shard"]["rows_of_pieces"] = {{1, 2}, {2, 0}};
        },
        Exit::bad_input, "piece 1 of the sweep is there twice: in first.json and second.json");
    expect_refused(
        [](Shards& s) {
            s[1].results.context["shard"]["rows_of_pieces"] = bench::Json::array({{0, 2}});
        },
        Exit::bad_input, "expected the 3 pieces of the sweep, found 2");
    expect_refused(
        [](Shards& s) {
            s[1].results.context["shard"]["rows_of_pieces"] = {{0, 2}, {3, 0}};
        },
        Exit::bad_input, "the last numbered 3");
    // A sweep of a single piece, too: it is numbered 0.
    expect_refused(
        [](Shards& s) {
            s[0].results.context["shard"]["rows_of_pieces"] = {{1, 1}};
            s[1].results.context["shard"]["rows_of_pieces"] = bench::Json::array();
            s[1].results.rows.clear();
            for (auto& shard : s) {
                shard.results.context["shard"]["pieces"] = 1;
            }
        },
        Exit::bad_input, "expected the 1 pieces of the sweep, found 1 in the shards, the last numbered 1");
    expect_refused([](Shards& s) { s[1].results.context["commit"] = "d"; }, Exit::not_comparable,
                   "commit differs: \"c\" in first.json, \"d\" in second.json");
    expect_refused([](Shards& s) { s[0].results.context["new_field"] = 1; }, Exit::not_comparable,
                   "new_field differs: 1 in first.json, nothing in second.json");
    expect_refused([](Shards& s) { s[1].results.context["sweep"]["orders"] = {0.7}; }, Exit::not_comparable,
                   "sweep.orders differs: [0.5] in first.json, [0.7] in second.json");
    expect_refused([](Shards& s) { s[1].results.context["shard"]["count"] = 3; }, Exit::not_comparable,
                   "number of shards");
    expect_refused([](Shards& s) { s[1].results.context["cpu"] = "y"; }, Exit::not_comparable, "cpu differs");
}

TEST(Merge, RefusesADamagedShard) {
    using Shards = std::vector<bench::NamedResults>;
    for (const bench::Json& damaged :
         {bench::Json(3), bench::Json{{"index", 2}}, bench::Json{{"index", -2}, {"count", 2}, {"pieces", 3}},
          bench::Json{{"index", 2}, {"count", 2.5}, {"pieces", 3}},
          bench::Json{{"index", 3}, {"count", 2}, {"pieces", 3}, {"rows_of_pieces", {{0, 2}, {2, 0}}}},
          bench::Json{{"index", 2}, {"count", 2}, {"pieces", 3}, {"rows_of_pieces", 7}},
          bench::Json{{"index", 2}, {"count", 2}, {"pieces", 3}, {"rows_of_pieces", {{0, 2, 0}}}},
          bench::Json{
              {"index", 2}, {"count", 2}, {"pieces", 3}, {"rows_of_pieces", {{0, 18446744073709551615U}, {2, 3}}}}}) {
        expect_refused([&](Shards& s) { s[1].results.context["shard"] = damaged; }, glsum::Exit::bad_input,
                       "second.json: ");
    }
}

// Ten of those that are missing are named; of long values the first 200 letters are shown.
TEST(Merge, MessagesAreOfAReadableLength) {
    using Shards = std::vector<bench::NamedResults>;
    using glsum::Exit;
    const auto missing = [](std::size_t count) {
        return [count](Shards& s) {
            s.pop_back();
            s[0].results.context["shard"]["count"] = count;
        };
    };
    const std::string ten = "missing: shard 2/11, 3/11, 4/11, 5/11, 6/11, 7/11, 8/11, 9/11, 10/11, 11/11";
    EXPECT_EQ(refusal_of(missing(11), Exit::bad_input), ten);
    std::string more = ten;
    for (std::size_t at = 0; (at = more.find("/11", at)) != std::string::npos;) {
        more[at + 2] = '2';
    }
    EXPECT_EQ(refusal_of(missing(12), Exit::bad_input), more + ", ...");
    EXPECT_EQ(
        refusal_of([](Shards& s) { s[0].results.context["commit"] = std::string(250, 'd'); }, Exit::not_comparable),
        "commit differs: \"" + std::string(199, 'd') + " in first.json, \"c\" in second.json");
    expect_refused([](Shards& s) { s[0].results.context["shard"]["index"] = 0; }, Exit::bad_input,
                   "first.json: context.shard: expected one of at most 10000, found 0/2");
    expect_refused(missing(10'000), Exit::bad_input, "missing: shard 2/10000, ");
    expect_refused(missing(10'001), Exit::bad_input, "expected one of at most 10000, found 1/10001");
}

TEST(Merge, AShardListsAtMostTheRowsThatAFileMayHave) {
    const auto listing = [](std::size_t one, std::size_t other) {
        return [=](std::vector<bench::NamedResults>& s) {
            s[1].results.context["shard"]["rows_of_pieces"] = {{0, one}, {2, other}};
        };
    };
    expect_refused(listing(999'999, 1), glsum::Exit::bad_input,
                   "second.json: expected the 1000000 rows that context.shard lists, found 2");
    for (const std::size_t more : {std::size_t{2}, std::size_t{3'000'000}, std::size_t{INT64_MAX}}) {
        expect_refused(listing(999'999, more), glsum::Exit::bad_input,
                       "second.json: context.shard: expected at most 1000000 rows, found more");
    }
}

TEST(Merge, MixedHostsAreMarked) {
    std::vector<bench::NamedResults> shards = two_shards();
    shards[1].results.context["cpu"] = "y";
    const bench::Results merged = bench::merge(std::move(shards), true);
    EXPECT_EQ(merged.context["mixed_hosts"], "true");
    EXPECT_EQ(merged.context["shards"][0]["cpu"], "x");
    EXPECT_EQ(merged.context["shards"][1]["cpu"], "y");
}

// A sweep in shards, put together again, is the sweep: the same rows in the same order, of accuracy to the last bit.
TEST(Run, ShardsAreTheWhole) {
    bench::Sweep small;
    small.kernels = {"shift_plain_f32", "ring_plain_q15"};
    small.orders = {0.5, 0.9};
    small.lengths = {{5}, {20}};
    small.signals = {"step", "noise"};
    small.samples = 60;
    small.targets = {"host"};
    const std::vector<std::string> quick = {"--benchmark_min_time=0.0001"};
    const bench::Results whole = bench::measure(small, std::nullopt, {}, quick);
    EXPECT_FALSE(whole.context.contains("shard"));
    EXPECT_EQ(whole.context.at("host_timing_order"), "0.5");  // what the timing says of itself
    EXPECT_TRUE(whole.context.contains("cycle_counter"));
    ASSERT_EQ(whole.rows.size(), 4U * 4U + 4U);
    std::vector<bench::NamedResults> shards;
    for (const std::size_t index : {1U, 2U}) {
        shards.push_back({"shard", bench::measure(small, bench::Shard{index, 2}, {}, quick)});
        const bench::Json& shard = shards.back().results.context.at("shard");
        EXPECT_EQ(shard.at("index"), index);
        EXPECT_EQ(shard.at("count"), 2);
        EXPECT_EQ(shard.at("pieces"), 5);
    }
    const bench::Results merged = bench::merge(std::move(shards), false);
    ASSERT_EQ(merged.rows.size(), whole.rows.size());
    for (std::size_t i = 0; i < whole.rows.size(); ++i) {
        EXPECT_EQ(merged.rows[i].at("name"), whole.rows[i].at("name"));
        if (whole.rows[i].contains("error_max")) {
            EXPECT_EQ(merged.rows[i], whole.rows[i]);
        } else {
            EXPECT_TRUE(whole.rows[i].at("name").get<std::string>().ends_with("/host"));
        }
    }
}

}  // namespace
