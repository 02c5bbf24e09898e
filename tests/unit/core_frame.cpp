// Tangent frames and normalisation over every pair, degenerate ones included (numerics.md T1 to T4).
#include "unit/core_support.hpp"

#include "ao/picture.hpp"

#include <catch2/catch.hpp>

#include <cmath>
#include <limits>

using namespace core_test;

namespace {

constexpr float inf = std::numeric_limits<float>::infinity();
constexpr float not_a_number = std::numeric_limits<float>::quiet_NaN();

// Largest deviation from orthonormal and right-handed of tangent, bitangent, normal in nine numbers; NaN counts as infinite.
double frame_error(const double* f)
{
    const auto dot = [&](int a, int b) { return f[a] * f[b] + f[a + 1] * f[b + 1] + f[a + 2] * f[b + 2]; };
    const double handed =
        f[6] * (f[1] * f[5] - f[2] * f[4]) + f[7] * (f[2] * f[3] - f[0] * f[5]) + f[8] * (f[0] * f[4] - f[1] * f[3]);
    double worst = 0;
    for (const double e : { dot(0, 0) - 1, dot(3, 3) - 1, dot(6, 6) - 1, dot(0, 3), dot(0, 6), dot(3, 6), handed - 1 }) {
        worst = std::abs(e) <= worst ? worst : (std::isfinite(e) ? std::abs(e) : std::numeric_limits<double>::infinity());
    }
    return worst;
}

template <class Real>
double worst_any_tangent(const std::vector<std::array<float, 3>>& normals)
{
    using m = ao::math<Real>;
    const auto frames = evaluate<Real>(normals, [](const std::array<Real, 3>& in) {
        const typename m::vec3 n(in[0], in[1], in[2]);
        const auto t = m::ao_any_tangent(n);
        const auto b = m::ao_cross(n, t);
        return std::array{ t.x, t.y, t.z, b.x, b.y, b.z, n.x, n.y, n.z };
    });
    double worst = 0;
    for (const auto& frame : frames) {
        worst = std::max(worst, frame_error(frame.data()));
    }
    return worst;
}

} // namespace

TEMPLATE_TEST_CASE("any tangent is orthonormal to every normal, both poles and both zeros", "[core][frame]", float, double,
                   lanes4, lanes8, lanes16)
{
    std::vector<std::array<float, 3>> normals;
    for (const float one : { 1.0F, -1.0F }) {
        for (const float zero : { 0.0F, -0.0F }) {
            normals.push_back({ zero, zero, one });
            normals.push_back({ one, zero, zero });
            normals.push_back({ zero, one, zero });
        }
        for (float tiny = 1e-2F; tiny > 1e-40F; tiny *= 0.1F) {
            const float rest = std::sqrt(1.0F - tiny * tiny);
            normals.push_back({ tiny, 0, one * rest });
            normals.push_back({ 0, -tiny, one * rest });
            normals.push_back({ rest, 0, one * tiny });
        }
    }
    directions random(7);
    for (int i = 0; i < 200000; ++i) {
        normals.push_back(random.next());
    }
    CHECK(worst_any_tangent<TestType>(normals) < 4e-7);
}

TEMPLATE_TEST_CASE("Gram-Schmidt is orthonormal for all pairs", "[core][frame]", float, double, lanes4, lanes8, lanes16)
{
    using m = ao::math<TestType>;
    std::vector<std::array<float, 6>> pairs;
    const auto add = [&](const std::array<float, 3>& n, float x, float y, float z) {
        pairs.push_back({ n[0], n[1], n[2], x, y, z });
    };
    directions random(11);
    std::mt19937 engine(13);
    std::uniform_real_distribution<float> signed_unit(-1.0F, 1.0F);
    for (int i = 0; i < 20000; ++i) {
        const auto n = i == 0 ? std::array{ 0.0F, 0.0F, -1.0F } : i == 1 ? std::array{ 1.0F, 0.0F, 0.0F } : random.next();
        add(n, signed_unit(engine), signed_unit(engine), 0);
        add(n, n[0], n[1], n[2]);
        add(n, -n[0], -n[1], -n[2]);
        add(n, n[0] * 0.001F, n[1] * 0.001F, n[2] * 0.001F);
        add(n, 0, 0, 0);
        add(n, not_a_number, 0, 0);
        add(n, 0, inf, 0);
        add(n, -inf, inf, not_a_number);
        add(n, 1e-30F, 1e-30F, 0);
        add(n, 1e30F, -1e30F, 0);
        for (float t = 0.2F; t > 1e-7F; t *= 0.5F) {
            const auto o = random.next();
            add(n, n[0] + t * o[0], n[1] + t * o[1], n[2] + t * o[2]);
        }
    }
    const auto frames = evaluate<TestType>(pairs, [](const std::array<TestType, 6>& in) {
        const auto f = m::ao_gram_schmidt(typename m::vec3(in[0], in[1], in[2]), typename m::vec3(in[3], in[4], in[5]));
        return std::array{ f.tangent.x,   f.tangent.y, f.tangent.z, f.bitangent.x, f.bitangent.y,
                           f.bitangent.z, f.normal.x,  f.normal.y,  f.normal.z };
    });
    double worst = 0;
    for (const auto& frame : frames) {
        worst = std::max(worst, frame_error(frame.data()));
    }
    CHECK(worst < 1e-5);
}

