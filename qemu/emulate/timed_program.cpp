#include "qemu/emulate/timed_program.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <iterator>
#include <set>

#include "base/failure.hpp"
#include "base/scratch.hpp"
#include "qemu/emulate/software_double.hpp"
#include "qemu/emulate/unwinding.hpp"

namespace qemu {
namespace {

// What the vector table names from one vector to another. Where it has none the core locks up there. [ARMv7-M B1.5.2]
// Nothing says how many interrupts it has: it ends where what follows is no function's address.
std::set<std::uint32_t> handlers_of(const Elf& program, std::uint32_t first, std::uint32_t last) {
    constexpr std::uint32_t exceptions = 16;
    std::set<std::uint32_t> handlers;
    for (std::uint32_t vector = first; vector <= last && program.has_word(4 * vector); ++vector) {
        const std::uint32_t handler = program.word(4 * vector) & ~1U;
        const Function* const function = program.function_at(handler);
        if (vector >= exceptions && handler != 0 && (function == nullptr || function->address != handler)) {
            break;
        }
        handlers.insert(handler);
    }
    return handlers;
}

std::string place_of(std::uint32_t address, const Elf& program) {
    const Function* const function = program.function_at(address);
    return fmt::format("{:#010x}{}", address, function != nullptr ? " in " + function->name : "");
}

std::string beginning(std::uint32_t address, const Elf& program) {
    return "the stretch that glsum_mark_begin at " + place_of(address, program) + " began";
}

// Marks of stretches that do not pair. \param failure  of the program, which then is why one is open
void check_marks(const timing::TimingLog& log, const Elf& program, glsum::Exit status, const std::string& failure) {
    const auto refuse = [&](glsum::Exit exit, const std::string& text) {
        throw glsum::Failure(exit, program.path().string() + ": " + text);
    };
    if (log.misused_mark && log.misused_mark->open) {
        refuse(glsum::Exit::bad_input,
               fmt::format("glsum_mark_begin at {} stands within {}: stretches do not nest",
                           place_of(log.misused_mark->address, program), beginning(*log.misused_mark->open, program)));
    }
    if (log.misused_mark) {
        refuse(glsum::Exit::bad_input,
               fmt::format("glsum_mark_end at {} ends no stretch", place_of(log.misused_mark->address, program)));
    }
    if (log.open_stretch) {
        refuse(failure.empty() ? glsum::Exit::bad_input : status,
               fmt::format("{} never met glsum_mark_end{}", beginning(*log.open_stretch, program),
                           failure.empty() ? " before the program ended" : "; " + failure));
    }
}

// For the message of a program that failed.
std::string where_it_ended(const timing::TimingLog& log, const Elf& program) {
    std::string text;
    if (log.fault) {
        text += "; it faulted at " + place_of(*log.fault, program);
    }
    if (log.last_address) {
        text += "; the last instruction that it executed was at " + place_of(*log.last_address, program);
    }
    return text;
}

}  // namespace

std::vector<timing::TimingLog> time_program(const Emulator& emulator, const std::filesystem::path& plugin,
                                            const std::filesystem::path& elf, const std::vector<std::string>& arguments,
                                            const std::vector<std::uint32_t>& entries,
                                            const timing::TimingRequest& request, const std::optional<Marks>& marks,
                                            const std::function<void(const std::string&)>& line, bool uncalled) {
    const Elf program(elf);
    const base::Scratch scratch;
    {
        std::ofstream watch(scratch.file("watch"));
        for (const std::uint32_t entry : entries) {
            watch << entry << '\n';
        }
        std::ofstream out(scratch.file("request"));
        timing::TimingRequest own = for_program(request, program);
        constexpr std::uint32_t nmi = 2, hard_fault = 3, usage_fault = 6, last_interrupt = 511;
        own.handlers = handlers_of(program, nmi, last_interrupt);
        own.unwinding = unwinding_of(program);
        own.fault_handlers = handlers_of(program, hard_fault, usage_fault);
        timing::write_timing_request(out, own);
        std::ofstream of_marks(scratch.file("marks"));
        if (marks) {
            of_marks << marks->row << ' ' << marks->on << ' ' << marks->off << '\n';
        }
        if (!watch.flush() || !out.flush() || !of_marks.flush()) {
            throw glsum::Failure(glsum::Exit::check_failed, fmt::format("{}: cannot write", scratch.file("").string()));
        }
    }
    std::string value = fmt::format("{},watch={},timing={},times={}", plugin.string(), scratch.file("watch").string(),
                                    scratch.file("request").string(), scratch.file("log").string());
    if (marks) {
        value += fmt::format(",marks={}", scratch.file("marks").string());
    }
    std::string failure;
    glsum::Exit status = glsum::Exit::good;
    try {
        emulate(emulator, elf, arguments, value, [&](const std::string& text) {
            if (line) {
                line(text);
            }
        });
    } catch (const glsum::Failure& failed) {
        failure = failed.what();
        status = failed.status();
    }
    std::ifstream in(scratch.file("log"));
    std::vector<timing::TimingLog> logs;
    try {
        do {
            logs.push_back(timing::read_timing_log(in));
        } while (in.peek() != std::ifstream::traits_type::eof());
    } catch (const std::runtime_error& damaged) {
        throw glsum::Failure(status == glsum::Exit::good ? glsum::Exit::check_failed : status,
                             failure.empty() ? damaged.what() : failure);
    }
    if (!failure.empty()) {
        failure += where_it_ended(logs.back(), program);
    }
    // Which one, where each has a log of its own.
    const std::set<std::uint32_t> sorted(entries.begin(), entries.end());
    const auto timed = [&](const timing::TimingLog& log) {
        if (marks || sorted.size() < 2 || logs.size() != sorted.size() + request.stretches.size()) {
            return std::string("the timed function");
        }
        const Function* const function = program.function_at(*std::next(sorted.begin(), &log - logs.data()));
        return function != nullptr ? function->name : std::string("a timed function");
    };
    check_marks(logs.back(), program, status, failure);
    const auto unfinished = std::find_if(logs.begin(), logs.end(), [](const auto& log) { return log.unfinished; });
    if (unfinished != logs.end() && (!marks || logs.back().unfinished)) {
        throw glsum::Failure(glsum::Exit::check_failed,
                             fmt::format("{}: a call of {} did not return{}", elf.string(), timed(*unfinished),
                                         failure.empty() ? " before the program ended" : "; " + failure));
    }
    if (!failure.empty()) {
        throw glsum::Failure(status, failure);
    }
    // Of stretches only those that were met are asked for.
    const auto stretches = logs.end() - static_cast<std::ptrdiff_t>(std::min(request.stretches.size(), logs.size()));
    const auto uncalled_one = [](const timing::TimingLog& log) { return log.runs.empty(); };
    if (!request.stretches.empty() && std::all_of(stretches, logs.end(), uncalled_one)) {
        throw glsum::Failure(glsum::Exit::check_failed, fmt::format("{}: none of its {} glsum_mark_begin was executed",
                                                                    elf.string(), request.stretches.size()));
    }
    const auto none = std::find_if(logs.begin(), stretches, uncalled_one);
    if (none != stretches && !uncalled) {
        throw glsum::Failure(glsum::Exit::check_failed,
                             fmt::format("{}: {} was never called", elf.string(), timed(*none)));
    }
    return logs;
}

}  // namespace qemu
