// The sectors of a slice, against the integral that defines them.
#include "ao/math.hpp"
#include "ao/slices.hpp"

#include <bit>

namespace {

using reals = ao::math<float>;

constexpr bool near(float a, float b, float within)
{
    return a - b <= within && b - a <= within;
}

static_assert(reals::ao_sectors_from(0) == 0xffffffffU);
static_assert(reals::ao_sectors_from(1) == 0xfffffffeU);
static_assert(reals::ao_sectors_from(31) == 0x80000000U);
static_assert(reals::ao_sectors_from(32) == 0U);

constexpr bool counts(unsigned set)
{
    return reals::ao_sectors_in(set) == static_cast<float>(std::popcount(set));
}
static_assert(counts(0U) && counts(0xffffffffU) && counts(0x12345678U) && counts(0x80000001U) && counts(0xfffe7fffU));

// Seen along the normal: V is the first border, the tangent plane the last.
constexpr auto upright = reals::ao_make_slice(0.0F, 1.0F);
static_assert(upright.weight == 1.0F);
static_assert(reals::ao_sector_border(upright, 1.0F) == 0);
static_assert(reals::ao_sector_border(upright, 0.0F) == 32);
// Half of a cosine-weighted slice lies within 45 degrees.
static_assert(reals::ao_sector_border(upright, 0.70710678F) == 16);

// A normal at right angles to V has everything on its side, nothing on the other; one that leans away counts as that.
constexpr auto level = reals::ao_make_slice(1.0F, 0.0F);
static_assert(near(level.weight, 3.1415927F, 2e-6F));
static_assert(reals::ao_sector_border(level, 1.0F) == 0 && reals::ao_sector_border(level, 0.0F) == 16);
static_assert(reals::ao_sector_border(level, -1.0F) == 32);
static_assert(near(reals::ao_make_slice(-1.0F, 0.0F).weight, 0.0F, 2e-6F));
static_assert(reals::ao_make_slice(1.0F, -0.5F).weight == level.weight);
// A slice at right angles to the normal knows nothing.
static_assert(reals::ao_make_slice(0.0F, 0.0F).weight == 0.0F);

constexpr bool inverse_root_is_near(float x, double root)
{
    const double e = static_cast<double>(reals::ao_inverse_root(x)) * root - 1;
    return e < 6.6e-4 && e > -6.6e-4;
}
static_assert(inverse_root_is_near(1.0F, 1) && inverse_root_is_near(4.0F, 2) && inverse_root_is_near(2.0F, 1.4142135623730951));
static_assert(inverse_root_is_near(1e-30F, 1e-15) && inverse_root_is_near(1e30F, 1e15) &&
              inverse_root_is_near(3.0F, 1.7320508075688772));
static_assert(reals::ao_inverse_root(0.0F) > 0.0F && reals::ao_inverse_root(0.0F) < 1e20F);

// Every texel of the tile once along the curve, and each step to a neighbour.
constexpr bool is_a_path(std::uint32_t side)
{
    unsigned x_at[64] = {};
    unsigned y_at[64] = {};
    bool seen[64] = {};
    for (unsigned y = 0; y < side; ++y) {
        for (unsigned x = 0; x < side; ++x) {
            const unsigned i = ao::hilbert_index(x, y, side);
            if (i >= side * side || seen[i]) {
                return false;
            }
            seen[i] = true;
            x_at[i] = x;
            y_at[i] = y;
        }
    }
    for (unsigned i = 1; i < side * side; ++i) {
        const unsigned across = x_at[i] > x_at[i - 1] ? x_at[i] - x_at[i - 1] : x_at[i - 1] - x_at[i];
        const unsigned down = y_at[i] > y_at[i - 1] ? y_at[i] - y_at[i - 1] : y_at[i - 1] - y_at[i];
        if (across + down != 1) {
            return false;
        }
    }
    return true;
}
static_assert(is_a_path(8));

// Steps outwards, slices turned by equal angles.
constexpr auto taps = ao::make_slice_taps(12, 2);
static_assert(taps[0].x == 1.0F && taps[0].y == 0.0F && taps[0].z == 0.0F && taps[0].w == 0.0F);
static_assert(near(taps[1].z, 1.0F / 6, 1e-7F) && near(taps[1].w, 0.618034F, 1e-6F));
static_assert(near(taps[6].x, -1.0F, 1e-7F) && near(taps[6].y, 0.0F, 1e-7F) && taps[6].z == 0.0F);
static_assert(taps[12] == glm::vec4(0.0F));

} // namespace