TEST_CASE("The tangent lies in the plane of normal and helper, on the helper's side", "[core][frame]")
{
    using m = ao::math<float>;
    directions random(17);
    for (int i = 0; i < 1000; ++i) {
        const auto normal = random.next();
        const auto helper = random.next();
        const glm::dvec3 n(normal[0], normal[1], normal[2]);
        const glm::dvec3 h(helper[0], helper[1], helper[2]);
        const double along = n.x * h.x + n.y * h.y + n.z * h.z;
        if (std::abs(along) > 0.99) {
            continue; // the fallback's region
        }
        const auto f = m::ao_gram_schmidt(m::vec3(n), m::vec3(h));
        const double across = std::sqrt(1 - along * along);
        CHECK(static_cast<double>(f.tangent.x) == Approx((h.x - n.x * along) / across).margin(1e-5));
        CHECK(static_cast<double>(f.tangent.y) == Approx((h.y - n.y * along) / across).margin(1e-5));
        CHECK(static_cast<double>(f.tangent.z) == Approx((h.z - n.z * along) / across).margin(1e-5));
    }
}

TEMPLATE_TEST_CASE("Normalising is defined for every vector", "[core][frame]", float, double, lanes4, lanes8, lanes16)
{
    using m = ao::math<TestType>;
    const float lowest = std::numeric_limits<float>::denorm_min();
    const float highest = std::numeric_limits<float>::max();
    std::vector<std::array<float, 3>> vectors;
    for (const float x : { 0.0F, -0.0F, lowest, 1e-38F, 1e-30F, 1e-16F, 1e-14F, 1.0F, -3.0F, 1e14F, 1e16F, 1e30F, highest, inf,
                           -inf, not_a_number }) {
        vectors.push_back({ x, 0, 0 });
        vectors.push_back({ x, x, x });
        vectors.push_back({ 1, 0, x });
    }
    const auto units = evaluate<TestType>(vectors, [](const std::array<TestType, 3>& in) {
        return parts(
            m::ao_normalize_or(typename m::vec3(in[0], in[1], in[2]), typename m::vec3(TestType(0), TestType(0), TestType(1))));
    });
    for (std::size_t i = 0; i < vectors.size(); ++i) {
        const auto x = static_cast<double>(vectors[i][0]);
        const auto y = static_cast<double>(vectors[i][1]);
        const auto z = static_cast<double>(vectors[i][2]);
        const double norm = std::sqrt(x * x + y * y + z * z);
        const auto& u = units[i];
        CAPTURE(x, y, z);
        if (norm >= 1e-14 && norm <= 1e14) {
            CHECK(u[0] == Approx(x / norm).margin(2e-7));
            CHECK(u[2] == Approx(z / norm).margin(2e-7));
        }
        if (!(norm >= 1e-16 && norm <= 1e16)) {
            CHECK((u[0] == 0 && u[1] == 0 && u[2] == 1));
        }
        CHECK(u[0] * u[0] + u[1] * u[1] + u[2] * u[2] == Approx(1).margin(1e-6));
    }
}

