// A unit of its own: where only one of the operators is inlined, g++ takes the pair for a mismatch.
#include "unit/cpu_allocations.hpp"

#include <cstdlib>
#include <new>

#if defined(AO_COUNTS_ALLOCATIONS)

namespace {

thread_local int count = 0;

} // namespace

int cpu_test::allocations()
{
    return count;
}

void* operator new(std::size_t size)
{
    ++count;
    if (void* p = std::malloc(size == 0 ? 1 : size)) {
        return p;
    }
    throw std::bad_alloc();
}

void operator delete(void* p) noexcept
{
    std::free(p);
}

void operator delete(void* p, std::size_t) noexcept
{
    std::free(p);
}

#endif
