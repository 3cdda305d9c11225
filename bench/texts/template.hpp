// Texts of headers: the files NAME.h.in, one beside each family, technique and format in kernels/glsum and one here.
// They hold C99 with places, and lines that begin with a percent sign and say what stands there.
//
//   %section NAME             what follows, up to the next one; what stands before the first holds for all of them
//   %text NAME [| A => B]...  a statement of the kernels (shared.hpp), as deep as the sign stands, with B for A
//   %optional NAME            the same, if any kernel has it
//   %file NAME                a file of window/cortex-m whole
//   %words A => B             B for A in the statements of this section; quotes keep spaces
//   %if TERM [and|or ...]     to %else or %end; TERM: [not] FACT [< > >= == % NUMBER]
//   %let FACT CONDITION       makes it one
//   %each LIST                to %end, for each item; LIST.FACT is then its own
//   %kept NAME [| A => B]     the section of the text behind this one in its chain
//   %CHAIN NAME [| A => B]    a section of another chain, of the first text there that has it
//   %#                        nothing
//
// @NAME@ is a place's text or a fact's number; @CHAIN NAME@ a section without its last line's end.
#pragma once

#include <map>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "bench/texts/shared.hpp"
#include "bench/texts/text.hpp"

namespace generate {

/// Numbers that decide what stands in a header; a truth is 1. One that is not there is 0.
using Facts = std::map<std::string, long, std::less<>>;

/// What a header of one kernel is made of.
struct HeaderText {
    Facts facts;
    Places places;
    /// By the name of a chain those of its texts, each for what the ones before do not have.
    std::map<std::string, std::vector<std::string>, std::less<>> chains;

    /// \throws std::out_of_range for a section that none of the chain has, and whatever else a text names in vain.
    [[nodiscard]] std::string section(const std::string& chain, std::string_view name) {
        return section(chain, name, 0);
    }

    /// The sections "helper NAME" of these chains whose function `used` calls, or one of them, in their order.
    [[nodiscard]] std::string helpers(const std::vector<std::string>& of_chains, std::string used);

    /// `text` with what its places stand for.
    [[nodiscard]] std::string filled(std::string_view text);

private:
    struct Scope;
    std::string section(const std::string& chain, std::string_view name, std::size_t from);
    std::size_t run(std::span<const std::string_view> lines, std::size_t at, bool active, Scope& scope,
                    std::string& out);
    void include(std::string_view word, std::string_view rest, std::size_t indent, Scope& scope, std::string& out);
    [[nodiscard]] bool holds(std::string_view condition, const Scope& scope) const;
    [[nodiscard]] std::string filled(std::string_view line, const Scope& scope);
};

/// Whether there is a text NAME.h.in with this section.
[[nodiscard]] bool has_section(std::string_view text, std::string_view section);

/// These files one behind the other, each behind "%file-of NAME"; the build makes it of them.
extern const std::string_view header_texts;

}  // namespace generate
