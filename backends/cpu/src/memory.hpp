// Memory for one pixel or N side by side. Every function is a template over a Real type that carries its translation unit's
// Tag, or inlined without fail: nothing compiled here for a wide instruction set may be shared with other units.
#pragma once

#include "ao/half.hpp"
#include "ao/lanes.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <utility>

namespace ao::cpu::detail {

// Instructions that lanes of a Tag use on memory. Specialised beside lane_instructions.
template <int N, class Tag>
struct memory_instructions {
    using floats = typename ao::detail::native_vector<float, N>::type;
    using words = typename ao::detail::native_vector<std::int32_t, N>::type;

    // The words at data + 4 * index, index >= 0.
    static words gather(const std::byte* data, words index)
    {
        words loaded{};
        for (int i = 0; i < N; ++i) {
            std::int32_t word = 0;
            std::memcpy(&word, data + std::size_t{ 4 } * static_cast<std::uint32_t>(index[i]), 4);
            loaded[i] = word;
        }
        return loaded;
    }
    static bool equal(words a, words b) { return std::memcmp(&a, &b, sizeof(words)) == 0; }
    // From the low 16 bits of each word.
    static floats half(words codes)
    {
        floats decoded{};
        for (int i = 0; i < N; ++i) {
            decoded[i] = half_to_float(static_cast<std::uint16_t>(codes[i]));
        }
        return decoded;
    }
};

template <class Real>
struct memory;

template <>
struct memory<float> {
    static constexpr int width = 1;
    using integer = std::int32_t;

    static integer ascending(int first, int, int) { return first; }
    static int first(integer x) { return x; }
    static bool uniform(integer) { return true; }
    static bool consecutive(integer a, integer b, integer c, integer d) { return b == a + 1 && c == a + 2 && d == a + 3; }
    static integer load_words(const std::byte* data) { return gather(data, 0); }
    static integer load(const std::byte* data, integer index) { return gather(data, index); }
    static std::array<integer, 3> gather_triples(const std::byte* data, integer index)
    {
        return { gather(data, index), gather(data + 4, index), gather(data + 8, index) };
    }
    static std::array<integer, 2> load_pairs(const std::byte* data, integer index)
    {
        return { gather(data, index), gather(data + 4, index) };
    }
    static integer gather(const std::byte* data, integer index)
    {
        std::int32_t word = 0;
        std::memcpy(&word, data + std::size_t{ 4 } * static_cast<std::uint32_t>(index), 4);
        return word;
    }
    static float as_real(integer word) { return std::bit_cast<float>(word); }
    static float half(integer code) { return half_to_float(static_cast<std::uint16_t>(code)); }
    static integer shift_right(integer word, int bits) { return static_cast<integer>(static_cast<std::uint32_t>(word) >> bits); }
    static void store(std::byte* target, float value, int) { std::memcpy(target, &value, 4); }
    static void store_bytes(std::byte* target, integer value, int) { *target = static_cast<std::byte>(value); }
};

template <int N, class Tag>
struct memory<lanes<float, N, Tag>> {
    static constexpr int width = N;
    using real = lanes<float, N, Tag>;
    using integer = lanes<std::int32_t, N, Tag>;
    using words = typename integer::native;
    using instructions = memory_instructions<N, Tag>;

