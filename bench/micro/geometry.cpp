// The geometry pass: without maps against a pass written by hand, and with the courtyard's maps against without; shading the
// same. Interleaved medians of one run, as Markdown.
#include "micro/measure.hpp"
#include "micro/plain_pass.hpp"
#include "micro/scene_runners.hpp"
#include "scene/camera.hpp"
#include "scene/courtyard.hpp"
#include "scene/drawn.hpp"

#include <glm/geometric.hpp>

#include <cstdio>
#include <memory>
#include <string>
#include <vector>

namespace {

using namespace ao;
using namespace ao::bench;
using host::scene_picture;

constexpr int width = 1280;
constexpr int height = 720;

enum class maps { all, none };

// The courtyard, with all its maps or none of them.
const tools::scene& courtyard(maps which)
{
    static const tools::scene full = tools::courtyard();
    static const tools::scene plain = [] {
        tools::scene s = full;
        for (standard_material& m : s.materials) {
            m.alpha_map = m.normal_map = m.diffuse_map = m.specular_map = m.reflection_map = no_texture;
        }
        for (blend_node& b : s.blends) {
            b.mask = no_texture;
        }
        return s;
    }();
    return which == maps::all ? full : plain;
}

gbuffer_camera view()
{
    const tools::camera c = tools::courtyard_camera();
    const tools::frustum f =
        tools::perspective(c, static_cast<float>(width) / height, tools::clip_range(tools::bounds_of(courtyard(maps::all)), c));
    projection_options options;
    options.range = depth_range::minus_one_to_one;
    const auto wide = [](float x) { return static_cast<double>(x); };
    gbuffer_camera camera;
    camera.projection =
        make_projection({ wide(f.left), wide(f.right), wide(f.bottom), wide(f.top), wide(f.near), wide(f.far) }, options);
    camera.view = matrix4(tools::view_matrix(c));
    camera.previous_projection = camera.projection;
    camera.previous_view = camera.view;
    return camera;
}

gbuffer_facts position_and_normal()
{
    gbuffer_facts f;
    f.width = width;
    f.height = height;
    f.position = true;
    return f;
}

// Without maps, every pixel but edges where two surfaces' depths are as good as the same.
void require_same(host::scene_runner& ours, plain_pass& plain)
{
    const picture by_hand = take(plain.position());
    const picture drawn = take(ours.download(scene_picture::position));
    std::size_t apart = 0;
    for (std::size_t i = 0; i < drawn.pixels(); ++i) {
        const glm::vec4 difference = drawn.texel<glm::vec4>(i) - by_hand.texel<glm::vec4>(i);
        apart += glm::dot(difference, difference) > 1e-6F ? 1 : 0;
    }
    if (apart > drawn.pixels() / 1000) {
        stop("the plain pass draws another picture: " + std::to_string(apart) + " pixels");
    }
}

void compare_with_plain()
{
    const tools::scene& whole = courtyard(maps::none);
    const tools::scene_view shown(whole);
    const gbuffer_camera camera = view();
    std::vector<contestant> field;
    const auto plain =
        std::shared_ptr(take(plain_pass::create({ whole.positions, whole.normals, whole.triangles }, width, height)));
    field.push_back(
        { "a plain pass of one draw", [=] { return plain->run(camera.view.to_glm(), camera.projection.matrix.to_glm()); }, {} });
    field.back().run();
    for (const bool restore : { false, true }) {
        gl::raster_options o;
        o.restore_state = restore;
        const std::shared_ptr<host::scene_runner> ours = take(host::make_gl_scene_runner({}, o));
        take(ours->load(shown.get(), position_and_normal()));
        field.push_back(
            { restore ? "ao::gl, restoring the host's state" : "ao::gl", [=] { return take(ours->draw(camera)); }, {} });
        field.back().run();
        require_same(*ours, *plain);
        if (restore) {
            const host::draw_counts n = ours->counts();
            std::printf("## Position and normal at %dx%d, %zu triangles, %zu objects in %zu draw calls\n\n", width, height,
                        whole.triangles.size(), n.draws, n.calls);
        }
    }
    measure(field, 41);
    std::printf("| pass | ms | times plain |\n|---|---|---|\n");
    for (const contestant& each : field) {
        std::printf("| %s | %.2f | %.3f |\n", each.name.c_str(), each.median(), each.median() / field[0].median());
    }
    std::printf("\n");
}

// A runner with the courtyard drawn and shading prepared.
std::shared_ptr<host::scene_runner> prepared(std::string_view backend, tools::scene_view& shown)
{
    light sun;
    sun.vector = { 0.4F, 1.0F, 0.3F };
    shown.set_lights({ sun }, ambient_light(glm::vec3(0.4F)));
    const scene s = shown.get();
    shade_facts shading;
    shading.width = width;
    shading.height = height;
    shading.stored_position = true;
    const gbuffer_camera camera = view();
    const shade_plan plan = take(make_shade_plan(s, shading, { camera.projection, camera.view }));
    gbuffer_facts f = position_and_normal();
    f.ids = true;
    f.surface = plan.options.maps || plan.options.frames;
    f.frame = plan.options.frames;
    std::shared_ptr<host::scene_runner> made = scene_runner_of(backend);
    take(made->load(s, f));
    take(made->draw(camera));
    take(made->prepare_shading(plan, take(make_texel_heap(s.textures))));
    return made;
}

void compare_maps(std::string_view backend)
{
    const gbuffer_camera camera = view();
    std::vector<contestant> field;
    std::vector<host::draw_counts> counts;
    for (const maps which : { maps::none, maps::all }) {
        tools::scene_view shown(courtyard(which));
        const auto runner = prepared(backend, shown);
        counts.push_back(runner->counts());
        field.push_back({ "draw", [=] { return take(runner->draw(camera)); }, {} });
        field.push_back({ "shade", [=] { return take(runner->shade()); }, {} });
    }
    measure(field, 9);
    std::printf("## Maps, %s, the courtyard at %dx%d\n\n| | geometry pass, ms | shading, ms | variants | programs |\n"
                "|---|---|---|---|---|\n",
                std::string(backend).c_str(), width, height);
    for (std::size_t i = 0; i < 2; ++i) {
        std::printf("| %s | %.2f | %.2f | %zu | %zu |\n", i == 0 ? "no maps" : "its maps", field[2 * i].median(),
                    field[2 * i + 1].median(), counts[i].variants, counts[i].programs);
    }
    std::printf("| times | %.2f | %.2f | | |\n\n", field[2].median() / field[0].median(), field[3].median() / field[1].median());
    std::fflush(stdout);
}

} // namespace

// Takes and ignores Google Benchmark's options, which ./run bench gives to every program.
int main()
{
    compare_with_plain();
    for (const std::string& backend : names_of_scene_runners()) {
        compare_maps(backend);
    }
}
