// The bounds of whole passes: wide enough for any conforming implementation, and only fragile taps widen them.
#include "ao/conformance/suite.hpp"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cstdio>

using namespace ao;
using namespace ao::conformance;

namespace {

// A float whose quotients and roots are off by as much as hardware's may be, at random.
struct careless {
    float x;

    careless() = default;
    template <class S>
        requires std::is_arithmetic_v<S>
    constexpr careless(S value) : x(static_cast<float>(value)) {}
    explicit operator std::int32_t() const { return static_cast<std::int32_t>(x); }
    explicit operator std::uint32_t() const { return static_cast<std::uint32_t>(x); }

    // One of the floats that the bounds allow.
    static careless one_of(interval allowed)
    {
        static random_stream random(11);
        if (allowed.is_unknown()) {
            return (allowed.lo + allowed.hi);
        }
        const float t = random.uniform();
        return std::clamp(allowed.lo + (allowed.hi - allowed.lo) * t, allowed.lo, allowed.hi);
    }
    friend careless operator+(careless a, careless b) { return a.x + b.x; }
    friend careless operator-(careless a, careless b) { return a.x - b.x; }
    friend careless operator*(careless a, careless b) { return a.x * b.x; }
    friend careless operator/(careless a, careless b) { return one_of(interval(a.x) / interval(b.x)); }
    friend careless operator-(careless a) { return -a.x; }
    careless& operator+=(careless b) { return *this = *this + b; }
    careless& operator-=(careless b) { return *this = *this - b; }
    careless& operator*=(careless b) { return *this = *this * b; }
    careless& operator/=(careless b) { return *this = *this / b; }
    friend bool operator<(careless a, careless b) { return a.x < b.x; }
    friend bool operator<=(careless a, careless b) { return a.x <= b.x; }
    friend bool operator>(careless a, careless b) { return a.x > b.x; }
    friend bool operator>=(careless a, careless b) { return a.x >= b.x; }
};

} // namespace

template <>
struct ao::real_traits<careless> {
    using uint = std::uint32_t;
    using integer = std::int32_t;
    using mask = bool;

    template <class T>
    static T select(T a, T b, bool m)
    {
        return m ? b : a;
    }
    static careless sqrt(careless a) { return careless::one_of(real_traits<interval>::sqrt(interval(a.x))); }
    static careless floor(careless a) { return std::floor(a.x); }
    static careless abs(careless a) { return std::abs(a.x); }
    static careless min(careless a, careless b) { return b < a ? b : a; }
    static careless max(careless a, careless b) { return a < b ? b : a; }
};

template <>
struct ao::detail::bits_of<careless, std::int32_t, std::uint32_t> {
    using single = bits_of<float, std::int32_t, std::uint32_t>;
    static std::int32_t exponent(careless a) { return single::exponent(a.x); }
    static careless power_of_two(std::int32_t n) { return single::power_of_two(n); }
    static careless real(std::uint32_t bits) { return single::real(bits); }
    static careless inverse_root_guess(careless a) { return single::inverse_root_guess(a.x); }
};

