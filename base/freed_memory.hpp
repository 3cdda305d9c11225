// Memory that is wanted again at once.
#pragma once

namespace base {

/// Has the C library keep what is freed, where it is glibc: a program that makes and drops the same large vectors for
/// each of a million simulations otherwise gives their pages back each time, and has them cleared anew.
void keep_freed_memory();

}  // namespace base
