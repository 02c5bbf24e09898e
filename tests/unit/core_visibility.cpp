// From a depth buffer to shaded light, with scalar C++: an open plane keeps its ambient light to the bit, the floor of a pit has
// the share of it that sees out. Taking occlusion for visibility fails both.
#include "unit/core_geometry.hpp"

#include "ao/conformance/shade_reference.hpp"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

using namespace core_test;

namespace {

constexpr double degrees = 3.14159265358979323846 / 180;

// A G-buffer seen by a viewer, and its two stages.
struct seen_scene {
    viewer view;
    pictures buffer;
    ao::settings settings;

    ao::picture visibility() const
    {
        const ao::plan plan = plan_for(buffer, settings, view.camera(), view.parallel);
        const auto depth = ao::pack_depth(buffer.depth, view.width, view.height, ao::depth_source::linear, ao::pixel_format::r32f,
                                          view.camera().projection);
        return ao::conformance::reference_visibility(plan, depth, normals());
    }
    // One material under ambient light and a lamp in the eye's direction; nothing but visibility differs between calls.
    ao::picture shaded(const ao::picture* visibility) const
    {
        ao::standard_material material;
        material.ambient = { 1.0F, 0.5F, 0.25F };
        material.diffuse = glm::vec3(0.25F);
        ao::light lamp;
        lamp.vector = { 0, 0, 1 };
        const ao::mesh none;
        const ao::object object;
        ao::scene s;
        s.meshes = { &none, 1 };
        s.materials = { &material, 1 };
        s.objects = { &object, 1 };
        s.lights = { &lamp, 1 };
        s.ambient = ao::ambient_light(glm::vec3(0.5F));
        ao::shade_facts f;
        f.width = view.width;
        f.height = view.height;
        f.stored_position = true;
        f.normal_format = ao::pixel_format::rgba32f;
        f.parallel = view.parallel;
        f.visibility = visibility != nullptr;
        const auto plan = ao::make_shade_plan(s, f, { view.camera().projection, {} });
        REQUIRE(plan);
        const auto heap = ao::make_texel_heap({});
        REQUIRE(heap);
        ao::conformance::shade_inputs in;
        in.geometry = ao::pack_depth(buffer.depth, view.width, view.height, ao::depth_source::position, ao::pixel_format::rgba32f,
                                     view.camera().projection);
        in.normal = normals();
        in.ids = ao::picture(ao::pixel_format::rg32ui, view.width, view.height);
        for (std::size_t i = 0; i < in.ids.pixels(); ++i) {
            in.ids.set_texel(i, buffer.depth[i] > 0 ? glm::uvec2(1, 1) : glm::uvec2(0));
        }
        if (visibility != nullptr) {
            in.visibility = *visibility;
        }
        return ao::conformance::reference_color(*plan, *heap, in);
    }

private:
    ao::picture normals() const
    {
        return ao::pack_normals(buffer.normals, view.width, view.height, ao::normal_source::vector, ao::pixel_format::rgba32f);
    }
};

ao::picture inverted(const ao::picture& visibility)
{
    ao::picture occlusion = visibility;
    for (std::size_t i = 0; i < occlusion.pixels(); ++i) {
        occlusion.set_texel(i, 1 - visibility.texel<float>(i));
    }
    return occlusion;
}

// Share of the half ball over the floor of a deep shaft x0 ... x1, y0 ... y1 that lies within the shaft; the surface is at the
// origin, lengths in radii. Height above the floor integrates in closed form, the rest as a sum.
double open_share(double x0, double x1, double y0, double y1)
{
    const int steps = 400;
    double volume = 0;
    for (int i = 0; i < steps; ++i) {
        const double x = x0 + (x1 - x0) * (i + 0.5) / steps;
        for (int j = 0; j < steps; ++j) {
            const double y = y0 + (y1 - y0) * (j + 0.5) / steps;
            volume += std::sqrt(std::max(0.0, 1 - x * x - y * y));
        }
    }
    return volume * (x1 - x0) * (y1 - y0) / (static_cast<double>(steps) * steps) / (120 * degrees); // 2 pi / 3
}

constexpr int first_floor = 20; // the pit's floor, pixels either way
constexpr int last_floor = 43;

// A shaft as deep as three radii, seen from straight above.
seen_scene pit()
{
    const viewer v{ 64, 64, 3.2, true }; // 0.1 a pixel
    seen_scene s{ v, pictures(v.width, v.height, 2.0F), {} };
    for (int y = first_floor; y <= last_floor; ++y) {
        for (int x = first_floor; x <= last_floor; ++x) {
            s.buffer.depth[s.buffer.index(x, y)] = 8.0F;
        }
    }
    s.settings.method = ao::method::hemisphere;
    s.settings.radius = 2;
    s.settings.thickness = std::numeric_limits<float>::infinity();
    s.settings.filter = 1;
    s.settings.taps = 256;
    return s;
}

// Whether the pit's floor has the ambient light that closed form and sampling law allow, beside the lamp's.
bool pit_is_lit(const seen_scene& s, const ao::picture& color)
{
    const ao::picture open = s.shaded(nullptr);
    const double radius = static_cast<double>(s.settings.radius);
    double sum = 0;
    double variance = 0;
    int pixels = 0;
    bool right = true;
    for (int y = first_floor; y <= last_floor; y += 3) {
        for (int x = first_floor; x <= last_floor; x += 3) {
            const double share = open_share((first_floor - x - 0.5) * 0.1 / radius, (last_floor - x + 0.5) * 0.1 / radius,
                                            (first_floor - y - 0.5) * 0.1 / radius, (last_floor - y + 0.5) * 0.1 / radius);
            const std::size_t i = s.buffer.index(x, y);
            const glm::dvec3 lost = glm::dvec3(open.texel<glm::vec4>(i)) - glm::dvec3(color.texel<glm::vec4>(i));
            const double of_law = share * (1 - share) / s.settings.taps;
            for (int channel = 0; channel < 3; ++channel) {
                const double ambient = 0.5 * std::exp2(-channel);
                right = right && std::abs(lost[channel] / ambient - (1 - share)) < 4.5 * std::sqrt(of_law) + 1e-6;
            }
            sum += lost.x / 0.5 - (1 - share);
            variance += of_law;
            ++pixels;
        }
    }
    CAPTURE(sum / pixels, std::sqrt(variance) / pixels);
    return right && std::abs(sum) < 4 * std::sqrt(variance) + 1e-6 * pixels;
}

} // namespace