namespace {

// Not exact: quotients, roots and the conversion of codes differ from the reference's.
struct careless_subject {
    std::string_view name() const { return "careless"; }
    bool exact() const { return false; }
    result<picture> run(const settings& chosen, const facts& known, const camera& view, const picture& depth,
                        const picture& normal) const
    {
        const result<plan> p = make_plan(chosen, known, view);
        if (!p) {
            return p.error();
        }
        executor<careless> run(*p, depth, normal);
        const values<careless>& visibility = run.run();
        picture out(known.output_format, known.width, known.height);
        for (std::size_t i = 0; i < out.pixels(); ++i) {
            const float v = visibility.texels[i].x.x;
            differing_ += v != reference_value(*p, depth, normal, i) ? 1U : 0U;
            if (out.format == pixel_format::rgba16f) {
                const auto& texel = visibility.texels[i];
                out.set_texel(i, std::array{ float_to_half(std::min(v, 1.0F)), float_to_half(texel.y.x), float_to_half(texel.z.x),
                                             float_to_half(texel.w.x) });
            }
            else if (out.format == pixel_format::r8) {
                out.set_texel(i, static_cast<std::uint8_t>(unorm_code(static_cast<double>(v), 255)));
            }
            else {
                out.set_texel(i, std::min(v, 1.0F));
            }
        }
        return out;
    }
    result<success> evaluate(int function, std::span<const glm::vec4> a, std::span<const glm::vec4> b,
                             std::span<glm::vec4> out) const
    {
        using functions = evaluator<careless>;
        for (std::size_t i = 0; i < a.size(); ++i) {
            const auto v =
                functions::ao_evaluate(function, { a[i].x, a[i].y, a[i].z, a[i].w }, { b[i].x, b[i].y, b[i].z, b[i].w });
            out[i] = { v.x.x, v.y.x, v.z.x, v.w.x };
        }
        return success{};
    }
    std::size_t differing() const { return differing_; }

private:
    float reference_value(const plan& p, const picture& depth, const picture& normal, std::size_t i) const
    {
        if (i == 0) {
            executor<float> run(p, depth, normal);
            reference_ = run.run();
        }
        return reference_.texels[i].x;
    }
    mutable values<float> reference_;
    mutable std::size_t differing_ = 0;
};

struct fragility {
    double taps = 0;   // share of taps whose outcome is open
    double pixels = 0; // share of pixels with such a tap
};

fragility fragile_share(depth_choice depth, normal_choice normal, bool parallel)
{
    constexpr int width = 160;
    constexpr int height = 120;
    choice c{};
    c[of_parallel] = parallel ? 1 : 0;
    pass_case input = make_case(c);
    input.facts.width = width;
    input.facts.height = height;
    input.facts.depth = depth.source;
    input.facts.depth_format = depth.format;
    input.facts.normals = normal.source;
    input.facts.normal_format = normal.format;
    input.settings = { .method = method::hemisphere, .taps = 32, .radius = 0.8F, .filter = 1 };
    const camera_projection& projection = input.camera.projection;
    const surfaces seen = make_scene(width, height, projection);
    const picture depths = pack_depth(seen.depth, width, height, depth.source, depth.format, projection);
    const picture normals = normal.source == normal_source::from_depth
                                ? picture()
                                : pack_normals(seen.normals, width, height, normal.source, normal.format);
    const result<plan> p = make_plan(input.settings, input.facts, input.camera);
    REQUIRE(p);
    executor<interval> bounds(*p, depths, normals);
    fragility open;
    for (const auto& texel : bounds.run().texels) {
        const double taps = std::floor(static_cast<double>(texel.x.hi - texel.x.lo) * 32 + 0.01);
        open.taps += taps / (32.0 * width * height);
        open.pixels += taps > 0 ? 1.0 / (width * height) : 0.0;
    }
    return open;
}

} // namespace

TEST_CASE("an implementation as careless as allowed stays inside the bounds")
{
    careless_subject subject;
    const suite_summary summary = run_suite(subject, [&](const case_result& r) {
        INFO(describe(r));
        CHECK(r.verdict == outcome::passed);
    });
    CHECK(summary.failed == 0);
    // And it is careless: its pictures are not the reference's.
    CHECK(subject.differing() > 100);
}

TEST_CASE("fragile taps are below .05 % of all, whatever the G-buffer holds")
{
    // Normals rebuilt from 24-bit depth are the exception: their differences of depths lose 12 bits, and the error that a
    // conversion from 24 bits may have is then as large as .4 % of the normal.
    for (const bool parallel : { false, true }) {
        for (const depth_choice& depth : depth_choices) {
            for (const normal_choice& normal : normal_choices) {
                const fragility open = fragile_share(depth, normal, parallel);
                const bool lost = depth.format == pixel_format::d24 && normal.source == normal_source::from_depth && !parallel;
                std::printf("fragile: %-11s depth %-16s normals %-14s taps %.4f %%  pixels %.3f %%\n",
                            parallel ? "parallel" : "perspective", std::string(depth.name).c_str(),
                            std::string(normal.name).c_str(), 100 * open.taps, 100 * open.pixels);
                CHECK(open.taps < (lost ? 0.02 : 0.0005));
            }
        }
    }
}
