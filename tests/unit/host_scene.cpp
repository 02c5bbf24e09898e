// Runners of scenes: what each backend draws it shades as scalar C++ does, given the same pictures all shade the same, and
// requests that do not fit are refused.
#include "host/scene_runner.hpp"

#include "ao/conformance/shade_reference.hpp"
#include "unit/picture_test.hpp"

#include <glm/gtc/matrix_transform.hpp>

#include <array>
#include <string>
#include <vector>

using ao::host::scene_picture;
using picture_test::differing;

namespace {

constexpr int width = 61;
constexpr int height = 45;

// A floor of two blended materials by a mask, and a wall before it.
struct world {
    std::vector<glm::vec3> positions{ { -1, 0, 1 }, { 1, 0, 1 }, { 1, 0, -1 }, { -1, 0, -1 } };
    std::vector<glm::vec3> normals = std::vector<glm::vec3>(4, glm::vec3(0, 1, 0));
    std::vector<glm::vec2> uvs{ { 0, 1 }, { 1, 1 }, { 1, 0 }, { 0, 0 } };
    std::vector<std::uint32_t> indices{ 0, 1, 2, 0, 2, 3 };
    std::vector<std::uint8_t> checks{ 255, 40, 40, 255, 30, 200, 30, 255, 90, 90, 250, 255, 20, 20, 20, 255 };
    std::vector<std::uint8_t> ramp{ 0, 0, 0, 255, 255, 255, 255, 255 };
    std::vector<ao::mesh> meshes{ 1 };
    std::vector<ao::texture> textures{ 2 };
    std::vector<ao::standard_material> materials{ 2 };
    std::vector<ao::blend_node> blends{ { 0, 1, 0, 1 } };
    std::vector<ao::object> objects{ 2 };
    std::vector<ao::light> lights{ 1 };

    ao::scene get()
    {
        meshes[0].positions = positions;
        meshes[0].normals = normals;
        meshes[0].uvs = uvs;
        meshes[0].indices = indices;
        textures[0] = { 2, 2, true, ao::wrap_mode::repeat, ao::wrap_mode::repeat, checks };
        textures[1] = { 2, 1, false, ao::wrap_mode::clamp, ao::wrap_mode::clamp, ramp };
        materials[0].diffuse_map = 0;
        materials[1].diffuse = { 0.2F, 0.3F, 0.9F };
        materials[1].specular = glm::vec3(0.5F);
        objects[0].material = -1;
        objects[0].model = ao::matrix4(glm::scale(glm::mat4(1), glm::vec3(3)));
        objects[1].material = 1;
        objects[1].model =
            ao::matrix4(glm::translate(glm::mat4(1), { 0, 1, -1 }) * glm::rotate(glm::mat4(1), 1.5707963F, glm::vec3(1, 0, 0)));
        ao::scene s{ meshes, textures, materials, blends, objects, lights, {} };
        s.ambient = ao::ambient_light(glm::vec3(0.4F));
        return s;
    }
};

ao::gbuffer_facts facts()
{
    ao::gbuffer_facts f;
    f.width = width;
    f.height = height;
    f.ids = f.surface = true;
    return f;
}

ao::gbuffer_camera camera()
{
    ao::gbuffer_camera c;
    c.projection = ao::make_projection({ -0.7, 0.7, -0.5, 0.5, 0.5, 40 });
    c.view =
        ao::matrix4(glm::rotate(glm::mat4(1), 0.5F, glm::vec3(1, 0, 0)) * glm::translate(glm::mat4(1), glm::vec3(0, -2.5F, -5)));
    return c;
}

ao::shade_plan plan(const ao::scene& s, const ao::gbuffer_facts& f)
{
    ao::shade_facts known;
    known.width = f.width;
    known.height = f.height;
    known.depth_format = f.depth_format;
    known.normal_format = f.normal_format;
    const auto made = ao::make_shade_plan(s, known, { camera().projection, camera().view });
    REQUIRE(made);
    return *made;
}

template <class T>
T take(ao::result<T> r)
{
    if (!r) {
        FAIL(std::string(r.error().reason()));
    }
    return std::move(*r);
}

ao::picture visibility()
{
    ao::picture v(ao::pixel_format::r32f, width, height);
    for (std::size_t i = 0; i < v.pixels(); ++i) {
        v.set_texel(i, static_cast<float>(i % 7) / 6);
    }
    return v;
}

ao::conformance::shade_inputs inputs_of(ao::host::scene_runner& r)
{
    ao::conformance::shade_inputs in;
    in.geometry = take(r.download(scene_picture::depth));
    in.normal = take(r.download(scene_picture::normal));
    in.ids = take(r.download(scene_picture::ids));
    in.surface = take(r.download(scene_picture::surface));
    in.visibility = visibility();
    return in;
}

std::vector<ao::host::scene_runner_ptr> all_runners()
{
    auto runners = take(ao::host::make_scene_runners("all"));
#ifdef AO_HAS_VK
    for (auto& each : runners) {
        if (each->backend() == "vk") {
            each = take(ao::host::make_vk_scene_runner({ .device = {}, .validation = true }));
        }
    }
#endif
    return runners;
}

template <class T>
std::string reason(const ao::result<T>& r)
{
    REQUIRE_FALSE(r);
    return std::string(r.error().reason());
}

} // namespace

