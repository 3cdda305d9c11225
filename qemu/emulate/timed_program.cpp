#include "qemu/emulate/timed_program.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>

#include "base/failure.hpp"
#include "base/scratch.hpp"
#include "qemu/emulate/software_double.hpp"

namespace qemu {

std::vector<timing::TimingLog> time_program(const Emulator& emulator, const std::filesystem::path& plugin,
                                            const std::filesystem::path& elf, const std::vector<std::string>& arguments,
                                            const std::vector<std::uint32_t>& entries,
                                            const timing::TimingRequest& request, const std::optional<Marks>& marks,
                                            const std::function<void(const std::string&)>& line) {
    const base::Scratch scratch;
    {
        std::ofstream watch(scratch.file("watch"));
        for (const std::uint32_t entry : entries) {
            watch << entry << '\n';
        }
        std::ofstream out(scratch.file("request"));
        timing::write_timing_request(out, for_program(request, Elf(elf)));
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
    if (logs.back().unfinished) {
        throw glsum::Failure(glsum::Exit::check_failed,
                             fmt::format("{}: a call of the timed function did not return{}", elf.string(),
                                         failure.empty() ? " before the program ended" : "; " + failure));
    }
    if (!failure.empty()) {
        throw glsum::Failure(status, failure);
    }
    if (std::any_of(logs.begin(), logs.end(), [](const timing::TimingLog& log) { return log.runs.empty(); })) {
        throw glsum::Failure(glsum::Exit::check_failed,
                             fmt::format("{}: the timed function was never called", elf.string()));
    }
    return logs;
}

}  // namespace qemu
