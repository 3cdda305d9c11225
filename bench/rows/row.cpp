#include "bench/rows/row.hpp"

#include "bench/rows/key.hpp"

namespace bench {

Json make_row(const std::string& name, std::size_t iterations) {
    Json row;
    row["name"] = name;
    row["family_index"] = 0;
    row["per_family_instance_index"] = 0;
    row["run_name"] = name;
    row["run_type"] = "iteration";
    row["repetitions"] = 1;
    row["repetition_index"] = 0;
    row["threads"] = 1;
    row["iterations"] = iterations;
    row["real_time"] = 0.0;
    row["cpu_time"] = 0.0;
    row["time_unit"] = "ns";
    return row;
}

void mark_error(Json& row, const std::string& message) {
    row["error_occurred"] = true;
    row["error_message"] = message;
}

bool is_wrong(const Json& row) { return row.value("error_occurred", false); }

bool is_timed(const Json& row) { return value_of(row, Counter::real_time).value_or(0.0) > 0.0; }

std::optional<double> value_of(const Json& row, Counter counter) {
    const auto found = row.find(name_of(counter));
    return found != row.end() && found->is_number() ? std::optional(found->get<double>()) : std::nullopt;
}

Row::Row(const RowKey& key, std::size_t iterations) : json_(make_row(to_name(key), iterations)) {}

void Row::set_time(double ns) {
    set(Counter::real_time, ns);
    set(Counter::cpu_time, ns);
}

std::string to_text(glsum::Status status) {
    switch (status) {
        case glsum::Status::ok:
            return "ok";
        case glsum::Status::order_out_of_range:
            return "the order is not in (-2, 2]";
        case glsum::Status::no_taps:
            return "no taps";
        case glsum::Status::table_too_small:
        case glsum::Status::past_too_small:
            return "the length is beyond the capacity";
        case glsum::Status::format_too_narrow:
            return "the coefficients do not fit the format";
        case glsum::Status::modes_out_of_range:
            return "the modes leave no tap, or do not decay";
        case glsum::Status::weights_out_of_range:
            return "the weights are too few, are no numbers, or have no Horner form";
        case glsum::Status::blocks_out_of_range:
            return "the blocks leave no tap, are none a level, or reach too far";
    }
    return "unknown status";
}

}  // namespace bench
