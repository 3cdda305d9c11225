#include "bench/report/report.hpp"

#include "bench/files.hpp"
#include "bench/plot.hpp"
#include "bench/results.hpp"

namespace bench::report {

std::vector<std::filesystem::path> write_report(const Input& input, const Input* other,
                                                const std::filesystem::path& html, unsigned jobs) {
    std::vector<std::filesystem::path> written;
    const auto beside = [&](const char* end) {
        std::filesystem::path path = html;
        path.replace_extension();
        path += end;
        written.push_back(path);
        return path;
    };
    written.push_back(html);
    write_file(html, make_page(input, other, jobs));
    write_csv(beside(".csv"), input.results.rows);
    const std::vector<Group> groups = group(input.results.rows);
    plot_error(groups, beside(""));
    written.back() += ".svg";
    return written;
}

}  // namespace bench::report
