#include "cli/exam.hpp"

#include <fmt/format.h>
#include <time.h>

#include <map>

#include "base/failure.hpp"
#include "base/files.hpp"
#include "base/parallel.hpp"
#include "base/progress.hpp"
#include "base/sha256.hpp"
#include "cli/drive_files.hpp"
#include "cli/output.hpp"
#include "gap/drive/diagnose.hpp"
#include "gap/exam/ask.hpp"
#include "gap/exam/score.hpp"

namespace cli {
namespace {

namespace exam = gap::exam;
using std::filesystem::path;

constexpr const char* hashes_file = "answers.sha256";
constexpr const char* verdict_file = "verdict.json";
constexpr const char* refusal_file = "refused.txt";

exam::Given read_given(const exam::Asked& asked, const path& data) {
    const auto below = [&](const std::vector<std::string>& names) {
        std::vector<path> paths;
        for (const std::string& name : names) {
            paths.push_back(data / name);
        }
        return paths;
    };
    exam::Given given{read_records(below(asked.train), asked.columns),
                      read_records(below(asked.validate), asked.columns), std::nullopt};
    if (!asked.is_fitted()) {
        given.model = read_model(data / asked.base);
    }
    return given;
}

// Of this thread; a question is answered on one.
double cpu_seconds() {
    timespec now{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
    return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

// The file that holds the answer, below the question's folder.
const char* answer(const exam::Asked& asked, const path& data, const path& folder) {
    try {
        const gap::Question question = exam::to_question(asked, read_given(asked, data), 1);
        base::write_file(folder / verdict_file,
                         exam::to_answer(asked, gap::diagnose(question, [](const std::string&) {})));
        return verdict_file;
    } catch (const glsum::Failure& failure) {
        base::write_file(folder / refusal_file, fmt::format("{}\n", failure.what()));
        return refusal_file;
    }
}

exam::Reply read_reply(const path& file) {
    std::string text = base::read_file(file, exam::Limits::bytes);
    if (file.filename() == verdict_file) {
        return exam::parse_reply(text, file.string());
    }
    return exam::refusal(text.substr(0, text.find('\n')));
}

}  // namespace

void run_exam(const path& manifest, const path& data, const path& out, unsigned jobs) {
    if (out.empty()) {
        throw glsum::Failure(glsum::Exit::bad_input, "diagnose --exam: expected --out DIR for the answers");
    }
    const std::vector<exam::Asked> asked =
        exam::parse_manifest(base::read_file(manifest, exam::Limits::bytes), manifest.string());
    base::check_new_or_empty(out);
    std::error_code error;
    for (const exam::Asked& question : asked) {
        std::filesystem::create_directories(out / question.name, error);
    }
    std::vector<std::string> files(asked.size());
    std::vector<double> cpu_s(asked.size());
    {
        base::Progress progress("questions", asked.size());
        base::parallel_for(asked.size(), jobs, [&](std::size_t i) {
            const double began_s = cpu_seconds();
            files[i] = answer(asked[i], data.empty() ? manifest.parent_path() : data, out / asked[i].name);
            cpu_s[i] = cpu_seconds() - began_s;
            progress.advance();
        });
    }
    std::string hashes;
    for (std::size_t i = 0; i < asked.size(); ++i) {
        const std::string file = asked[i].name + "/" + files[i];
        const exam::Reply reply = read_reply(out / file);
        fmt::print("{}  {}{}  ({:.1f} CPU s)\n", asked[i].name, reply.verdict,
                   reply.reason.empty() ? "" : ": " + reply.reason, cpu_s[i]);
        hashes += base::sha256_line(base::sha256_of(out / file), file);
    }
    base::write_file(out / hashes_file, hashes);
    fmt::print("sha256 of the answers' hashes: {}\n", base::sha256_of(out / hashes_file));
}

void score_exam(const path& answers, const path& truth, const Output& json) {
    if (truth.empty()) {
        throw glsum::Failure(glsum::Exit::bad_input,
                             "score --exam: expected --truth FILE, what is known of the questions");
    }
    const path noted = answers / hashes_file;
    std::map<std::string, exam::Reply> replies;
    for (const auto& [hash, file] :
         base::parse_sha256_lines(base::read_file(noted, exam::Limits::bytes), noted.string())) {
        const path place(file);
        const path name = place.filename();
        if (std::distance(place.begin(), place.end()) != 2 || *place.begin() == ".." ||
            (name != verdict_file && name != refusal_file)) {
            throw glsum::Failure(glsum::Exit::bad_input, fmt::format("{}: expected NAME/{} or NAME/{}, found {}",
                                                                     noted.string(), verdict_file, refusal_file, file));
        }
        base::check_sha256(answers / place, hash, noted.string());
        if (!replies.emplace(place.begin()->string(), read_reply(answers / place)).second) {
            throw glsum::Failure(glsum::Exit::bad_input,
                                 fmt::format("{}: {} is answered twice", noted.string(), place.begin()->string()));
        }
    }
    std::vector<exam::Scored> scored;
    for (const exam::Truth& known : exam::parse_truth(base::read_file(truth, exam::Limits::bytes), truth.string())) {
        const auto reply = replies.find(known.name);
        if (reply == replies.end()) {
            throw glsum::Failure(glsum::Exit::bad_input,
                                 fmt::format("{}: expected an answer to {}, found none", noted.string(), known.name));
        }
        scored.push_back(exam::score(known, reply->second));
        replies.erase(reply);
    }
    if (!replies.empty()) {
        throw glsum::Failure(glsum::Exit::bad_input, fmt::format("{}: expected what is known of {}, found nothing",
                                                                 truth.string(), replies.begin()->first));
    }
    fmt::print("{}", exam::to_text(scored));
    if (json.wanted()) {
        json.write(exam::to_json(scored));
    }
}

}  // namespace cli
