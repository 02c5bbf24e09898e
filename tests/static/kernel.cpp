// Kernels as constant expressions: inside their solids, and the first Halton points as the formula gives them.
#include "ao/kernel.hpp"
#include "static/support.hpp"

namespace {

using namespace static_test;

constexpr int few = 8;

template <class Inside>
constexpr bool all_inside(ao::method method, std::uint32_t seed, Inside inside)
{
    const auto offsets = ao::make_kernel(method, few, seed);
    for (int i = 0; i < few; ++i) {
        const glm::vec4& s = offsets[static_cast<std::size_t>(i)];
        if (!inside(s.x, s.y, s.z) || s.w != 0.0F) {
            return false;
        }
    }
    const glm::vec4& unused = offsets[few];
    return unused.x == 0.0F && unused.y == 0.0F && unused.z == 0.0F && unused.w == 0.0F;
}

constexpr auto in_half_box = [](float x, float y, float z) {
    return x >= -1.0F && x < 1.0F && y >= -1.0F && y < 1.0F && z >= 0.0F && z < 1.0F;
};
constexpr auto in_half_ball = [](float x, float y, float z) { return z >= 0.0F && x * x + y * y + z * z <= 1.000001F; };

static_assert(all_inside(ao::method::box, 1, in_half_box));
static_assert(all_inside(ao::method::box, 77, in_half_box));
static_assert(all_inside(ao::method::hemisphere, 1, in_half_ball));
static_assert(all_inside(ao::method::hemisphere, 77, in_half_ball));
static_assert(all_inside(ao::method::halton, 1, in_half_ball));

// u = 1/2, v = 1/3, w = 1/5: (1/3) (cos pi sqrt(4/5), sin pi sqrt(4/5), sqrt(1/5)).
constexpr glm::vec4 first = ao::make_kernel(ao::method::halton, 1, 1)[0];
static_assert(near(first.x, -0.29814239699997197F, 1e-7F) && near(first.y, 0.0F, 1e-7F) &&
              near(first.z, 0.14907119849998598F, 1e-7F));
// u = 1/4, v = 2/3, w = 2/5: (2/3) (0, sqrt(3/5), sqrt(2/5)).
constexpr glm::vec4 second = ao::make_kernel(ao::method::halton, 2, 1)[1];
static_assert(near(second.x, 0.0F, 1e-7F) && near(second.y, 0.51639777949432220F, 1e-7F) &&
              near(second.z, 0.42163702135578396F, 1e-7F));

constexpr bool same(const glm::vec4& a, const glm::vec4& b)
{
    return a.x == b.x && a.y == b.y && a.z == b.z;
}
// The seed matters to the random kernels and to them only; more taps continue the Halton sequence.
static_assert(!same(ao::make_kernel(ao::method::box, 1, 1)[0], ao::make_kernel(ao::method::box, 1, 2)[0]));
static_assert(!same(ao::make_kernel(ao::method::hemisphere, 1, 1)[0], ao::make_kernel(ao::method::hemisphere, 1, 2)[0]));
static_assert(same(ao::make_kernel(ao::method::halton, 1, 1)[0], ao::make_kernel(ao::method::halton, 1, 2)[0]));
static_assert(same(ao::make_kernel(ao::method::halton, 4, 1)[3], ao::make_kernel(ao::method::halton, 5, 1)[3]));

// The edges of the unit cube.
static_assert(ao::cosine_linear_offset(0, 0, 0).z == 0.0F);
static_assert(near(ao::cosine_linear_offset(0.3, 1, 1).z, 1.0F, 1e-7F));
static_assert(ao::cosine_linear_offset(0.9, 0.999, 0).z == 0.0F);

static_assert(ao::half_ball_offset(0.4, 0.5, 0).z == 0.0F && near(ao::half_ball_offset(0.4, 0.125, 1).z, 0.5F, 1e-7F));
static_assert(near(ao::detail::cube_root(0.001), 0.1, 1e-15) && ao::detail::cube_root(1.0) == 1.0 &&
              ao::detail::cube_root(0.0) == 0.0);

static_assert(near(static_cast<float>(ao::detail::sine(1.0)), 0.8414709848F, 1e-7F) &&
              near(static_cast<float>(ao::detail::cosine(1.0)), 0.5403023059F, 1e-7F));

constexpr bool stream_in_range()
{
    ao::random_stream random(0);
    for (int i = 0; i < 64; ++i) {
        const float x = random.uniform();
        if (!(x >= 0.0F && x < 1.0F)) {
            return false;
        }
    }
    return true;
}
static_assert(stream_in_range());
// The largest 32-bit integer stays below 1.
static_assert(static_cast<float>(0xffffffffU >> 8U) * 5.9604644775390625e-8F < 1.0F);

static_assert((ao::tile_size & (ao::tile_size - 1)) == 0);
using tile = ao::math<float>;
static_assert(tile::ao_tile_texel({ 0, 0 }).x == 0 && tile::ao_tile_texel({ ao::tile_size, ao::tile_size + 3 }).x == 0 &&
              tile::ao_tile_texel({ ao::tile_size, ao::tile_size + 3 }).y == 3);

} // namespace
