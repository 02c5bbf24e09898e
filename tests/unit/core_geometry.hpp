// Analytic scenes seen by rays in double, and what the k-estimator expects over them: an independent, brute-force account of
// stage 2 of paper 1 that shares no code with the pass.
#pragma once

#include "unit/core_pictures.hpp"

#include <glm/vec3.hpp>

#include <cmath>
#include <functional>
#include <limits>
#include <random>

namespace core_test {

inline double dot(const glm::dvec3& a, const glm::dvec3& b)
{
    return a.x * b.x + a.y * b.y + a.z * b.z;
}
inline glm::dvec3 normalized(const glm::dvec3& v)
{
    return v * (1 / std::sqrt(dot(v, v)));
}

struct surface_point {
    double depth = 0; // eye depth, 0 where nothing is hit
    glm::dvec3 normal{ 0, 0, 1 };
};

// What the ray from `origin` along `direction` (z = -1, so that its parameter is depth) meets first.
using solid = std::function<surface_point(const glm::dvec3& origin, const glm::dvec3& direction)>;

inline surface_point nearer(const surface_point& a, const surface_point& b)
{
    return b.depth > 0 && (a.depth == 0 || b.depth < a.depth) ? b : a;
}

// Points p with n . p = distance; within `radius` of `centre` where given.
inline solid plane(const glm::dvec3& n, double distance, const glm::dvec3& centre = {}, double radius = 1e30)
{
    return [=](const glm::dvec3& o, const glm::dvec3& d) {
        const double t = (distance - dot(n, o)) / dot(n, d);
        const glm::dvec3 from = o + d * t - centre;
        return t > 0 && dot(from, from) <= radius * radius ? surface_point{ t, n } : surface_point{};
    };
}

inline solid sphere(const glm::dvec3& centre, double radius)
{
    return [=](const glm::dvec3& o, const glm::dvec3& d) {
        const glm::dvec3 from = o - centre;
        const double a = dot(d, d);
        const double b = dot(from, d);
        const double root = b * b - a * (dot(from, from) - radius * radius);
        if (root < 0) {
            return surface_point{};
        }
        const double t = (-b - std::sqrt(root)) / a;
        return t > 0 ? surface_point{ t, (from + d * t) * (1 / radius) } : surface_point{};
    };
}

inline solid both(const solid& a, const solid& b)
{
    return [=](const glm::dvec3& o, const glm::dvec3& d) { return nearer(a(o, d), b(o, d)); };
}

// A camera at the origin; `extent` as in simple_camera.
struct viewer {
    int width = 400;
    int height = 300;
    double extent = 0.6;
    bool parallel = false;

    ao::camera camera() const { return simple_camera(width, height, extent, parallel); }
    double wide() const { return extent * width / height; }
    surface_point see(const solid& scene, double column, double row) const
    {
        const double x = (2 * column / width - 1) * wide();
        const double y = (2 * row / height - 1) * extent;
        return parallel ? scene({ x, y, 0 }, { 0, 0, -1 }) : scene({ 0, 0, 0 }, { x, y, -1 });
    }
    glm::dvec3 point(double column, double row, double depth) const
    {
        const double reach = parallel ? 1 : depth;
        return { (2 * column / width - 1) * wide() * reach, (2 * row / height - 1) * extent * reach, -depth };
    }
    // Column and row; outside the picture or behind the eye: -1.
    glm::dvec2 pixel(const glm::dvec3& p) const
    {
        const double reach = parallel ? 1 : -p.z;
        const double column = (p.x / reach / wide() + 1) * width / 2;
        const double row = (p.y / reach / extent + 1) * height / 2;
        const bool inside = -p.z > 0 && column >= 0 && column < width && row >= 0 && row < height;
        return inside ? glm::dvec2(column, row) : glm::dvec2(-1, -1);
    }
    pictures picture(const solid& scene) const
    {
        pictures p(width, height);
        for (int y = 0; y < height; ++y) {
            for (int x = 0; x < width; ++x) {
                const surface_point s = see(scene, x + 0.5, y + 0.5);
                p.depth[p.index(x, y)] = static_cast<float>(s.depth);
                p.normals[p.index(x, y)] = glm::vec3(s.normal);
            }
        }
        return p;
    }
};

// A point of a kernel's density, normal along +z, by rejection from its definition.
inline glm::dvec3 kernel_point(ao::method kernel, std::mt19937_64& engine)
{
    std::uniform_real_distribution<double> unit(0, 1);
    const auto box = [&] { return glm::dvec3(2 * unit(engine) - 1, 2 * unit(engine) - 1, unit(engine)); };
    if (kernel == ao::method::box) {
        return box();
    }
    glm::dvec3 p = box();
    while (dot(p, p) > 1 || dot(p, p) == 0) {
        p = box();
    }
    if (kernel == ao::method::hemisphere) {
        return p;
    }
    // Cosine-weighted: a uniform point of the disc, lifted to the half sphere (Malley); distance uniform.
    double x = 2 * unit(engine) - 1;
    double y = 2 * unit(engine) - 1;
    while (x * x + y * y > 1) {
        x = 2 * unit(engine) - 1;
        y = 2 * unit(engine) - 1;
    }
    return glm::dvec3(x, y, std::sqrt(1 - x * x - y * y)) * unit(engine);
}

// Share of the kernel about the surface seen at a pixel that lies behind the depth picture by `bias` or more and by `thickness`
// or less: k at infinitely many taps. Random rotation, which changes nothing for the round kernels.
inline double expected_occlusion(const viewer& view, const solid& scene, const pictures& buffer, const ao::settings& s,
                                 int column, int row, int samples)
{
    const surface_point at_pixel = view.see(scene, column + 0.5, row + 0.5);
    const glm::dvec3 p = view.point(column + 0.5, row + 0.5, at_pixel.depth);
    const glm::dvec3 n = at_pixel.normal;
    const glm::dvec3 aside = std::abs(n.x) < 0.7 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0);
    const glm::dvec3 t = normalized(aside - n * dot(aside, n));
    const glm::dvec3 b(n.y * t.z - n.z * t.y, n.z * t.x - n.x * t.z, n.x * t.y - n.y * t.x);
    std::mt19937_64 engine(static_cast<std::uint64_t>(row * 65536 + column));
    int hits = 0;
    for (int i = 0; i < samples; ++i) {
        const glm::dvec3 offset = kernel_point(s.method, engine);
        const glm::dvec3 a = p + (t * offset.x + b * offset.y + n * offset.z) * static_cast<double>(s.radius);
        const glm::dvec2 texel = view.pixel(a);
        if (texel.x < 0) {
            continue;
        }
        const auto surface =
            static_cast<double>(buffer.depth[buffer.index(static_cast<int>(texel.x), static_cast<int>(texel.y))]);
        const double behind = -a.z - surface;
        hits += surface > 0 && behind >= static_cast<double>(s.bias) &&
                behind <= static_cast<double>(s.thickness) * static_cast<double>(s.radius);
    }
    return static_cast<double>(hits) / samples;
}

} // namespace core_test
