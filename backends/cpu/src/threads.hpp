// The threads of an executor, and what is dealt out to them. Nothing that is dealt out may depend on who does it.
#pragma once

#include "kernels.hpp"

#include "ao/cpu/backend.hpp"
#include "ao/result.hpp"

#include <oneapi/tbb/blocked_range.h>
#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/task_arena.h>

#include <algorithm>
#include <cstddef>
#include <memory>

namespace ao::cpu::detail {

struct threads {
    oneapi::tbb::task_arena arena;
    int tile_width;
    int tile_height;

    threads(int count, int width, int height) : arena(count), tile_width(width), tile_height(height) {}

    int count() const { return arena.max_concurrency(); }
    // Of the calling thread, within what is dealt out: below count().
    std::size_t own_index() const
    {
        return count() == 1 ? 0 : static_cast<std::size_t>(oneapi::tbb::this_task_arena::current_thread_index());
    }

    // Calls body(first, last) with ranges that together are 0 ... items - 1, last not included.
    template <class Body>
    void over(int items, const Body& body)
    {
        if (count() == 1) {
            body(0, items);
            return;
        }
        using range = oneapi::tbb::blocked_range<int>;
        arena.execute([&] { oneapi::tbb::parallel_for(range(0, items), [&](const range& r) { body(r.begin(), r.end()); }); });
    }

    // Calls body(tile) with tiles that together are the picture.
    template <class Body>
    void over_tiles(int width, int height, const Body& body)
    {
        const int columns = (width + tile_width - 1) / tile_width;
        const int rows = (height + tile_height - 1) / tile_height;
        over(columns * rows, [&](int first, int last) {
            for (int i = first; i < last; ++i) {
                const int left = i % columns * tile_width;
                const int top = i / columns * tile_height;
                body(tile{ left, top, std::min(left + tile_width, width), std::min(top + tile_height, height) });
            }
        });
    }
};

// errc::invalid_settings for negative numbers, errc::out_of_memory. options::lanes is not looked at.
result<std::unique_ptr<threads>> make_threads(const options& o);

} // namespace ao::cpu::detail
