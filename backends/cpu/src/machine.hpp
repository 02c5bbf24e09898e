// What executors of passes share: a width's kernels, the threads, and memory for pictures.
#pragma once

#include "kernels.hpp"
#include "threads.hpp"
#include "width.hpp"

#include "ao/cpu/backend.hpp"

#include <glm/vec2.hpp>

#include <cstddef>
#include <cstdint>
#include <memory>
#include <new>
#include <span>
#include <string>
#include <utility>

namespace ao::cpu::detail {

struct machine {
    width lanes;
    const kernel_table& kernels;
    std::unique_ptr<threads> workers;

    template <class Arguments>
    void run(void (*pass)(const Arguments&, const tile&), const Arguments& a)
    {
        workers->over_tiles(a.width, a.height, [&](const tile& t) { pass(a, t); });
    }
};

inline result<std::unique_ptr<machine>> make_machine(const options& o)
{
    const width lanes = o.lanes == width::automatic ? widest() : o.lanes;
    if (!is_available(lanes)) {
        return error(errc::device, std::string("this machine or build does not have ") + std::string(name_of(lanes)));
    }
    auto workers = make_threads(o);
    if (!workers) {
        return workers.error();
    }
    return std::unique_ptr<machine>(new machine{ lanes, kernels_of(lanes), std::move(*workers) });
}

using aligned_words = std::unique_ptr<std::uint32_t[], free_aligned>;

// Null where there is no memory.
inline void* allocate_bytes(std::size_t count)
{
    return ::operator new[](count, std::align_val_t{ 64 }, std::nothrow);
}

inline aligned_floats allocate(std::size_t count)
{
    return aligned_floats(static_cast<float*>(allocate_bytes(count * sizeof(float))));
}

inline aligned_words allocate_words(std::size_t count)
{
    return aligned_words(static_cast<std::uint32_t*>(allocate_bytes(count * sizeof(std::uint32_t))));
}

// Floats between rows: a multiple of a cache line, and no multiple of 1 KiB, at which a column's texels would share few sets
// of the first-level cache.
inline int padded_pitch(int pixels)
{
    const int lines = (pixels + 15) / 16;
    return 16 * (lines % 16 == 0 ? lines + 1 : lines);
}

inline plane plane_of(const image_view& v)
{
    return { static_cast<std::byte*>(v.data), v.row_bytes, bytes_per_pixel(v.format) / 4, v.format };
}

inline plane plane_of(const aligned_floats& floats, int pitch, std::size_t offset = 0)
{
    return { reinterpret_cast<std::byte*>(floats.get() + offset), static_cast<std::size_t>(pitch) * sizeof(float), 1,
             pixel_format::r32f };
}

// All x of the rotation tile, then all y: 2 * tile_size * tile_size floats.
void fill_rotation(float* to, std::span<const glm::vec2> rotation);

} // namespace ao::cpu::detail