    // first, first + step, ... in the first `count` lanes, and the last of these in the others.
    static integer ascending(int first, int step, int count)
    {
        words lane{};
        for (int i = 0; i < N; ++i) {
            lane[i] = i;
        }
        const words last = words{} + (count - 1);
        return integer((lane < last ? lane : last) * step + first);
    }
    static int first(integer x) { return x[0]; }
    // Whether all lanes are the same.
    static bool uniform(integer x) { return instructions::equal(x.v, words{} + x[0]); }
    // Whether lanes of `a` are so many numbers one after the other, and each of b, c and d is the one after that before.
    static bool consecutive(integer a, integer b, integer c, integer d)
    {
        return consecutive(a) && instructions::equal(a.v, b.v - 1) && instructions::equal(a.v, c.v - 2) &&
               instructions::equal(a.v, d.v - 3);
    }
    static bool consecutive(integer a) { return instructions::equal(a.v, ascending(a[0], 1, N).v); }
    // N words from there on.
    static integer load_words(const std::byte* data)
    {
        words loaded;
        std::memcpy(&loaded, data, sizeof(words));
        return integer(loaded);
    }
    // As gather, and quick where the words lie side by side, each for one lane or for two.
    static integer load(const std::byte* data, integer index)
    {
        const std::byte* at = data + std::size_t{ 4 } * static_cast<std::uint32_t>(index[0]);
        if (consecutive(index)) {
            return load_words(at);
        }
        if (instructions::equal(index.v, twice(index[0], 1))) {
            words used{};
            std::memcpy(&used, at, sizeof(words) / 2);
            return every<1, 2, 0>(used, words{});
        }
        return gather(data, index);
    }
    // The words at data + 4 * index, index >= 0, and the one behind each, of texels of two words; quick where these lie side by
    // side, or each second one serves two lanes.
    static std::array<integer, 2> load_pairs(const std::byte* data, integer index)
    {
        if (instructions::equal(index.v, ascending(index[0], 2, N).v)) {
            const std::byte* at = data + std::size_t{ 4 } * static_cast<std::uint32_t>(index[0]);
            const words low = load_words(at).v;
            const words high = load_words(at + std::size_t{ 4 } * N).v;
            return { every<2, 1, 0>(low, high), every<2, 1, 1>(low, high) };
        }
        if (instructions::equal(index.v, twice(index[0], 4))) {
            const std::byte* at = data + std::size_t{ 4 } * static_cast<std::uint32_t>(index[0]);
            const words low = load_words(at).v;
            const words high = load_words(at + std::size_t{ 4 } * (N - 2)).v; // up to the last that is used
            return { every<4, 2, 0>(low, high), every<4, 2, 1>(low, high) };
        }
        return { gather(data, index), gather(data + 4, index) };
    }
    // The words at data + 4 * index, index >= 0.
    static integer gather(const std::byte* data, integer index) { return integer(instructions::gather(data, index.v)); }
    // The words at data + 4 * index, index >= 0, and the two behind each, of texels of four words; quick where these lie side by
    // side.
    static std::array<integer, 3> gather_triples(const std::byte* data, integer index)
    {
        if constexpr (requires { instructions::every_fourth(data, 0); }) {
            if (instructions::equal(index.v, ascending(index[0], 4, N).v)) {
                const std::byte* at = data + std::size_t{ 4 } * static_cast<std::uint32_t>(index[0]);
                return { integer(instructions::every_fourth(at, 0)), integer(instructions::every_fourth(at, 1)),
                         integer(instructions::every_fourth(at, 2)) };
            }
            const auto found = instructions::gather_triples(data, index.v);
            return { integer(found[0]), integer(found[1]), integer(found[2]) };
        }
        return { gather(data, index), gather(data + 4, index), gather(data + 8, index) };
    }
    static real as_real(integer word) { return real(reinterpret_cast<typename real::native>(word.v)); }
    // From the low 16 bits of each word.
    static real half(integer codes) { return real(instructions::half(codes.v)); }
    static integer shift_right(integer word, int bits)
    {
        using unsigned_words = typename lanes<std::uint32_t, N, Tag>::native;
        return integer(reinterpret_cast<words>(reinterpret_cast<unsigned_words>(word.v) >> static_cast<std::uint32_t>(bits)));
    }
    // The first `count` lanes.
    static void store(std::byte* target, real value, int count)
    {
        if (count == N) {
            std::memcpy(target, &value.v, sizeof(value.v));
            return;
        }
        for (int i = 0; i < count; ++i) {
            const float lane = value[i];
            std::memcpy(target + 4 * i, &lane, 4);
        }
    }
    static void store_bytes(std::byte* target, integer value, int count)
    {
        for (int i = 0; i < count; ++i) {
            target[i] = static_cast<std::byte>(value[i]);
        }
    }

private:
    // first, first, first + step, first + step, ...
    static words twice(int first, int step)
    {
        words lane{};
        for (int i = 0; i < N; ++i) {
            lane[i] = i / 2;
        }
        return lane * step + first;
    }
    // In lane i the word Step * (i / Lanes) + First: of N words in `low`, or of 2 N + 2 - Step, the first N of them in `low` and
    // the last N in `high`.
    template <int Step, int Lanes, int First>
    static integer every(words low, words high)
    {
        return every<Step, Lanes, First>(low, high, std::make_integer_sequence<int, N>{});
    }
    template <int Step, int Lanes, int First, int... Lane>
    static integer every(words low, words high, std::integer_sequence<int, Lane...>)
    {
        constexpr auto place = [](int word) { return word < N ? word : word + Step - 2; };
        return integer(__builtin_shufflevector(low, high, place(Step * (Lane / Lanes) + First)...));
    }
};

} // namespace ao::cpu::detail
