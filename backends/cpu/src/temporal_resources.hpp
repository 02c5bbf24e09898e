// Answers to the callbacks of the temporal pass bodies.
#pragma once

#include "resources.hpp"

#include "ao/temporal_passes.hpp"

#include <array>
#include <cstdint>

namespace ao::cpu::detail {

// A history in memory: not words pixel after pixel, but all first words, then all second ones, and so on, so that the words of
// neighbours lie side by side.
template <class Real>
struct history_reader {
    using memory = detail::memory<Real>;
    using integer = typename memory::integer;

    const std::byte* data = nullptr;
    std::size_t plane_bytes = 0;
    int words = 0; // of a pixel

    // What the caller does not read is not loaded.
    template <class Uint>
    glm::vec<4, Uint> at(Uint pixel) const
    {
        const auto word = [&](int which) {
            return Uint(memory::load(data + static_cast<std::size_t>(which < words ? which : 0) * plane_bytes, integer(pixel)));
        };
        return { word(0), word(1), word(2), word(3) };
    }
    // Of four pixels. Quick where those of each lane lie side by side, and lanes do.
    template <class Uint>
    std::array<glm::vec<4, Uint>, 4> row(Uint first, Uint second, Uint third, Uint fourth) const
    {
        const auto plane = [&](int which) { return data + static_cast<std::size_t>(which < words ? which : 0) * plane_bytes; };
        if (memory::consecutive(integer(first), integer(second), integer(third), integer(fourth))) {
            const auto start = std::size_t{ 4 } * static_cast<std::uint32_t>(memory::first(integer(first)));
            const auto pixel = [&](std::size_t i) {
                const auto word = [&](int which) { return Uint(memory::load_words(plane(which) + start + 4 * i)); };
                return glm::vec<4, Uint>{ word(0), word(1), word(2), word(3) };
            };
            return { pixel(0), pixel(1), pixel(2), pixel(3) };
        }
        const auto pixel = [&](Uint at) {
            const auto word = [&](int which) { return Uint(memory::gather(plane(which), integer(at))); };
            return glm::vec<4, Uint>{ word(0), word(1), word(2), word(3) };
        };
        return { pixel(first), pixel(second), pixel(third), pixel(fourth) };
    }
};

template <class Real>
struct temporal_resources {
    using memory = detail::memory<Real>;
    using integer = typename math<Real>::integer;
    using uint = typename math<Real>::uint;
    using uvec4 = typename math<Real>::uvec4;
    using ivec2 = typename math<Real>::ivec2;
    using vec2 = typename math<Real>::vec2;
    using vec4 = typename math<Real>::vec4;
    reader<Real> eye_depth;
    reader<Real> normals;
    reader<Real> motions;
    reader<Real> rotation_x;
    reader<Real> rotation_y;
    history_reader<Real> last;
    const std::byte* taps = nullptr; // all x, then all y, z and w
    std::size_t tap_bytes = 0;       // of each
    bool slices = false;             // w is more than 0

    Real depth(ivec2 pixel) const { return eye_depth.gathered(pixel); }
    Real own_depth(ivec2 pixel) const { return eye_depth.loaded(pixel); }
    vec4 normal(ivec2 pixel) const { return normals.normal(pixel); }
    vec4 motion(ivec2 pixel) const
    {
        if (motions.format == pixel_format::rg32f) {
            return vec4(motions.component(pixel, 0), motions.component(pixel, 1), Real(0), Real(0));
        }
        return motions.normal(pixel); // the other formats are those of normals
    }
    uvec4 history(uint pixel) const { return last.at(pixel); }
    std::array<uvec4, 4> history_row(uint first, uint second, uint third, uint fourth) const
    {
        return last.row(first, second, third, fourth);
    }
    vec2 rotation(ivec2 texel) const { return vec2(rotation_x.loaded(texel), rotation_y.loaded(texel)); }
    vec4 tap(uint i) const
    {
        // Pixels with the same past, most of them, are at the same sample.
        const integer index = integer(i);
        if (memory::uniform(index)) {
            const std::byte* at = taps + std::size_t{ 4 } * static_cast<std::uint32_t>(memory::first(index));
            const auto each = [&](std::size_t component) {
                float x = 0;
                std::memcpy(&x, at + component * tap_bytes, 4);
                return Real(x);
            };
            return vec4(each(0), each(1), each(2), slices ? each(3) : Real(0));
        }
        const auto each = [&](std::size_t component) {
            return memory::as_real(memory::gather(taps + component * tap_bytes, index));
        };
        return vec4(each(0), each(1), each(2), slices ? each(3) : Real(0));
    }
};

template <class Real>
struct temporal_filter_resources {
    using uint = typename math<Real>::uint;
    using uvec4 = typename math<Real>::uvec4;
    using ivec2 = typename math<Real>::ivec2;
    reader<Real> eye_depth;
    reader<Real> rows;
    history_reader<Real> now;

    Real depth(ivec2 pixel) const { return eye_depth.loaded(pixel); }
    uvec4 history(uint pixel) const { return now.at(pixel); }
    Real row(ivec2 pixel) const { return rows.loaded(pixel); }
};

} // namespace ao::cpu::detail
