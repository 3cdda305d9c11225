// What the timer saw, as text: written where the program runs, read where it is judged.
#pragma once

#include <cstdint>
#include <iosfwd>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "qemu/timing/call_timer.hpp"

namespace timing {

/// Consecutive calls that took the same.
struct TimedRun {
    std::uint64_t calls = 0;
    TimedCall call;
};

struct TimingLog {
    std::vector<TimedRun> runs;
    std::vector<std::map<std::uint32_t, HotSpot>> hot;  ///< by core: what each address took within calls
    std::map<std::uint32_t, std::uint64_t> unknown;     ///< executions of encodings that the decoder does not know
    std::optional<std::uint32_t> last_address;          ///< that was executed
    std::optional<std::uint32_t> fault;                 ///< where the program first faulted
    bool recursive = false;
    bool unfinished = false;                        ///< the program ended within a watched call
    std::optional<std::uint32_t> open_stretch;      ///< which is open at the end: where it began
    std::optional<qemu::MisusedMark> misused_mark;  ///< the first
};

/// Collects calls and writes them.
class TimingLogWriter {
public:
    explicit TimingLogWriter(std::ostream& out) : out_(out) {}
    void add(const TimedCall& call);
    /// The rest, and the mark that the log is whole.
    void finish(const CallTimer& timer);

private:
    void write_run();
    std::ostream& out_;
    TimedRun run_;
};

/// \throws std::runtime_error when the log is damaged or cut short
[[nodiscard]] TimingLog read_timing_log(std::istream& in);

/// What is to be timed, on which cores: handed to the program that runs the emulated one.
struct TimingRequest {
    struct Core {
        std::string name;
        std::string code;  ///< placement; empty: as the core file has it
        std::string data;
        bool instruction_cache = true;          ///< false: off, whatever the core file says
        std::string set = {};                   ///< this rule set alone; empty: all, the nominal one first
        std::vector<std::string> without = {};  ///< effects that are switched off
        std::vector<PlacedRange> ranges = {};   ///< placed by themselves
        std::string file = {};                  ///< to be read in place of the folder's; empty: none
    };
    std::string cores_folder;
    std::vector<Core> cores;
    std::vector<AddressRange> double_routines = {};  ///< of the program, see software_double.hpp
    std::set<std::uint32_t> handlers = {};           ///< of its exceptions: their entry addresses
    std::set<std::uint32_t> fault_handlers = {};     ///< of those, its fault handlers
    Unwinding unwinding = {};                        ///< by exceptions of C++ and longjmp
    std::set<std::uint32_t> stretches = {};          ///< addresses of the marks that begin what is to be timed, too
};
/// What somebody means who names a core: one of the folder's, or a file by its path (`names_core_file`).
[[nodiscard]] TimingRequest::Core core_asked_for(const std::string& core);
void write_timing_request(std::ostream& out, const TimingRequest& request);
[[nodiscard]] TimingRequest read_timing_request(std::istream& in);

/// Reads the core files that a request names, with its placements, sets and effects applied.
/// \throws glsum::Failure as read_core, and for a set or an effect that does not exist or is none of the model's
[[nodiscard]] std::vector<CoreFile> cores_of(const TimingRequest& request);

}  // namespace timing