namespace {

// A picture of stored normals as the pass reads its texels.
struct stored_normals {
    const ao::picture* picture;
    ao::math<float>::vec4 normal(ao::math<float>::ivec2 pixel) const
    {
        const auto i = static_cast<std::size_t>(pixel.x);
        switch (picture->format) {
        case ao::pixel_format::rgba32f:
            return picture->texel<glm::vec4>(i);
        case ao::pixel_format::rgba16f: {
            const auto h = picture->texel<std::array<std::uint16_t, 4>>(i);
            return { ao::half_to_float(h[0]), ao::half_to_float(h[1]), ao::half_to_float(h[2]), ao::half_to_float(h[3]) };
        }
        case ao::pixel_format::rgb10a2: {
            const auto code = picture->texel<std::uint32_t>(i);
            const auto part = [&](unsigned shift) { return static_cast<float>(code >> shift & 1023U) / 1023.0F; };
            return { part(0), part(10), part(20), 1.0F };
        }
        default: {
            const auto code = picture->texel<std::uint32_t>(i);
            return { static_cast<float>(code & 65535U) / 65535.0F, static_cast<float>(code >> 16U) / 65535.0F, 0.0F, 1.0F };
        }
        }
    }
    float depth(ao::math<float>::ivec2) const { return 1.0F; }
    ao::math<float>::vec2 rotation(ao::math<float>::ivec2) const { return {}; }
    ao::math<float>::vec4 tap(int) const { return {}; }
};

} // namespace

TEST_CASE("Stored normals decode to unit vectors near the ones stored", "[core][frame]")
{
    struct storage {
        ao::normal_source source;
        ao::pixel_format format;
        double degrees; // greatest angle that quantising can make
    };
    const storage kind = GENERATE(storage{ ao::normal_source::vector, ao::pixel_format::rgba32f, 2e-5 },
                                  storage{ ao::normal_source::vector, ao::pixel_format::rgba16f, 0.024 },
                                  storage{ ao::normal_source::unorm10, ao::pixel_format::rgb10a2, 0.098 },
                                  storage{ ao::normal_source::octahedral, ao::pixel_format::rg16, 0.0038 });
    std::vector<glm::vec3> normals{ { 0, 0, 1 }, { 0, 0, -1 }, { 1, 0, 0 }, { -1, 0, 0 }, { 0, 1, 0 }, { 0, -1, 0 } };
    directions random(23);
    for (int i = 0; i < 50000; ++i) {
        const auto n = random.next();
        normals.emplace_back(n[0], n[1], n[2]);
    }
    const ao::picture packed = ao::pack_normals(normals, static_cast<int>(normals.size()), 1, kind.source, kind.format);
    ao::occlusion_pass<float, stored_normals> pass{ { &packed } };
    pass.ao_normal_source = static_cast<int>(kind.source);

    double worst_angle = 0;
    double worst_length = 0;
    std::vector<std::array<float, 3>> decoded;
    for (std::size_t i = 0; i < normals.size(); ++i) {
        const auto n = pass.ao_shading_normal({}, {}, { 1, 1 }, { static_cast<int>(i), 0 }, { 0, 0, -1 }, false);
        const glm::dvec3 a(n.x, n.y, n.z);
        const glm::dvec3 b(normals[i].x, normals[i].y, normals[i].z);
        const glm::dvec3 cross(a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x);
        const double sine = std::sqrt(cross.x * cross.x + cross.y * cross.y + cross.z * cross.z);
        worst_angle = std::max(worst_angle, std::atan2(sine, a.x * b.x + a.y * b.y + a.z * b.z));
        worst_length = std::max(worst_length, std::abs(std::sqrt(a.x * a.x + a.y * a.y + a.z * a.z) - 1));
        decoded.push_back({ n.x, n.y, n.z });
    }
    CHECK(worst_angle * 180 / 3.14159265358979 < kind.degrees);
    CHECK(worst_length < 2e-7);
    CHECK(worst_any_tangent<float>(decoded) < 1e-6);
}

TEST_CASE("A zero or non-finite stored normal becomes +Z", "[core][frame]")
{
    ao::picture packed(ao::pixel_format::rgba32f, 4, 1);
    packed.set_texel(0, glm::vec4(0, 0, 0, 0));
    packed.set_texel(1, glm::vec4(not_a_number, 0, 1, 0));
    packed.set_texel(2, glm::vec4(0, inf, 0, 0));
    packed.set_texel(3, glm::vec4(1e30F, 0, 0, 0));
    const ao::occlusion_pass<float, stored_normals> pass{ { &packed } };
    auto run = pass;
    for (int i = 0; i < 4; ++i) {
        const auto n = run.ao_shading_normal({}, {}, { 4, 1 }, { i, 0 }, { 0, 0, -1 }, false);
        CHECK((n.x == 0 && n.y == 0 && n.z == 1));
    }
}