TEST_CASE("every backend shades what it drew as the reference does, and what others drew alike", "[host][scene]")
{
    world w;
    const ao::scene s = w.get();
    const auto heap = take(ao::make_texel_heap(s.textures));
    const ao::shade_plan p = plan(s, facts());
    const ao::conformance::shade_inputs* first = nullptr;
    ao::conformance::shade_inputs kept;
    for (const auto& r : all_runners()) {
        INFO(r->name() << " on " << r->device());
        static_cast<void>(take(r->load(s, facts())));
        CHECK(take(r->draw(camera())) >= 0);
        CHECK(r->counts().draws == 2);
        CHECK(r->counts().variants == 1);
        const ao::conformance::shade_inputs in = inputs_of(*r);
        std::array<std::size_t, 3> seen{};
        for (std::size_t i = 0; i < in.ids.pixels(); ++i) {
            ++seen[in.ids.texel<glm::uvec2>(i).x];
        }
        CHECK((seen[0] > 100 && seen[1] > 100 && seen[2] > 100));

        static_cast<void>(take(r->prepare_shading(p, heap)));
        static_cast<void>(take(r->shade()));
        ao::conformance::shade_inputs open = in;
        for (std::size_t i = 0; i < open.visibility.pixels(); ++i) {
            open.visibility.set_texel(i, 1.0F);
        }
        const ao::picture plain = take(r->download(scene_picture::color));
        static_cast<void>(take(r->upload(scene_picture::visibility, in.visibility)));
        static_cast<void>(take(r->shade()));
        const ao::picture color = take(r->download(scene_picture::color));
        CHECK(differing(color, plain) > 1000);
        CHECK(take(r->clamped_weights()) == 0);
        if (r->exact()) {
            CHECK(differing(plain, ao::conformance::reference_color(p, heap, open)) == 0);
            CHECK(differing(color, ao::conformance::reference_color(p, heap, in)) == 0);
        }
        if (first == nullptr) {
            kept = in;
            first = &kept;
            continue;
        }
        // The first backend's pictures, in targets that nothing was drawn to.
        static_cast<void>(take(r->make_targets(facts())));
        static_cast<void>(take(r->upload(scene_picture::depth, first->geometry)));
        static_cast<void>(take(r->upload(scene_picture::normal, first->normal)));
        static_cast<void>(take(r->upload(scene_picture::ids, first->ids)));
        static_cast<void>(take(r->upload(scene_picture::surface, first->surface)));
        CHECK(differing(take(r->download(scene_picture::ids)), first->ids) == 0);
        static_cast<void>(take(r->prepare_shading(p, heap)));
        static_cast<void>(take(r->upload(scene_picture::visibility, first->visibility)));
        static_cast<void>(take(r->shade()));
        if (r->exact()) {
            CHECK(differing(take(r->download(scene_picture::color)), ao::conformance::reference_color(p, heap, *first)) == 0);
        }
        CHECK(r->messages().empty());
    }
}

