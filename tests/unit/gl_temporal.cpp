// OpenGL's executor of temporal plans.
#include "ao/gl/temporal.hpp"
#include "unit/cpu_allocations.hpp"
#include "unit/gl_hostile.hpp"
#include "unit/temporal_cases.hpp"

#include <string>
#include <utility>

using namespace gl_test;
using namespace temporal_test;
using Catch::Matchers::Contains;

namespace {

ao::host::temporal_runner_ptr make_runner(const ao::gl::options& o = {})
{
    auto made = ao::host::make_gl_temporal_runner({}, o);
    REQUIRE(made);
    return std::move(*made);
}

ao::gl::temporal make_gl(const ao::gl::options& o = {})
{
    auto made = ao::gl::temporal::create(context().loader(), o);
    REQUIRE(made);
    return std::move(*made);
}

std::vector<std::uint32_t> words_of(const ao::gl::temporal_program& program, const ao::temporal_plan& p, int which)
{
    std::vector<std::uint32_t> words(ao::history_bytes(p) / 4);
    entry<decltype(glGetNamedBufferSubData)>("glGetNamedBufferSubData")(
        program.history(which), 0, static_cast<GLsizeiptr>(ao::history_bytes(p)), words.data());
    return words;
}

} // namespace

TEST_CASE("OpenGL accumulates as scalar C++ does, in every bit, histories included")
{
    auto runner = make_runner({ .source = ao::gl::shader_source::spirv });
    CHECK(runner->name() == "gl (compute, SPIR-V)");
    check_cases(*runner);
    check_rest(*runner);
}

TEST_CASE("OpenGL accumulates the same from GLSL text")
{
    auto runner = make_runner({ .source = ao::gl::shader_source::text });
    CHECK(runner->name() == "gl (compute, text)");
    check_cases(*runner);
}

TEST_CASE("OpenGL accumulates the same in groups of any size")
{
    for (const auto& [across, down] : { std::pair{ 8U, 8U }, std::pair{ 64U, 1U }, std::pair{ 5U, 3U } }) {
        auto runner = make_runner({ .group_width = across, .group_height = down });
        check_case(*runner, base_case("groups", true, 33, 17));
    }
}

TEST_CASE("OpenGL refuses temporal requests that make no sense, and goes on")
{
    auto runner = make_runner();
    check_bad_requests(*runner);
}

TEST_CASE("hostile state changes no bit of a history, and is put back where that is asked for")
{
    temporal_case c = base_case("hostile");
    c.facts.frame.depth = ao::depth_source::hardware;
    c.facts.frame.depth_format = ao::pixel_format::d24;
    c.frames = 5;
    const auto frames = make_sequence(c);
    const ao::conformance::temporal_inputs& first = frames[0].frame.inputs;
    auto depth = upload(first.depth);
    auto normal = upload(first.normal);
    auto motion = upload(first.motion);
    const auto visibility = make_texture(ao::pixel_format::r32f, c.facts.frame.width, c.facts.frame.height);
    for (const bool restore : { true, false }) {
        const hostile_state host;
        AO_ENTRY(TextureParameteri);
        TextureParameteri(depth.name, GL_DEPTH_STENCIL_TEXTURE_MODE, GL_STENCIL_INDEX);
        TextureParameteri(depth.name, GL_TEXTURE_COMPARE_MODE, GL_COMPARE_REF_TO_TEXTURE);
        TextureParameteri(motion.name, GL_TEXTURE_SWIZZLE_R, GL_ONE);
        auto gl = make_gl({ .restore_state = restore });
        host.set_unpack();
        const std::string before = snapshot();
        auto plan = ao::make_temporal_plan(c.settings, c.facts);
        REQUIRE(plan);
        auto program = gl.prepare_temporal(*plan);
        REQUIRE(program);
        auto bound = gl.bind_temporal(*program, *plan, { depth.name, normal.name, motion.name, visibility.name });
        REQUIRE(bound);
        CHECK(snapshot() == before);
        ao::temporal_state state;
        executor reference = make_executor(c.settings, c.facts);
        for (const sequence_frame& f : frames) {
            // The host's own uploads are to arrive.
            entry<decltype(glPixelStorei)>("glPixelStorei")(GL_UNPACK_SWAP_BYTES, GL_FALSE);
            REQUIRE(depth.upload(f.frame.inputs.depth.bytes));
            REQUIRE(normal.upload(f.frame.inputs.normal.bytes));
            REQUIRE(motion.upload(f.frame.inputs.motion.bytes));
            host.set_unpack();
            const auto frame = ao::next_frame(*plan, state, f.frame.camera);
            REQUIRE(frame);
            CHECK(frame->steps.size() == 5);
            for (std::size_t i = 0; i < frame->steps.size(); ++i) {
                gl.record_temporal({}, *program, *bound, *plan, *frame, i);
                INFO("step " << i << ", restore " << restore);
                CHECK((snapshot() == before) == restore);
            }
            CHECK(take_error() == GL_NO_ERROR);
            const picture& expected = reference.run(f.frame.inputs, f.frame.camera);
            CHECK(differing(download(visibility), stored_visibility(expected, ao::pixel_format::r32f)) == 0);
            const bool same = words_of(*program, *plan, state.latest) == reference.history();
            CHECK(same);
        }
    }
}