TEST_CASE("An open plane keeps its ambient light to the bit", "[core][visibility]")
{
    const double tilt = GENERATE(0.0, 35.0);
    const viewer v{ 48, 36, 0.3, false };
    const glm::dvec3 n(std::sin(tilt * degrees), 0, std::cos(tilt * degrees));
    seen_scene s{ v, v.picture(plane(n, -5 * n.z)), {} };
    s.settings.bias = 0.1F; // more than the depth changes within half a pixel at this tilt: 5 * 0.3 / 36 * tan(35 degrees)
    const ao::picture visibility = s.visibility();
    const ao::picture without = s.shaded(nullptr);
    CHECK(s.shaded(&visibility).bytes == without.bytes);
    const ao::picture occlusion = inverted(visibility);
    CHECK(s.shaded(&occlusion).bytes != without.bytes);
    CHECK(without.texel<glm::vec4>(0).x > 0.5F);
}

TEST_CASE("The floor of a pit has the share of ambient light that sees out", "[core][visibility]")
{
    const seen_scene s = pit();
    const ao::picture visibility = s.visibility();
    const ao::picture color = s.shaded(&visibility);
    CHECK(pit_is_lit(s, color));
    const ao::picture occlusion = inverted(visibility);
    CHECK_FALSE(pit_is_lit(s, s.shaded(&occlusion)));
    CHECK_FALSE(pit_is_lit(s, s.shaded(nullptr)));

    // Darker than the brink, which is open to the bit away from the picture's depth steps.
    const std::size_t middle = s.buffer.index(32, 32);
    const std::size_t corner = s.buffer.index(first_floor, first_floor);
    const std::size_t brink = s.buffer.index(2, 2);
    const ao::picture open = s.shaded(nullptr);
    CHECK(color.texel<glm::vec4>(brink) == open.texel<glm::vec4>(brink));
    CHECK(color.texel<glm::vec4>(middle).x < open.texel<glm::vec4>(middle).x);
    CHECK(color.texel<glm::vec4>(corner).x < color.texel<glm::vec4>(middle).x);
}
