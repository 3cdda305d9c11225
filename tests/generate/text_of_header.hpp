// What a header's text says: words, numbers behind words, and the statements that its comment shows.
#pragma once

#include <cmath>
#include <sstream>
#include <string>

#include "base/scratch.hpp"
#include "bench/verify/target_program.hpp"

namespace test {

inline bool says(const std::string& text, const std::string& words) { return text.find(words) != std::string::npos; }

/// NaN where the words do not stand there.
inline double number_behind(const std::string& text, const std::string& words) {
    const std::size_t at = text.find(words);
    return at == std::string::npos ? std::nan("") : std::stod(text.substr(at + words.size()));
}

/// Compiles the statements that the first comment shows, as they stand there, behind the header.
/// \param arguments  declares what the statements use \throws glsum::Failure where the compiler refuses them
inline void compile_example(const std::string& text, const std::string& prefix, const std::string& arguments) {
    std::string statements;
    std::istringstream comment(text.substr(0, text.find("*/")));
    for (std::string line; std::getline(comment, line);) {
        if (line.starts_with(" *   ") && says(line, prefix + "_")) {
            statements += line.substr(5, line.rfind(';') - 4) + "\n";
        }
    }
    const base::Scratch folder;
    generate::write_file(folder.file("own.h"), text);
    generate::write_file(folder.file("example.c"), "#include \"own.h\"\nvoid example(" + arguments +
                                                       ");\nvoid example(" + arguments + ")\n{\n" + statements + "}\n");
    generate::compile("cc -std=c99 -fsyntax-only -Werror '" + folder.file("example.c").string() + "'", "cc");
}

}  // namespace test
