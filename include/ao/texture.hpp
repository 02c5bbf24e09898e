// All textures of a scene with their smaller levels as one array of words (ao/shared/texture.h has the layout), and sampling
// from it. The same words serve every backend, so all of them see the same texels and weights.
#pragma once

#include "ao/color.hpp"
#include "ao/math.hpp"
#include "ao/result.hpp"
#include "ao/scene_check.hpp"

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "ao/detail/shared_begin.inc"

namespace ao {

// Resources: uint word(uint index) of the heap.
template <class Real, class Resources>
struct texture_reader {
#include "ao/detail/scope.inc"
#include "ao/shared/functions.h"

    Resources resources;

    constexpr uint ao_load_texel(uint index)
    {
        return resources.word(index);
    }

#include "ao/shared/texture.h"
};

} // namespace ao

#include "ao/detail/shared_end.inc"

namespace ao {

struct texel_heap {
    std::vector<std::uint32_t> words;
    std::size_t textures = 0;

    std::size_t bytes() const { return words.size() * sizeof(std::uint32_t); }
};

namespace detail {

struct heap_words {
    constexpr std::uint32_t word(std::uint32_t) const { return 0; }
};
using heap_layout = texture_reader<float, heap_words>;

static_assert(heap_layout::ao_wrap_repeat == static_cast<int>(wrap_mode::repeat) &&
              heap_layout::ao_wrap_clamp == static_cast<int>(wrap_mode::clamp) &&
              heap_layout::ao_wrap_mirror == static_cast<int>(wrap_mode::mirror));

struct level_size {
    std::size_t width;
    std::size_t height;

    constexpr level_size next() const { return { width > 1 ? width / 2 : 1, height > 1 ? height / 2 : 1 }; }
    constexpr bool last() const { return width == 1 && height == 1; }
    constexpr std::size_t texels() const { return width * height; }
};

// Which texels of the level above texel i covers along one axis, and how much of each: two halves, or three parts where the
// larger size is odd.
struct box_taps {
    std::size_t first = 0;
    std::size_t count = 0;
    std::array<double, 3> weights{};

