// A few pixels of a geometry pass made by hand, what shades them, and what they are by the textbook.
#pragma once

#include "ao/conformance/shade_reference.hpp"
#include "ao/half.hpp"

#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <random>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace core_test {

struct shaded_pixel {
    glm::dvec3 position{ 0, 0, -5 }; // view space
    glm::dvec3 normal{ 0, 0, 1 };
    glm::dvec2 uv{ 0.5 };
    float footprint = 0;
    float side = 1;
    float visibility = 1;
    glm::vec3 opening{ 0, 0, 1 }; // stored with visibility where the fixture has bent normals
    int material = 0;
    bool background = false;
    glm::vec4 frame{ 0 };
};

// A row of pixels, a scene and a camera.
struct shading_fixture {
    std::vector<shaded_pixel> pixels;
    std::vector<std::vector<std::uint8_t>> bytes;
    std::vector<ao::texture> textures;
    std::vector<ao::standard_material> materials;
    std::vector<ao::blend_node> blends;
    std::vector<ao::object> objects;
    std::vector<ao::light> lights;
    ao::ambient_light ambient;
    ao::shade_camera camera{ ao::make_projection({}), {} };
    std::vector<glm::vec3> positions{ { 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 } };
    std::vector<glm::vec2> uvs = std::vector<glm::vec2>(3);
    std::vector<glm::vec4> tangents = std::vector<glm::vec4>(3, glm::vec4(1, 0, 0, 1));
    std::vector<std::uint32_t> indices{ 0, 1, 2 };
    std::vector<ao::mesh> meshes{ 1 };
    bool stored_position = true;
    bool visibility = true;
    bool bent_normal = false;
    bool multi_bounce = false;

    int add_texture(int width, int height, std::vector<std::uint8_t> texels, bool srgb = false)
    {
        bytes.push_back(std::move(texels));
        ao::texture t;
        t.width = width;
        t.height = height;
        t.srgb = srgb;
        textures.push_back(t);
        return static_cast<int>(textures.size()) - 1;
    }
    // One texel.
    int add_texture(std::array<std::uint8_t, 4> texel) { return add_texture(1, 1, { texel.begin(), texel.end() }); }

    // One object per material that a pixel has, so that all of them are in use.
    ao::scene scene()
    {
        for (std::size_t i = 0; i < textures.size(); ++i) {
            textures[i].texels = bytes[i];
        }
        meshes[0].positions = positions;
        meshes[0].uvs = uvs;
        meshes[0].tangents = tangents;
        meshes[0].indices = indices;
        objects.clear();
        for (const shaded_pixel& p : pixels) {
            ao::object o;
            o.material = p.material;
            objects.push_back(o);
        }
        ao::scene s;
        s.meshes = meshes;
        s.textures = textures;
        s.materials = materials;
        s.blends = blends;
        s.objects = objects;
        s.lights = lights;
        s.ambient = ambient;
        return s;
    }
    ao::shade_plan plan(const ao::blend_settings& settings = {})
    {
        ao::shade_facts f;
        f.width = static_cast<int>(pixels.size());
        f.height = 1;
        f.stored_position = stored_position;
        f.normal_format = ao::pixel_format::rgba32f;
        f.visibility = visibility;
        f.bent_normal = bent_normal;
        f.visibility_format = bent_normal ? ao::pixel_format::rgba16f : ao::pixel_format::r32f;
        f.multi_bounce = multi_bounce;
        auto made = ao::make_shade_plan(scene(), f, camera, settings);
        if (!made) {
            throw std::runtime_error(std::string(made.error().reason()));
        }
        return std::move(*made);
    }
    ao::conformance::shade_inputs inputs() const
    {
        using enum ao::pixel_format;
        const int width = static_cast<int>(pixels.size());
        ao::conformance::shade_inputs in;
        in.geometry = ao::picture(stored_position ? rgba32f : d32f, width, 1);
        in.normal = in.surface = in.frame = ao::picture(rgba32f, width, 1);
        in.ids = ao::picture(rg32ui, width, 1);
        in.visibility = ao::picture(bent_normal ? rgba16f : r32f, width, 1);
        for (std::size_t i = 0; i < pixels.size(); ++i) {
            const shaded_pixel& p = pixels[i];
            if (stored_position) {
                in.geometry.set_texel(i, glm::vec4(glm::vec3(p.position), 1));
            }
            else {
                const ao::matrix4& m = camera.projection.matrix;
                in.geometry.set_texel(
                    i, static_cast<float>((static_cast<double>(m[2][2]) * p.position.z + static_cast<double>(m[3][2])) /
                                          (static_cast<double>(m[2][3]) * p.position.z)));
            }
            in.normal.set_texel(i, glm::vec4(glm::vec3(p.normal), 0));
            in.surface.set_texel(i, glm::vec4(glm::vec2(p.uv), p.footprint, p.side));
            in.frame.set_texel(i, p.frame);
            in.ids.set_texel(i, p.background ? glm::uvec2(0)
                                             : glm::uvec2(static_cast<unsigned>(i + 1), static_cast<unsigned>(p.material + 1)));
            if (bent_normal) {
                in.visibility.set_texel(i, std::array{ ao::float_to_half(p.visibility), ao::float_to_half(p.opening.x),
                                                       ao::float_to_half(p.opening.y), ao::float_to_half(p.opening.z) });
                continue;
            }
            in.visibility.set_texel(i, p.visibility);
        }
        return in;
    }
    template <class Real = float>
    std::vector<glm::vec<4, Real>> shade(const ao::shade_plan& p, std::uint64_t* clamped = nullptr)
    {
        const auto heap = ao::make_texel_heap(scene().textures);
        const ao::conformance::shade_inputs in = inputs();
        ao::conformance::shade_executor<Real> run(p, *heap, in);
        const std::vector<glm::vec<4, Real>> color = run.run().texels;
        if (clamped != nullptr) {
            *clamped = run.clamped();
        }
        return color;
    }
    template <class Real = float>
    std::vector<glm::vec<4, Real>> shade(const ao::blend_settings& settings = {})
    {
        return shade<Real>(plan(settings));
    }
};

