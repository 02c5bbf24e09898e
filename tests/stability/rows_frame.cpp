// 4.1: tangent frames.
#include "stability/figure.hpp"
#include "stability/row.hpp"

#include "ao/conformance/functions.hpp"
#include "ao/conformance/reference.hpp"
#include "ao/half.hpp"

#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

namespace stability {

namespace {

using ids = ao::conformance::evaluator<float>;
using glm::dvec3;

constexpr float endless_f = std::numeric_limits<float>::infinity();
const float nan_f = std::numeric_limits<float>::quiet_NaN();

struct pairs {
    std::vector<glm::vec4> normals;
    std::vector<glm::vec4> helpers;
};

void add(pairs& p, const glm::vec3& n, const glm::vec3& h)
{
    p.normals.emplace_back(n, 0.0F);
    p.helpers.emplace_back(h, 0.0F);
}

// Random ones, helpers at every angle down to 1e-7 from the normal, parallel ones, and no direction at all.
pairs make_pairs(const subject& s)
{
    pairs p;
    ao::random_stream random(11);
    const int count = s.thorough ? 400000 : 20000;
    for (int i = 0; i < count; ++i) {
        const glm::vec3 n = ao::conformance::detail::unit_vector(random);
        add(p, n, { 2 * random.uniform() - 1, 2 * random.uniform() - 1, 0 });
        const glm::vec3 aside = ao::conformance::detail::unit_vector(random);
        add(p, n, n + aside * std::pow(10.0F, -7 * random.uniform()));
    }
    for (int i = 0; i < 500; ++i) {
        const glm::vec3 n = ao::conformance::detail::unit_vector(random);
        const std::array<glm::vec3, 6> helpers{ n, -n, glm::vec3(0), glm::vec3(nan_f), glm::vec3(endless_f), n * 1e-30F };
        for (const glm::vec3& h : helpers) {
            add(p, n, h);
        }
    }
    return p;
}

double frame_error(const dvec3& t, const dvec3& b, const dvec3& n)
{
    worst w;
    for (const double x : { glm::dot(t, t) - 1, glm::dot(b, b) - 1, glm::dot(t, n), glm::dot(b, n), glm::dot(t, b) }) {
        w.add(std::abs(x));
    }
    return w.value();
}

double orthonormality(subject& s)
{
    const pairs p = make_pairs(s);
    const auto t = s.evaluate(ids::ao_of_tangent, p.normals, p.helpers);
    const auto b = s.evaluate(ids::ao_of_bitangent, p.normals, p.helpers);
    worst w;
    for (std::size_t i = 0; i < t.size(); ++i) {
        w.add(frame_error(dvec3(t[i]), dvec3(b[i]), dvec3(p.normals[i])));
    }
    return w.value();
}

void plain_gram_schmidt(subject& s)
{
    s.evaluate_instead = [](int function, auto normals, auto helpers, auto out) {
        for (std::size_t i = 0; i < out.size(); ++i) {
            const glm::vec3 n(normals[i]);
            const glm::vec3 h(helpers[i]);
            const glm::vec3 t = glm::normalize(h - n * glm::dot(n, h));
            out[i] = glm::vec4(function == ids::ao_of_tangent ? t : glm::cross(n, t), 0.0F);
        }
    };
}

// Unit normals: random ones, both poles and what lies 1e-2 to 1e-8 off them, both signs of zero.
std::vector<glm::vec4> make_normals(const subject& s)
{
    std::vector<glm::vec4> all;
    ao::random_stream random(5);
    const int count = s.thorough ? 4000000 : 100000;
    for (int i = 0; i < count; ++i) {
        all.emplace_back(ao::conformance::detail::unit_vector(random), 0.0F);
    }
    for (const float side : { 1.0F, -1.0F }) {
        for (float off = 1e-2F; off > 1e-8F; off *= 0.5F) {
            for (int k = 0; k < 8; ++k) {
                const float turn = 0.785F * static_cast<float>(k) + 0.1F;
                all.emplace_back(off * std::cos(turn), off * std::sin(turn), side * std::sqrt(1 - off * off), 0.0F);
            }
        }
        all.emplace_back(0.0F, 0.0F, side, 0.0F);
        all.emplace_back(-0.0F, -0.0F, side, 0.0F);
        all.emplace_back(0.6F, 0.8F, side * 0.0F, 0.0F);
        all.emplace_back(-0.8F, side * 0.0F, 0.6F, 0.0F);
    }
    return all;
}

double pole_error(subject& s)
{
    const auto normals = make_normals(s);
    const auto tangents = s.evaluate(ids::ao_of_any_tangent, normals, normals);
    worst w;
    for (std::size_t i = 0; i < normals.size(); ++i) {
        const dvec3 n(normals[i]);
        const dvec3 t(tangents[i]);
        w.add(std::abs(glm::dot(t, t) - 1));
        w.add(std::abs(glm::dot(t, n)));
    }
    const std::vector<glm::vec4> nothing{ glm::vec4(0.0F) };
    const glm::vec4 t = s.evaluate(ids::ao_of_any_tangent, nothing, nothing)[0];
    w.add(std::isfinite(t.x + t.y + t.z) ? 0.0 : endless);
    return w.value();
}

void frisvad(subject& s)
{
    s.evaluate_instead = [](int, auto normals, auto, auto out) {
        for (std::size_t i = 0; i < out.size(); ++i) {
            const glm::vec4 n = normals[i];
            const float a = 1 / (1 + n.z);
            out[i] = n.z < -0.9999999F ? glm::vec4(0, -1, 0, 0) : glm::vec4(1 - n.x * n.x * a, -n.x * n.y * a, -n.x, 0);
        }
    };
}

double handedness(subject& s)
{
    const pairs p = make_pairs(s);
    const auto t = s.evaluate(ids::ao_of_tangent, p.normals, p.helpers);
    const auto b = s.evaluate(ids::ao_of_bitangent, p.normals, p.helpers);
    double least = 1;
    for (std::size_t i = 0; i < t.size(); ++i) {
        const double det = glm::dot(glm::cross(dvec3(t[i]), dvec3(b[i])), dvec3(p.normals[i]));
        least = det >= least ? least : std::isnan(det) ? -endless : det;
    }
    return least;
}

void turn_bitangent(subject& s)
{
    subject plain(s);
    s.evaluate_instead = [plain](int function, auto a, auto b, auto out) mutable {
        const auto made = plain.evaluate(function, { a.begin(), a.end() }, { b.begin(), b.end() });
        for (std::size_t i = 0; i < out.size(); ++i) {
            out[i] = function == ids::ao_of_bitangent ? made[i] * -1.0F : made[i];
        }
    };
}

struct normal_format {
    ao::normal_source source;
    ao::pixel_format format;
};

constexpr std::array normal_formats{ normal_format{ ao::normal_source::vector, ao::pixel_format::rgba16f },
                                     normal_format{ ao::normal_source::vector, ao::pixel_format::rgba32f },
                                     normal_format{ ao::normal_source::unorm10, ao::pixel_format::rgb10a2 },
                                     normal_format{ ao::normal_source::octahedral, ao::pixel_format::rg16 } };

// As a pass gets them from the texel, before it makes them unit.
std::vector<glm::vec4> decoded(const std::vector<glm::vec3>& normals, const normal_format& f)
{
    const auto count = static_cast<int>(normals.size());
    const ao::picture stored = ao::pack_normals(normals, count, 1, f.source, f.format);
    std::vector<glm::vec4> out;
    for (std::size_t i = 0; i < normals.size(); ++i) {
        const glm::vec4 texel = ao::conformance::decode_texel<float>(stored, i);
        out.emplace_back(ao::math<float>::ao_decoded_normal(static_cast<int>(f.source), texel), 0.0F);
    }
    return out;
}

std::vector<glm::vec3> some_normals(int count)
{
    std::vector<glm::vec3> all;
    ao::random_stream random(3);
    for (int i = 0; i < count; ++i) {
        all.push_back(ao::conformance::detail::unit_vector(random));
    }
    return all;
}

std::vector<glm::vec4> normalized_by(subject& s, const std::vector<glm::vec4>& v)
{
    const std::vector<glm::vec4> fallback(v.size(), glm::vec4(0, 0, 1, 0));
    return s.evaluate(ids::ao_of_normalize_or, v, fallback);
}

double stored_frame_error(subject& s)
{
    worst w;
    for (const normal_format& f : normal_formats) {
        const auto stored = decoded(some_normals(s.thorough ? 60000 : 6000), f);
        const auto n = s.faulty ? stored : normalized_by(s, stored);
        const auto t = s.evaluate(ids::ao_of_any_tangent, n, n);
        for (std::size_t i = 0; i < n.size(); ++i) {
            w.add(std::abs(glm::dot(dvec3(t[i]), dvec3(t[i])) - 1));
            w.add(std::abs(glm::dot(dvec3(t[i]), dvec3(n[i]))));
            w.add(std::abs(glm::dot(dvec3(n[i]), dvec3(n[i])) - 1));
        }
    }
    return w.value();
}

double degrees_between(const dvec3& a, const dvec3& b)
{
    return std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b)) * 57.29577951308232;
}

