// What every executor of shading plans must compute, whatever the API: random geometry passes, tables of materials and trees of
// blends, in every bit what scalar C++ computes. `run` executes a plan.
#pragma once

#include "ao/conformance/pictures.hpp"
#include "ao/conformance/shade_reference.hpp"
#include "ao/half.hpp"
#include "unit/picture_test.hpp"

#include <catch2/catch.hpp>

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <random>
#include <utility>
#include <vector>

namespace shade_test {

using ao::pixel_format;
using picture_test::differing;

// A scene without meshes but with everything that shading reads.
class random_scene {
public:
    random_scene(unsigned seed, bool maps, bool reflections, int blends) : random_(seed)
    {
        for (int i = 0; i < (maps || reflections ? 5 : 0); ++i) {
            add_texture(i);
        }
        for (int i = 0; i < 6; ++i) {
            materials_.push_back(material(maps, reflections));
        }
        for (int i = 0; i < blends; ++i) {
            // Children are materials or earlier blends, so that there is no cycle.
            const auto child = [&] { return i > 0 && chance(0.6F) ? -1 - below(i) : below(6); };
            blends_.push_back({ child(), child(), unit(), maps && chance(0.5F) ? below(5) : ao::no_texture });
        }
        for (int i = 0; i < 12; ++i) {
            ao::object o;
            o.material = blends > 0 && i % 2 == 0 ? -1 - (blends - 1 - below((blends + 1) / 2)) : below(6);
            objects_.push_back(o);
        }
        for (int i = 0; i < 3; ++i) {
            ao::light l;
            l.type = i == 0 ? ao::light_type::directional : ao::light_type::point;
            l.vector = { 4 * unit() - 2, 4 * unit(), 4 * unit() - 5 };
            l.color = { 2 * unit(), 2 * unit(), 2 * unit() };
            l.attenuation = { 1, unit(), unit() };
            lights_.push_back(l);
        }
        for (glm::vec3& c : ambient_.coefficients) {
            c = { unit() - 0.3F, unit() - 0.3F, unit() - 0.3F };
        }
        mesh_.indices = {};
    }
    ao::scene get() const
    {
        ao::scene s;
        s.meshes = { &mesh_, 1 };
        s.textures = textures_;
        s.materials = materials_;
        s.blends = blends_;
        s.objects = objects_;
        s.lights = lights_;
        s.ambient = ambient_;
        return s;
    }
    float unit() { return std::uniform_real_distribution<float>(0.0F, 1.0F)(random_); }
    int below(int n) { return std::uniform_int_distribution<int>(0, n - 1)(random_); }
    bool chance(float p) { return unit() < p; }

private:
    ao::standard_material material(bool maps, bool reflections)
    {
        const auto color = [&] { return glm::vec3(unit(), unit(), unit()); };
        const auto map = [&](bool wanted) { return wanted && chance(0.6F) ? below(5) : ao::no_texture; };
        ao::standard_material m;
        m.ambient = color();
        m.diffuse = color();
        m.specular = color();
        m.emission = color() * 0.1F;
        m.shininess = chance(0.2F) ? 0.0F : 200 * unit() * unit();
        m.model = chance(0.5F) ? ao::specular_model::phong : ao::specular_model::blinn;
        m.repeat = { 3 * unit(), -2 * unit() };
        m.diffuse_map = map(maps);
        m.specular_map = map(maps);
        m.normal_map = map(maps);
        m.normal_green_down = chance(0.5F);
        m.reflection_map = map(reflections);
        return m;
    }
    void add_texture(int i)
    {
        ao::texture t;
        t.width = 1 + below(19);
        t.height = 1 + below(7);
        t.srgb = chance(0.5F);
        t.wrap_u = static_cast<ao::wrap_mode>(i % 3);
        t.wrap_v = static_cast<ao::wrap_mode>(below(3));
        std::vector<std::uint8_t>& texels = texels_[static_cast<std::size_t>(i)];
        texels.resize(4 * static_cast<std::size_t>(t.width * t.height));
        for (std::uint8_t& texel : texels) {
            texel = static_cast<std::uint8_t>(below(256));
        }
        t.texels = texels;
        textures_.push_back(t);
    }

