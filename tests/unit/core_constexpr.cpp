// What the compiler computes and what the program computes are the same bits: functions, tables, plans and a pass.
#include "ao/kernel.hpp"
#include "ao/plan.hpp"

#include <catch2/catch.hpp>

#include <array>
#include <bit>
#include <cstdint>
#include <random>

namespace {

using m = ao::math<float>;

constexpr int cases = 64;

// Inputs the optimiser may not see through.
template <class T>
T hidden(T value)
{
    volatile T copy = value;
    return copy;
}

struct inputs {
    std::array<float, cases> a{};
    std::array<float, cases> b{};
    std::array<float, cases> c{};
    std::array<std::uint32_t, cases> index{};
};

constexpr inputs make_inputs()
{
    inputs in;
    ao::random_stream random(42);
    for (std::size_t i = 0; i < cases; ++i) {
        in.a[i] = 8.0F * random.uniform() - 4.0F;
        in.b[i] = 8.0F * random.uniform() - 4.0F;
        in.c[i] = 8.0F * random.uniform() - 4.0F;
        in.index[i] = random.next();
    }
    return in;
}

using table = std::array<std::uint32_t, cases * 12>;

// Every shared function that takes plain numbers, as bits. `hide` keeps run-time evaluation from being folded.
template <class Hide>
constexpr table evaluate(const inputs& in, Hide hide)
{
    table bits{};
    std::size_t at = 0;
    const auto put = [&](float x) { bits[at++] = std::bit_cast<std::uint32_t>(x); };
    const auto put3 = [&](m::vec3 v) {
        put(v.x);
        put(v.y);
        put(v.z);
    };
    for (std::size_t i = 0; i < cases; ++i) {
        const float a = hide(in.a[i]);
        const float b = hide(in.b[i]);
        const float c = hide(in.c[i]);
        const m::vec3 n = m::ao_normalize_or(m::vec3(a, b, c), m::vec3(0, 0, 1));
        put3(n);
        const m::ao_frame f = m::ao_gram_schmidt(n, m::vec3(b, c, 0));
        put3(f.tangent);
        put3(f.bitangent);
        put(m::ao_radical_inverse(m::ao_halton_base(static_cast<int>(i % 6)), hide(in.index[i])));
        put(m::sqrt(m::abs(a)));
        put(m::floor(b) + m::ao_any_tangent(n).x);
    }
    return bits;
}

constexpr inputs fixed = make_inputs();

// A picture computed while compiling.
constexpr int taps = 4;
constexpr auto kernel = ao::make_kernel(ao::method::halton, taps, 1);
struct little_scene {
    constexpr float depth(glm::ivec2 p) const { return p.x < 3 ? 2.0F : 2.5F + 0.125F * static_cast<float>(p.y); }
    constexpr m::vec4 normal(glm::ivec2 p) const { return { 0.25F * static_cast<float>(p.x - 3), 0.1F, 1.0F, 0.0F }; }
    constexpr m::vec2 rotation(glm::ivec2 p) const
    {
        return { 0.3F + 0.1F * static_cast<float>(p.x), -0.7F + 0.2F * static_cast<float>(p.y) };
    }
    constexpr m::vec4 tap(int i) const { return kernel[static_cast<std::size_t>(i)]; }
};

constexpr int side = 6;

template <class Hide>
constexpr std::array<float, side * side> render(Hide hide)
{
    ao::facts f;
    f.width = side;
    f.height = side;
    ao::settings s;
    s.method = ao::method::halton;
    s.taps = taps;
    s.filter = 1;
    const ao::plan p = *ao::make_plan(s, f, { ao::make_projection({ -0.5, 0.5, -0.5, 0.5, 0.1, 100 }), {}, 1e10F });
    using body_type = ao::occlusion_pass<float, little_scene>;
    body_type body{ {} };
    body.ao_tap_count = hide(taps);
    const auto constants = ao::convert_constants<body_type::ao_occlusion_constants, float, ao::occlusion_constants, float>(
        ao::constants_of<ao::occlusion_constants>(p.passes[0]));
    std::array<float, side * side> picture{};
    for (int y = 0; y < side; ++y) {
        for (int x = 0; x < side; ++x) {
            picture[static_cast<std::size_t>(y * side + x)] = body.ao_occlusion_pass(constants, { hide(x), hide(y) });
        }
    }
    return picture;
}

constexpr auto as_it_is = [](auto x) { return x; };
constexpr auto hide = [](auto x) { return hidden(x); };

} // namespace

TEST_CASE("Shared functions: constexpr equals run time", "[core][constexpr]")
{
    static constexpr table compiled = evaluate(fixed, as_it_is);
    CHECK(compiled == evaluate(fixed, hide));
}

TEST_CASE("Square roots: constexpr equals run time, correctly rounded", "[core][constexpr]")
{
    // Called at run time, the constexpr route against the hardware's.
    std::mt19937 engine(1);
    int wrong = 0;
    for (int i = 0; i < 1000000; ++i) {
        const auto x = std::bit_cast<float>(static_cast<std::uint32_t>(engine()) & 0x7fffffffU);
        if (x <= std::numeric_limits<float>::max()) {
            wrong += static_cast<float>(ao::detail::constexpr_sqrt(static_cast<double>(x))) != std::sqrt(x);
        }
        const auto y = static_cast<double>(x) * 1.0000001234 + 1e-300;
        wrong += y <= std::numeric_limits<double>::max() && ao::detail::constexpr_sqrt(y) != std::sqrt(y);
    }
    CHECK(wrong == 0);
}

TEST_CASE("Kernels: constexpr equals run time", "[core][constexpr]")
{
    static constexpr auto box = ao::make_kernel(ao::method::box, 8, 3);
    static constexpr auto ball = ao::make_kernel(ao::method::hemisphere, 8, 3);
    static constexpr auto halton = ao::make_kernel(ao::method::halton, 8, 3);
    CHECK(box == ao::make_kernel(ao::method::box, hidden(8), hidden(3U)));
    CHECK(ball == ao::make_kernel(ao::method::hemisphere, hidden(8), hidden(3U)));
    CHECK(halton == ao::make_kernel(ao::method::halton, hidden(8), hidden(3U)));
}

TEST_CASE("Projections: constexpr equals run time", "[core][constexpr]")
{
    constexpr ao::frustum f{ -0.3, 0.7, -0.2, 0.9, 0.05, 300 };
    static constexpr auto folded = ao::fold_projection(ao::make_projection(f), 641, 359)->projection;
    ao::frustum g = f;
    g.left = hidden(g.left);
    g.near = hidden(g.near);
    const auto again = ao::fold_projection(ao::make_projection(g), hidden(641), hidden(359))->projection;
    using bits = std::array<std::uint32_t, 8>;
    CHECK(std::bit_cast<bits>(folded) == std::bit_cast<bits>(again));
}

TEST_CASE("A pass: constexpr equals run time", "[core][constexpr]")
{
    static constexpr auto compiled = render(as_it_is);
    CHECK(compiled == render(hide));
    // There is something in the picture.
    CHECK(*std::min_element(compiled.begin(), compiled.end()) < 1.0F);
    CHECK(*std::max_element(compiled.begin(), compiled.end()) == 1.0F);
}
