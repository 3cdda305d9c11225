// The error bound that every kernel promises: the number that its test enforces.
#pragma once

#include "glsum/error_bound.hpp"

#define GLSUM_FAMILIES_BOUNDS
#include "glsum/families.def"
#undef GLSUM_FAMILIES_BOUNDS
