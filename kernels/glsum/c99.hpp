// A sum is written once: what stands between "// C99: NAME" and the next "// C99" is compiled here, in C++, and is what
// a generated header holds, in C99 (bench/texts/shared.hpp says which words change). In a header the compiler knows
// lengths and scales, and its flags are not ours. What must be kept from it is said by these words, which here do
// nothing.
#pragma once

/// A product that is not to be fused with the addition behind it.
#define GLSUM_KEEP(product)
/// A number of one word that is not to be known: neither where it comes from nor what it is.
#define GLSUM_KEEP_WORD(word)
/// Before a loop of a few turns: in a header each is written out, at whatever optimisation.
#define GLSUM_UNROLLED
/// Before a loop: in software double no turn is to be written twice.
#define GLSUM_ROLLED