#if defined(AO_COUNTS_ALLOCATIONS)
TEST_CASE("a temporal frame on OpenGL allocates nothing, the state of the host put back or not")
{
    temporal_case c = base_case("allocations");
    c.frames = 12; // the filter runs, too; drivers compile in the first ones
    const auto frames = make_sequence(c);
    const ao::conformance::temporal_inputs& first = frames[0].frame.inputs;
    const auto depth = upload(first.depth);
    const auto normal = upload(first.normal);
    const auto motion = upload(first.motion);
    const auto visibility = make_texture(ao::pixel_format::r32f, c.facts.frame.width, c.facts.frame.height);
    for (const bool restore : { true, false }) {
        auto gl = make_gl({ .restore_state = restore });
        auto made = ao::temporal_effect<ao::gl::temporal>::create(gl, c.settings, c.facts);
        REQUIRE(made);
        auto bound = made->bind({ depth.name, normal.name, motion.name, visibility.name });
        REQUIRE(bound);
        int allocated = 0;
        bool failed = false;
        for (std::size_t i = 0; i < frames.size(); ++i) {
            const int before = cpu_test::allocations();
            failed = made->record({}, *bound, frames[i].frame.camera).has_value() || failed;
            allocated += i < 4 ? 0 : cpu_test::allocations() - before;
        }
        INFO("restore " << restore);
        CHECK_FALSE(failed);
        CHECK(allocated == 0);
        CHECK(take_error() == GL_NO_ERROR);
    }
}
#endif

TEST_CASE("temporal binding names the texture that does not fit")
{
    const temporal_case c = base_case("binding");
    const ao::facts& f = c.facts.frame;
    auto gl = make_gl();
    const auto plan = ao::make_temporal_plan(c.settings, c.facts);
    REQUIRE(plan);
    auto program = gl.prepare_temporal(*plan);
    REQUIRE(program);
    CHECK(program->history(0) != program->history(1));
    const auto depth = make_texture(ao::pixel_format::r32f, f.width, f.height);
    const auto four = make_texture(ao::pixel_format::rgba32f, f.width, f.height);
    const auto halves = make_texture(ao::pixel_format::rgba16f, f.width, f.height);
    const auto small = make_texture(ao::pixel_format::rgba32f, 8, 8);
    const ao::temporal_images<unsigned> good{ depth.name, four.name, four.name, depth.name };
    REQUIRE(gl.bind_temporal(*program, *plan, good));
    const auto reason = [&](const ao::temporal_images<unsigned>& images) {
        const auto bound = gl.bind_temporal(*program, *plan, images);
        REQUIRE_FALSE(bound);
        return std::string(bound.error().reason());
    };
    CHECK_THAT(reason({ 0, four.name, four.name, depth.name }), Contains("depth texture 0 is not a texture"));
    CHECK_THAT(reason({ four.name, four.name, four.name, depth.name }), Contains("depth texture") && Contains("format"));
    CHECK_THAT(reason({ depth.name, halves.name, four.name, depth.name }), Contains("normal texture") && Contains("format"));
    CHECK_THAT(reason({ depth.name, four.name, halves.name, depth.name }), Contains("motion texture") && Contains("format"));
    CHECK_THAT(reason({ depth.name, four.name, small.name, depth.name }), Contains("motion texture") && Contains("8x8"));
    CHECK_THAT(reason({ depth.name, four.name, four.name, four.name }), Contains("visibility texture") && Contains("format"));

    // What the plan leaves out is not looked at.
    temporal_case still = base_case("from depth", false);
    still.facts.frame.normals = ao::normal_source::from_depth;
    const auto less = ao::make_temporal_plan(still.settings, still.facts);
    REQUIRE(less);
    auto other = gl.prepare_temporal(*less);
    REQUIRE(other);
    CHECK(gl.bind_temporal(*other, *less, { depth.name, 0, 4711, depth.name }));
    CHECK(gl.bind_temporal(*other, *plan, good).error().code() == ao::errc::plan_mismatch);
    temporal_case longer = still; // its taps are not in the program
    longer.settings.period *= 2;
    const auto more = ao::make_temporal_plan(longer.settings, longer.facts);
    REQUIRE(more);
    CHECK(gl.bind_temporal(*other, *more, { depth.name, 0, 0, depth.name }).error().code() == ao::errc::plan_mismatch);
}

TEST_CASE("temporal executors name what the driver lacks")
{
    ao::gl::options large;
    large.group_width = large.group_height = 64;
    CHECK(ao::gl::temporal::create(context().loader(), large).error().code() == ao::errc::invalid_settings);
    CHECK_THAT(std::string(ao::gl::temporal::create(static_cast<ao::gl::backend::get_proc_address>(nullptr)).error().reason()),
               Contains("no loader"));
    auto gl = make_gl();
    temporal_case c = base_case("large");
    c.facts.frame.width = 60000;
    CHECK(gl.prepare_temporal(*ao::make_temporal_plan(c.settings, c.facts)).error().code() == ao::errc::invalid_size);
    c.facts.frame.width = c.facts.frame.height = 16384;
    const auto refused = gl.prepare_temporal(*ao::make_temporal_plan(c.settings, c.facts));
    REQUIRE_FALSE(refused);
    CHECK(refused.error().code() == ao::errc::out_of_memory);
    CHECK_THAT(std::string(refused.error().reason()), Contains("a history"));
    CHECK(take_error() == GL_NO_ERROR);
}