    constexpr box_taps(std::size_t i, std::size_t from, std::size_t to)
    {
        if (from == to) {
            first = i;
            count = 1;
            weights[0] = 1;
            return;
        }
        // In units of 1 / to of a larger texel: texel i is [i * from, (i + 1) * from), texel j there is [j * to, (j + 1) * to).
        const std::size_t begin = i * from;
        const std::size_t end = begin + from;
        first = begin / to;
        for (std::size_t j = first; j * to < end; ++j) {
            const std::size_t low = j * to < begin ? begin : j * to;
            const std::size_t high = (j + 1) * to < end ? (j + 1) * to : end;
            weights[count++] = static_cast<double>(high - low) / static_cast<double>(from);
        }
    }
};

// The mean of the texels covered, color in linear light for sRGB, each channel rounded to the nearest code. Alpha does not weigh.
inline void shrink(std::span<const std::uint32_t> above, level_size from, std::span<std::uint32_t> below, level_size to,
                   bool srgb)
{
    const auto light = [&](std::uint32_t code, unsigned channel) {
        return srgb && channel < 3 ? static_cast<double>(srgb_table[code]) : static_cast<double>(code) / 255;
    };
    for (std::size_t y = 0; y < to.height; ++y) {
        const box_taps down(y, from.height, to.height);
        for (std::size_t x = 0; x < to.width; ++x) {
            const box_taps across(x, from.width, to.width);
            std::array<double, 4> sum{};
            for (std::size_t j = 0; j < down.count; ++j) {
                for (std::size_t i = 0; i < across.count; ++i) {
                    const std::uint32_t word = above[(down.first + j) * from.width + across.first + i];
                    const double weight = down.weights[j] * across.weights[i];
                    for (unsigned channel = 0; channel < 4; ++channel) {
                        sum[channel] += weight * light(word >> (8 * channel) & 255U, channel);
                    }
                }
            }
            std::uint32_t word = 0;
            for (unsigned channel = 0; channel < 4; ++channel) {
                const std::uint32_t code =
                    srgb && channel < 3 ? srgb_code(sum[channel]) : static_cast<std::uint32_t>(sum[channel] * 255 + 0.5);
                word |= code << (8 * channel);
            }
            below[y * to.width + x] = word;
        }
    }
}

} // namespace detail

// Packs textures and makes their levels. Fails for textures that validate(scene) refuses, and where the heap would be larger
// than `most_bytes`: what a device takes as one storage buffer.
inline result<texel_heap> make_texel_heap(std::span<const texture> textures, std::size_t most_bytes = std::size_t{ 1 } << 30U)
{
    using layout = detail::heap_layout;
    const std::size_t table = layout::ao_heap_table;
    const std::size_t per_texture = layout::ao_descriptor_words;
    std::size_t total = table + per_texture * textures.size();
    for (std::size_t i = 0; i < textures.size(); ++i) {
        if (const auto wrong = detail::check_texture(textures[i], i)) {
            return *wrong;
        }
        detail::level_size size{ static_cast<std::size_t>(textures[i].width), static_cast<std::size_t>(textures[i].height) };
        total += size.texels();
        while (!size.last()) {
            size = size.next();
            total += size.texels();
        }
        if (total > std::numeric_limits<std::uint32_t>::max() || total * sizeof(std::uint32_t) > most_bytes) {
            return error(errc::out_of_memory,
                         detail::reason("textures 0 to ", i, " with their levels need ", total * 4 / 1048576 + 1,
                                        " MiB, the limit is ", most_bytes / 1048576, " MiB"));
        }
    }

    texel_heap heap;
    heap.textures = textures.size();
    heap.words.resize(total);
    for (std::size_t i = 0; i < table; ++i) {
        heap.words[i] = std::bit_cast<std::uint32_t>(srgb_table[i]);
    }
    std::size_t offset = table + per_texture * textures.size();
    for (std::size_t i = 0; i < textures.size(); ++i) {
        const texture& t = textures[i];
        const std::span<std::uint32_t> descriptor(heap.words.data() + table + i * per_texture, per_texture);
        detail::level_size size{ static_cast<std::size_t>(t.width), static_cast<std::size_t>(t.height) };
        descriptor[0] = static_cast<std::uint32_t>(t.width);
        descriptor[1] = static_cast<std::uint32_t>(t.height);
        descriptor[3] = static_cast<std::uint32_t>(t.wrap_u);
        descriptor[4] = static_cast<std::uint32_t>(t.wrap_v);
        descriptor[5] = t.srgb ? 1 : 0;

        const auto level = [&](std::size_t at, detail::level_size s) { return std::span(heap.words).subspan(at, s.texels()); };
        std::size_t texel = 0;
        for (std::uint32_t& word : level(offset, size)) {
            const auto byte = [&](std::size_t channel) { return static_cast<std::uint32_t>(t.texels[4 * texel + channel]); };
            word = byte(0) | byte(1) << 8U | byte(2) << 16U | byte(3) << 24U;
            ++texel;
        }
        std::uint32_t levels = 0;
        for (;;) {
            descriptor[layout::ao_descriptor_levels + levels] = static_cast<std::uint32_t>(offset);
            ++levels;
            const std::size_t next = offset + size.texels();
            if (size.last()) {
                offset = next;
                break;
            }
            detail::shrink(level(offset, size), size, level(next, size.next()), size.next(), t.srgb);
            offset = next;
            size = size.next();
        }
        descriptor[2] = levels;
    }
    return heap;
}

// One trilinear sample, as a shader takes it. `footprint`: squared length of the longer derivative of uv per pixel.
template <class Real>
glm::vec<4, Real> sample(const texel_heap& heap, int texture, glm::vec<2, Real> uv, Real footprint)
{
    struct resources {
        const std::uint32_t* words;
        std::uint32_t word(std::uint32_t index) const { return words[index]; }
    };
    texture_reader<Real, resources> reader{ { heap.words.data() } };
    return reader.ao_sample(static_cast<std::uint32_t>(texture), uv, footprint);
}

} // namespace ao
