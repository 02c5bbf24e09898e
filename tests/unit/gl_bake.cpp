// Ambient occlusion per vertex in OpenGL against the reference, bit for bit.
#include "ao/gl/bake.hpp"
#include "unit/bake_cube_cases.hpp"
#include "unit/gl_hostile.hpp"

#include <string>

using namespace gl_test;
using namespace bake_test;

namespace {

ao::gl::baker make_baker(const ao::gl::options& chosen = {}, const ao::bake_gpu_options& cut = {})
{
    auto made = ao::gl::baker::create(context().loader(), chosen, cut);
    REQUIRE(made);
    return std::move(*made);
}

} // namespace

TEST_CASE("OpenGL bakes as the reference does, in every bit, by every route, from SPIR-V and from text")
{
    for (const ao::gl::shader_source source : { ao::gl::shader_source::spirv, ao::gl::shader_source::text }) {
        auto gl = make_baker({ .source = source });
        CHECK(gl.chosen().source == source);
        check_sums([&](const auto& job, const auto& request) { return gl.run(job, request); });
    }
}

TEST_CASE("OpenGL bakes parts, and meshes of nothing, in groups of any size")
{
    auto first_owner = make_baker({ .group_width = 5, .group_height = 3 });
    ao::gl::baker gl = std::move(first_owner);
    check_parts([&](const auto& job, const auto& request) { return gl.run(job, request); });
}

TEST_CASE("a bake in OpenGL says how far it is, ends when told, and goes on where it ended")
{
    auto gl = make_baker({ .group_width = 8, .group_height = 8 }, { .launch_seconds = 1e-9, .scratch = 1 });
    check_progress([&](const auto& job, const auto& request) { return gl.run(job, request); });
}

TEST_CASE("a bake in OpenGL leaves the host's state as it was, also between launches")
{
    auto gl = make_baker();
    const auto job = job_of(sphere_on_floor(), *ao::lebedev_rule(26), {});
    const auto expected = ao::bake_reference(job);
    const hostile_state hostile;
    const std::string before = snapshot();
    for (const ao::bake_route route : gpu_routes) {
        bool same = true;
        ao::bake_request request{ .route = route };
        request.progress = [&](double) {
            same = same && snapshot() == before;
            return true;
        };
        const auto sums = gl.run(job, request);
        REQUIRE(sums);
        CHECK(same);
        CHECK(snapshot() == before);
        CHECK(differing_sums(*sums, *expected) == 0);
    }
}

TEST_CASE("cube maps in OpenGL are the reference's in every texel that is looked up")
{
    for (const std::uint32_t texels : { 1U, 9U, 24U }) {
        auto gl = make_baker({ .group_width = 8, .group_height = 4 },
                             { .scratch = texels == 9 ? 1U : 1U << 24U, .cube_texels = texels });
        const auto run = [&](const auto& job, const auto& request) { return gl.run(job, request); };
        check_cube(run, static_cast<int>(texels));
        if (texels == 9) {
            check_cube_progress(run);
        }
    }
}

TEST_CASE("OpenGL refuses to bake what it cannot, and says why")
{
    auto gl = make_baker();
    check_refusals([&](const auto& job, const auto& request) { return gl.run(job, request); });
    CHECK(ao::gl::baker::create(ao::gl::backend::get_proc_address{ nullptr }).error().code() == ao::errc::device);
}
