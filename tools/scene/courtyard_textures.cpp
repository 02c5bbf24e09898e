#include "courtyard_textures.hpp"

#include "sequence.hpp"

#include <algorithm>
#include <cstdlib>
#include <utility>
#include <vector>

namespace ao::tools::courtyard_textures {
namespace {

constexpr int one = 1 << 12; // fixed point of heights and shares

// 0 ... one - 1.
int random(int x, int y, std::uint32_t seed)
{
    return static_cast<int>(combine(combine(seed, static_cast<std::uint32_t>(x)), static_cast<std::uint32_t>(y)) >> 20);
}

// 0 ... one to 0 ... one, flat at both ends.
int smooth(int t)
{
    return static_cast<int>(std::int64_t{ t } * t * (3 * one - 2 * t) / (std::int64_t{ one } * one));
}

int mix(int a, int b, int t)
{
    return a + (b - a) * t / one;
}

// Value noise 0 ... one over a picture of `size` texels with `cells` cells a side, both powers of two; tiles.
int noise(int x, int y, int size, int cells, std::uint32_t seed)
{
    const int cell = size / cells;
    const int column = x / cell, row = y / cell;
    const int right = (column + 1) % cells, below = (row + 1) % cells;
    const int u = smooth(x % cell * one / cell), v = smooth(y % cell * one / cell);
    return mix(mix(random(column, row, seed), random(right, row, seed), u),
               mix(random(column, below, seed), random(right, below, seed), u), v);
}

// Noise of ever finer cells, each with half the weight of the one before.
int rough(int x, int y, int size, int cells, int octaves, std::uint32_t seed)
{
    int sum = 0, weights = 0;
    for (int i = 0; i < octaves; ++i) {
        const int weight = 1 << (octaves - 1 - i);
        sum += weight * noise(x, y, size, cells << i, seed + static_cast<std::uint32_t>(i));
        weights += weight;
    }
    return sum / weights;
}

std::uint8_t byte(int x)
{
    return static_cast<std::uint8_t>(std::clamp(x, 0, 255));
}

std::int64_t square_root(std::int64_t x)
{
    std::int64_t root = 0;
    for (std::int64_t bit = std::int64_t{ 1 } << 30; bit > 0; bit /= 2)
        if ((root + bit) * (root + bit) <= x)
            root += bit;
    return root;
}

template <class Texel>
scene_texture make(const char* name, int size, bool srgb, const Texel& texel)
{
    scene_texture t;
    t.name = name;
    t.width = t.height = size;
    t.srgb = srgb;
    t.rgba.reserve(std::size_t{ 4 } * static_cast<std::size_t>(size) * static_cast<std::size_t>(size));
    for (int y = 0; y < size; ++y)
        for (int x = 0; x < size; ++x)
            texel(x, y, t.rgba);
    return t;
}

// Of a field of heights 0 ... one that tiles; `steep` is the slope of one full step between neighbours. Green up.
template <class Height>
scene_texture make_normals(const char* name, int size, int steep, const Height& height)
{
    std::vector<int> heights;
    for (int y = 0; y < size; ++y)
        for (int x = 0; x < size; ++x)
            heights.push_back(height(x, y));
    return make(name, size, false, [&](int x, int y, std::vector<std::uint8_t>& to) {
        const auto at = [&](int dx, int dy) {
            return heights[static_cast<std::size_t>((y + dy + size) % size * size + (x + dx + size) % size)];
        };
        const std::int64_t right = -std::int64_t{ steep } * (at(1, 0) - at(-1, 0)) / 2;
        const std::int64_t up = -std::int64_t{ steep } * (at(0, -1) - at(0, 1)) / 2;
        const std::int64_t length = square_root(right * right + up * up + std::int64_t{ one } * one);
        const auto code = [&](std::int64_t part) {
            return byte(static_cast<int>((255 * (part + length) + length) / (2 * length)));
        };
        to.insert(to.end(), { code(right), code(up), code(one), 255 });
    });
}

constexpr int paving_size = 512, slabs = 4;

// 0 in the joint, one on the slab, in between on its rounded edge.
int slab_edge(int x, int y)
{
    constexpr int slab = paving_size / slabs, joint = 2, round = 5;
    const auto to_edge = [](int c) { return std::min(c % slab, slab - 1 - c % slab); };
    return smooth(std::clamp((std::min(to_edge(x), to_edge(y)) - joint) * one / round, 0, one));
}

int paving_height(int x, int y)
{
    const int edge = slab_edge(x, y);
    const int chiselled = rough(x, y, paving_size, 32, 4, 11);
    return mix(rough(x, y, paving_size, 64, 3, 19) / 4, one / 2 + chiselled / 2, edge);
}

constexpr int asphalt_size = 256;

int grit(int x, int y)
{
    const int coarse = noise(x, y, asphalt_size, 64, 31), fine = noise(x, y, asphalt_size, 128, 37);
    return (2 * std::max(coarse, fine) + fine) / 3;
}

} // namespace

scene_texture leaf()
{
    constexpr int size = 128;
    return make("leaf", size, true, [](int x, int y, std::vector<std::uint8_t>& to) {
        // From the midrib outward and from the middle to tip or stem, 0 ... one.
        const int out = std::abs(2 * x + 1 - size) * one / size, far = std::abs(2 * y + 1 - size) * one / size;
        const int rhombus = one - far;
        // Teeth along the edge, each leaning toward the tip.
        const int tooth = (size - 1 - y) % 16 * one / 16;
        const int reach = rhombus * (one * 3 / 4 + tooth / 5) / one;
        const bool inside = out < std::min(reach, rhombus - one / 64);
        const bool rib = out < one / 24 || (tooth < one / 8 && out > one / 12);
        const int shade = rough(x, y, size, 8, 3, 3) * 40 / one + (rib ? 40 : 0);
        // The color goes on outside, for the smaller levels.
        to.insert(to.end(), { byte(52 + shade), byte(104 + shade), byte(36 + shade / 2), byte(inside ? 255 : 0) });
    });
}

scene_texture paving()
{
    return make("paving", paving_size, true, [](int x, int y, std::vector<std::uint8_t>& to) {
        constexpr int slab = paving_size / slabs;
        const int own = random(x / slab, y / slab, 5) * 36 / one;
        const int grain = rough(x, y, paving_size, 16, 5, 7) * 70 / one;
        const int bright = mix(70, 128 + own + grain, slab_edge(x, y));
        to.insert(to.end(), { byte(bright), byte(bright - 6), byte(bright - 16), 255 });
    });
}

scene_texture paving_normals()
{
    return make_normals("paving normals", paving_size, 3, paving_height);
}

scene_texture asphalt()
{
    return make("asphalt", asphalt_size, true, [](int x, int y, std::vector<std::uint8_t>& to) {
        const bool bright = random(x / 2, y / 2, 41) > one * 15 / 16;
        const int grey = 52 + grit(x, y) * 40 / one + (bright ? 50 : 0);
        to.insert(to.end(), { byte(grey), byte(grey), byte(grey + 3), 255 });
    });
}

scene_texture asphalt_normals()
{
    return make_normals("asphalt normals", asphalt_size, 2, grit);
}

scene_texture snow()
{
    constexpr int size = 128;
    return make("snow", size, true, [](int x, int y, std::vector<std::uint8_t>& to) {
        const int grey = 226 + rough(x, y, size, 8, 4, 53) * 24 / one;
        to.insert(to.end(), { byte(grey), byte(grey + 2), byte(grey + 5), 255 });
    });
}

scene_texture drifts()
{
    constexpr int size = 512;
    return make("drifts", size, false, [](int x, int y, std::vector<std::uint8_t>& to) {
        const int depth = rough(x, y, size, 16, 4, 61);
        const int share = smooth(std::clamp((depth - one * 3 / 8) * 4, 0, one));
        const std::uint8_t code = byte((share * 255 + one / 2) / one);
        to.insert(to.end(), { code, code, code, 255 });
    });
}

} // namespace ao::tools::courtyard_textures
