#include "qemu/timing/timing_log.hpp"

#include <algorithm>
#include <istream>
#include <ostream>
#include <sstream>
#include <stdexcept>

#include "base/failure.hpp"

namespace timing {
namespace {

bool same(const TimedCall& a, const TimedCall& b) {
    if (a.entry != b.entry || a.instructions != b.instructions || a.stack_bytes != b.stack_bytes ||
        a.cores.size() != b.cores.size()) {
        return false;
    }
    for (std::size_t c = 0; c < a.cores.size(); ++c) {
        if (a.cores[c] != b.cores[c]) {
            return false;
        }
    }
    return true;
}

}  // namespace

void TimingLogWriter::add(const TimedCall& call) {
    if (run_.calls > 0 && !same(run_.call, call)) {
        write_run();
    }
    if (run_.calls == 0) {
        run_.call = call;
    }
    ++run_.calls;
}

void TimingLogWriter::write_run() {
    out_ << "calls " << run_.calls << ' ' << run_.call.entry << ' ' << run_.call.instructions;
    for (const CoreTime& core : run_.call.cores) {
        out_ << " core " << core.half_cycles.size();
        for (const std::int64_t half_cycles : core.half_cycles) {
            out_ << ' ' << half_cycles;
        }
        for (const std::int64_t loss : core.losses) {
            out_ << ' ' << loss;
        }
        out_ << ' ' << core.double_in_software;
        if (!core.sets.empty()) {
            out_ << " sets " << core.sets.size();
            for (const std::int64_t half_cycles : core.sets) {
                out_ << ' ' << half_cycles;
            }
        }
    }
    if (run_.call.stack_bytes > 0) {
        out_ << " stack " << run_.call.stack_bytes;
    }
    out_ << '\n';
    run_ = {};
}

void TimingLogWriter::finish(const CallTimer& timer) {
    if (run_.calls > 0) {
        write_run();
    }
    const auto hot = timer.hot();
    for (std::size_t c = 0; c < hot.size(); ++c) {
        for (const auto& [address, spot] : hot[c]) {
            out_ << "hot " << c << ' ' << address << ' ' << spot.half_cycles << ' ' << effect_names[index(spot.reason)]
                 << ' ' << spot.lost << '\n';
        }
    }
    for (const auto& [address, times] : timer.unknown()) {
        out_ << "unknown " << address << ' ' << times << '\n';
    }
    if (timer.last_address()) {
        out_ << "at " << *timer.last_address() << '\n';
    }
    if (timer.fault()) {
        out_ << "fault " << *timer.fault() << '\n';
    }
    if (timer.recursive()) {
        out_ << "recursive\n";
    }
    if (timer.inside()) {
        out_ << "unfinished\n";
    }
    if (timer.stretch_marks().open()) {
        out_ << "open " << *timer.stretch_marks().open() << '\n';
    }
    if (const auto& misused = timer.stretch_marks().misused()) {
        out_ << "misused " << misused->address;
        if (misused->open) {
            out_ << ' ' << *misused->open;
        }
        out_ << '\n';
    }
    out_ << "end\n";
}

TimingLog read_timing_log(std::istream& in) {
    TimingLog log;
    for (std::string line; std::getline(in, line);) {
        std::istringstream words(line);
        std::string kind;
        words >> kind;
        if (kind == "calls") {
            TimedRun run;
            if (!(words >> run.calls >> run.call.entry >> run.call.instructions) || run.calls == 0) {
                throw std::runtime_error("timing log: damaged line: " + line);
            }
            std::size_t sets = 0;
            for (std::string word; words >> word >> sets;) {
                if (word == "stack") {
                    run.call.stack_bytes = static_cast<std::uint32_t>(sets);
                    continue;
                }
                if (word == "sets" && !run.call.cores.empty()) {
                    std::vector<std::int64_t>& of_core = run.call.cores.back().sets;
                    of_core.resize(std::min<std::size_t>(sets, 1000));
                    for (std::int64_t& half_cycles : of_core) {
                        words >> half_cycles;
                    }
                    if (!words) {
                        throw std::runtime_error("timing log: damaged line: " + line);
                    }
                    continue;
                }
                CoreTime core;
                core.half_cycles.resize(std::min<std::size_t>(sets, 1000));
                for (std::int64_t& half_cycles : core.half_cycles) {
                    words >> half_cycles;
                }
                for (std::int64_t& loss : core.losses) {
                    words >> loss;
                }
                words >> core.double_in_software;
                if (!words || word != "core") {
                    throw std::runtime_error("timing log: damaged line: " + line);
                }
                run.call.cores.push_back(std::move(core));
            }
            log.runs.push_back(std::move(run));
        } else if (kind == "hot") {
            std::size_t core = 0;
            std::uint32_t address = 0;
            HotSpot spot;
            std::string reason;
            if (!(words >> core >> address >> spot.half_cycles >> reason >> spot.lost) || core > 1000 ||
                !effect_named(reason)) {
                throw std::runtime_error("timing log: damaged line: " + line);
            }
            spot.reason = *effect_named(reason);
            log.hot.resize(std::max(log.hot.size(), core + 1));
            log.hot[core][address] = spot;
        } else if (kind == "unknown") {
            std::uint32_t address = 0;
            std::uint64_t times = 0;
            if (!(words >> address >> times)) {
                throw std::runtime_error("timing log: damaged line: " + line);
            }
            log.unknown[address] = times;
        } else if (kind == "at" || kind == "fault" || kind == "open") {
            std::uint32_t address = 0;
            if (!(words >> address)) {
                throw std::runtime_error("timing log: damaged line: " + line);
            }
            (kind == "at" ? log.last_address : kind == "fault" ? log.fault : log.open_stretch) = address;
        } else if (kind == "misused") {
            qemu::MisusedMark misused;
            if (!(words >> misused.address)) {
                throw std::runtime_error("timing log: damaged line: " + line);
            }
            if (std::uint32_t open = 0; words >> open) {
                misused.open = open;
            }
            log.misused_mark = misused;
        } else if (kind == "recursive") {
            log.recursive = true;
        } else if (kind == "unfinished") {
            log.unfinished = true;
        } else if (kind == "end") {
            return log;
        } else {
            throw std::runtime_error("timing log: " + line);
        }
    }
    throw std::runtime_error("timing log: cut short: the emulator ended before it was written");
}

TimingRequest::Core core_asked_for(const std::string& core) {
    TimingRequest::Core asked{core, "", ""};
    if (names_core_file(core)) {
        asked.name = std::filesystem::path(core).stem().string();
        asked.file = std::filesystem::absolute(core).string();
    }
    return asked;
}

void write_timing_request(std::ostream& out, const TimingRequest& request) {
    const auto word = [](const std::string& text) { return text.empty() ? "-" : text; };
    out << "folder " << request.cores_folder << '\n';
    for (const AddressRange& range : request.double_routines) {
        out << "double " << range.begin << ' ' << range.end << '\n';
    }
    for (const AddressRange& range : request.unwinding.restorers) {
        out << "restorer " << range.begin << ' ' << range.end << '\n';
    }
    for (const auto& [begin, function] : request.unwinding.functions) {
        out << "function " << begin << ' ' << function << '\n';
    }
    for (const std::uint32_t handler : request.handlers) {
        out << "handler " << handler << '\n';
    }
    for (const std::uint32_t handler : request.fault_handlers) {
        out << "faults " << handler << '\n';
    }
    for (const std::uint32_t begin : request.stretches) {
        out << "stretch " << begin << '\n';
    }
    for (const auto& core : request.cores) {
        out << "core " << core.name << ' ' << word(core.code) << ' ' << word(core.data) << ' ' << core.instruction_cache
            << ' ' << word(core.set);
        for (const std::string& effect : core.without) {
            out << ' ' << effect;
        }
        out << '\n';
        for (const PlacedRange& range : core.ranges) {
            out << "place " << range.begin << ' ' << range.end << ' ' << name_of(range.place) << '\n';
        }
        if (!core.file.empty()) {
            out << "file " << core.file << '\n';
        }
    }
}

TimingRequest read_timing_request(std::istream& in) {
    TimingRequest request;
    for (std::string line; std::getline(in, line);) {
        std::istringstream words(line);
        std::string kind;
        words >> kind;
        if (kind == "folder") {
            std::getline(words >> std::ws, request.cores_folder);
        } else if (kind == "double" || kind == "restorer") {
            AddressRange range;
            words >> range.begin >> range.end;
            (kind == "double" ? request.double_routines : request.unwinding.restorers).push_back(range);
        } else if (kind == "function") {
            std::uint32_t begin = 0;
            words >> begin;
            words >> request.unwinding.functions[begin];
        } else if (kind == "handler" || kind == "faults" || kind == "stretch") {
            std::uint32_t address = 0;
            words >> address;
            (kind == "handler"  ? request.handlers
             : kind == "faults" ? request.fault_handlers
                                : request.stretches)
                .insert(address);
        } else if (kind == "core") {
            TimingRequest::Core core;
            words >> core.name >> core.code >> core.data >> core.instruction_cache >> core.set;
            for (std::string* word : {&core.code, &core.data, &core.set}) {
                *word = *word == "-" ? "" : *word;
            }
            for (std::string effect; words >> effect;) {
                core.without.push_back(effect);
            }
            request.cores.push_back(core);
        } else if (kind == "place" && !request.cores.empty()) {
            PlacedRange range;
            std::string place;
            words >> range.begin >> range.end >> place;
            range.place = place_named(place);
            request.cores.back().ranges.push_back(range);
        } else if (kind == "file" && !request.cores.empty()) {
            std::getline(words >> std::ws, request.cores.back().file);
        }
    }
    return request;
}

namespace {

void switch_off_all(CoreFile& core, const std::vector<std::string>& effects) {
    for (const std::string& effect : effects) {
        if (!switch_off(core, effect)) {
            std::string known;
            for (const std::string_view one : effect_names) {
                known += " " + std::string(one);
            }
            known += " " + std::string(double_in_software);
            for (const std::string_view one : effects_beside_a_call) {
                known += " " + std::string(one);
            }
            throw glsum::Failure(glsum::Exit::bad_input, effect + ": no such effect; expected one of" + known);
        }
    }
}

void keep_only(CoreFile& core, const std::string& set) {
    const auto found =
        std::find_if(core.sets.begin(), core.sets.end(), [&](const RuleSet& one) { return one.name == set; });
    if (found == core.sets.end()) {
        std::string known;
        for (const RuleSet& one : core.sets) {
            known += " " + one.name;
        }
        throw glsum::Failure(glsum::Exit::bad_input,
                             set + ": no such rule set of the core " + core.name + "; expected one of" + known);
    }
    core.sets = {RuleSet(*found)};
}

}  // namespace

std::vector<CoreFile> cores_of(const TimingRequest& request) {
    std::vector<CoreFile> cores;
    for (const auto& wanted : request.cores) {
        CoreFile core = wanted.file.empty() ? read_core(request.cores_folder, wanted.name)
                                            : read_core_file(wanted.file, request.cores_folder);
        switch_off_all(core, wanted.without);
        if (!wanted.set.empty()) {
            keep_only(core, wanted.set);
        }
        if (!wanted.code.empty()) {
            core.placement.code = code_place_named(wanted.code);
        }
        if (!wanted.data.empty()) {
            core.placement.data = data_place_named(wanted.data);
        }
        core.placement.ranges = wanted.ranges;
        if (!wanted.instruction_cache) {
            for (RuleSet& set : core.sets) {
                set.figures.cache_instruction_bytes = 0;
            }
        }
        cores.push_back(std::move(core));
    }
    return cores;
}

}  // namespace timing
