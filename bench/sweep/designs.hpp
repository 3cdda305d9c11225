// What a kernel is prepared for at a length: with a window its taps alone; with modes also which.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "bench/sweep/sweep.hpp"
#include "glsum/kernel.hpp"

namespace glsum {
struct CatalogueEntry;
}

namespace bench {

/// What the catalogue (glsum/catalogue.hpp) says of a kernel. \throws std::out_of_range for a name that is not in it.
[[nodiscard]] const glsum::CatalogueEntry& facts_of(const std::string& kernel);

/// Whether a kernel keeps near taps and modes in place of a window. \throws as facts_of.
[[nodiscard]] bool has_modes(const std::string& kernel);

/// Whether the slowest of a kernel's modes does not decay: an integrator, for integrals alone. Of any other name no.
[[nodiscard]] bool has_integrator(const std::string& kernel);

/// Whether a kernel keeps near taps and blocks in place of a window. \throws as facts_of.
[[nodiscard]] bool has_blocks(const std::string& kernel);

/// The order whose weights a kernel sums over what it keeps: v, or v - 1 over increments. Of any other name v.
[[nodiscard]] double order_of_weights(const std::string& kernel, double order);

/// Whether a kernel takes an order. \throws as facts_of.
[[nodiscard]] bool serves(const std::string& kernel, double order);

/// Whether a kernel takes what leaves its window as 0: then its error follows from the length as truncation's does.
/// \throws as facts_of.
[[nodiscard]] bool truncates(const std::string& kernel);

/// The length of a design of `taps` coefficients: `modes_within` of them are modes. The order is that of the weights;
/// of a name that is no kernel's as for `modes`.
[[nodiscard]] Length length_with_modes(const std::string& kernel, double order, std::size_t taps);

/// The same with blocks: those of `design_blocks` for a record of so many samples.
[[nodiscard]] Length length_with_blocks(double order, std::size_t taps, std::size_t samples);

/// A length as a kernel counts it: with modes those of `length_with_modes`, with blocks of `length_with_blocks`.
[[nodiscard]] Length length_of(const std::string& kernel, double order, std::size_t taps, std::size_t samples);

/// What `parse_length` read as taps and modes, as the kernel counts it: of one with blocks each is one coefficient, and
/// how many a level has is not written. Of any other name as it is.
[[nodiscard]] Length as_counted(const std::string& kernel, const Length& read);

/// The design of a kernel at a length: its blocks, or its modes, if any, for a record of `samples`, and the weights of
/// a discretisation that names them, over increments their sums. They stay where they are to the end of the program,
/// and each is made once. Thread-safe. Modes are made for the weights that are named. \pre the kernel serves the
/// discretisation. Blocks are laid out for the order's own weights, from which the others differ little but at the
/// first.
[[nodiscard]] glsum::Design design_of(const std::string& kernel, double order, const Length& length,
                                      std::size_t samples, Discretisation weights = Discretisation::gl);

/// What a design of `design_of` errs by against full memory over so many samples from rest, for |x| <= 1: with modes or
/// blocks as they were designed, in double; of a window, which errs by truncation, 0.
[[nodiscard]] double design_error(const std::string& kernel, double order, const glsum::Design& design,
                                  std::size_t samples);

/// The length with what else tells designs of one order and length apart: blocks, or an integrator.
[[nodiscard]] std::string named(const Length& length, const glsum::Design& design);

/// The lengths at which a sweep measures a kernel. With a window: those without modes. With
/// blocks: one for each of these but `full`, of as many coefficients. With modes: those with modes, or
/// where the sweep names none, for each of its `design_errors` the shortest design that keeps it over the record.
/// Over increments that is the error for |x_k - x_(k-1)| <= 1. Orders that the kernel does not take, and with modes
/// those whose weights have no tail of exponentials (whole orders, and weights of order <= -1), have none; nor has a
/// kernel that cannot sum the sweep's weights. Rising.
[[nodiscard]] std::vector<Length> lengths_of(const Sweep& sweep, const std::string& kernel, double order);

}  // namespace bench