TEST_CASE("lights, weights and transforms change between frames; bad weights are clamped and counted", "[host][scene]")
{
    world w;
    w.blends.push_back({ 0, 1, 0.5F, ao::no_texture });
    ao::scene s = w.get();
    w.objects[0].material = -2;
    const auto heap = take(ao::make_texel_heap(s.textures));
    ao::shade_facts known;
    known.width = width;
    known.height = height;
    const auto made = ao::make_shade_plan(s, known, { camera().projection, camera().view }, { .fixed_k = false });
    for (const auto& r : all_runners()) {
        INFO(r->name());
        ao::shade_plan p = take(ao::result<ao::shade_plan>(made));
        static_cast<void>(take(r->load(s, facts())));
        static_cast<void>(take(r->draw(camera())));
        static_cast<void>(take(r->prepare_shading(p, heap)));
        static_cast<void>(take(r->shade()));
        const ao::picture before = take(r->download(scene_picture::color));
        w.lights[0].color = glm::vec3(3, 2, 1);
        s.lights = w.lights;
        ao::set_lights(p, s);
        static_cast<void>(take(r->update_shading(p)));
        static_cast<void>(take(r->shade()));
        const ao::picture lit = take(r->download(scene_picture::color));
        CHECK(differing(before, lit) > 500);

        CHECK(take(r->clamped_weights()) == 0);
        ao::set_weight(p, 1, 7.0F);
        static_cast<void>(take(r->update_shading(p)));
        static_cast<void>(take(r->shade()));
        const ao::picture ids = take(r->download(scene_picture::ids));
        std::size_t floor = 0;
        for (std::size_t i = 0; i < ids.pixels(); ++i) {
            floor += ids.texel<glm::uvec2>(i).x == 1 ? 1 : 0;
        }
        CHECK(take(r->clamped_weights()) == floor);

        world moved = w;
        moved.objects[1].model[3][0] += 1;
        ao::scene other = s;
        other.objects = moved.objects;
        static_cast<void>(take(r->move(other)));
        static_cast<void>(take(r->draw(camera())));
        CHECK(differing(take(r->download(scene_picture::ids)), ids) > 50);
        w.lights[0].color = glm::vec3(1);
        s.lights = w.lights;
    }
}

TEST_CASE("what does not fit the targets is refused, and why", "[host][scene]")
{
    using Catch::Matchers::Contains;
    world w;
    const ao::scene s = w.get();
    const auto heap = take(ao::make_texel_heap(s.textures));
    for (const auto& r : all_runners()) {
        INFO(r->name());
        ao::gbuffer_facts f = facts();
        static_cast<void>(take(r->make_targets(f)));
        CHECK_THAT(reason(r->upload(scene_picture::motion, ao::picture(ao::pixel_format::rg32f, width, height))),
                   Contains("no motion picture"));
        CHECK_THAT(reason(r->upload(scene_picture::ids, ao::picture(ao::pixel_format::rg32f, width, height))),
                   Contains("the ids picture has another size or format"));
        CHECK_THAT(reason(r->upload(scene_picture::depth, ao::picture(f.depth_format, width, height + 1))), Contains("depth"));
        CHECK_THAT(reason(r->upload(scene_picture::visibility, visibility())), Contains("no visibility"));
        CHECK_THAT(reason(r->upload(scene_picture::color, visibility())), Contains("no color"));
        CHECK_THAT(reason(r->download(scene_picture::position)), Contains("no position picture"));

        const ao::shade_plan p = plan(s, f);
        f.surface = false;
        static_cast<void>(take(r->make_targets(f)));
        CHECK_THAT(reason(r->prepare_shading(p, heap)), Contains("surface"));
        f = facts();
        f.width = 7;
        static_cast<void>(take(r->make_targets(f)));
        CHECK_THAT(reason(r->prepare_shading(p, heap)), Contains("another size"));
        f = facts();
        f.depth_format = ao::pixel_format::d24;
        static_cast<void>(take(r->make_targets(f)));
        CHECK_THAT(reason(r->prepare_shading(p, heap)), Contains("depth"));

        world broken = w;
        broken.objects[0].mesh = 3;
        CHECK_THAT(reason(r->load(broken.get(), facts())), Contains("no mesh 3"));
        static_cast<void>(take(r->load(s, facts())));
        ao::gbuffer_camera bad = camera();
        bad.projection.matrix[0][0] = 0;
        CHECK(r->draw(bad).error().code() == ao::errc::invalid_projection);
    }
    CHECK_THAT(reason(ao::host::make_scene_runners("metal")), Contains("unknown backend"));
}