// The centre of the only row's pixel i at eye depth d, for the fixture's camera.
inline glm::dvec3 point_under_pixel(const ao::shade_camera& camera, std::size_t i, std::size_t width, double d)
{
    const double x = (static_cast<double>(i) + 0.5) / static_cast<double>(width) * 2 - 1;
    return { x * d / static_cast<double>(camera.projection.matrix[0][0]), 0, -d };
}

inline double apart(const glm::dvec3& a, const glm::dvec3& b)
{
    return std::max({ std::abs(a.x - b.x), std::abs(a.y - b.y), std::abs(a.z - b.z) });
}

// Everything in world space and double, as textbooks have it. No maps.
inline glm::dvec3 textbook(const shading_fixture& f, const shaded_pixel& p, const ao::standard_material& m)
{
    glm::dmat4 view(1);
    for (int c = 0; c < 4; ++c) {
        for (int r = 0; r < 4; ++r) {
            view[c][r] = static_cast<double>(f.camera.view[c][r]);
        }
    }
    const glm::dmat4 to_world = glm::inverse(view);
    const glm::dvec3 position = glm::dvec3(to_world * glm::dvec4(p.position, 1));
    const glm::dvec3 normal = glm::normalize(glm::dmat3(to_world) * p.normal);
    const glm::dvec3 to_eye = glm::normalize(glm::dvec3(to_world[3]) - position);
    glm::dvec3 color = glm::dvec3(m.ambient) * glm::dvec3(f.ambient.coefficients[0]) * static_cast<double>(p.visibility) +
                       glm::dvec3(m.emission);
    for (const ao::light& l : f.lights) {
        glm::dvec3 towards = glm::normalize(glm::dvec3(l.vector));
        glm::dvec3 light(l.color);
        if (l.type == ao::light_type::point) {
            const glm::dvec3 way = glm::dvec3(l.vector) - position;
            const double d = glm::length(way);
            towards = way / d;
            light /= static_cast<double>(l.attenuation.x) + static_cast<double>(l.attenuation.y) * d +
                     static_cast<double>(l.attenuation.z) * d * d;
        }
        const double cosine = glm::dot(normal, towards);
        if (cosine <= 0) {
            continue;
        }
        const glm::dvec3 mirrored = 2 * cosine * normal - towards;
        const double base = m.model == ao::specular_model::phong ? glm::dot(mirrored, to_eye)
                                                                 : glm::dot(normal, glm::normalize(towards + to_eye));
        const double highlight = std::pow(std::clamp(base, 0.0, 1.0), static_cast<double>(m.shininess));
        color += light * (glm::dvec3(m.diffuse) * cosine + glm::dvec3(m.specular) * highlight);
    }
    return color;
}

inline glm::dvec3 random_direction(std::mt19937& engine)
{
    std::normal_distribution<double> normal;
    return glm::normalize(glm::dvec3(normal(engine), normal(engine), normal(engine)));
}

inline ao::light directional(const glm::dvec3& towards, const glm::vec3& color)
{
    ao::light l;
    l.vector = glm::vec3(towards);
    l.color = color;
    return l;
}

// A leaf that only shines.
inline ao::standard_material lamp(const glm::vec3& color)
{
    ao::standard_material m;
    m.ambient = m.diffuse = glm::vec3(0);
    m.emission = color;
    return m;
}

inline glm::dvec3 rgb(const glm::vec4& color)
{
    return { color.x, color.y, color.z };
}

} // namespace core_test