    std::mt19937 random_;
    std::array<std::vector<std::uint8_t>, 5> texels_;
    std::vector<ao::texture> textures_;
    std::vector<ao::standard_material> materials_;
    std::vector<ao::blend_node> blends_;
    std::vector<ao::object> objects_;
    std::vector<ao::light> lights_;
    ao::ambient_light ambient_;
    ao::mesh mesh_;
};

// What a geometry pass of the scene could hold, in an order that none would.
inline ao::conformance::shade_inputs random_inputs(random_scene& from, const ao::shade_facts& f,
                                                   const ao::camera_projection& projection)
{
    const auto noise = ao::conformance::make_noise(f.width, f.height, 17);
    ao::conformance::shade_inputs in;
    in.geometry = ao::pack_depth(noise.depth, f.width, f.height,
                                 f.stored_position ? ao::depth_source::position : ao::depth_source::hardware,
                                 f.stored_position ? f.position_format : f.depth_format, projection);
    in.normal = ao::pack_normals(noise.normals, f.width, f.height, f.normals, f.normal_format);
    in.ids = ao::picture(pixel_format::rg32ui, f.width, f.height);
    in.surface = ao::picture(pixel_format::rgba32f, f.width, f.height);
    in.frame = ao::picture(pixel_format::rgba32f, f.width, f.height);
    in.visibility = ao::picture(f.visibility_format, f.width, f.height);
    const ao::scene s = from.get();
    const auto other = ao::conformance::make_noise(f.width, f.height, 23);
    for (std::size_t i = 0; i < in.ids.pixels(); ++i) {
        const int object = from.below(13) - 1;
        const std::uint32_t code =
            object < 0 ? 0U : static_cast<std::uint32_t>(s.objects[static_cast<std::size_t>(object)].material + 1);
        in.ids.set_texel(i, glm::uvec2(object + 1, code));
        const float footprint = std::exp(12 * from.unit() - 14);
        in.surface.set_texel(i, glm::vec4(6 * from.unit() - 3, 6 * from.unit() - 3, footprint, from.chance(0.5F) ? 1.0F : -1.0F));
        in.frame.set_texel(
            i, ao::math<float>::ao_packed_frame(noise.normals[i], other.normals[i], from.chance(0.5F) ? 1.0F : -1.0F));
        if (f.bent_normal) {
            // Some of them are no directions.
            const glm::vec3 d = (from.chance(0.1F) ? 0.0F : from.chance(0.1F) ? std::nanf("") : 1.0F) * other.normals[i];
            in.visibility.set_texel(i, std::array{ ao::float_to_half(from.unit()), ao::float_to_half(d.x), ao::float_to_half(d.y),
                                                   ao::float_to_half(d.z) });
        }
        else if (f.visibility_format == pixel_format::r8) {
            in.visibility.set_texel(i, static_cast<std::uint8_t>(from.below(256)));
        }
        else {
            in.visibility.set_texel(i, from.chance(0.1F) ? -1.0F : from.unit());
        }
    }
    return in;
}

inline ao::shade_camera camera(bool parallel)
{
    ao::projection_options options;
    options.range = ao::depth_range::minus_one_to_one;
    options.parallel = parallel;
    ao::shade_camera c;
    c.projection = parallel ? ao::make_projection({ -2, 1.5, -1, 1.2, 0.5, 40 }, options)
                            : ao::make_projection({ -0.8, 0.7, -0.5, 0.45, 0.1, 50 }, options);
    // A rotation about (1, 2, 2) / 3 by 90 degrees, then a translation.
    c.view = ao::matrix4(glm::mat4(1.0F / 9, 8.0F / 9, -4.0F / 9, 0, -4.0F / 9, 4.0F / 9, 7.0F / 9, 0, 8.0F / 9, 1.0F / 9,
                                   4.0F / 9, 0, 0.5F, -1.5F, 2.5F, 1));
    return c;
}

inline ao::shade_facts facts()
{
    ao::shade_facts f;
    f.width = 61;
    f.height = 37;
    return f;
}

struct outcome {
    ao::picture color;
    std::uint64_t clamped = 0;
};

// What the plan does not read must not be handed over.
using run_function = std::function<outcome(const ao::shade_plan&, const ao::texel_heap&, const ao::conformance::shade_inputs&)>;

// What `run` makes, having the reference's bits.
inline outcome require_bits(const run_function& run, const ao::shade_plan& plan, const ao::texel_heap& heap,
                            const ao::conformance::shade_inputs& in)
{
    ao::conformance::shade_executor<float> reference(plan, heap, in);
    reference.run();
    outcome made = run(plan, heap, in);
    REQUIRE(differing(made.color, ao::conformance::reference_color(plan, heap, in)) == 0);
    REQUIRE(made.clamped == reference.clamped());
    return made;
}

// Returns the clamped weights.
inline std::uint64_t require_reference(const run_function& run, const ao::shade_plan& plan, const ao::texel_heap& heap,
                                       const ao::conformance::shade_inputs& in)
{
    return require_bits(run, plan, heap, in).clamped;
}

// Kinds 0 to 5: with and without maps and reflections, stored positions, parallel projection, formats of normals and visibility.
inline void check_shading(const run_function& run, int first_kind = 0, int last_kind = 5)
{
    for (int kind = first_kind; kind <= last_kind; ++kind) {
        const bool maps = (kind & 1) != 0;
        const bool reflections = (kind & 2) != 0;
        random_scene scene(static_cast<unsigned>(kind) + 1, maps, reflections, 0);
        ao::shade_facts f = facts();
        f.stored_position = kind == 4;
        f.parallel = kind == 5;
        f.visibility = kind != 2;
        f.visibility_format = kind == 1 ? pixel_format::r8 : pixel_format::r32f;
        f.normals = kind == 3   ? ao::normal_source::unorm10
                    : kind == 0 ? ao::normal_source::octahedral
                                : ao::normal_source::vector;
        f.normal_format = kind == 3 ? pixel_format::rgb10a2 : kind == 0 ? pixel_format::rg16 : pixel_format::rgba16f;
        f.depth_format = pixel_format::d32f;
        const auto view = camera(f.parallel);
        const auto plan = ao::make_shade_plan(scene.get(), f, view);
        REQUIRE(plan);
        CHECK(plan->options.maps == maps);
        CHECK(plan->options.reflections == reflections);
        const auto heap = ao::make_texel_heap(scene.get().textures);
        REQUIRE(heap);
        INFO("kind " << kind);
        require_reference(run, *plan, *heap, random_inputs(scene, f, view.projection));
    }
}

// Fused, cut into segments, and as in the paper.
inline void check_blending(const run_function& run, const std::vector<int>& register_counts = { 16, 2, 1 })
{
    for (const bool maps : { false, true }) {
        for (const int registers : register_counts) {
            random_scene scene(40 + static_cast<unsigned>(registers), maps, maps, 14);
            const ao::shade_facts f = facts();
            const auto view = camera(false);
            ao::blend_settings settings;
            settings.registers = registers;
            const auto plan = ao::make_shade_plan(scene.get(), f, view, settings);
            REQUIRE(plan);
            CHECK(plan->options.blends);
            CHECK((plan->targets != 0) == (registers != 16));
            CHECK(plan->options.frames == maps);
            const auto heap = ao::make_texel_heap(scene.get().textures);
            REQUIRE(heap);
            INFO("maps " << maps << ", registers " << registers << ", passes " << plan->passes.size());
            require_reference(run, *plan, *heap, random_inputs(scene, f, view.projection));
        }
    }
}

// Ambient light along bent normals, and visibility tinted by the albedo, with leaves that have normals of their own.
inline void check_openings(const run_function& run)
{
    for (const auto& [bent, bounces] : { std::pair(true, false), std::pair(false, true), std::pair(true, true) }) {
        random_scene scene(91, true, true, 14);
        ao::shade_facts f = facts();
        f.bent_normal = bent;
        f.multi_bounce = bounces;
        f.visibility_format = bent ? pixel_format::rgba16f : pixel_format::r32f;
        const auto view = camera(false);
        const auto plan = ao::make_shade_plan(scene.get(), f, view);
        REQUIRE(plan);
        CHECK(plan->options.frames);
        const auto heap = ao::make_texel_heap(scene.get().textures);
        REQUIRE(heap);
        INFO("bent normals " << bent << ", bounces " << bounces);
        const auto inputs = random_inputs(scene, f, view.projection);
        const ao::picture color = require_bits(run, *plan, *heap, inputs).color;
        // Neither option is without effect.
        ao::shade_plan without = *plan;
        (bounces ? without.options.multi_bounce : without.options.bent_normal) = false;
        CHECK(differing(color, ao::conformance::reference_color(without, *heap, inputs)) > 100);
    }
}

// Weights outside [0, 1] are clamped and counted.
inline void check_clamping(const run_function& run)
{
    random_scene scene(77, false, false, 6);
    const ao::shade_facts f = facts();
    const auto view = camera(false);
    ao::blend_settings settings;
    settings.fixed_k = false;
    auto plan = ao::make_shade_plan(scene.get(), f, view, settings);
    REQUIRE(plan);
    const auto heap = ao::make_texel_heap({});
    REQUIRE(heap);
    const auto inputs = random_inputs(scene, f, view.projection);
    ao::set_weight(*plan, 3, 1.5F);
    ao::set_weight(*plan, 4, -0.5F);
    ao::set_weight(*plan, 5, std::nanf(""));
    CHECK(require_reference(run, *plan, *heap, inputs) > 0);
}

} // namespace shade_test