double stored_angle(subject& s)
{
    worst w;
    const auto normals = some_normals(s.thorough ? 60000 : 6000);
    if (s.faulty) {
        std::vector<glm::vec4> bytes;
        for (const glm::vec3& n : normals) {
            const auto code = [](float x) { return std::round((x * 0.5F + 0.5F) * 255) / 255 * 2 - 1; };
            bytes.emplace_back(code(n.x), code(n.y), code(n.z), 0.0F);
        }
        const auto made = normalized_by(s, bytes);
        for (std::size_t i = 0; i < normals.size(); ++i) {
            w.add(degrees_between(dvec3(made[i]), dvec3(normals[i])));
        }
        return w.value();
    }
    for (const normal_format& f : normal_formats) {
        const auto made = normalized_by(s, decoded(normals, f));
        for (std::size_t i = 0; i < normals.size(); ++i) {
            w.add(degrees_between(dvec3(made[i]), dvec3(normals[i])));
        }
    }
    return w.value();
}

double normalize_range(subject& s)
{
    std::vector<glm::vec4> all;
    for (const float size :
         { 0.0F, 1e-45F, 1e-40F, 1e-30F, 1e-19F, 1e-15F, 1.0F, 1e15F, 1e19F, 1e30F, 3e38F, endless_f, nan_f }) {
        for (const glm::vec3& d : some_normals(40)) {
            all.emplace_back(d * size, 0.0F);
        }
        all.emplace_back(size, 1.0F, 0.0F, 0.0F);
    }
    worst w;
    for (const glm::vec4& n : normalized_by(s, all)) {
        w.add(std::abs(glm::length(dvec3(n)) - 1));
    }
    return w.value();
}

