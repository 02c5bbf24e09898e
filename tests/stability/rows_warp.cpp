// 4.3: warps and cubature.
#include "stability/figure.hpp"
#include "stability/methods.hpp"
#include "stability/row.hpp"
#include "stability/scenes.hpp"

#include "ao/kernel.hpp"
#include "ao/rule_text.hpp"
#include "ao/temporal_taps.hpp"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <vector>

namespace stability {

namespace {

using glm::dvec3;
constexpr double pi = 3.14159265358979323846;

// Chi-square of points in the unit cube over 8x8x8 cells, over its 1 % point (Wilson and Hilferty 1931).
template <class Draw>
double chi_square(int count, Draw&& draw)
{
    constexpr int side = 8;
    std::vector<int> hits(side * side * side);
    for (int i = 0; i < count; ++i) {
        const dvec3 u = draw();
        if (!(u.x >= 0 && u.x <= 1 && u.y >= 0 && u.y <= 1 && u.z >= 0 && u.z <= 1)) {
            return endless;
        }
        const auto cell = [](double x) { return static_cast<std::size_t>(std::min(static_cast<int>(x * side), side - 1)); };
        ++hits[(cell(u.x) * side + cell(u.y)) * side + cell(u.z)];
    }
    const double expected = static_cast<double>(count) / static_cast<double>(hits.size());
    double sum = 0;
    for (const int n : hits) {
        sum += (n - expected) * (n - expected) / expected;
    }
    const double degrees = static_cast<double>(hits.size()) - 1;
    return sum / (degrees * std::pow(1 - 2 / (9 * degrees) + 2.3263478740408408 * std::sqrt(2 / (9 * degrees)), 3));
}

double turns(const dvec3& p)
{
    const double t = std::atan2(p.y, p.x) / (2 * pi);
    return t < 0 ? t + 1 : t;
}

// Each warp undone must be uniform: worst of box, half ball, cosine-weighted with linear distance, and both discs.
double warp_densities(subject& s)
{
    const int count = s.thorough ? 400000 : 100000;
    ao::random_stream random(99);
    const auto u = [&] { return static_cast<double>(random.uniform()); };
    const double skew = s.faulty ? 1.1 : 1;
    worst w;
    w.add(chi_square(count, [&] {
        const float a = random.uniform();
        const float b = random.uniform();
        const dvec3 p(ao::box_offset(a, b, random.uniform()));
        return dvec3(std::pow(p.x * 0.5 + 0.5, skew), p.y * 0.5 + 0.5, p.z);
    }));
    w.add(chi_square(count, [&] {
        const double a = u();
        const double b = u();
        const dvec3 p(ao::half_ball_offset(a, b, u()));
        const double r = glm::length(p);
        return dvec3(turns(p), p.z / r, std::pow(std::min(r * r * r, 1.0), skew));
    }));
    w.add(chi_square(count, [&] {
        const double a = u();
        const double b = u();
        const dvec3 p(ao::cosine_linear_offset(a, b, u()));
        const double r = glm::length(p);
        const double cosine = r > 0 ? p.z / r : 0;
        return dvec3(turns(p), std::min(cosine * cosine, 1.0), std::pow(std::min(r, 1.0), skew));
    }));
    for (const bool area : { false, true }) {
        w.add(chi_square(count, [&] {
            const double a = u();
            const glm::vec2 p = ao::disc_offset(a, u(), area);
            const double r = glm::length(glm::dvec2(p));
            return dvec3(turns({ p.x, p.y, 0 }), std::pow(std::min(area ? r * r : r, 1.0), skew), u());
        }));
    }
    return w.value();
}

// How far a warp's parameters come back, and a point below the horizon or outside the ball, at edges of [0, 1) too.
double warp_inverse(subject& s)
{
    worst w;
    ao::random_stream random(5);
    for (int i = 0; i < 20000; ++i) {
        const double u = static_cast<double>(random.uniform());
        const double v = 0.01 + 0.99 * static_cast<double>(random.uniform());
        const double h = static_cast<double>(random.uniform());
        dvec3 p(ao::cosine_linear_offset(u, v, h));
        if (s.faulty) { // paper 2, eq. 14, its radicand as it can be read at all: z and the rest exchanged
            p = { v * std::sqrt(h) * std::cos(2 * pi * u), v * std::sqrt(h) * std::sin(2 * pi * u), v * std::sqrt(1 - h) };
        }
        const double r = glm::length(p);
        w.add(std::abs(r - v));
        w.add(std::abs(p.z * p.z / (r * r) - h));
    }
    const double last = 1 - 1.0 / 16777216;
    for (const double u : { 0.0, 0.5, last }) {
        for (const double v : { 0.0, 0.5, last }) {
            for (const double h : { 0.0, 0.5, last }) {
                for (const dvec3& p : { dvec3(ao::cosine_linear_offset(u, v, h)), dvec3(ao::half_ball_offset(u, v, h)) }) {
                    w.add(p.z >= 0 ? 0 : endless);
                    w.add(std::max(glm::length(p) - 1, 0.0));
                }
            }
        }
    }
    return w.value();
}

// Share of a kernel's offsets outside the ball of the radius.
double outside_the_ball(subject& s)
{
    worst w;
    for (const ao::method m : methods) {
        if ((m == ao::method::box) != s.faulty || m == ao::method::bitmask) { // whose columns are cut off at the ball
            continue;
        }
        int outside = 0;
        const auto kernel = ao::make_kernel(m, ao::max_taps, 1);
        for (const glm::vec4& p : kernel) {
            outside += glm::dot(dvec3(p), dvec3(p)) > 1 + 1e-6 ? 1 : 0;
        }
        w.add(static_cast<double>(outside) / ao::max_taps);
    }
    return w.value();
}

// Open everywhere is exactly 1, closed everywhere exactly 0, in every method, depth format and output format.
double furnace(subject& s)
{
    worst w;
    const viewer v{ 24, 16, 0.6, false };
    for (const ao::method m : methods) {
        for (const depth_storage& d : depth_storages) {
            for (const auto output : { ao::pixel_format::r32f, ao::pixel_format::r8 }) {
                if (!s.thorough && (output == ao::pixel_format::r8) != (d.format == ao::pixel_format::d24)) {
                    continue;
                }
                ao::settings settings;
                settings.method = m;
                settings.taps = 14; // no power of two: n / n must still be 1
                settings.thickness = std::numeric_limits<float>::infinity();
                shot open = stored_as(shoot(v, tilted(0, 4), settings), d, v, 0.1, 100);
                open.facts.output_format = output;
                for (const float x : s.frame(open)) {
                    w.add(std::abs(static_cast<double>(x) - 1));
                }
                // The half ball lies behind the surface: the normal points away from the eye. Slices end at the tangent plane,
                // and one that leans away has none.
                if (m == ao::method::bitmask) {
                    continue;
                }
                shot closed = open;
                std::fill(closed.normals.begin(), closed.normals.end(), glm::vec3(0, 0, -1));
                closed.settings.bias = 0;
                closed.settings.radius = 1;
                for (const float x : s.frame(closed)) {
                    w.add(std::abs(static_cast<double>(x)));
                }
            }
        }
    }
    return w.value();
}

void lose_a_tap(subject& s)
{
    s.change_visibility = [](std::vector<float>& all) {
        for (float& x : all) {
            x *= 13.0F / 14.0F;
        }
    };
}

ao::sphere_rule rule_of(const char* name)
{
    return *ao::named_rule(name);
}

// Integral over the sphere, total 1, of x^a y^b z^c.
double monomial(int a, int b, int c)
{
    if (a % 2 != 0 || b % 2 != 0 || c % 2 != 0) {
        return 0;
    }
    return std::tgamma((a + 1) / 2.0) * std::tgamma((b + 1) / 2.0) * std::tgamma((c + 1) / 2.0) /
           std::tgamma((a + b + c + 3) / 2.0) / (2 * pi);
}

// Greatest error of a Lebedev rule of order 31 (350 points) over all monomials up to its order; faulty: one order too many.
double exactness(subject& s)
{
    const auto rule = *ao::lebedev_rule(31);
    const int most = s.faulty ? 32 : 31;
    worst w;
    for (int a = 0; a <= most; ++a) {
        for (int b = 0; a + b <= most; ++b) {
            for (int c = 0; a + b + c <= most; ++c) {
                double sum = 0;
                for (std::size_t i = 0; i < rule.size(); ++i) {
                    const auto& d = rule.directions[i];
                    sum += rule.weights[i] * std::pow(d[0], a) * std::pow(d[1], b) * std::pow(d[2], c);
                }
                w.add(std::abs(sum - monomial(a, b, c)));
            }
        }
    }
    return w.value();
}

// Growth of errors by negative weights: sum |w| / |sum w|.
double condition(subject& s)
{
    worst w;
    const auto add = [&](const ao::sphere_rule& rule) {
        double sum = 0;
        double magnitudes = 0;
        for (const double x : rule.weights) {
            sum += x;
            magnitudes += std::abs(x);
        }
        w.add(magnitudes / std::abs(sum));
    };
    if (s.faulty) {
        add(*ao::lebedev_rule(25, ao::generic_rotation, ao::negative_weights::allowed));
        return w.value();
    }
    for (const auto& design : ao::lebedev_designs) {
        if (const auto rule = ao::lebedev_rule(design.order)) {
            add(*rule);
        }
    }
    return w.value();
}

// Root mean square error of a rule on 300 half spheres, whose share is 1/2 of those with an edge through another direction: caps.
double edge_error(const ao::sphere_rule& rule)
{
    ao::random_stream random(77);
    double sum = 0;
    constexpr int caps = 300;
    for (int k = 0; k < caps; ++k) {
        const double z = 2 * static_cast<double>(random.uniform()) - 1;
        const double turn = 2 * pi * static_cast<double>(random.uniform());
        const double across = std::sqrt(1 - z * z);
        const dvec3 axis(across * std::cos(turn), across * std::sin(turn), z);
        const double height = 1.6 * static_cast<double>(random.uniform()) - 0.8;
        double share = 0;
        for (std::size_t i = 0; i < rule.size(); ++i) {
            const auto& d = rule.directions[i];
            share += axis.x * d[0] + axis.y * d[1] + axis.z * d[2] > height ? rule.weights[i] : 0;
        }
        const double error = share - (1 - height) / 2;
        sum += error * error / caps;
    }
    return std::sqrt(sum);
}

// What a rule exact to order 53 gains on hard edges: its error over that of a spiral of as many points.
double hard_edges(subject& s)
{
    return edge_error(s.faulty ? rule_of("marsaglia:974") : rule_of("lebedev:974")) / edge_error(rule_of("fibonacci:974"));
}

// Lebedev's error on caps against the same rule's on a smooth function, exp(5 u.x).
double edges_against_smooth(subject& s)
{
    const auto rule = rule_of("lebedev:974");
    const auto error_of_smooth = [](const ao::sphere_rule& r) {
        double sum = 0;
        for (std::size_t i = 0; i < r.size(); ++i) {
            sum += r.weights[i] * std::exp(5 * r.directions[i][2]);
        }
        return std::abs(sum / (std::sinh(5.0) / 5) - 1);
    };
    return s.faulty ? edge_error(rule) : error_of_smooth(rule);
}

// Length of the mean of exp(i k angle), k = 1 and 2, over the tile of rotations: a shift of the mean by the tile.
double tile_shift(subject& s)
{
    worst w;
    const auto tile = ao::make_rotation_tile(1);
    for (int k = 1; k <= 2; ++k) {
        double re = 0;
        double im = 0;
        for (const glm::vec2& h : tile) {
            const double angle = s.faulty ? std::atan2(static_cast<double>(h.y) * 0.5 + 0.5, static_cast<double>(h.x) * 0.5 + 0.5)
                                          : std::atan2(static_cast<double>(h.y), static_cast<double>(h.x));
            re += std::cos(k * angle) / static_cast<double>(tile.size());
            im += std::sin(k * angle) / static_cast<double>(tile.size());
        }
        w.add(std::hypot(re, im));
    }
    return w.value();
}

// The strongest line of the tile's spectrum over what white noise has on average.
double tile_spectrum(subject& s)
{
    auto tile = ao::make_rotation_tile(1);
    if (s.faulty) {
        for (std::size_t i = 0; i < tile.size(); ++i) {
            tile[i] = tile[i % 4];
        }
    }
    constexpr int n = ao::tile_size;
    std::vector<double> wave(n);
    for (int i = 0; i < n; ++i) {
        wave[static_cast<std::size_t>(i)] = std::cos(2 * pi * i / n);
    }
    double total = 0;
    double most = 0;
    for (int v = 0; v < n; ++v) {
        for (int u = 0; u < n; ++u) {
            if (u == 0 && v == 0) {
                continue;
            }
            double re = 0;
            double im = 0;
            for (int y = 0; y < n; ++y) {
                for (int x = 0; x < n; ++x) {
                    const double value = static_cast<double>(tile[static_cast<std::size_t>(y * n + x)].x);
                    const int phase = u * x + v * y;
                    re += value * wave[static_cast<std::size_t>(phase % n)];
                    im += value * wave[static_cast<std::size_t>((phase + 3 * n / 4) % n)];
                }
            }
            total += re * re + im * im;
            most = std::max(most, re * re + im * im);
        }
    }
    return most / (total / (n * n - 1));
}

void mark_faulty(subject& s)
{
    s.faulty = true;
}

} // namespace

std::vector<row> warp_rows()
{
    return {
        { "W1", "chi-square over its 1 % point: box, half ball, cosine-weighted, discs", 1, false,
          "a fixed seed; 511 degrees of freedom", domain::core, warp_densities, "one coordinate to the power 1.1", mark_faulty },
        { "W1i", "inverse of the cosine-weighted warp; 0, 1/2 and 1 - 2^-24 in every coordinate stay in the half ball", 1e-5,
          false, "numerics.md W1", domain::core, warp_inverse, "eq. 14 with z and the rest exchanged", mark_faulty },
        { "W1b", "share of the round kernels' offsets outside the ball", 0, false, "the density's support", domain::core,
          outside_the_ball, "box kernel, as printed in paper 1 (1 - pi/6 of it)", mark_faulty },
        { "W2", "open plane minus 1, and closed picture minus 0: every method and depth format, 14 taps", 0, false,
          "n / n and 0 / n are exact", domain::passes, furnace, "one of 14 taps lost", lose_a_tap },
        { "W3", "error of Lebedev's rule of order 31 on all monomials up to its order", 1e-13, false,
          "rounding of 350 terms in double", domain::core, exactness, "the same, one order further", mark_faulty },
        { "W3c", "sum |w| / |sum w|, worst of the rules that are given out", 1.000001, false, "no negative weight is given out",
          domain::core, condition, "order 25, negative weights asked for", mark_faulty },
        { "W3e", "error on hard edges: Lebedev's 974 points over a spiral's 974", 1.25, false,
          "docs/numerics.md: 0.72 to 1.19 on meshes", domain::core, hard_edges, "random directions", mark_faulty },
        { "W3s", "Lebedev's 974 points on exp(5z)", 1e-12, false, "exact to order 53; the series' rest is below rounding",
          domain::core, edges_against_smooth, "the same rule on hard edges", mark_faulty },
        { "W4", "mean of exp(i a) and exp(2 i a) over the tile of rotations", 0.047, false,
          "3 standard errors of 4096 random directions", domain::core, tile_shift, "helpers in [0, 1] instead of [-1, 1]",
          mark_faulty },
        { "W4s", "strongest line of the tile's spectrum over the mean", 11.3, false,
          "ln 4096 + 3 for white noise, exponential law", domain::core, tile_spectrum, "a tile that repeats every 4 pixels",
          mark_faulty },
    };
}

} // namespace stability
