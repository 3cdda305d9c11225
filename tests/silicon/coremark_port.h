/* Before each file of CoreMark: types that its barebones port takes for known, and what is timed kept whole. */
#pragma once
#include <stddef.h>

__attribute__((noinline, noclone)) void *iterate(void *);
