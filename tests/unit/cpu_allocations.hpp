// Counts what the calling thread allocates.
#pragma once

// AddressSanitizer has an operator new of its own, and compares it with the one that memory goes back to.
#if !defined(__SANITIZE_ADDRESS__)
#define AO_COUNTS_ALLOCATIONS
#endif

namespace cpu_test {

// Calls of operator new so far.
int allocations();

} // namespace cpu_test