// Of neighbouring normals on either side of n.z = 0, with a helper at least 0.1 off both.
double seam(subject& s)
{
    pairs above;
    pairs below;
    ao::random_stream random(17);
    while (above.normals.size() < 4000) {
        const float turn = 6.2831853F * random.uniform();
        const glm::vec3 n(std::cos(turn), std::sin(turn), 0.0F);
        const glm::vec3 h(2 * random.uniform() - 1, 2 * random.uniform() - 1, 0.0F);
        if (glm::length(glm::cross(n, h)) > 0.1F) {
            add(above, glm::normalize(n + glm::vec3(0, 0, 1e-4F)), h);
            add(below, glm::normalize(n - glm::vec3(0, 0, 1e-4F)), h);
        }
    }
    const auto up = s.evaluate(ids::ao_of_tangent, above.normals, above.helpers);
    const auto down = s.evaluate(ids::ao_of_tangent, below.normals, below.helpers);
    worst w;
    for (std::size_t i = 0; i < up.size(); ++i) {
        w.add(glm::length(dvec3(up[i]) - dvec3(down[i])));
    }
    return w.value();
}

void duff_without_helper(subject& s)
{
    subject plain(s);
    s.evaluate_instead = [plain](int, auto a, auto b, auto out) mutable {
        const auto made = plain.evaluate(ids::ao_of_any_tangent, { a.begin(), a.end() }, { b.begin(), b.end() });
        std::copy(made.begin(), made.end(), out.begin());
    };
}

void plain_normalize(subject& s)
{
    s.evaluate_instead = [](int, auto a, auto, auto out) {
        for (std::size_t i = 0; i < out.size(); ++i) {
            out[i] = glm::vec4(glm::normalize(glm::vec3(a[i])), 0.0F);
        }
    };
}

void mark_faulty(subject& s)
{
    s.faulty = true;
}

} // namespace

std::vector<row> frame_rows()
{
    return {
        { "T1", "frame error of Gram-Schmidt: random and planar helpers, at angles down to 1e-7, parallel, 0, NaN, infinite",
          1e-5, false, "numerics.md T1", domain::passes, orthonormality, "Gram-Schmidt without a fallback axis",
          plain_gram_schmidt },
        { "T2", "frame error of the fallback tangent: all unit normals, both poles, both zeros, n = 0 finite", 4e-7, false,
          "numerics.md T2: 3 roundings of 2^-24 in each product", domain::passes, pole_error,
          "Frisvad with the usual guard -0.9999999", frisvad },
        { "T2h", "least determinant of tangent, bitangent, normal: right-handed everywhere", 0.9999, true, "1 but for roundings",
          domain::passes, handedness, "bitangent turned round", turn_bitangent },
        { "T3", "frame error from every stored normal: rgba16f, rgba32f, rgb10a2, rg16 octahedral", 1e-6, false, "numerics.md T3",
          domain::passes, stored_frame_error, "stored lengths not made 1", mark_faulty },
        { "T3a", "angle of stored normals, worst of the four formats, degrees", 0.1, false,
          "numerics.md T3: half a step of 10 bits on three axes is 0.095", domain::passes, stored_angle, "8 bits an axis",
          mark_faulty },
        { "T4", "length of normalised vectors minus 1: lengths 0, 1e-45 to 3e38, infinite, NaN", 4e-7, false,
          "fallback outside 1e-15 ... 1e15; sqrt and division round once each", domain::passes, normalize_range, "v / sqrt(v.v)",
          plain_normalize },
        { "T5", "jump of the tangent between normals 1e-4 on either side of n.z = 0, helper 0.1 or more off", 4e-3, false,
          "2e-4 / sin(angle to the helper) twice", domain::passes, seam, "Duff's frame, which turns by the sign of n.z",
          duff_without_helper },
    };
}

} // namespace stability
